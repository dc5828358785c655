"""The elliptical indenter and its adhesion: integrals, energies, limits."""

from math import acos, pi, sqrt

import numpy as np
import pytest

from pestle.reference import ellipse, hertz, jkr, peeling
from pestle.reference.ellipse import Ellipse
from pestle.reference.peeling import Peel

SHAPE = Ellipse(0.05, 1.6)
SPHERE = Ellipse(4.0, 2.0)
K = {"modulus": 220.0, "work_of_adhesion": 1e-3}


def slope(function, x, d):
    near = function(x + d) - function(x - d)
    far = function(x + 2 * d) - function(x - 2 * d)
    return (8 * near - far) / (12 * d)


@pytest.mark.parametrize("part", [0.02, 0.3, 0.7, 1.0])
def test_force_is_the_formula_as_printed(part):
    """Eq. (30), where it does not cancel."""
    de, (a, b) = part * SHAPE.height / 2, SHAPE
    t = 1 - 2 * de / a
    printed = acos(t) - t * sqrt(4 * de / a - 4 * de**2 / a**2)
    assert ellipse.force(SHAPE, de, modulus=220.0) == pytest.approx(
        220.0 * a * b / 4 * printed, rel=1e-12
    )


@pytest.mark.parametrize("de", [1e-12, 1e-9, 1e-6])
def test_small_penetration_is_hertz_without_cancellation(de):
    """Next term of the series: F/F_H = 1 - (3/10) de/A + ..."""
    hertzian = hertz.force(de, 1.0, modulus=3.0)
    expected = hertzian * (1 - 0.3 * de / SPHERE.height)
    assert ellipse.force(SPHERE, de, modulus=3.0) == pytest.approx(expected, rel=2e-12)


def test_series_meets_closed_form():
    for x in (1.499999, 1.500001, 0.7):
        assert ellipse.angle_minus_sine(x) == pytest.approx(x - np.sin(x), rel=1e-14)


@pytest.mark.parametrize("part", [0.001, 0.4, 0.9])
def test_radius_is_where_the_profile_meets_the_surface(part):
    de = part * SHAPE.height / 2
    a = ellipse.contact_radius(SHAPE, de)
    assert ellipse.profile(SHAPE, a) == pytest.approx(de, rel=1e-13)
    measured = slope(lambda x: ellipse.profile(SHAPE, x), a, 1e-4 * a)
    assert ellipse.slope(SHAPE, a) == pytest.approx(measured, rel=1e-6)


@pytest.mark.parametrize("part", [1e-6, 0.3, 0.95])
def test_force_is_the_slope_of_the_stored_energy(part):
    de = part * SHAPE.height / 2

    def energy(d):
        a = ellipse.contact_radius(SHAPE, d)
        return ellipse.stored_energy(SHAPE, d, a, modulus=220.0)

    force = ellipse.force(SHAPE, de, modulus=220.0)
    assert force == pytest.approx(slope(energy, de, 1e-3 * de), rel=1e-8)


def test_force_beyond_the_equator_is_the_largest():
    assert ellipse.force(SHAPE, 1.0, modulus=2.0) == pytest.approx(
        ellipse.largest_force(SHAPE, modulus=2.0), rel=1e-14
    )


class TestPeeling:
    """Adhesion of the ellipse."""

    @pytest.mark.parametrize(("control", "xi"), [("force", 3.0), ("displacement", 1.0)])
    @pytest.mark.parametrize("w", [1e-9, 1e-3, 1.0, 1e3, 1e9])
    def test_critical_radius_solves_its_equation(self, control, xi, w):
        k = {"modulus": 220.0, "work_of_adhesion": w}
        a = peeling.critical_radius(SHAPE, **k, control=control)
        half = SHAPE.width / 2
        # dg/da = xi sqrt(pi W/(2 E a)), squared and free of poles
        left = (SHAPE.height / SHAPE.width) ** 2 * a**3
        right = xi**2 * pi * w / (2 * 220.0) * (half - a) * (half + a)
        assert 0.0 < a <= half
        assert left == pytest.approx(right, rel=1e-12) or half - a < 1e-6 * half

    def test_is_jkr_for_a_weakly_loaded_sphere(self):
        k = {"modulus": 1e9, "work_of_adhesion": 1.0}
        found = peeling.pull_off(SPHERE, 0.5, **k)
        assert found.force == pytest.approx(
            jkr.pull_off(1.0, work_of_adhesion=1.0), rel=1e-5
        )
        radius = jkr.critical_radius(1.0, **k, control="force")
        assert found.radius == pytest.approx(radius, rel=1e-5)

    def test_work_of_peeling_is_the_work_of_adhesion(self):
        """At the edge of detachment dU/da = 2 pi a W, U the energy of the springs."""
        a = 0.5
        length = peeling.detachment_length(a, **K)
        de = ellipse.profile(SHAPE, a) - length

        def energy(x):
            return ellipse.stored_energy(SHAPE, de, x, modulus=K["modulus"])

        released = slope(energy, a, 1e-3)
        assert released == pytest.approx(2 * pi * a * K["work_of_adhesion"], rel=1e-8)

    def test_held_force_is_the_slope_of_the_energy(self):
        a, de = 0.5, 0.002

        def energy(d):
            return ellipse.stored_energy(SHAPE, d, a, modulus=K["modulus"])

        force = peeling.force(SHAPE, de, a, modulus=K["modulus"])
        assert force == pytest.approx(slope(energy, de, 1e-3), rel=1e-9)

    def test_pull_off_is_the_least_force_of_an_unloading(self):
        depths = np.linspace(SHAPE.height / 2, -0.01, 40001)
        a, forces, last = 0.0, [], None
        for de in depths:
            answer = peeling.adhere(SHAPE, de, a, **K)
            if answer.state is Peel.SEPARATED:
                break
            a, last = answer.radius, (de, answer)
            forces.append(answer.force)
        found = peeling.pull_off(SHAPE, SHAPE.width / 2, **K)
        assert min(forces) == pytest.approx(found.force, rel=1e-6)
        assert last[0] == pytest.approx(found.penetration_separation, abs=2e-6)
        assert last[1].force == pytest.approx(found.force_separation, rel=0.05)

    def test_a_small_contact_separates_without_peeling(self):
        lowest = peeling.critical_radius(SHAPE, **K)
        a = 0.5 * lowest
        found = peeling.pull_off(SHAPE, a, **K)
        assert found.radius == found.radius_separation == a
        assert found.force == found.force_separation
        beyond = found.penetration_separation - 1e-9
        assert peeling.adhere(SHAPE, beyond, a, **K).state is Peel.SEPARATED
        before = found.penetration_separation + 1e-9
        assert peeling.adhere(SHAPE, before, a, **K).state is Peel.HELD

    def test_separated_contact_does_not_adhere_again_in_tension(self):
        answer = peeling.adhere(SHAPE, -1e-6, 0.0, **K)
        assert answer == (0.0, 0.0, Peel.SEPARATED)

    @pytest.mark.parametrize("de", [0.02, 0.001, 1e-6, -0.001])
    def test_without_adhesion_is_the_plain_contact(self, de):
        a = ellipse.contact_radius(SHAPE, 0.022)
        answer = peeling.adhere(SHAPE, de, a, modulus=220.0, work_of_adhesion=0.0)
        plain = ellipse.force(SHAPE, de, modulus=220.0)
        assert answer.force == pytest.approx(plain, rel=1e-13)
        assert answer.radius == ellipse.contact_radius(SHAPE, de)

    def test_scales_with_units(self):
        """Lengths by s, stresses by p, W by s p: forces by s^2 p, same states."""
        s, p = 3.1e-5, 7.7e8
        a = b = 0.0
        big = Ellipse(s * SHAPE.height, s * SHAPE.width)
        k = {"modulus": p * 220.0, "work_of_adhesion": s * p * 1e-3}
        for de in (0.02, 0.015, 0.005, 0.001, -0.0005, 0.003, -0.002):
            one = peeling.adhere(SHAPE, de, a, **K)
            two = peeling.adhere(big, s * de, b, **k)
            a, b = one.radius, two.radius
            assert two.state is one.state
            assert two.force == pytest.approx(s * s * p * one.force, rel=1e-10)
            assert b == pytest.approx(s * a, rel=1e-10)
