"""Angle of repose of heaps whose angle is known."""

import numpy as np
import pytest

from pestle.metrics.heap import heap_of


def cone(angle, *, base=15e-3, radius=0.25e-3, seed=2, shift=0.0):
    """Spheres that fill a cone of an angle [deg] at random, one in another."""
    random = np.random.default_rng(seed)
    slope = np.tan(np.deg2rad(angle))
    top = base * slope
    place = random.uniform([-base, -base, 0.0], [base, base, top], (200_000, 3))
    far = np.hypot(place[:, 0], place[:, 1])
    place = place[place[:, 2] + radius < (base - far) * slope]
    return place + np.array([shift, -shift, 0.0]), np.full(len(place), radius)


@pytest.mark.parametrize("angle", [15.0, 25.0, 40.0])
def test_the_angle_of_a_cone_is_found(angle):
    heap = heap_of(*cone(angle))
    found, error = heap.angle
    assert error < 0.5
    assert found == pytest.approx(angle, abs=1.0)


def test_place_floor_and_strays_do_not_matter():
    place, radius = cone(25.0)
    angle = heap_of(place, radius).angle[0]
    place, radius = cone(25.0, shift=3e-3)
    assert heap_of(place, radius).angle[0] == pytest.approx(angle, abs=1e-6)
    raised = heap_of(place + np.array([0.0, 0.0, 1e-3]), radius, floor=1e-3)
    assert raised.angle[0] == pytest.approx(angle, abs=1e-6)
    far = np.array([[43e-3, -3e-3, 0.25e-3], [-37e-3, -3e-3, 0.25e-3]])
    place, radius = np.vstack([place, far]), np.append(radius, radius[:2])
    assert heap_of(place, radius).angle[0] == pytest.approx(angle, abs=0.3)


def test_the_error_says_how_far_sectors_differ():
    """A heap whose flank is steeper on one side has a larger error."""
    place, radius = cone(25.0)
    even = heap_of(place, radius).angle[1]
    steep = place.copy()
    steep[place[:, 0] > 0.0, 2] *= 1.4
    assert heap_of(steep, radius).angle[1] > 3.0 * even


def test_a_flat_layer_has_no_angle():
    place = np.zeros((3, 3))
    place[:, 0] = [0.0, 1e-3, 2e-3]
    assert np.isnan(heap_of(place, np.full(3, 5e-4)).angle[0])


def test_a_low_middle_is_not_the_flank():
    """Few particles lie on the axis; that they lie low must not widen the flank."""
    place, radius = cone(25.0)
    angle = heap_of(place, radius).angle[0]
    near = np.hypot(place[:, 0], place[:, 1]) < 0.5e-3
    place[near, 2] *= 0.5
    assert heap_of(place, radius).angle[0] == pytest.approx(angle, abs=0.2)
