"""Quarter disc meshed by three blocks of quadrilaterals, graded to pole and surface.

The pole is the origin, the centre of the sphere lies at (0, 1), its equator is the line
z = 1; all lengths are in radii. Blocks: a core, one between it and the arc from the
pole to 65 degrees, one between it and the rest of the arc.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from pestle.errors import InputError, did_you_mean

if TYPE_CHECKING:
    from skfem import MeshQuad

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

_SPLIT = np.radians(65.0)
_CORE = (0.48, 0.56, 0.5)  # distance of the core's corners from the centre [R]


@dataclass(frozen=True)
class Fineness:
    """How fine a quarter disc is.

    Parameters
    ----------
    arc, rest, layers : int
        Edges on the arc from the pole to 65 degrees, on the rest of the arc, and
        between core and surface.
    first, last : float
        Length of the first edge at the pole and of the last one at 65 degrees [R].
    """

    arc: int
    rest: int
    layers: int
    first: float
    last: float


MESHES = {
    "coarse": Fineness(36, 10, 20, 0.0126, 0.063),
    "medium": Fineness(60, 12, 30, 0.0067, 0.041),
    "fine": Fineness(99, 16, 44, 0.0034, 0.027),
}
"""1280, 2880 and 6644 elements."""


@dataclass(frozen=True, eq=False)
class Mesh:
    """Nodes and cells of a quarter disc, and what the element loop needs of them.

    Parameters
    ----------
    name : str
        Name of its fineness.
    fineness : Fineness
        How fine it is.
    points : array (nodes, 2)
        Coordinates r, z [R].
    cells : array (elements, 4)
        Nodes of each quadrilateral, anticlockwise.
    surface : array
        Nodes of the surface from the pole to the equator.
    """

    name: str
    fineness: Fineness
    points: Floats
    cells: Integers
    surface: Integers

    @cached_property
    def skfem(self) -> "MeshQuad":
        """The same mesh for scikit-fem."""
        from skfem import MeshQuad

        # both index arrays are transposed views: scikit-fem wants them contiguous
        return MeshQuad(
            np.ascontiguousarray(self.points.T), np.ascontiguousarray(self.cells.T)
        )

    @cached_property
    def quadrature(self) -> tuple[Floats, Floats]:
        """Gradients (elements, 4, 4, 3) = dN/dr, dN/dz, N/r and weights (elements, 4).

        Two by two Gauss points; a weight is the volume around the whole axis [R^3].
        """
        basis = gauss_basis(self.skfem)
        r = np.asarray(basis.global_coordinates())[0]
        shapes = [phi[0] for phi in basis.basis]
        gradients = np.empty((*r.shape, 4, 3))
        for a, shape in enumerate(shapes):
            gradients[:, :, a, :2] = np.moveaxis(shape.grad, 0, -1)
            gradients[:, :, a, 2] = np.broadcast_to(np.asarray(shape), r.shape) / r
        return gradients, 2.0 * np.pi * r * basis.dx

    @cached_property
    def axis(self) -> Integers:
        """Nodes on the axis of rotation."""
        return np.flatnonzero(self.points[:, 0] < 1e-12)

    @cached_property
    def equator(self) -> Integers:
        """Nodes on the plane of the equator."""
        return np.flatnonzero(self.points[:, 1] > 1.0 - 1e-12)

    @property
    def edges(self) -> Floats:
        """Lengths of the edges of the surface, from the pole [R]."""
        return np.asarray(
            np.linalg.norm(np.diff(self.points[self.surface], axis=0), axis=1)
        )


def gauss_basis(mesh: "MeshQuad") -> Any:
    """Bilinear basis of scikit-fem with 2 by 2 points."""
    from skfem import Basis, ElementQuad1

    return Basis(mesh, ElementQuad1(), intorder=3)


def quarter_disc(mesh: str | Fineness) -> Mesh:
    """Mesh a quarter disc.

    Parameters
    ----------
    mesh : {"coarse", "medium", "fine"} or Fineness
        How fine.

    Returns
    -------
    Mesh
        The mesh.

    Examples
    --------
    >>> len(quarter_disc("coarse").cells)
    1280
    """
    if isinstance(mesh, Fineness):
        return _build("own", mesh)
    return _build(mesh, named(mesh))


def named(mesh: str) -> Fineness:
    """Fineness of a name."""
    if mesh not in MESHES:
        raise InputError(
            "unknown-mesh",
            f'there is no mesh "{mesh}"',
            hint=did_you_mean(mesh, MESHES),
        )
    return MESHES[mesh]


def scaled(mesh: str, factor: float) -> Fineness:
    """Fineness with edges `factor` times as long as those of a named mesh [-]."""
    if not 0.1 <= factor <= 4.0:
        raise InputError(
            "mesh-too-coarse" if factor > 4.0 else "mesh-factor-out-of-range",
            f"edges {factor:g} times as long as those of the mesh {mesh!r} are not "
            "possible",
            hint="a factor between 0.1 (very slow) and 4 (very coarse)",
        )
    base = named(mesh)
    arc, rest, layers = (
        max(2, round(n / factor)) for n in (base.arc, base.rest, base.layers)
    )
    return Fineness(arc, rest, layers, base.first * factor, base.last * factor)


def graded(length: float, first: float, count: int) -> Floats:
    """Divide a length into edges that grow geometrically from the first one.

    Examples
    --------
    >>> graded(1.0, 1 / 7, 3).round(9).tolist()
    [0.0, 0.142857143, 0.428571429, 1.0]
    """
    from scipy.optimize import brentq

    def excess(logarithm: float) -> float:
        return float(np.sum(np.exp(logarithm * np.arange(count)))) * first - length

    span = 40.0 / count
    ratio = np.exp(brentq(excess, -span, span, xtol=1e-15))
    sums = np.cumsum(ratio ** np.arange(count))
    return np.concatenate([[0.0], sums / sums[-1] * length])


def _build(name: str, fineness: Fineness) -> Mesh:
    """Make the three blocks and merge their common nodes."""
    f = fineness
    long = graded(_SPLIT, f.first, f.arc)
    short = np.linspace(_SPLIT, 0.5 * np.pi, f.rest + 1)
    top, side = np.array([0.0, _CORE[0]]), np.array([_CORE[2], 0.0])
    corner = _CORE[1] * np.array([np.sin(_SPLIT), np.cos(_SPLIT)])
    share = (long / _SPLIT)[:, None]
    upper = top + share * (corner - top)
    part = ((short - _SPLIT) / (0.5 * np.pi - _SPLIT))[:, None]
    lower = corner + part * (side - corner)
    blocks = [
        _core(upper, lower, share, part),
        _shell(upper, _arc(long), f),
        _shell(lower, _arc(short), f),
    ]
    points, cells = _merge(blocks)
    points[:, 1] = 1.0 - points[:, 1]
    points[np.abs(points) < 1e-12] = 0.0
    radius = np.hypot(points[:, 0], 1.0 - points[:, 1])
    rim = np.flatnonzero(radius > 1.0 - 1e-9)
    order = np.argsort(points[rim, 1])
    return Mesh(name, f, points, _anticlockwise(points, cells), rim[order])


def _arc(angles: Floats) -> Floats:
    return np.column_stack([np.sin(angles), np.cos(angles)])


def _shell(inner: Floats, outer: Floats, fineness: Fineness) -> Floats:
    """Points (along, across, 2) between the core and the surface."""
    length = 1.0 - _CORE[1]  # the same for both shells, so that they fit
    depth = graded(length, fineness.first, fineness.layers) / length
    t = 1.0 - depth[::-1]
    return inner[:, None] + t[None, :, None] * (outer - inner)[:, None]


def _core(upper: Floats, lower: Floats, share: Floats, part: Floats) -> Floats:
    """Transfinite map of the core; its first index runs from the axis outwards."""
    centre = np.zeros(2)
    corner, side, top = upper[-1], lower[-1], upper[0]
    bottom = centre + share * (side - centre)
    axis = top + part * (centre - top)
    s, t = share[:, None], part[None, :]
    edges = (1 - t) * upper[:, None] + t * bottom[:, None]
    edges = edges + (1 - s) * axis[None, :] + s * lower[None, :]
    corners = (1 - s) * (1 - t) * top + (1 - s) * t * centre
    return np.asarray(edges - corners - s * (1 - t) * corner - s * t * side)


def _merge(blocks: list[Floats]) -> tuple[Floats, Integers]:
    """Number the points of all blocks, common ones once."""
    cells, offset = [], 0
    for block in blocks:
        n, m = block.shape[:2]
        number = offset + np.arange(n * m).reshape(n, m)
        corners = (number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:])
        cells.append(np.stack([c.ravel() for c in corners], axis=1))
        offset += n * m
    points = np.concatenate([block.reshape(-1, 2) for block in blocks])
    keys = np.round(points, 9) + 0.0
    _, first, inverse = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    return points[first], np.asarray(inverse.ravel()[np.concatenate(cells)], np.int64)


def _anticlockwise(points: Floats, cells: Integers) -> Integers:
    """Turn cells so that their area is positive."""
    a = points[cells[:, 2]] - points[cells[:, 0]]
    b = points[cells[:, 3]] - points[cells[:, 1]]
    turned = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0] < 0.0
    cells = cells.copy()
    cells[turned] = cells[turned][:, ::-1]
    return np.ascontiguousarray(cells)
