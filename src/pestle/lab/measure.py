"""What is read off a sphere under a flat: contact radius, pressure, profile."""

import numpy as np

from pestle.lab.assembly import Booleans
from pestle.lab.mesh import Floats, Mesh
from pestle.lab.octant import SolidMesh


def contact_radius(
    mesh: Mesh, u: Floats, active: Booleans, depth: float
) -> tuple[float, float, float]:
    """Contact radius with its bracket.

    Beyond the edge the gap grows as the power 3/2 of the distance in an elastic contact
    and at a finite slope in plastic flow. The line through gap^(2/3) of the next two
    free nodes and that through their gaps give two edges; the mean of both is taken,
    kept in the bracket. Nothing finer than an edge of the mesh is resolved.

    Returns
    -------
    tuple of float
        Estimate, radius of the outermost touching node, of the next free one [R].
    """
    touching = np.flatnonzero(active)
    if not touching.size:
        return 0.0, 0.0, 0.0
    last = int(touching[-1])
    place = mesh.points[mesh.surface] + u[mesh.surface]
    inner, outer, far = (
        float(place[min(last + i, len(place) - 1), 0]) for i in range(3)
    )
    gaps = np.maximum(place[last + 1 : last + 3, 1] - depth, 0.0)
    if len(gaps) < 2 or gaps[1] <= gaps[0]:
        return 0.5 * (inner + outer), inner, outer
    edges = [_zero(outer, far, gaps**power) for power in (2.0 / 3.0, 1.0)]
    return float(np.clip(edges, inner, outer).mean()), inner, outer


def _zero(first: float, second: float, values: Floats) -> float:
    """Where the straight line through two values reaches zero."""
    return first - float(values[0]) * (second - first) / float(values[1] - values[0])


def contact_area(
    mesh: SolidMesh, u: Floats, pushes: Floats, touching: Booleans, axis: int
) -> tuple[float, float, float]:
    """Contact area of a flat on an octant with its bracket.

    A node at the rim touches, though only a part of what it stands for may.  Its full
    share is too much by as much as the rim lies inside of it; what its force needs at
    the pressure of its inner neighbours is too little where the pressure falls towards
    the rim.  The mean of both is taken, kept in the bracket.

    Parameters
    ----------
    mesh : SolidMesh
        The mesh.
    u : array (nodes, 3)
        Displacements [R].
    pushes : array (nodes,)
        Force of the flat on each node [E R^2].
    touching : array (nodes,) of bool
        Which nodes touch.
    axis : int
        The axis that the flat stands on.

    Returns
    -------
    tuple of float
        Estimate, area of faces with all and with any corners touching [R^2].
    """
    corners = touching[mesh.faces]
    area = face_areas(mesh, u, axis)
    inner = float(area[corners.all(axis=1)].sum())
    outer = float(area[corners.any(axis=1)].sum())
    share = node_areas(mesh, area)
    rim = np.zeros(len(touching), dtype=bool)
    rim[mesh.faces[~corners.all(axis=1)]] = True
    inside, rim = touching & ~rim, touching & rim
    around = mesh.neighbours @ np.where(inside, np.stack([pushes, share]), 0.0).T
    highest = float((pushes[touching] / share[touching]).max(initial=1e-300))
    pressure = np.full(len(touching), highest)
    known = around[:, 1] > 0.0
    pressure[known] = around[known, 0] / around[known, 1]
    need = np.minimum(share[rim], pushes[rim] / pressure[rim]).sum()
    full = share[inside].sum() + 0.5 * (share[rim].sum() + need)
    return float(np.clip(full, inner, outer)), inner, outer


def pressure_profile(
    mesh: Mesh, u: Floats, pushes: Floats, active: Booleans
) -> tuple[Floats, Floats]:
    """Radii of the touching nodes [R] and pressure there [E].

    The force of a node over the deformed area that belongs to it.
    """
    r = mesh.points[mesh.surface, 0] + u[mesh.surface, 0]
    share = ring_areas(r)
    return r[active], pushes[active] / share[active]


def ring_areas(r: Floats) -> Floats:
    """Area of a flat that belongs to each of the radii [R^2].

    The integral of a linear shape function times 2 pi r over each edge.

    Examples
    --------
    >>> round(float(ring_areas(np.array([0.0, 0.5, 1.0])).sum() / np.pi), 12)
    1.0
    """
    share, length = np.zeros(len(r)), np.diff(r)
    share[:-1] += np.pi * length * (2.0 * r[:-1] + r[1:]) / 3.0
    share[1:] += np.pi * length * (r[:-1] + 2.0 * r[1:]) / 3.0
    return share


def face_areas(mesh: SolidMesh, u: Floats, axis: int) -> Floats:
    """Area of each face of an octant as a flat across an axis sees it [R^2]."""
    place = np.delete(mesh.points + u, axis, axis=1)[mesh.faces]
    a, b = place[:, 2] - place[:, 0], place[:, 3] - place[:, 1]
    return 0.5 * np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])


def node_areas(mesh: SolidMesh, areas: Floats) -> Floats:
    """Area that belongs to each node: a quarter of that of its faces [R^2]."""
    share = np.zeros(len(mesh.points))
    np.add.at(share, mesh.faces, 0.25 * areas[:, None])
    return share


def profile(mesh: Mesh, u: Floats) -> tuple[Floats, Floats]:
    """Radii and heights of the deformed surface from the pole [R]."""
    place = mesh.points[mesh.surface] + u[mesh.surface]
    return place[:, 0], place[:, 1]
