"""Triangle meshes as the engine's arrays: features, smooth surfaces, bins of triangles.

All of it lies in the frame of the body and never changes: a moving mesh is looked at
from its own frame.  Both sides of a triangle act, so its winding means nothing.
"""

from dataclasses import dataclass
from math import cos, radians
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from pestle import _jit

Array = npt.NDArray[Any]

CREASE = cos(radians(30.0))
"""Faces that meet at a smaller turn than 30 degrees are one smooth surface [-]."""

# columns of `face`: corners 9, normal 3, direction into the neighbour at each edge 9
NORMAL, ACROSS, FACE = 9, 12, 21
# columns of `bins`: lowest corner 3, edge, cells along x, y, z, first cell
EDGE, CELLS, BASE, BINS = 3, 4, 7, 8
MOST_CELLS = 250_000


class Meshes(NamedTuple):
    """All meshes of an engine, one after the other."""

    face: Array  # see the columns above [m]
    corner: Array  # vertices 3 and smooth surface of each triangle
    ring: Array  # directions along the edges of vertex v are ring[v]:ring[v + 1]
    spoke: Array
    bins: Array  # grid of each wall
    cell: Array  # triangles in cell c are cell[c]:cell[c + 1] of `inside`
    inside: Array


@dataclass(frozen=True, slots=True)
class Surface:
    """A triangle mesh in the frame of its body, without double vertices or edges of three.

    Parameters
    ----------
    vertices : array
        Corners (V, 3), from the point that the body turns about [m].
    faces : array
        Three vertices of each triangle (T, 3) [-].
    """

    vertices: Array
    faces: Array

    @property
    def extent(self) -> float:
        """Largest distance of a vertex from the point that the body turns about [m]."""
        return float(np.sqrt(np.max(np.sum(self.vertices**2, axis=1))))

    def normals(self) -> Array:
        """Unit normals of the triangles (T, 3) [-]."""
        a, b, c = (self.vertices[self.faces[:, k]] for k in range(3))
        n = np.cross(b - a, c - a)
        return n / np.linalg.norm(n, axis=1, keepdims=True)

    def edges(self) -> tuple[Array, Array]:
        """Edge number of the three edges of each triangle (T, 3), and triangles by edge.

        The second gives the two triangles of each edge, -1 for none.
        """
        ends = np.sort(
            np.stack([self.faces[:, [k, (k + 1) % 3]] for k in range(3)], axis=1),
            axis=2,
        )
        _, number = np.unique(ends.reshape(-1, 2), axis=0, return_inverse=True)
        number = number.reshape(-1)
        owner = np.repeat(np.arange(len(self.faces)), 3)
        order = np.argsort(number, kind="stable")
        start = np.searchsorted(number[order], np.arange(number.max() + 2))
        pair = np.full((len(start) - 1, 2), -1)
        pair[:, 0] = owner[order[start[:-1]]]
        two = np.diff(start) > 1
        pair[two, 1] = owner[order[start[:-1][two] + 1]]
        return number.reshape(-1, 3), pair

    def columns(self) -> tuple[Array, Array]:
        """Rows of `face`, and the smooth surface that each triangle belongs to."""
        from scipy.sparse import coo_array
        from scipy.sparse.csgraph import connected_components

        count = len(self.faces)
        number, pair = self.edges()
        inwards = np.zeros((count, 3, 3))  # from each edge into the triangle
        for k in range(3):
            a, b, c = (self.vertices[self.faces[:, (k + m) % 3]] for m in range(3))
            along = (b - a) / np.linalg.norm(b - a, axis=1, keepdims=True)
            way = (c - a) - np.sum((c - a) * along, axis=1, keepdims=True) * along
            inwards[:, k] = way / np.linalg.norm(way, axis=1, keepdims=True)
        across = np.zeros((count, 3, 3))
        smooth = []
        for k in range(3):
            both = pair[number[:, k]]
            other = np.where(both[:, 0] == np.arange(count), both[:, 1], both[:, 0])
            has = np.flatnonzero(other >= 0)
            place = np.argmax(number[other[has]] == number[has, k : k + 1], axis=1)
            across[has, k] = inwards[other[has], place]
            turn = -np.sum(across[has, k] * inwards[has, k], axis=1)
            smooth.append(np.column_stack([has, other[has]])[turn > CREASE])
        one, two = np.concatenate(smooth).T
        graph = coo_array((np.ones(len(one)), (one, two)), shape=(count, count))
        _, surface = connected_components(graph, directed=False)
        corners = self.vertices[self.faces].reshape(count, 9)
        rows = np.hstack([corners, self.normals(), across.reshape(count, 9)])
        return rows, surface

    def rings(self) -> tuple[Array, Array]:
        """Directions along all edges that leave each vertex: start of each, and they."""
        ends = np.concatenate([self.faces[:, [k, (k + 1) % 3]] for k in range(3)])
        ends = np.unique(np.concatenate([ends, ends[:, ::-1]]), axis=0)
        way = self.vertices[ends[:, 1]] - self.vertices[ends[:, 0]]
        start = np.searchsorted(ends[:, 0], np.arange(len(self.vertices) + 1))
        return start, way / np.linalg.norm(way, axis=1, keepdims=True)

    def grid(self) -> tuple[Array, Array, Array]:
        """Bins of triangles: row of `bins` without its base, starts and triangles."""
        corners = self.vertices[self.faces]
        low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
        span = high - low
        size = float(np.mean((corners.max(axis=1) - corners.min(axis=1)).max(axis=1)))
        while np.prod(np.floor(span / size) + 1.0) > MOST_CELLS:
            size *= 1.26
        cells = (np.floor(span / size) + 1).astype(np.int64)
        row = np.array([*low, size, *cells, 0.0])
        face = np.hstack([corners.reshape(-1, 9), self.normals()])
        start = np.zeros(int(np.prod(cells)) + 1, np.int64)
        fill_bins(face, row, start, np.empty(0, np.int32))
        inside = np.empty(int(start[-1]), np.int32)
        fill_bins(face, row, start, inside)
        return row, start, inside


@_jit.njit
def fill_bins(face: Any, row: Any, start: Any, inside: Any) -> None:
    """Sort triangles into the cells that they may pass through; first count, then fill."""
    fill = inside.shape[0] > 0
    size = row[3]
    nx, ny, nz = int(row[4]), int(row[5]), int(row[6])
    place = start[:-1].copy()
    lo, hi = np.zeros(3, np.int64), np.zeros(3, np.int64)
    for t in range(face.shape[0]):
        for c in range(3):
            least = min(face[t, c], face[t, 3 + c], face[t, 6 + c])
            most = max(face[t, c], face[t, 3 + c], face[t, 6 + c])
            last = int(row[4 + c]) - 1
            lo[c] = min(max(int(np.floor((least - row[c]) / size - 1e-9)), 0), last)
            hi[c] = min(max(int(np.floor((most - row[c]) / size + 1e-9)), 0), last)
        n0, n1, n2 = face[t, 9], face[t, 10], face[t, 11]
        wide = 0.5 * size * (abs(n0) + abs(n1) + abs(n2)) * (1.0 + 1e-9)
        for a in range(lo[0], hi[0] + 1):
            for b in range(lo[1], hi[1] + 1):
                for d in range(lo[2], hi[2] + 1):
                    off = n0 * (row[0] + (a + 0.5) * size - face[t, 0])
                    off += n1 * (row[1] + (b + 0.5) * size - face[t, 1])
                    off += n2 * (row[2] + (d + 0.5) * size - face[t, 2])
                    if abs(off) > wide:
                        continue
                    cell = (a * ny + b) * nz + d
                    if fill:
                        inside[place[cell]] = t
                        place[cell] += 1
                    else:
                        start[cell + 1] += 1
    if not fill:
        for cell in range(nx * ny * nz):
            start[cell + 1] += start[cell]


def pack(surfaces: dict[int, Surface], walls: int) -> Meshes:
    """Put the surfaces of some of so many walls one after the other."""
    face, corner, spoke, inside = [], [], [], []
    ring, cell = [np.zeros(1, np.int64)], [np.zeros(1, np.int64)]
    bins = np.zeros((walls, BINS))
    faces = vertices = smooth = 0
    for w, surface in sorted(surfaces.items()):
        rows, groups = surface.columns()
        start, ways = surface.rings()
        row, first, held = surface.grid()
        bins[w] = row
        bins[w, BASE] = sum(len(part) for part in cell) - 1
        face.append(rows)
        corner.append(
            np.column_stack([surface.faces + vertices, groups + smooth]).astype(
                np.int64
            )
        )
        ring.append(start[1:] + ring[-1][-1])
        cell.append(first[1:] + cell[-1][-1])
        spoke.append(ways)
        inside.append(held + faces)
        faces += len(rows)
        vertices += len(surface.vertices)
        smooth += int(groups.max()) + 1
    return Meshes(
        np.concatenate([np.zeros((0, FACE)), *face]),
        np.concatenate([np.zeros((0, 4), np.int64), *corner]),
        np.concatenate(ring),
        np.concatenate([np.zeros((0, 3)), *spoke]),
        bins,
        np.concatenate(cell),
        np.concatenate([np.zeros(0, np.int64), *inside]).astype(np.int64),
    )
