"""From elements to one sparse system: pattern, sums, solution."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pestle.lab._element import element_pass
from pestle.lab._scatter import constrain, scatter
from pestle.lab.material import Material
from pestle.lab.mesh import Floats, Mesh

Booleans = NDArray[np.bool_]


class Inverted(Exception):
    """An element is turned inside out at these displacements."""


class Answer(NamedTuple):
    """What the elements answer to displacements."""

    force: Floats  # internal forces (2 nodes) [E R^2]
    matrix: Floats | None  # entries of the stiffness in the pattern of `Assembly`
    state: Floats  # new state (elements, 4, 5)
    stress: Floats  # see `element_pass` (elements, 4, 7)


class Assembly:
    """Elements of a mesh with one material.

    Parameters
    ----------
    mesh : Mesh
        The mesh.
    material : Material
        Its material.
    """

    def __init__(self, mesh: Mesh, material: Material) -> None:
        self.mesh, self.material = mesh, material
        self.gradients, self.weights = mesh.quadrature
        self.constants, self.table = material.kernel_constants()
        count = len(mesh.cells)
        unknowns = 2 * mesh.cells[:, :, None] + np.arange(2)
        self.unknowns = np.ascontiguousarray(
            unknowns.reshape(count, 8).astype(np.int64)
        )
        self.size = 2 * len(mesh.points)
        self._make_pattern()
        self._forces = np.empty((count, 8))
        self._matrices = np.empty((count, 8, 8))

    def _make_pattern(self) -> None:
        """Places of all element entries in a sparse matrix stored by columns."""
        from scipy.sparse import coo_array

        width = self.unknowns.shape[1]
        rows = np.repeat(self.unknowns, width, axis=1).ravel()
        columns = np.tile(self.unknowns, (1, width)).ravel()
        keys, places = np.unique(columns * self.size + rows, return_inverse=True)
        self._places = places.ravel().astype(np.int64)
        entries = (np.ones(len(keys)), (keys % self.size, keys // self.size))
        pattern = coo_array(entries, shape=(self.size, self.size)).tocsc()
        self.indptr = pattern.indptr.astype(np.int32)
        self.indices = pattern.indices.astype(np.int32)

    def fresh_state(self) -> Floats:
        """State of a material that was never loaded."""
        state = np.zeros((len(self.mesh.cells), 4, 5))
        state[:, :, [0, 2, 3]] = 1.0
        return state

    def evaluate(self, u: Floats, state: Floats, *, tangent: bool = True) -> Answer:
        """Forces, stiffness, state and stress at displacements u (nodes, 2) [R].

        Raises
        ------
        Inverted
            Where an element is turned inside out.
        """
        new_state = np.empty_like(state)
        stress = np.empty((*state.shape[:2], 7))
        status = element_pass(
            u,
            self.mesh.cells,
            self.gradients,
            self.weights,
            state,
            self.constants,
            self.table,
            tangent,
            self._forces,
            self._matrices,
            new_state,
            stress,
        )
        if status:
            raise Inverted
        return self._assembled(tangent, new_state, stress)

    def _assembled(self, tangent: bool, state: Floats, stress: Floats) -> Answer:
        """Sum the elements' forces and stiffnesses that a pass has left."""
        force = np.empty(self.size)
        scatter(self._forces.ravel(), self.unknowns.ravel(), force)
        matrix = None
        if tangent:
            matrix = np.empty(len(self.indices))
            scatter(self._matrices.ravel(), self._places, matrix)
        return Answer(force, matrix, state, stress)

    def solve(
        self, matrix: Floats, residual: Floats, fixed: Booleans, change: Floats
    ) -> Floats:
        """Solve for a change of the unknowns with some of them prescribed.

        Parameters
        ----------
        matrix : array
            Entries of the stiffness; it is overwritten.
        residual : array
            Right side.
        fixed : array of bool
            Prescribed unknowns.
        change : array
            Their values [R].
        """
        from scipy.sparse import csc_array
        from scipy.sparse.linalg import splu

        rhs = residual.copy()
        scale = float(np.abs(matrix).max())
        constrain(self.indptr, self.indices, matrix, fixed, change, rhs, scale)
        shape = (self.size, self.size)
        factors = splu(
            csc_array((matrix, self.indices, self.indptr), shape=shape),
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=0.0,
            options={"SymmetricMode": True},
        )
        return np.asarray(factors.solve(rhs))
