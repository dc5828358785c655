"""Momentum, and set-ups that are the same but for where they stand or how they are named."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

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
from pestle.engine import step as st
from pestle.engine.engine import PairRule
from pestle.laws import Hertz

RULE = PairRule(sliding_friction=0.4, damping=0.2, rolling_friction=0.05)
STICKY = PairRule(sliding_friction=0.4, damping=0.2, work_of_adhesion=1e4)


def cloud(law, count=24, *, walls=(), **options):
    """Particles of two materials that collide; `walls` around them or none."""
    place, size = packing(count, spacing=1.9, seed=7)
    random = np.random.default_rng(5)
    rule = RULE if isinstance(law, Hertz) else STICKY
    v, w = random.normal(size=(2, count, 3))
    return Setup(
        law=law, solids=(SOFT, HARD, RIGID), particle_solids=2, position=place,
        radius=size, material=np.arange(count) % 2, velocity=4 * v - 0.8 * (place - 3),
        spin=3 * w, step=3e-4, skin=0.05, walls=walls,
        rules={(a, b): rule for a in (0, 1) for b in (0, 1, 2)}, **options,
    )  # fmt: skip


def momenta(engine):
    """Linear and angular momentum, and the sums of the sizes of their parts."""
    mass, inertia = engine.vel[:, 3:4], engine.vel[:, 7:8]
    p = mass * engine.vel[:, :3]
    spin = np.cross(engine.pos[:, :3], p) + inertia * engine.vel[:, 4:7]
    return (p.sum(0), spin.sum(0)), (np.abs(p).sum(), np.abs(spin).sum())


@pytest.mark.parametrize("law", [Hertz(), MDR], ids=["hertz", "mdr"])
@pytest.mark.parametrize("rolling", [False, True])
def test_momenta_stay_to_round_off(law, rolling):
    engine = cloud(law, rolling=rolling).engine()
    first, size = momenta(engine)
    touched = 0.0
    for _ in range(10):
        run(engine, 60)
        touched = max(touched, engine.sums[st.TOUCHING])
    last, _ = momenta(engine)
    assert touched > 15
    assert engine.rebuilds > 2
    for was, now, scale in zip(first, last, size, strict=True):
        np.testing.assert_allclose(now, was, atol=1e-14 * scale)


BOX = box_walls(-0.1, 6.0, speed=3.0, solid=2)


def turned(setup, rotation, shift=(0, 0, 0)):
    """The same set-up, turned (or mirrored) and moved."""
    move = np.array(shift, float)
    handed = np.linalg.det(rotation)  # a mirror reverses spins
    return setup.but(
        position=setup.position @ rotation.T + move,
        velocity=setup.velocity @ rotation.T, spin=handed * setup.spin @ rotation.T,
        gravity=tuple(rotation @ np.array(setup.gravity)),
        walls=tuple(
            Wall(
                point=tuple(rotation @ np.array(w.point) + move),
                normal=tuple(rotation @ np.array(w.normal)),
                speed=w.speed, solid=w.solid, radius=w.radius, height=w.height,
            )
            for w in setup.walls
        ),
    )  # fmt: skip


TURN = Rotation.from_euler("xyz", [0.3, -1.1, 2.0]).as_matrix()
QUARTER = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1.0]])
MIRROR = np.diag([-1.0, 1.0, 1.0])


@pytest.mark.parametrize("law", [Hertz(), MDR], ids=["hertz", "mdr"])
@pytest.mark.parametrize(
    "rotation", [TURN, QUARTER, MIRROR, np.eye(3)],
    ids=["turned", "quarter turn", "mirrored", "moved"],
)  # fmt: skip
def test_turned_mirrored_moved(law, rotation):
    """400 steps of a squeezed packing: differences are those of rounding, amplified."""
    setup = cloud(law, walls=BOX, gravity=(0.0, -3.0, -9.81))
    shift = (11.0, -7.0, 5.0)
    one = run(setup.engine(), 400)
    two = run(turned(setup, rotation, shift).engine(), 400)
    place = by_id(one, "pos")[:, :3] @ rotation.T + np.array(shift)
    np.testing.assert_allclose(by_id(two, "pos")[:, :3], place, atol=1e-9)
    speed = by_id(one, "vel")[:, :3] @ rotation.T
    np.testing.assert_allclose(by_id(two, "vel")[:, :3], speed, atol=1e-7)
    spin = np.linalg.det(rotation) * by_id(one, "vel")[:, 4:7] @ rotation.T
    np.testing.assert_allclose(by_id(two, "vel")[:, 4:7], spin, atol=1e-7)
    np.testing.assert_allclose(
        by_id(two, "pos")[:, 3], by_id(one, "pos")[:, 3], atol=1e-10
    )


@pytest.mark.parametrize("law", [Hertz(), MDR], ids=["hertz", "mdr"])
def test_relabelled(law):
    """Other names: other order of sums, and i and j change places in half the pairs."""
    setup = cloud(law, walls=BOX)
    order = np.random.default_rng(2).permutation(len(setup.radius))
    other = setup.but(
        position=setup.position[order], radius=setup.radius[order],
        material=setup.material[order], velocity=setup.velocity[order],
        spin=setup.spin[order],
    )  # fmt: skip
    one, two = run(setup.engine(), 400), run(other.engine(), 400)
    np.testing.assert_allclose(by_id(two, "pos"), by_id(one, "pos")[order], atol=1e-9)


@pytest.mark.parametrize("law", [Hertz(), MDR], ids=["hertz", "mdr"])
def test_two_unlike_spheres_swapped(law):
    """The answer of a pair does not depend on which is first."""
    setup = Setup(
        law=law, solids=(SOFT, HARD, RIGID), particle_solids=2, step=2e-4,
        position=np.array([[0, 0, 0], [1.2, 0.9, 0.3]]), radius=np.array([1.0, 0.55]),
        material=np.array([0, 1]), velocity=np.array([[3, 0, 0], [-3.0, 1, 0]]),
        spin=np.array([[1.0, 0, 2], [0, -1.0, 0]]),
        rules={(a, b): STICKY for a in (0, 1) for b in (0, 1)},
    )  # fmt: skip
    swapped = setup.but(
        position=setup.position[::-1], radius=setup.radius[::-1],
        material=setup.material[::-1], velocity=setup.velocity[::-1],
        spin=setup.spin[::-1],
    )  # fmt: skip
    one, two = run(setup.engine(), 300), run(swapped.engine(), 300)
    np.testing.assert_allclose(by_id(two, "vel")[::-1], by_id(one, "vel"), rtol=1e-10)


def test_scaled():
    """Lengths and times times s, speeds and stresses kept: everything else follows."""
    scale = 1e-3
    big = cloud(MDR, walls=BOX)
    small = big.but(
        position=big.position * scale, radius=big.radius * scale, step=big.step * scale,
        skin=big.skin * scale, spin=big.spin / scale,
        walls=box_walls(-0.1 * scale, 6.0 * scale, speed=3.0, solid=2),
        rules={
            key: PairRule(sliding_friction=0.4, damping=0.2, work_of_adhesion=1e4 * scale)
            for key in big.rules
        },
    )  # fmt: skip
    one, two = run(big.engine(), 400), run(small.engine(), 400)
    np.testing.assert_allclose(by_id(two, "pos") / scale, by_id(one, "pos"), atol=1e-9)


def test_galilean():
    """Seen from a moving frame (no walls) nothing changes."""
    setup = cloud(Hertz())
    drift = np.array([30.0, -20.0, 10.0])
    one = run(setup.engine(), 400)
    two = run(setup.but(velocity=setup.velocity + drift).engine(), 400)
    moved = by_id(two, "pos")[:, :3] - drift * two.time
    np.testing.assert_allclose(moved, by_id(one, "pos")[:, :3], atol=1e-9)


def test_a_head_on_pair_stays_on_its_line():
    setup = Setup(
        position=np.array([[0, 0, 0], [0, 0, 2.0]]), radius=np.ones(2), step=1e-4,
        velocity=np.array([[0, 0, 1.0], [0, 0, -1]]), rules={(0, 0): RULE},
        solids=(GLASS, RIGID),
    )  # fmt: skip
    engine = run(setup.engine(), 2000)
    assert not engine.vel[:, [0, 1, 4, 5, 6]].any()
