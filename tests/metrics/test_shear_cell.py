"""Yield locus, Mohr circles and points of a shear cell against closed forms."""

from math import degrees, hypot, pi, radians, sin, tan

import numpy as np
import pytest

from pestle.metrics.shear_cell import ShearCurve, YieldLocus, shear_test

PHI, COHESION = radians(30.0), 300.0


def locus(cohesion=COHESION, phi=PHI):
    normal = np.array([1e3, 2e3, 3e3])
    return YieldLocus.through(normal, cohesion + tan(phi) * normal, np.full(3, 10.0))


def distance(centre, cohesion=COHESION, phi=PHI):
    """Distance of a point of the normal-stress axis from the line."""
    return (cohesion + tan(phi) * centre) / hypot(1.0, tan(phi))


def test_an_exact_line_is_found_again():
    found = locus()
    assert found.cohesion == pytest.approx(COHESION)
    assert found.friction_angle[0] == pytest.approx(30.0)


def test_unconfined_strength_is_that_of_the_textbook():
    """sigma_c = 2 c cos(phi) / (1 - sin(phi)); its circle touches the line."""
    strength, _ = locus().strength
    expected = 2.0 * COHESION * np.cos(PHI) / (1.0 - sin(PHI))
    assert strength == pytest.approx(expected)
    assert distance(strength / 2) == pytest.approx(strength / 2)


@pytest.mark.parametrize("below", [0.0, 50.0, 400.0])
def test_the_circle_of_steady_flow_passes_the_point_and_touches_the_line(below):
    normal = 4e3
    shear = COHESION + tan(PHI) * normal - below
    low, high = locus().consolidation(normal, shear)
    centre, radius = (low + high) / 2, (high - low) / 2
    assert hypot(normal - centre, shear) == pytest.approx(radius, rel=1e-6)
    assert distance(centre) == pytest.approx(radius)
    touches = centre - radius * sin(PHI)
    assert touches <= normal * (1.0 + 1e-6)


def test_without_cohesion_the_stresses_have_the_ratio_of_the_textbook():
    """sigma_1/sigma_2 = (1 + sin(phi))/(1 - sin(phi)) for a point on the line."""
    low, high = locus(0.0).consolidation(1e3, 1e3 * tan(PHI))
    assert high / low == pytest.approx((1.0 + sin(PHI)) / (1.0 - sin(PHI)), rel=1e-6)


def test_errors_are_those_of_repeated_tests():
    """Scattered points: the stated errors against the scatter of the results."""
    random = np.random.default_rng(3)
    normal, error = np.array([1e3, 2e3, 3e3, 4e3]), np.array([20.0, 40.0, 30.0, 60.0])
    found = []
    for _ in range(4000):
        shear = COHESION + tan(PHI) * normal + error * random.normal(size=4)
        one = YieldLocus.through(normal, shear, error)
        found.append((one.cohesion, one.friction_angle[0], one.strength[0]))
    exact = COHESION + tan(PHI) * normal
    line = YieldLocus.through(normal, exact, error)
    stated = line.cohesion_error, line.friction_angle[1], line.strength[1]
    np.testing.assert_allclose(np.std(found, axis=0), stated, rtol=0.06)


def test_a_scatter_beyond_the_errors_of_the_points_makes_the_errors_larger():
    normal = np.array([1e3, 2e3, 3e3])
    shear = 0.5 * normal + [100.0, -200.0, 100.0]
    calm = YieldLocus.through(normal, 0.5 * normal, np.full(3, 10.0))
    wild = YieldLocus.through(normal, shear, np.full(3, 10.0))
    assert wild.cohesion_error == pytest.approx(calm.cohesion_error * 6e4**0.5 / 10.0)


def curve(role, angle, shear, normal=1e3):
    return ShearCurve("shear", role, angle, np.full_like(angle, normal), shear)


def test_peak_and_steady_points():
    angle = np.linspace(0.001, 1.0, 1000)
    shear = 500.0 - 100.0 * np.abs(angle - 0.3)  # mean over 0.2 about the peak: 495
    normal, top, error = curve("yield", angle, shear).point()
    assert normal == pytest.approx(1e3)
    assert top == pytest.approx(495.0, abs=0.1)
    assert error < 20.0
    wave = 400.0 + 30.0 * np.sin(2.0 * pi * 10.0 * angle)
    _, steady, _ = curve("pre-shear", angle, wave).point()
    assert steady == pytest.approx(400.0, abs=0.5)


def test_a_locus_needs_two_stresses():
    angle = np.linspace(0.001, 1.0, 1000)
    one = curve("yield", angle, 400.0 + 0.0 * angle)
    other = curve("yield", angle, 800.0 + 0.0 * angle, normal=2e3)
    assert shear_test([one, one]).locus is None
    found = shear_test([one, other]).locus
    assert found.cohesion == pytest.approx(0.0, abs=1e-9)
    assert found.friction_angle[0] == pytest.approx(degrees(np.arctan(0.4)))
