"""The ledger: work of walls and box = kinetic + stored + dissipated energy.

Each sum is made on its own; nothing is found as a remainder.  The velocities before and
after a step multiply to a kinetic energy whose change is exactly the trapezoidal work of
the forces, so a ledger closes to round-off where every contact does its sums like that.
"""

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
    lost,
    packing,
    pair,
    press,
    run,
    total,
)  # fmt: skip
from engine.test_collisions import factor, head_on, hertz, until_apart
from pestle.engine import step as st
from pestle.engine.engine import PairRule
from pestle.laws import Hertz, Solid

WORK = [st.WALL_WORK, st.BOX_WORK]


def residual(engine, before):
    """What does not close, over all the energy that went in or was there."""
    moved = engine.sums[WORK].sum() - before
    scale = (
        abs(moved) + np.abs(engine.sums[[st.STORED, st.KINETIC]]).sum() + lost(engine)
    )
    return (total(engine) + lost(engine) - moved) / scale


def energy(engine):
    """Kinetic energy of the velocities as given, stored and potential energy."""
    mass, inertia = engine.vel[:, 3], engine.vel[:, 7]
    kinetic = 0.5 * mass @ (engine.vel[:, :3] ** 2).sum(1)
    kinetic += 0.5 * inertia @ (engine.vel[:, 4:7] ** 2).sum(1)
    return kinetic - mass @ (engine.pos[:, :3] @ engine.gravity)


# ------------------------------------------------------------------ two spheres


@pytest.mark.parametrize("case", [{}, {"small": 0.3, "other": SOFT, "speed": 10.0}])
def test_elastic_collision_closes_and_converges(case):
    """Nothing is dissipated but by the trapezoid, with an order above 2 in the step."""
    spurious = []
    for parts in (50, 100, 200, 400):
        setup, *_ = head_on(**case, parts=parts)
        start = energy(setup.engine())
        engine, _ = until_apart(setup)
        assert total(engine) + lost(engine) == pytest.approx(start, rel=1e-12)
        assert engine.sums[st.NEGATIVES] == 0
        spurious.append(abs(engine.sums[st.PLASTIC]) / start)
    assert spurious[1] < 1e-6
    orders = np.log2(np.array(spurious[:-1]) / spurious[1:])
    assert orders.min() > 3.0


def rubbing(
    parts, *, e=1.0, mu=0.3, tangential=1.0, spin=0.0, rolling=0.0, stretched=False
):
    """A sphere that meets a wall at an angle."""
    time = hertz(4 / 3 * np.pi * GLASS.density, 1.0, 1 / GLASS.compliance, 1.0)[2]
    rule = PairRule(sliding_friction=mu, rolling_friction=rolling, damping=factor(e))
    return Setup(
        position=np.array([[0, 0, 1.0]]), radius=np.ones(1), walls=(Wall(),),
        velocity=[tangential, 0.2, -1.0], spin=[0.1, spin, 0.3], step=time / parts,
        rules={(0, 1): rule}, rolling=rolling > 0.0, stretched=stretched,
    )  # fmt: skip


def ledger_of(setup):
    start = energy(setup.engine())
    engine, _ = until_apart(setup)
    return (total(engine) + lost(engine)) / start - 1, engine


@pytest.mark.parametrize(
    "case",
    [
        {"mu": 50.0},
        {"mu": 0.3, "tangential": 4.0},
        {"mu": 0.3, "spin": 3.0},
        {"mu": 0.3, "spin": 3.0, "rolling": 0.2},
        {"mu": 0.3, "spin": 3.0, "stretched": True},
    ],
)
def test_friction_closes_to_round_off(case):
    gap, engine = ledger_of(rubbing(100, **case))
    assert abs(gap) < 1e-13
    assert engine.sums[st.SLIDING] > 0.0
    assert engine.sums[st.NEGATIVES] == 0


def test_two_rubbing_spheres_close():
    """The pair turns while it touches: first order, and small."""
    gaps, spin = [], np.array([[1.0, 2.0, 0.5], [-1.0, 0.3, 2.0]])
    for parts in (100, 200, 400):
        setup, *_ = head_on(small=0.6, other=SOFT, sliding_friction=0.4, parts=parts)
        velocity = setup.velocity + np.array([[0.3, 0, 0], [0, 0, 0]])
        gaps.append(abs(ledger_of(setup.but(spin=spin, velocity=velocity))[0]))
    assert gaps[2] < 1e-6
    assert gaps[0] / gaps[2] == pytest.approx(4.0, rel=0.1)


def test_tangential_dashpot_closes_with_first_order():
    """Its work is taken with the force at the end of a step."""
    gaps = [abs(ledger_of(rubbing(n, e=0.5, mu=50.0))[0]) for n in (200, 800)]
    assert gaps[0] < 2e-3
    assert gaps[0] / gaps[1] == pytest.approx(4.0, rel=0.15)


@pytest.mark.parametrize("stretched", [False, True])
def test_a_sliding_impact_converges_with_the_step(stretched):
    """First order with both sliding rules, where the dashpot acts too."""
    speeds = []
    for parts in (50, 100, 200, 400, 800, 1600):
        setup = rubbing(parts, e=0.5, tangential=2.0, spin=1.0, stretched=stretched)
        engine, _ = until_apart(setup)
        speeds.append(engine.vel[0, 0])
    changes = np.abs(np.diff(speeds))
    order = -np.polyfit(np.arange(len(changes)), np.log2(changes), 1)[0]
    assert order > 0.8
    assert changes[-1] < 1e-4


def test_dissipation_is_never_negative():
    """Sliding, rolling and dashpots only take, in every step."""
    for case in (
        {"mu": 0.3, "tangential": 2.0},
        {"mu": 0.3, "spin": -3.0, "rolling": 0.1},
    ):
        setup = rubbing(200, e=0.6, **case)
        _, rows = until_apart(setup, (st.SLIDING, st.DAMPED))
        assert np.diff(rows[:, 1:], axis=0).min() > -1e-6 * rows[-1, 1:].min()


# ------------------------------------------------------------------ laws that jump


CYCLES = {
    "wall": ((1.0,), (SOFT,), 0.0),
    "equal": ((1.0, 1.0), (SOFT,), 0.0),
    "unlike": ((1.0, 0.6), (SOFT, HARD), 0.0),
    "adhesive wall": ((1.0,), (SOFT,), 2e4),
    "adhesive equal": ((1.0, 1.0), (SOFT,), 2e4),
    "adhesive unlike": ((1.0, 0.6), (SOFT, HARD), 2e4),
}


@pytest.mark.parametrize("case", CYCLES.values(), ids=CYCLES)
def test_plastic_cycle(case):
    """Press, ease, press on, part: first order; energy from nothing at most in a jump."""
    radius, solids, adhesion = case
    results = []
    for n in (200, 400, 800, 1600):
        engine = pair(radius, solids=solids, work_of_adhesion=adhesion).engine()
        for depth in (0.2, -0.05, 0.06, -0.25):
            press(engine, depth, round(abs(depth) / 0.2 * n))
        # sides that adhesion has let go of meet again with a jump
        made = -engine.sums[st.NEGATIVE] / engine.sums[st.PLASTIC]
        assert made < 2e-5 * (200 / n) if adhesion else made == 0.0
        assert engine.sums[st.STORED] == pytest.approx(0.0, abs=1e-9)
        results.append(engine.sums[st.PLASTIC])
    steps = np.abs(np.diff(results)) / results[-1]
    assert steps[-1] < 1e-3
    # adhesion lets go at one step or the next: no smooth error there
    assert adhesion or steps[-1] < 0.75 * steps[0]


def test_a_flat_that_one_side_left_holds_nothing():
    """Both sides of unlike spheres part at once, and keep no energy."""
    engine = pair((1.0, 0.6), solids=(SOFT, HARD), work_of_adhesion=2e4).engine()
    press(engine, 0.2, 800)
    back = press(engine, -0.06, 800)
    parted = np.flatnonzero(back[:, 1])[-1]
    assert back[parted + 1 :, 2].max() < 1e-3 * back[:, 2].max()
    assert not engine.hist[0, -2:].any()  # adhered radii


def squeezed(steps, *, depth=0.24, axes=(0, 1, 2), back=1.0):
    """One particle between six walls, pressed and let go on some axes."""
    solid = Solid(youngs_modulus=1e8, poisson_ratio=0.3, density=1e30, yield_stress=5e6)
    walls = tuple(
        Wall(point=w.point, normal=w.normal, speed=1.0 if n // 2 in axes else 0.0)
        for n, w in enumerate(box_walls(-1.0, 1.0))
    )
    setup = Setup(
        position=np.zeros((1, 3)), radius=np.ones(1), solids=(solid, RIGID), law=MDR,
        walls=walls, rules={(0, 1): PairRule()}, step=depth / steps,
    )  # fmt: skip
    engine = run(setup.engine(), steps)
    for axis in axes:
        for w in (2 * axis, 2 * axis + 1):
            engine.set_program(w, np.array([0.0, 1e9]), np.full(2, -1.0))
    return run(engine, round(back * steps))


@pytest.mark.parametrize("axes", [(0,), (0, 1), (0, 1, 2)])
def test_particle_between_walls(axes):
    """Growth and bulk response: closed to round-off, energy from nothing fades out."""
    made = []
    for steps in (300, 1200):
        engine = squeezed(steps, axes=axes, depth=0.36 - 0.06 * len(axes))
        worked = engine.sums[st.WALL_WORK]
        assert total(engine) + lost(engine) == pytest.approx(worked, rel=1e-10)
        made.append(-engine.sums[st.NEGATIVE] / engine.sums[st.PLASTIC])
    assert made[1] < 2e-3
    assert made[1] <= max(0.7 * made[0], 1e-4)


# ------------------------------------------------------------------ packings


def test_elastic_packing_closes():
    """Friction, rolling, gravity, moving and curved walls."""
    place, size = packing(16, lower=(-1.9 * 1.5, -1.9 * 1.5, 0.0))
    spin = np.random.default_rng(1).normal(size=(16, 3))
    rule = PairRule(sliding_friction=0.4, rolling_friction=0.05)
    walls = (
        Wall(radius=4.0, height=30.0),
        Wall(speed=0.5),
        Wall(point=(0, 0, 6.0), normal=(0, 0, -1), speed=2.0, drive=(0.1, 0, -1.0)),
    )
    setup = Setup(
        position=place, radius=size, rules={(0, 0): rule, (0, 1): rule}, walls=walls,
        step=2e-4, spin=spin, velocity=spin[::-1], gravity=(1.0, 0.0, -9.81),
        rolling=True, skin=0.05,
    )  # fmt: skip
    engine = setup.engine()
    before = energy(engine)
    engine.start()
    before += engine.sums[st.STORED]
    run(engine, 3000)
    assert engine.rebuilds > 3
    worked = engine.sums[st.WALL_WORK]
    gap = total(engine) + lost(engine) - before - worked
    assert abs(gap) < 3e-5 * abs(worked)


def pressed(steps):
    place, size = packing(12, spacing=1.95)
    rule = {
        (a, b): PairRule(sliding_friction=0.3, damping=0.1)
        for a in (0, 1) for b in (0, 1, 2)
    }  # fmt: skip
    walls = box_walls(0.0, place.max(0) + 0.95, speed=1.0, solid=2)
    setup = Setup(
        position=place, radius=size, solids=(SOFT, HARD, RIGID), particle_solids=2,
        material=np.arange(12) % 2, rules=rule, law=MDR, walls=walls, step=0.3 / steps,
    )  # fmt: skip
    engine = setup.engine()
    engine.start()
    before = engine.sums[st.STORED]
    return run(engine, steps), before


def test_plastic_packing_closes():
    gaps = []
    for steps in (1500, 3000):
        engine, before = pressed(steps)
        worked = engine.sums[st.WALL_WORK]
        gaps.append(abs(total(engine) + lost(engine) - before - worked) / worked)
    assert gaps[1] < 1e-4
    assert gaps[1] < 0.7 * gaps[0]


def test_deforming_box_closes_with_second_order():
    gaps = []
    for steps in (250, 500, 1000):
        place, size = packing(27, spacing=1.85)
        setup = Setup(
            law=Hertz(), position=place, radius=size, lengths=(5.55,) * 3,
            rate=(-0.5, 0.3, -0.2), step=0.1 / steps,
            rules={(0, 0): PairRule(sliding_friction=0.3)},
        )  # fmt: skip
        engine = setup.engine()
        engine.start()
        before = engine.sums[st.STORED]
        run(engine, steps)
        worked = engine.sums[st.BOX_WORK]
        gaps.append(abs((total(engine) + lost(engine) - before) / worked - 1))
    assert gaps[-1] < 5e-5
    assert np.log2(gaps[0] / gaps[2]) / 2 > 1.7
