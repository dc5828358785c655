"""Two spheres, or a sphere and a wall, meet and part: Hertz, restitution, friction."""

from math import gamma, pi, sqrt

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from engine.setups import GLASS, RIGID, SOFT, Setup, Wall, by_id, lost, run
from pestle.engine import step as st
from pestle.engine.engine import PairRule

# duration times speed over largest overlap: integral of 2/sqrt(1 - x^2.5), 0 to 1
DURATION = 2 * sqrt(pi) * gamma(7 / 5) / gamma(9 / 10)


def factor(e):
    """Damping factor of a coefficient of restitution."""
    beta = -np.log(e) / sqrt(np.log(e) ** 2 + pi**2)
    return 2 * sqrt(5 / 6) * beta


def hertz(mass, radius, modulus, speed):
    """Largest overlap, largest force and duration."""
    deep = (15 * mass * speed**2 / (16 * modulus * sqrt(radius))) ** 0.4
    return deep, 4 / 3 * modulus * sqrt(radius) * deep**1.5, DURATION * deep / speed


def head_on(speed=1.0, *, small=1.0, other=GLASS, parts=400, **rule):
    """Two spheres about to touch, and what Hertz says; the step is T/parts."""
    solids, radius = (GLASS, other, RIGID), np.array([1.0, small])
    one, two = 4 / 3 * pi * radius**3 * [solids[0].density, solids[1].density]
    modulus = 1 / (solids[0].compliance + solids[1].compliance)
    hertzian = hertz(one * two / (one + two), small / (1 + small), modulus, speed)
    share = np.array([two, -one]) / (one + two)  # the centre of mass stands still
    setup = Setup(
        position=np.array([[0, 0, 0], [0, 0, 1.0 + small]]), radius=radius,
        velocity=np.outer(speed * share, [0, 0, 1]), step=hertzian[2] / parts,
        solids=solids, particle_solids=2, material=np.arange(2),
        rules=dict.fromkeys([(0, 0), (0, 1), (1, 1)], PairRule(**rule)),
    )  # fmt: skip
    return setup, *hertzian


def until_apart(setup, columns=(st.DEEPEST,)):
    """Run a collision to its end; sums of every step and the engine."""
    engine, rows = setup.engine(), []
    while len(rows) < 3 or engine.sums[st.TOUCHING] > 0:
        run(engine, 1)
        rows.append([engine.time, *engine.sums[list(columns)]])
    return engine, np.array(rows)


def restitution(engine, speed):
    v = by_id(engine, "vel")[:, 2]
    return (v[1] - v[0]) / speed


CASES = [
    {},
    {"speed": 0.01},
    {"speed": 20.0},
    {"small": 0.3},
    {"small": 1.7, "other": SOFT},
]


@pytest.mark.parametrize("case", CASES)
def test_hertz_collision(case):
    setup, deep, force, time = head_on(**case, parts=800)
    engine, rows = until_apart(setup, (st.DEEPEST, st.STORED))
    least = min(setup.radius)
    assert rows[:, 1].max() * least == pytest.approx(deep, rel=2e-5)
    assert rows[:, 2].max() == pytest.approx(0.4 * force * deep, rel=5e-5)
    assert rows[-1, 0] - setup.step == pytest.approx(time, abs=1.5 * setup.step)
    assert restitution(engine, case.get("speed", 1.0)) == pytest.approx(1, rel=1e-8)


def test_largest_force_on_a_wall():
    speed, mass = 1.0, 4 / 3 * pi * GLASS.density
    modulus = 1 / GLASS.compliance  # the tool is rigid
    _deep, force, time = hertz(mass, 1.0, modulus, speed)
    setup = Setup(
        position=np.array([[0, 0, 1.0]]), radius=np.ones(1), velocity=[0, 0, -speed],
        walls=(Wall(),), step=time / 400, rules={(0, 1): PairRule()},
    )  # fmt: skip
    engine, most = setup.engine(), 0.0
    for _ in range(420):
        run(engine, 1)
        most = max(most, engine.total[0, 2])
    assert most == pytest.approx(force, rel=1e-4)
    assert engine.vel[0, 2] == pytest.approx(speed, rel=1e-8)


@pytest.mark.parametrize("e", [0.05, 0.2, 0.5, 0.8, 0.95])
@pytest.mark.parametrize("speed", [0.01, 1.0, 20.0])
def test_restitution_does_not_depend_on_speed(e, speed):
    setup, *_ = head_on(speed, damping=factor(e), small=0.6)
    engine, _ = until_apart(setup)
    assert restitution(engine, speed) == pytest.approx(e, abs=1.5e-3)


def test_restitution_converges_with_the_step():
    errors = []
    for parts in (400, 1600, 6400):
        engine, _ = until_apart(head_on(damping=factor(0.3), parts=parts)[0])
        errors.append(abs(restitution(engine, 1.0) - 0.3))
    assert errors[2] < 1e-4
    assert errors[0] / errors[2] > 8  # first order: the dashpot lags half a step


# ------------------------------------------------------------------ oblique impact


def oblique(tangential, *, speed=1.0, mu=0.3, e=1.0, parts=2000, spin=0.0):
    """Sphere against a wall; its velocity, spin and the engine after the rebound."""
    mass, modulus = 4 / 3 * pi * GLASS.density, 1 / GLASS.compliance
    time = hertz(mass, 1.0, modulus, speed)[2]
    rule = PairRule(sliding_friction=mu, damping=factor(e))
    setup = Setup(
        position=np.array([[0, 0, 1.0]]), radius=np.ones(1), walls=(Wall(),),
        velocity=[tangential, 0, -speed], spin=[0, spin, 0], step=time / parts,
        rules={(0, 1): rule},
    )  # fmt: skip
    engine, _ = until_apart(setup)
    return engine, engine.vel[0, :3], engine.vel[0, 4:7]


# Maw, Barber & Fawcett (1976): a dimensionless angle of incidence decides
KAPPA = 2 * (1 - GLASS.poisson_ratio) / (2 - GLASS.poisson_ratio)  # kt / kn
CHI = 7 / 4 * KAPPA


@pytest.mark.parametrize("angle", [4 * CHI + 1, 20.0, 100.0])
def test_full_sliding(angle):
    """Tangential impulse 2 mu m v, and the spin that it gives."""
    mu, speed = 0.3, 0.02
    start = angle * mu / KAPPA * speed
    engine, v, w = oblique(start, mu=mu, speed=speed)
    assert (start - v[0]) / speed == pytest.approx(2 * mu, rel=1e-6)
    # 5/2 J R/(m R^2), less than an overlap of 0.1 % of R
    assert w[1] == pytest.approx(2.5 * (start - v[0]), rel=1e-3)
    # friction does work at the mean speed of the surface
    slip = (start + v[0] - w[1]) / 2
    heat = engine.vel[0, 3] * (start - v[0]) * slip
    assert engine.sums[st.SLIDING] == pytest.approx(heat, rel=2e-3)


def test_full_sliding_with_damping():
    """mu times the impulse of |F|: at the end the dashpot pulls, friction goes on."""
    mu, e = 0.3, 0.5
    _, v, _ = oblique(5.0, mu=mu, e=e)
    assert mu * (1 + e) < 5.0 - v[0] < 1.08 * mu * (1 + e)


def test_sliding_ends_where_maw_says():
    """From an angle of 4 chi - 1 on the sphere slides all the time (here: from - 2/3)."""
    mu = 0.3

    def part(angle):
        start = angle * mu / KAPPA
        return (start - oblique(start, mu=mu)[1][0]) / (2 * mu)

    assert part(4 * CHI - 0.5) == pytest.approx(1, abs=2e-3)
    assert part(4 * CHI - 2.0) < 0.97


def test_sticking_is_mindlins_spring_that_softens_as_the_contact_shrinks():
    """The same motion from an ODE solver: f' = -kt u, and f kt'/kt while unloading."""
    _, v, w = oblique(0.1, mu=50.0, speed=0.02)
    mass, modulus = 4 / 3 * pi * GLASS.density, 1 / GLASS.compliance
    deep, _, time = hertz(mass, 1.0, modulus, 0.02)

    def rates(_, y):
        overlap, approach, force, surface = y
        a = sqrt(max(overlap, 0.0))
        kn = 2 * modulus * a
        f = -KAPPA * kn * surface
        if approach < 0.0:
            f += force * approach / (2 * max(overlap, 1e-12 * deep))
        return approach, -2 / 3 * kn * overlap / mass, f, 3.5 * force / mass

    end = solve_ivp(
        rates, (0, time * (1 - 1e-6)), (0, 0.02, 0, 0.1), rtol=1e-9, atol=1e-14,
        max_step=time / 500,
    ).y[:, -1]  # fmt: skip
    assert v[0] - w[1] == pytest.approx(end[3], abs=5e-4)  # 0.5 % of the speed
    assert abs(end[3]) < 0.09


def test_sticking_is_linear():
    one, two = (oblique(start, mu=50.0)[1:] for start in (0.1, 0.2))
    np.testing.assert_allclose(two[0][0], 2 * one[0][0], rtol=1e-12)
    np.testing.assert_allclose(two[1], 2 * one[1], rtol=1e-12)


def test_angular_momentum_about_the_point_of_contact():
    """Friction acts at the wall: m v R - I w does not change."""
    start, spin = 0.7, 1.3
    _, v, w = oblique(start, spin=spin, e=0.7)
    # torque about the contact point at distance R - overlap: exact up to the overlap
    before, after = start + 0.4 * spin, v[0] + 0.4 * w[1]
    assert after == pytest.approx(before, rel=0.02)


def test_top_spin_throws_forward():
    _, v, _ = oblique(0.0, spin=5.0)
    assert v[0] > 0.0


def test_two_spheres_rub_like_one_on_a_wall():
    """Equal spheres, mirrored: the plane between them is a wall of half the depth."""
    setup, *_ = head_on(2.0, sliding_friction=0.3)
    tilted = setup.but(velocity=np.array([[0.5, 0, 1.0], [-0.5, 0, -1.0]]))
    engine, _ = until_apart(tilted)
    v, w = by_id(engine, "vel")[:, :3], by_id(engine, "vel")[:, 4:7]
    np.testing.assert_allclose(v[0], -v[1], atol=1e-13)
    np.testing.assert_allclose(w[0], w[1], atol=1e-13)
    assert lost(engine) > 0.0
