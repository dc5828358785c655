"""Restitution: closed forms, and the law's own work against steps in time."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from bench.test_drive import RADIUS, contact, particle
from pestle.bench import (
    SingleParticle,
    collide,
    restitution,
    sticking_velocity,
)
from pestle.errors import InputError

SPEEDS = np.geomspace(0.02, 5.0, 9)
LAWS = {
    "hertz": {},
    "jkr": {},
    "dmt": {},
    "nan2022": {},
    "thornton_ning1998": {},
    "luding2008": {
        "loading_stiffness": 1e3,
        "unloading_stiffness": 5e3,
        "cohesive_stiffness": 1e2,
    },
    "walton_braun1986": {"loading_stiffness": 1e3, "unloading_stiffness": 4e3},
}


@pytest.mark.parametrize("name", LAWS)
def test_exact_and_stepped_impacts_agree(name):
    one = contact(name, 0.0 if name == "hertz" else 0.05, **LAWS[name])
    exact = restitution(one, SPEEDS).restitution
    stepped = collide(one, SPEEDS, steps=40_000)
    np.testing.assert_allclose(stepped.restitution, exact, atol=1e-3)
    assert np.all(stepped.left == (exact > 0.0))


def test_jkr_loses_its_own_work_only():
    """e^2 = 1 - 2 W/(m V^2) with W = 7.0922 (G^5 R^4/E^2)^(1/3)."""
    jkr = contact("jkr", 0.05)
    modulus = 5e9 / 0.91
    loss = 7.0921960 * (0.05**5 * RADIUS**4 / modulus**2) ** (1.0 / 3.0)
    e2 = 1.0 - 2.0 * loss / (jkr.mass * SPEEDS**2)
    got = restitution(jkr, SPEEDS).restitution
    np.testing.assert_allclose(got, np.sqrt(np.maximum(e2, 0.0)), atol=2e-4)
    stick = np.sqrt(2.0 * loss / jkr.mass)
    assert sticking_velocity(jkr) == pytest.approx(stick, rel=1e-3)


def test_walton_braun_has_one_restitution():
    one = contact("walton_braun1986", **LAWS["walton_braun1986"])
    np.testing.assert_allclose(restitution(one, SPEEDS).restitution, 0.5, atol=1e-5)


def test_elastic_particles_never_stick():
    assert sticking_velocity(contact()) == 0.0
    assert sticking_velocity(dense()) == 0.0


def dense(configuration="simple"):
    base = particle(configuration)
    return SingleParticle(
        law=base.law, radius=base.radius, configuration=configuration, density=1500.0
    )


class TestParticle:
    @pytest.mark.filterwarnings("ignore::pestle.particle.RangeWarning")
    def test_exact_and_integrated_impacts_agree(self):
        one, speed = dense(), 1.0
        exact = restitution(one, speed)
        grid = np.linspace(0.0, 1.2 * exact.largest[0], 20_001)
        loading = one.follow(grid).force

        def push(t, y):
            return [y[1], -np.interp(y[0], grid, loading) / one.mass]

        def stops(t, y):
            return y[1]

        stops.terminal = True
        far = 10.0 * exact.largest[0] / speed
        tight = {"rtol": 1e-9, "atol": 1e-16, "events": stops}
        turn = solve_ivp(push, (0.0, far), [0.0, speed], **tight).y[0, -1]
        assert turn == pytest.approx(exact.largest[0], rel=1e-5)
        back = np.concatenate([[turn], np.linspace(0.0, turn, 20_001)[::-1]])
        unloading = one.follow(back).force[1:][::-1]

        def pull(t, y):
            f = np.interp(y[0], back[1:][::-1], unloading)
            return [y[1], -f / one.mass]

        end = solve_ivp(
            pull,
            (0.0, 3.0 * turn / speed),
            [turn, 0.0],
            rtol=1e-8,
            max_step=0.01 * turn / speed,
        )
        assert -end.y[1, -1] / speed == pytest.approx(exact.restitution[0], abs=1e-3)

    @pytest.mark.filterwarnings("ignore::pestle.particle.RangeWarning")
    def test_faster_impacts_lose_more(self):
        e = restitution(dense(), SPEEDS).restitution
        assert np.all(np.diff(e) < 0.0)
        assert np.all((e > 0.0) & (e < 1.0))

    def test_too_fast(self):
        with pytest.raises(InputError, match="takes up"):
            restitution(dense(), 1e4)


class TestOblique:
    def test_without_friction_nothing_turns(self):
        got = collide(contact(), 1.0, np.radians([10.0, 40.0, 70.0]), friction=0.0)
        np.testing.assert_allclose(got.tangential, 1.0, rtol=1e-12)
        np.testing.assert_allclose(got.restitution, 1.0, atol=1e-3)
        np.testing.assert_allclose(got.rebound_angle, got.angle, atol=1e-3)

    def test_sliding_is_rigid_body_dynamics(self):
        """Near grazing it slides throughout: the surface loses 3.5 mu (1 + e) v_n."""
        angle, mu = np.radians(80.0), 0.1
        got = collide(contact(), 1.0, angle, friction=mu)
        lost = 3.5 * mu * 2.0 * np.cos(angle) / np.sin(angle)
        assert got.tangential[0] == pytest.approx(1.0 - lost, abs=1e-3)

    def test_friction_never_gives_energy(self):
        angles = np.radians(np.linspace(1.0, 85.0, 30))
        got = collide(contact(), 1.0, angles, friction=0.5)
        assert np.all(np.abs(got.tangential) < 1.0)

    def test_damping(self):
        got = collide(contact(), SPEEDS, damping_ratio=0.3)
        assert np.all(got.restitution < 0.95)
        # hertzian dashpot of sqrt(m k): restitution does not depend on velocity
        assert np.ptp(got.restitution) < 1e-3


def test_no_impact_without_mass():
    with pytest.raises(InputError, match="must be positive"):
        restitution(particle(), 1.0)
