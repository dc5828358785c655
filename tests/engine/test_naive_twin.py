"""The engine does what its slow, obvious twin does."""

import numpy as np
import pytest

from engine.setups import (
    GLASS,
    HARD,
    MDR,
    RIGID,
    SOFT,
    Setup,
    Wall,
    box_walls,
    by_id,
    packing,
    run,
)  # fmt: skip
from naive import Twin
from pestle.engine.engine import PairRule
from pestle.laws import Hertz


def compare(setup, steps, *, rtol, rebuilds=2):
    """Run both; compare places, velocities, spins, radii and wall forces."""
    engine, twin = setup.engine(), Twin(setup)
    run(engine, steps)
    for _ in range(steps):
        twin.step(setup.step)
    assert engine.rebuilds >= rebuilds
    vel = by_id(engine, "vel")
    pairs = [
        (by_id(engine, "pos")[:, :3], twin.x),
        (by_id(engine, "pos")[:, 3], twin.r),
        (vel[:, :3], twin.v),
        (vel[:, 4:7], twin.w),
        (engine.total[:, :3], twin.wall_force),
        (engine.sums[1], twin.stored),
    ]
    for ours, theirs in pairs:
        largest = np.max(np.abs(theirs), initial=0.0)
        np.testing.assert_allclose(ours, theirs, rtol=0, atol=rtol * largest)
    return engine, twin


def speeds(count, seed=3, scale=1.0):
    random = np.random.default_rng(seed)
    return scale * random.normal(size=(count, 3)), scale * random.normal(
        size=(count, 3)
    )


BOTH = {
    (0, 0): PairRule(sliding_friction=0.4, rolling_friction=0.05, damping=0.2),
    (0, 1): PairRule(sliding_friction=0.2, rolling_friction=0.02, damping=0.3),
}
TWO = {
    (0, 0): PairRule(sliding_friction=0.5, damping=0.2, work_of_adhesion=2e4),
    (0, 1): PairRule(sliding_friction=0.3, damping=0.3, work_of_adhesion=1e4),
    (1, 1): PairRule(sliding_friction=0.1, damping=0.1, work_of_adhesion=5e3),
    (0, 2): PairRule(sliding_friction=0.2, damping=0.2, work_of_adhesion=8e3),
    (1, 2): PairRule(sliding_friction=0.2, damping=0.2),
}


def hertz(count=16, **options):
    place, size = packing(count)
    v, w = speeds(count)
    walls = box_walls(0.0, place.max(0) + 0.9)
    return Setup(
        position=place, radius=size, rules=BOTH, velocity=5 * v, spin=5 * w,
        walls=walls, step=5e-4, skin=0.05, gravity=(1.0, -2.0, -9.81), **options,
    )  # fmt: skip


def test_hertz_with_friction_and_walls():
    compare(hertz(), 400, rtol=1e-9)


def test_hertz_with_rolling_resistance():
    compare(hertz(rolling=True), 300, rtol=1e-9)


def test_hertz_with_spring_and_dashpot_cut_together():
    compare(hertz(stretched=True), 400, rtol=1e-9)


def test_hertz_in_a_moving_cylinder():
    place, size = packing(12, lower=(-1.9 * 1.5, -1.9 * 1.5, 0.0))
    v, w = speeds(12)
    walls = (
        Wall(radius=3.9, height=30.0),
        Wall(),
        Wall(point=(0, 0, 5.9), normal=(0, 0, -1), speed=2.0),
    )
    setup = Setup(
        position=place, radius=size, rules=BOTH, velocity=5 * v, spin=5 * w,
        walls=walls, step=5e-4, skin=0.05,
    )  # fmt: skip
    compare(setup, 400, rtol=1e-9)


def pressed(**options):
    """A dozen plastic particles, squeezed by six walls."""
    place, size = packing(12, spacing=1.95)
    v, w = speeds(12, scale=2.0)
    walls = box_walls(0.0, place.max(0) + 0.9, speed=8.0, solid=2)
    options = {
        "solids": (SOFT, HARD, RIGID), "particle_solids": 2, "rules": TWO,
        "law": MDR, "material": np.arange(12) % 2,
    } | options  # fmt: skip
    return Setup(
        position=place, radius=size, velocity=v, spin=w, walls=walls, step=3e-4,
        skin=0.08, **options,
    )  # fmt: skip


def test_mdr_of_two_materials_with_adhesion():
    _engine, twin = compare(pressed(), 250, rtol=1e-9)
    assert (twin.r / pressed().radius).max() > 1.001  # some have grown
    assert any(m.state.offset_i < 0 for m in twin.memory.values())  # and yielded
    assert min(twin.weight.values()) < 0.9  # and are screened


def test_mdr_of_one_material_up_to_the_bulk_response():
    setup = pressed(
        solids=(SOFT, RIGID), particle_solids=1, material=0,
        rules={(0, 0): TWO[0, 0], (0, 1): TWO[0, 2]},
    )  # fmt: skip
    walls = tuple(Wall(point=w.point, normal=w.normal, speed=14.0) for w in setup.walls)
    _, twin = compare(setup.but(walls=walls), 150, rtol=1e-9)
    assert sum(f.onset >= 0.0 for f in twin.fields) >= 3


def periodic(law, solid, step, rate=(0.0, 0.0, 0.0), **options):
    place, size = packing(27, spacing=1.85)
    v, w = speeds(27)
    return Setup(
        law=law, solids=(solid, RIGID), position=place, radius=size, rules=BOTH,
        velocity=v, spin=w, lengths=(5.55,) * 3, rate=rate, step=step, **options,
    )  # fmt: skip


@pytest.mark.parametrize("lengths", [(5.55, 5.55, 5.55), (5.55, 0.0, 5.55)])
def test_periodic_box_misses_no_image(lengths):
    setup = periodic(Hertz(), GLASS, 5e-4, skin=0.05).but(lengths=lengths)
    engine, twin = setup.engine(), Twin(setup)
    run(engine, 300)
    for _ in range(300):
        twin.step(5e-4)
    assert engine.rebuilds > 2
    apart = twin.image(by_id(engine, "pos")[:, :3] - twin.x)
    assert np.abs(apart).max() < 1e-9
    np.testing.assert_allclose(by_id(engine, "vel")[:, :3], twin.v, atol=1e-8)


def test_deforming_box():
    setup = periodic(Hertz(), GLASS, 5e-4, rate=(-0.5, 0.3, -0.2), skin=0.05)
    engine, twin = setup.engine(), Twin(setup)
    run(engine, 300)
    for _ in range(300):
        twin.step(5e-4)
    assert engine.rebuilds > 2
    apart = twin.image(by_id(engine, "pos")[:, :3] - twin.x)
    assert np.abs(apart).max() < 1e-9
    np.testing.assert_allclose(engine.box[0], twin.lengths, rtol=1e-12)


def test_reach_of_the_lists_changes_nothing():
    """A large particle far off makes the engine look at more distant pairs."""
    near = pressed()
    far = near.but(
        position=np.vstack([near.position, [50.0, 50.0, -1e3]]),
        radius=np.append(near.radius, 9.0), material=np.arange(13) % 2,
        velocity=np.vstack([near.velocity, np.zeros(3)]),
        spin=np.vstack([near.spin, np.zeros(3)]),
    )  # fmt: skip
    one, two = run(near.engine(), 250), run(far.engine(), 250)
    assert two.cut() > 1.5 * one.cut() > 0
    np.testing.assert_allclose(
        by_id(two, "pos")[:-1], by_id(one, "pos"), rtol=0, atol=1e-10
    )
