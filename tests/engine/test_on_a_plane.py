"""A sphere on a plane slides, rolls, rests and is slowed down by rolling resistance."""

from math import atan, cos, pi, sin

import numpy as np
import pytest

from engine.setups import GLASS, Setup, Wall, lost, run
from pestle.engine import step as st
from pestle.engine.engine import PairRule

G = 9.81
MASS = 4 / 3 * pi * GLASS.density
MODULUS = 1 / GLASS.compliance
SUNK = (3 * MASS * G / (4 * MODULUS)) ** (2 / 3)  # overlap under its own weight
LEVER = 1.0 - SUNK  # friction acts this far below the centre
# share of the speed left when a sliding sphere rolls: 5/7 with a lever of 1
ROLLS = 1 / (1 + 0.4 / LEVER**2)


def resting(*, tilt=0.0, mu=0.3, rolling=None, **options):
    """A sphere settled on a plane under gravity; the vector is tilted, not the plane."""
    rule = PairRule(
        sliding_friction=mu, rolling_friction=rolling or 0.0,
        damping=options.pop("damping", 0.5),
    )  # fmt: skip
    sunk = SUNK * cos(tilt) ** (2 / 3)
    setup = Setup(
        position=np.array([[0, 0, 1.0 - sunk]]), radius=np.ones(1), walls=(Wall(),),
        gravity=(G * sin(tilt), 0, -G * cos(tilt)), rules={(0, 1): rule}, step=2e-4,
        rolling=rolling is not None,
    )  # fmt: skip
    return setup.but(**options)


def test_slides_then_rolls():
    """Friction slows it down at mu g until v = 5/7 of the first speed; then it rolls."""
    mu, start = 0.3, 2.0
    engine = resting(mu=mu, velocity=[start, 0, 0]).engine()
    engine.start()
    until = (1 - ROLLS) * start / (mu * G)
    run(engine, int(0.8 * until / 2e-4))
    slowed = start - mu * G * (engine.time - 1e-4)  # velocities are half a step old
    assert engine.vel[0, 0] == pytest.approx(slowed, abs=2e-6)
    spun = 2.5 * LEVER * (start - engine.vel[0, 0])
    assert engine.vel[0, 5] == pytest.approx(spun, rel=1e-5)
    run(engine, int(3 * until / 2e-4))
    assert engine.vel[0, 0] == pytest.approx(ROLLS * start, rel=1e-5)
    assert pytest.approx(5 / 7, rel=5e-3) == ROLLS
    assert engine.vel[0, 0] == pytest.approx(LEVER * engine.vel[0, 5], rel=1e-6)


@pytest.mark.parametrize("stretched", [False, True])
def test_spring_of_a_sliding_contact(stretched):
    """At the limit; with the other rule what the dashpot leaves of it, gamma v less."""
    mu, damping, start = 0.3, 0.5, 2.0
    setup = resting(mu=mu, damping=damping, velocity=[start, 0, 0], stretched=stretched)
    engine = run(setup.engine(), 200)
    slip = engine.vel[0, 0] + mu * G * 1e-4 - LEVER * engine.vel[0, 5]
    assert slip > 0.5 * start
    radius = np.sqrt(SUNK)
    shear = 8 * GLASS.shear_modulus / (2 - GLASS.poisson_ratio) * radius
    drag = damping * np.sqrt(MASS * shear) * slip
    assert drag > 0.1 * mu * MASS * G
    expected = mu * MASS * G - (drag if stretched else 0.0)
    assert -engine.whist[0, 0] == pytest.approx(expected, rel=2e-3)


def test_heat_of_sliding():
    """2/7 of the kinetic energy is lost before it rolls."""
    engine = resting(velocity=[2.0, 0, 0]).engine()
    engine.start()
    run(engine, 5000)
    heat = (1 - ROLLS) * 0.5 * MASS * 4.0
    assert lost(engine) == pytest.approx(
        heat, rel=2e-3
    )  # its first half step is not seen
    assert engine.sums[st.SLIDING] > 0.9 * heat


def test_rolls_for_ever_without_resistance():
    engine = resting(velocity=[1.0, 0, 0], spin=[0, 1.0, 0]).engine()
    run(engine, 2000)
    speed = engine.vel[0, 0]
    run(engine, 10_000)
    assert engine.vel[0, 0] == pytest.approx(speed, rel=1e-6)


def test_rolling_resistance_slows_down():
    """Torque mu_r N R on a rolling sphere: dv/dt = -5/7 mu_r g."""
    mu_r = 0.02
    engine = resting(
        velocity=[1.0, 0, 0], spin=[0, 1.0, 0], rolling=mu_r
    ).engine()  # fmt: skip
    run(engine, 1000)
    speed, time = engine.vel[0, 0], engine.time
    run(engine, 4000)
    slowed = (speed - engine.vel[0, 0]) / (engine.time - time)
    assert slowed == pytest.approx(LEVER * mu_r * G / (0.4 + LEVER**2), rel=1e-3)


def test_rolling_resistance_brings_to_rest():
    engine = resting(
        velocity=[0.1, 0, 0], spin=[0, 0.1, 0], rolling=0.05
    ).engine()  # fmt: skip
    run(engine, 15_000)
    assert abs(engine.vel[0, 0]) < 1e-3


def test_sticks_below_the_angle_of_friction():
    """With rolling resistance too, a sphere stays where it is on a slope."""
    mu = 0.3
    engine = resting(tilt=0.9 * atan(mu), mu=mu, rolling=1.0).engine()
    run(engine, 20_000)
    place = engine.pos[0, 0]
    run(engine, 5000)
    assert abs(engine.pos[0, 0] - place) < 1e-6
    assert abs(engine.vel[0, 0]) < 1e-5
    assert engine.total[0, 0] == pytest.approx(
        -MASS * G * sin(0.9 * atan(mu)), rel=1e-3
    )


def test_slides_above_the_angle_of_friction():
    """Too much resistance to roll: a block on a slope, g (sin - mu cos)."""
    mu, tilt = 0.3, atan(0.5)
    engine = resting(tilt=tilt, mu=mu, rolling=1.0).engine()
    run(engine, 2000)
    v, t = engine.vel[0, 0], engine.time
    run(engine, 5000)
    acceleration = (engine.vel[0, 0] - v) / (engine.time - t)
    assert acceleration == pytest.approx(G * (sin(tilt) - mu * cos(tilt)), rel=1e-4)
    assert abs(engine.vel[0, 5]) < 0.02  # swings on the spring of the resistance


def test_rolls_down_a_slope():
    """Without resistance it rolls: 5/7 g sin, as long as mu is at least 2/7 tan."""
    tilt = 0.2
    engine = resting(tilt=tilt, mu=0.3).engine()
    run(engine, 2000)
    v, t = engine.vel[0, 0], engine.time
    run(engine, 5000)
    acceleration = (engine.vel[0, 0] - v) / (engine.time - t)
    assert acceleration == pytest.approx(ROLLS * G * sin(tilt), rel=1e-3)


def test_weight_is_carried():
    engine = run(resting().engine(), 5000)
    assert engine.total[0, 2] == pytest.approx(MASS * G, rel=1e-6)
    assert 1.0 - engine.pos[0, 2] == pytest.approx(SUNK, rel=1e-6)


def test_ledger_closes_while_sliding_and_rolling():
    setup = resting(velocity=[1.0, 0, 0], damping=0.0, rolling=0.01)
    engine = setup.engine()
    engine.start()
    start = engine.sums[st.STORED] - MASS * G * -engine.pos[0, 2] + 0.5 * MASS
    run(engine, 8000)
    end = engine.sums[[st.KINETIC, st.STORED, st.GRAVITY]].sum() + lost(engine)
    assert end == pytest.approx(start, rel=1e-10)
    assert abs(engine.sums[st.PLASTIC]) < 1e-6 * MASS  # a wall slides by at no cost
