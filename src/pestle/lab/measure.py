"""What is read off a sphere under a flat: contact radius, pressure, profile."""

import numpy as np

from pestle.lab.assembly import Booleans
from pestle.lab.mesh import Floats, Mesh


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


def pressure_profile(
    mesh: Mesh, u: Floats, pushes: Floats, active: Booleans
) -> tuple[Floats, Floats]:
    """Radii of the touching nodes [R] and pressure there [E].

    The force of a node over the deformed area that belongs to it.
    """
    r = mesh.points[mesh.surface, 0] + u[mesh.surface, 0]
    share = np.zeros(len(r))
    length = np.diff(r)
    # integral of a linear shape function times 2 pi r over each edge
    share[:-1] += np.pi * length * (2.0 * r[:-1] + r[1:]) / 3.0
    share[1:] += np.pi * length * (r[:-1] + 2.0 * r[1:]) / 3.0
    return r[active], pushes[active] / share[active]


def profile(mesh: Mesh, u: Floats) -> tuple[Floats, Floats]:
    """Radii and heights of the deformed surface from the pole [R]."""
    place = mesh.points[mesh.surface] + u[mesh.surface]
    return place[:, 0], place[:, 1]
