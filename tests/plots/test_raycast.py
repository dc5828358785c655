"""The renderer against closed forms."""

import numpy as np
import pytest
import trimesh

from pestle.plots.raycast import (
    CUT,
    FACET,
    SPHERE,
    Bodies,
    Camera,
    Window,
    cast,
)
from pestle.plots.triangles import draw_triangles

FRONT = Camera(azimuth=0.0, elevation=0.0)  # the viewer stands on +x and sees y right
WINDOW = Window(left=-1.5, bottom=-1.5, width=300, height=300, pixel=0.01)


def bodies(centre, radius, planes=()):
    """Spheres with planes (particle, normal, distance, kind)."""
    planes = sorted(planes, key=lambda plane: plane[0])
    owner = [plane[0] for plane in planes]
    return Bodies(
        np.asarray(centre, float).reshape(-1, 3),
        np.asarray(radius, float),
        np.searchsorted(owner, np.arange(len(radius) + 1)),
        np.array([plane[1] for plane in planes], float).reshape(-1, 3),
        np.array([plane[2] for plane in planes], float),
        np.array([plane[3] for plane in planes], np.int8),
    )


def grid():
    axis = -1.5 + (np.arange(300) + 0.5) * 0.01
    return axis[None, :], axis[:, None]


def test_axes_are_a_right_handed_frame():
    axes = Camera(azimuth=0.7, elevation=0.3).axes
    np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-15)
    np.testing.assert_allclose(np.cross(axes[0], axes[1]), -axes[2], atol=1e-15)
    assert FRONT.axes[2] == pytest.approx([-1.0, 0.0, 0.0])


def test_a_sphere_has_its_depth_and_normal():
    seen = cast(bodies([[0, 0, 0]], [1.0]), FRONT, WINDOW)
    y, z = grid()
    inside = y**2 + z**2 < 1
    np.testing.assert_array_equal(seen.particle >= 0, inside)
    depth = -np.sqrt(np.maximum(1 - y**2 - z**2, 0))
    np.testing.assert_allclose(seen.depth[inside], depth[inside], atol=1e-12)
    length = np.linalg.norm(seen.normal[inside], axis=1)
    np.testing.assert_allclose(length, 1.0, atol=1e-12)
    assert set(seen.kind[inside]) == {SPHERE}


def test_a_flat_toward_the_viewer_is_seen_as_a_disc():
    seen = cast(bodies([[0, 0, 0]], [1.0], [(0, (1, 0, 0), 0.8, FACET)]), FRONT, WINDOW)
    disc = seen.kind == FACET
    y, z = grid()
    np.testing.assert_array_equal(disc, y**2 + z**2 < 1 - 0.8**2)
    np.testing.assert_allclose(seen.depth[disc], -0.8)
    np.testing.assert_allclose(seen.normal[disc], [[0, 0, -1.0]] * disc.sum())


def test_a_flat_from_the_side_cuts_the_silhouette():
    seen = cast(bodies([[0, 0, 0]], [1.0], [(0, (0, 0, 1), 0.5, FACET)]), FRONT, WINDOW)
    rows = np.flatnonzero((seen.particle >= 0).any(axis=1))
    assert WINDOW.bottom + (rows[-1] + 1) * 0.01 == pytest.approx(0.5, abs=0.0101)
    assert WINDOW.bottom + rows[0] * 0.01 == pytest.approx(-1.0, abs=0.0101)


def test_the_nearer_of_two_is_seen_whatever_their_order():
    for order in ([0, 1], [1, 0]):
        centre = np.array([[2.0, 0, 0], [0, 0.3, 0]])[order]
        radius = np.array([0.5, 1.0])[order]
        seen = cast(bodies(centre, radius), FRONT, WINDOW)
        assert seen.particle[150, 150] == order.index(0)
        assert seen.particle[150, 260] == order.index(1)


def test_truncated_pair_meets_without_gap_or_overlap():
    planes = [(0, (0, 1, 0), 0.6, FACET), (1, (0, -1, 0), 0.6, FACET)]
    pair = bodies([[0, -0.6, 0], [0, 0.6, 0]], [0.8, 0.8], planes)
    seen = cast(pair, FRONT, WINDOW)
    row = seen.particle[150]
    covered = np.flatnonzero(row >= 0)
    assert np.all(np.diff(covered) == 1)
    assert (row[:150] <= 0).all()
    assert (row[150:] != 0).all()


def test_cut_opens_the_inside():
    seen = cast(bodies([[0, 0, 0]], [1.0], [(0, (1, 0, 0), 0.0, CUT)]), FRONT, WINDOW)
    inside = seen.particle >= 0
    assert set(seen.kind[inside]) == {CUT}
    assert inside.sum() * 1e-4 == pytest.approx(np.pi, rel=0.01)


def test_a_particle_cut_away_completely_is_not_seen():
    planes = [(0, (1, 0, 0), -0.5, CUT), (0, (-1, 0, 0), 0.4, CUT)]
    seen = cast(bodies([[0, 0, 0]], [1.0], planes), FRONT, WINDOW)
    assert (seen.particle < 0).all()


def box(half):
    """Mesh of a closed cube around the origin, wound outwards."""
    cube = trimesh.creation.box((2 * half,) * 3)
    return {"corner": cube.vertices, "triangle": cube.faces, "wall": np.zeros(12, int)}


@pytest.mark.parametrize(
    ("plane", "depth", "kind"), [(np.inf, -0.5, FACET), (0, 0.0, CUT)]
)
def test_a_body_of_triangles_is_whole_or_cut_and_filled(plane, depth, kind):
    seen = cast(bodies([[-1.2, 0, 0]], [0.2]), FRONT, WINDOW)
    draw_triangles(seen, box(0.5), 7, FRONT, WINDOW, plane)
    y, z = grid()
    square = np.maximum(np.abs(y), np.abs(z)) < 0.5
    np.testing.assert_array_equal(seen.particle == 7, square)
    np.testing.assert_allclose(seen.depth[square], depth, atol=1e-12)
    assert set(seen.kind[square]) == {kind}
    np.testing.assert_allclose(seen.normal[square], [[0, 0, -1]] * square.sum())


def test_a_particle_before_a_triangle_is_seen():
    seen = cast(bodies([[0.8, 0, 0]], [0.2]), FRONT, WINDOW)
    draw_triangles(seen, box(0.5), 7, FRONT, WINDOW, np.inf)
    y, z = grid()
    ball = y**2 + z**2 < 0.2**2
    np.testing.assert_array_equal(seen.particle == 0, ball)


def test_the_inside_of_a_sheet_is_no_cut():
    mesh = box(0.5)
    mesh["triangle"], mesh["wall"] = mesh["triangle"][:-1], mesh["wall"][:-1]
    seen = cast(bodies([], []), FRONT, WINDOW)
    draw_triangles(seen, mesh, 7, FRONT, WINDOW, 0.0)
    assert set(seen.kind[seen.particle == 7]) == {FACET}
