"""The same experiments by CalculiX, beside those of the lab."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from pestle.errors import InputError
from pestle.lab.calculix import Answer, Flat, Leg, Model, solve
from pestle.lab.confined import Confined, ConfinedPoint
from pestle.lab.measure import face_areas, node_areas, ring_areas
from pestle.lab.mesh import Floats, Mesh
from pestle.lab.press import Result
from pestle.lab.unloading import UnloadingNumbers, power_law, unloading_numbers

_STEPS = 60  # of an unloading
_BEYOND = 1.1  # end of an unloading, over the way to the lab's separation
_BRICK = [7, 4, 1, 5, 6, 2, 0, 3]  # corners of a brick in the order of CalculiX
_EDGE_SHARE = 0.75  # growth of sqrt(2 depth) in a step, in first edges
_GROWTH = 0.04  # the same for bricks [R]


def sphere_model(mesh: Mesh) -> Model:
    """Quarter disc between a flat and the equator; CalculiX takes two degrees of it."""
    held = np.zeros((len(mesh.points), 2), dtype=bool)
    held[mesh.axis, 0] = held[mesh.equator, 1] = True
    r, z = mesh.points[mesh.surface].T
    near = (z < 0.9) & (r < 0.95)
    flat = Flat(mesh.surface[near], 1, 1, z[near], ring_areas(r)[near], True)
    return Model(mesh.points, mesh.cells, "CAX4", held, (flat,), 1.0 / 180.0)


def confined_model(case: Confined) -> Model:
    """An octant and its flats."""
    mesh = case.mesh
    flats = []
    for axis in range(3):
        nodes = mesh.surface[case.open[axis]]
        if not nodes.size:
            continue
        areas = node_areas(mesh, face_areas(mesh, np.zeros_like(mesh.points), axis))
        some = nodes[(mesh.points[nodes, axis] > 0.1) & (areas[nodes] > 0.0)]
        clearances = 1.0 - mesh.points[some, axis]
        moves = axis in case.moving
        flats.append(Flat(some, axis, -1, clearances, areas[some], moves))
    held = case.held.reshape(-1, 3)
    return Model(mesh.points, mesh.cells[:, _BRICK], "C3D8", held, tuple(flats), 0.25)


def of_sphere(result: Result) -> dict[str, Any]:
    """Press and unload the sphere of a result by CalculiX and compare.

    Parameters
    ----------
    result : Result
        What the lab found; its mesh, material and depths are taken.

    Returns
    -------
    dict
        `comparison`: by depth, pairs of the lab's and CalculiX's force, work to there,
        and rho and alpha of an unloading; `stopped`: why it ended early, or None.

    Raises
    ------
    InputError
        If CalculiX is not installed, or the lab found nothing to compare.
    """
    sphere, model = result.sphere, sphere_model(result.sphere.mesh)
    if not result.loading:
        raise InputError("nothing-to-compare", "the lab has no step of this sphere")
    growth = _EDGE_SHARE * float(sphere.mesh.edges[0])
    branches = {branch.start.depth: branch for branch in result.branches}
    comparison: dict[str, dict[str, tuple[float, float]]] = {}
    stopped = None
    for depth in sorted({*branches, result.loading[-1].depth}):
        branch = branches.get(depth)
        legs = [Leg.loading(depth, growth)]
        if branch is not None:
            way = _BEYOND * (depth - branch.separation)
            legs.append(Leg.unloading(depth, depth - way, _STEPS))
        found = solve(model, sphere.material, legs)
        if found.stopped:
            stopped = _where(found)
            break
        row = _loading(
            [(p.depth, p.force) for p in result.loading if p.depth <= depth],
            found,
            found.forces[0][:, 0],
        )
        if branch is not None:
            mine, theirs = unloading_numbers(branch), _unloading(found, depth)
            row["rho"] = mine.rho, theirs.rho
            row["alpha"] = mine.alpha, theirs.alpha
        comparison[f"{depth:g} R"] = row
    return {"comparison": comparison, "stopped": stopped}


def _loading(
    points: Sequence[tuple[float, float]], found: Answer, forces: Floats
) -> dict[str, tuple[float, float]]:
    """Force at the end and work to there, of the lab and of CalculiX."""
    mine = np.array([(0.0, 0.0), *points]).T
    depths, theirs = np.append(0.0, found.depths[0]), np.append(0.0, forces)
    works = [float(np.trapezoid(f, d)) for d, f in (mine, (depths, theirs))]
    return {
        "force [E R^2]": (float(mine[1, -1]), float(theirs[-1])),
        "work [E R^3]": (works[0], works[1]),
    }


def _unloading(found: Answer, depth: float) -> UnloadingNumbers:
    """Numbers of an unloading; where the sphere is free its lowest node is."""
    separation = float(found.heights.min())
    touching = found.depths[1] > separation
    depths = np.append(depth, found.depths[1][touching])
    last = found.forces[0][-1, 0]
    forces = np.append(last, found.forces[1][touching, 0])
    return power_law(depths, forces, separation)


def of_confined(case: Confined, points: Sequence[ConfinedPoint]) -> dict[str, Any]:
    """Compress a sphere between six flats by CalculiX and compare.

    Parameters
    ----------
    case : Confined
        Mesh, material and flats.
    points : sequence of ConfinedPoint
        What the lab found.

    Returns
    -------
    dict
        As `of_sphere`, by flat.

    Raises
    ------
    InputError
        If CalculiX is not installed, or the lab found nothing to compare.
    """
    if not points:
        raise InputError("nothing-to-compare", "the lab has no step of this sphere")
    model, depth = confined_model(case), points[-1].depth
    found = solve(model, case.material, [Leg.loading(depth, _GROWTH)])
    if found.stopped:
        return {"comparison": {}, "stopped": _where(found)}
    column = {flat.axis: k for k, flat in enumerate(model.flats)}
    comparison = {
        f"{name}, {depth:g} R": _loading(
            [(point.depth, getattr(point, name).force) for point in points],
            found,
            found.forces[0][:, column[axis]],
        )
        for name, axis in (("primary", 2), ("secondary", 0))
        if axis in column
    }
    return {"comparison": comparison, "stopped": None}


def _where(found: Answer) -> str:
    """Where CalculiX stopped and why."""
    reached = float(np.concatenate(found.depths).max(initial=0.0))
    return f"at {reached:.4g} R: {found.stopped}"
