"""Volumes, surfaces, stress and spring-back of packings with known answers."""

import math

import numpy as np
import pytest

from pestle.metrics.packing import (
    contact_area_fraction,
    coordination,
    facets,
    largest_cluster,
    size_distribution,
    solid_volume,
    true_volume,
)
from pestle.metrics.spring_back import spring_back
from pestle.metrics.stress import (
    mean_stress_of_contacts,
    mean_stress_of_particles,
    pressure,
    von_mises,
)
from pestle.results import Frame
from pestle.results.write import NO_MESH


def frame(position, radius, contacts=(), **particles):
    """Frame from (first, second, normal, overlap, flat, force) rows; ids from 10."""
    count = len(radius)
    rows = list(contacts)
    flat = np.array([row[4] for row in rows], float)
    owner = np.array([row[0] - 10 for row in rows], int)
    big = np.asarray(radius, float)[owner] if rows else np.zeros(0)
    return Frame(
        0,
        0.0,
        "press",
        {
            "id": np.arange(10, 10 + count),
            "position": np.asarray(position, float),
            "radius": np.asarray(radius, float),
            "radius_initial": np.asarray(radius, float),
            **particles,
        },
        {
            "first": np.array([row[0] for row in rows], int),
            "second": np.array([row[1] for row in rows], int),
            "normal": np.array([row[2] for row in rows], float).reshape(-1, 3),
            "overlap": np.array([row[3] for row in rows], float),
            "flat": flat,
            "area": np.pi * (big**2 - flat**2),
            "force": np.array([row[5] for row in rows], float).reshape(-1, 3),
        },
        dict(NO_MESH),
    )


X = (1.0, 0.0, 0.0)
Z = (0.0, 0.0, 1.0)
PAIR = frame(
    [[0.9, 0, 0], [-0.9, 0, 0]], [1.0, 1.0], [(10, 11, X, 0.2, 0.9, (5.0, 0, 0))]
)


def test_a_pair_loses_its_lens():
    lens = 2 * math.pi / 3 * 0.1**2 * (3 - 0.1)
    assert true_volume(PAIR).sum() == pytest.approx(8 / 3 * math.pi - lens)
    assert solid_volume(PAIR) == pytest.approx(8 / 3 * math.pi)


def test_facets_of_a_pair_lie_in_one_plane():
    faces = facets(PAIR)
    ends = PAIR.particles["position"][faces.particle]
    plane = np.einsum("fi,fi->f", ends, faces.normal) + faces.distance
    np.testing.assert_allclose(plane[0] * faces.normal[0], plane[1] * faces.normal[1])
    np.testing.assert_allclose(faces.normal[0], -faces.normal[1])


def test_unlike_pair_is_cut_at_the_given_plane():
    pair = frame(
        [[0.0, 0, 0], [0, 0, 2.5]],
        [1.0, 2.0],
        [(11, 10, Z, 0.5, 1.7, (0, 0, 1.0))],
    )
    caps = [math.pi / 3 * c**2 * (3 * r - c) for r, c in ((1.0, 1.0 - 0.8), (2.0, 0.3))]
    expected = 4 / 3 * math.pi * np.array([1.0, 8.0]) - caps
    np.testing.assert_allclose(true_volume(pair), expected)


def test_a_cube_of_flats_by_counting_points():
    normals = np.concatenate([np.eye(3), -np.eye(3)])
    rows = [(10, -1 - w, n, 0.15, 0.85, n) for w, n in enumerate(normals)]
    cut = frame([[0.0, 0, 0]], [1.0], rows)
    side = (np.arange(200) + 0.5) / 100 - 1.0
    x, y, z = np.meshgrid(side, side, side, sparse=True)
    inside = (x**2 + y**2 + z**2 < 1) & (abs(x) < 0.85) & (abs(y) < 0.85)
    inside &= abs(z) < 0.85
    counted = inside.sum() * 0.01**3
    assert true_volume(cut)[0] == pytest.approx(counted, rel=2e-3)


def test_pair_across_a_periodic_boundary():
    pair = frame(
        [[0.1, 0, 0], [11.9, 0, 0]], [1.0, 1.0], [(10, 11, X, 0.2, 0.9, (1.0, 0, 0))]
    )
    np.testing.assert_allclose(facets(pair).distance, [0.9, 0.9])


def test_coordination_counts_both_ends_and_walls_once():
    rows = [
        (10, 11, X, 0.1, 0.95, X),
        (10, -1, Z, 0.1, 0.9, Z),
        (11, -1, Z, -0.1, 1.1, Z),
    ]
    assert coordination(frame(np.zeros((2, 3)), [1.0, 1.0], rows)) == 1.5
    assert coordination(frame(np.zeros((0, 3)), [])) == 0.0


def test_contact_area_fraction_of_a_pair():
    area, cap = math.pi * (1 - 0.81), 2 * math.pi * 0.1
    expected = area / (4 * math.pi - cap + area)
    assert contact_area_fraction(PAIR) == pytest.approx(expected)


def test_sizes_by_volume_and_by_number():
    sizes = size_distribution(np.array([1.0] * 8 + [2.0]))
    assert sizes.by_volume[7] == pytest.approx(0.5)
    assert sizes.percentile(50.0) == pytest.approx(2.0)
    assert sizes.percentile(50.0, by="number") == pytest.approx(2.0)
    assert sizes.percentile(90.0) > 3.0
    assert sizes.span > 0


def test_column_between_plates_carries_force_over_area():
    """Two spheres between plates: stress F/A by contacts."""
    rows = [
        (10, -1, Z, 0.1, 0.9, (0, 0, 7.0)),
        (11, 10, Z, 0.2, 0.9, (0, 0, 7.0)),
        (11, -2, (0, 0, -1.0), 0.1, 0.9, (0, 0, -7.0)),
    ]
    column = frame([[0, 0, 0.9], [0, 0, 2.7]], [1.0, 1.0], rows)
    stress = mean_stress_of_contacts(column, volume=3.6 * 2.0)
    np.testing.assert_allclose(stress, np.diag([0, 0, 3.5]), atol=1e-12)


def test_stress_of_particles_is_weighed_by_volume():
    tensor = np.array([np.eye(3), 2 * np.eye(3)])
    two = frame(np.zeros((2, 3)), [1.0, 2.0], stress=tensor)
    total = 4 / 3 * math.pi * (1 + 2 * 8)
    np.testing.assert_allclose(
        mean_stress_of_particles(two, 2.0), total / 2.0 * np.eye(3)
    )


def test_invariants():
    stress = np.array([[2.0, 1.0, 0], [1.0, -1.0, 0], [0, 0, 5.0]])
    assert pressure(stress) == pytest.approx(2.0)
    turn = np.array([[0, -1.0, 0], [1.0, 0, 0], [0, 0, 1.0]])
    assert von_mises(turn @ stress @ turn.T) == pytest.approx(float(von_mises(stress)))
    assert von_mises(np.eye(3)) == pytest.approx(0.0)


def rotation(angle, axis):
    k = np.cross(np.eye(3), np.asarray(axis) / np.linalg.norm(axis)) * -1
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


def chained(position):
    """Particles that hang together one after the other."""
    rows = [(10 + n, 11 + n, X, 0.1, 0.9, X) for n in range(len(position) - 1)]
    return frame(position, np.ones(len(position)), rows)


def test_spring_back_survives_a_tumble_and_loses_no_fragment():
    rng = np.random.default_rng(2)
    before = rng.normal(size=(40, 3))
    turn = rotation(1.1, [1.0, 2.0, -0.5])
    after = (before * [1.01, 1.01, 1.04]) @ turn.T + [3.0, 0, 9.0]
    stretch = spring_back(chained(before), chained(after))
    assert stretch.axial == pytest.approx(0.04, abs=1e-12)
    assert stretch.radial == pytest.approx(0.01, abs=1e-12)
    np.testing.assert_allclose(stretch.rotation, turn, atol=1e-12)
    lost = chained(after)
    lost.particles["position"][-1] += 50.0
    for column in ("first", "second", "normal", "overlap", "flat", "area", "force"):
        lost.contacts[column] = lost.contacts[column][:-1]
    assert largest_cluster(lost).sum() == 39
    assert spring_back(chained(before), lost).axial == pytest.approx(0.04)


def test_spring_back_of_too_few_particles_is_unknown():
    few = chained(np.eye(3))
    assert np.isnan(spring_back(few, few).axial)
