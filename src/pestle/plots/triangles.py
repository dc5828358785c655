"""Draw the triangles of walls into what the rays have seen."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pestle import _jit
from pestle.plots.raycast import CUT, FACET, Buffers, Camera, Window


def draw_triangles(
    seen: Buffers,
    meshes: dict[str, NDArray[Any]],
    row: int,
    camera: Camera,
    window: Window,
    plane: float,
) -> None:
    """Draw triangles where they are nearer than what was drawn before.

    Where the cut goes through a closed body, it is filled.

    Parameters
    ----------
    seen : Buffers
        Changed in place.
    meshes : dict of str to ndarray
        As in `pestle.results.Frame`.
    row : int
        What the buffers call the triangles.
    camera, window : Camera, Window
        From where, through what.
    plane : float
        What is nearer to the viewer than this, horizontally, is cut away [m].
    """
    if not len(meshes["triangle"]):
        return
    ends = meshes["corner"][meshes["triangle"]]
    normal = np.cross(ends[:, 1] - ends[:, 0], ends[:, 2] - ends[:, 0])
    size = np.linalg.norm(normal, axis=1, keepdims=True)
    normal = normal / np.where(size > 0.0, size, 1.0) @ camera.axes.T
    ends = ends @ camera.axes.T
    away = normal[:, 2] > 0.0
    inner = away & _outwards(meshes)
    kind = np.where(inner & np.isfinite(plane), CUT, FACET).astype(np.int8)
    normal[away] *= -1.0
    toward = camera.axes @ camera.toward_viewer
    x = window.left + (np.arange(window.width) + 0.5) * window.pixel
    y = window.bottom + (np.arange(window.height) + 0.5) * window.pixel
    cut = (plane - toward[0] * x - toward[1] * y[:, None]) / toward[2]
    depth, face = _nearest(ends, cut, window.left, window.bottom, window.pixel)
    kinds = kind[face]
    depth = np.where((face >= 0) & (kinds == CUT), cut, depth)
    hit = depth < seen.depth
    seen.depth[hit] = depth[hit]
    seen.normal[hit] = normal[face[hit]]
    seen.kind[hit] = kinds[hit]
    seen.particle[hit] = row


def _outwards(meshes: dict[str, NDArray[Any]]) -> NDArray[np.bool_]:
    """Triangles of closed bodies that are wound to face outwards."""
    found = np.zeros(len(meshes["wall"]), dtype=np.bool_)
    for wall in np.unique(meshes["wall"]):
        mine = meshes["wall"] == wall
        triangle = meshes["triangle"][mine]
        edges = np.concatenate([triangle[:, [k, (k + 1) % 3]] for k in range(3)])
        there, back = (
            {tuple(e) for e in way.tolist()} for way in (edges, edges[:, ::-1])
        )
        ends = meshes["corner"][triangle] - meshes["corner"][triangle[0, 0]]
        found[mine] = there == back and np.linalg.det(ends).sum() > 0.0
    return found


@_jit.njit
def _nearest(ends: Any, cut: Any, left: float, bottom: float, pixel: float) -> Any:
    """Depth and number of the nearest triangle (T, 3, 3) behind the cut, by pixel.

    All in camera coordinates; -1 where there is none.
    """
    height, width = cut.shape
    depth, face = np.full(cut.shape, np.inf), np.full(cut.shape, -1)
    for t in range(len(ends)):
        ax, ay, az = ends[t, 0, 0], ends[t, 0, 1], ends[t, 0, 2]
        bx, by, bz = ends[t, 1, 0], ends[t, 1, 1], ends[t, 1, 2]
        cx, cy, cz = ends[t, 2, 0], ends[t, 2, 1], ends[t, 2, 2]
        area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        if area == 0.0:
            continue
        first = max(int((min(ax, bx, cx) - left) / pixel - 0.5), 0)
        last = min(int((max(ax, bx, cx) - left) / pixel + 1.5), width)
        low = max(int((min(ay, by, cy) - bottom) / pixel - 0.5), 0)
        high = min(int((max(ay, by, cy) - bottom) / pixel + 1.5), height)
        for i in range(low, high):
            y = bottom + (i + 0.5) * pixel
            for j in range(first, last):
                x = left + (j + 0.5) * pixel
                u = ((bx - x) * (cy - y) - (by - y) * (cx - x)) / area
                v = ((cx - x) * (ay - y) - (cy - y) * (ax - x)) / area
                w = 1.0 - u - v
                z = u * az + v * bz + w * cz
                if min(u, v, w) >= 0.0 and cut[i, j] <= z < depth[i, j]:
                    depth[i, j], face[i, j] = z, t
    return depth, face
