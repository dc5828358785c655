"""An eighth of a sphere between flats in three dimensions: die and hydrostatic.

The centre is the origin, flats stand on the axes x, y, z at a distance of 1 less their
displacement; the planes x = 0, y = 0 and z = 0 are those of symmetry.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from pestle.lab._solid import solid_pass
from pestle.lab.assembly import Answer, Assembly, Inverted
from pestle.lab.material import Material
from pestle.lab.mesh import Floats, Integers, graded

if TYPE_CHECKING:
    from scipy.sparse import csr_array

_CORE = 0.5  # half width of the core [R]


@dataclass(frozen=True, eq=False)
class SolidMesh:
    """Nodes and bricks of an octant.

    Parameters
    ----------
    points : array (nodes, 3)
        Coordinates [R].
    cells : array (elements, 8)
        Nodes in the order of scikit-fem.
    surface : array
        Nodes of the spherical surface.
    faces : array (faces, 4)
        Nodes around each face of the surface.
    """

    points: Floats
    cells: Integers
    surface: Integers
    faces: Integers

    @cached_property
    def neighbours(self) -> "csr_array":
        """Which nodes share a face of the surface: a matrix of ones."""
        from scipy.sparse import csr_array

        pairs = self.faces[:, [[i, j] for i in range(4) for j in range(4) if i != j]]
        first, second = pairs.reshape(-1, 2).T
        shape = 2 * (len(self.points),)
        found = csr_array((np.ones(len(first)), (first, second)), shape=shape)
        found.data[:] = 1.0
        return found


def octant(edges: int = 6, layers: int = 6, first: float = 0.08) -> SolidMesh:
    """Mesh an octant by a core and three shells, graded to poles and surface.

    Parameters
    ----------
    edges : int
        Edges from a pole to the diagonal; the arc between two poles has twice as many.
    layers : int
        Layers between core and surface.
    first : float
        First edge at the pole and thickness of the outer layer [R].

    Examples
    --------
    >>> len(octant(4, 4).cells)
    256
    """
    angles = graded(0.25 * np.pi, first, edges)
    t = np.tan(angles)
    depth = 1.0 - graded(1.0, first / (1.0 - _CORE), layers)[::-1]
    grid = np.stack(np.meshgrid(t, t, t, indexing="ij"), axis=-1)
    blocks = [_inflated(grid)]
    face = np.stack(np.broadcast_arrays(1.0, t[:, None], t[None, :]), axis=-1)
    inside = _inflated(face)
    outside = face / np.linalg.norm(face, axis=-1, keepdims=True)
    shell = inside + depth[:, None, None, None] * (outside - inside)
    blocks += [np.roll(shell, turn, axis=-1) for turn in range(3)]
    points, cells = _merged(blocks)
    outer = np.linalg.norm(points, axis=1) > 1.0 - 1e-9
    faces = cells[:, [0, 1, 4, 2]]  # the outer side of a brick of a shell
    faces = faces[outer[faces].all(axis=1)]
    return SolidMesh(points, cells, np.flatnonzero(outer), faces)


def _inflated(v: Floats) -> Floats:
    """Points of the core: a cube halfway to a ball."""
    length = np.linalg.norm(v, axis=-1, keepdims=True)
    largest = v.max(axis=-1, keepdims=True)
    share = np.divide(largest, length, out=np.ones_like(length), where=length > 0.0)
    return np.asarray(_CORE * v * np.sqrt(share))


def _merged(blocks: list[Floats]) -> tuple[Floats, Integers]:
    """Number common points once; cells in the corner order of scikit-fem."""
    corners = [(1, 1, 1), (1, 1, 0), (1, 0, 1), (0, 1, 1)]
    corners += [(1, 0, 0), (0, 1, 0), (0, 0, 1), (0, 0, 0)]
    cells, offset = [], 0
    for block in blocks:
        n = np.array(block.shape[:3])
        number = offset + np.arange(n.prod()).reshape(n)
        parts = [
            number[i : n[0] - 1 + i, j : n[1] - 1 + j, k : n[2] - 1 + k].ravel()
            for i, j, k in corners
        ]
        cells.append(np.stack(parts, axis=1))
        offset += int(n.prod())
    points = np.concatenate([block.reshape(-1, 3) for block in blocks])
    _, first, inverse = np.unique(
        np.round(points, 9) + 0.0, axis=0, return_index=True, return_inverse=True
    )
    numbers = np.asarray(inverse.ravel()[np.concatenate(cells)], np.int64)
    return points[first], np.ascontiguousarray(numbers)


class SolidAssembly(Assembly):
    """Bricks of a mesh with one material.

    Parameters
    ----------
    mesh : SolidMesh
        The mesh.
    material : Material
        Its material.
    """

    def __init__(self, mesh: SolidMesh, material: Material) -> None:
        self.solid, self.material = mesh, material
        self.gradients, self.weights = _quadrature(mesh)
        self.constants, self.table = material.kernel_constants()
        count = len(mesh.cells)
        unknowns = 3 * mesh.cells[:, :, None] + np.arange(3)
        self.unknowns = np.ascontiguousarray(unknowns.reshape(count, 24))
        self.size = 3 * len(mesh.points)
        self._make_pattern()
        self._forces = np.empty((count, 24))
        self._matrices = np.empty((count, 24, 24))

    def fresh_state(self) -> Floats:
        """State of a material that was never loaded."""
        state = np.zeros((len(self.solid.cells), 8, 7))
        state[:, :, :3] = 1.0
        return state

    def evaluate(self, u: Floats, state: Floats, *, tangent: bool = True) -> Answer:
        """Forces, stiffness, state and stress at displacements u (nodes, 3) [R]."""
        new_state = np.empty_like(state)
        stress = np.empty((*state.shape[:2], 3))
        status = solid_pass(
            u,
            self.solid.cells,
            self.gradients,
            self.weights,
            state,
            self.constants,
            self.table,
            self._forces,
            self._matrices,
            new_state,
            stress,
        )
        if status:
            raise Inverted
        return self._assembled(tangent, new_state, stress)


def _quadrature(mesh: SolidMesh) -> tuple[Floats, Floats]:
    """Gradients (elements, 8, 8, 3) and weights (elements, 8) of 2 x 2 x 2 points."""
    from skfem import Basis, ElementHex1, MeshHex

    solid = MeshHex(
        np.ascontiguousarray(mesh.points.T), np.ascontiguousarray(mesh.cells.T)
    )
    basis = Basis(solid, ElementHex1(), intorder=3)
    gradients = [np.moveaxis(phi[0].grad, 0, -1) for phi in basis.basis]
    return np.ascontiguousarray(np.stack(gradients, axis=2)), np.asarray(basis.dx)
