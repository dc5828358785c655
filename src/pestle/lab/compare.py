"""Laws of a single particle against the lab: curves, errors, unloading numbers."""

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import pi
from pathlib import Path
from typing import Any

import numpy as np

from pestle.errors import InputError
from pestle.lab.material import Material
from pestle.lab.mesh import Floats
from pestle.lab.press import Result
from pestle.lab.unloading import UnloadingNumbers, fit_exponent, unloading_numbers

LEAST_DEPTH = 0.01
"""Smaller depths are not compared: a coarse mesh does not resolve their contact [R]."""
_POINTS = 400


@dataclass(frozen=True, eq=False)
class Branch:
    """Unloading of a law from a depth.

    Parameters
    ----------
    depths, forces : array
        From the peak to separation [R], [E R^2].
    numbers : UnloadingNumbers
        Its power law.
    """

    depths: Floats
    forces: Floats
    numbers: UnloadingNumbers


@dataclass(frozen=True, eq=False)
class Comparison:
    """A law beside the lab.

    Parameters
    ----------
    law : str
        Name of the law.
    depths : array
        Depths of the lab's steps beyond 0.01 R [R].
    force, radius : array
        The law there [E R^2], [R].
    errors : dict
        Relative deviations from the lab: "force", "area", "pressure" (arrays).
    branches : tuple of Branch or None
        Unloadings at the lab's depths; None where the law has none.
    notes : tuple of str
        What the law warned about.
    """

    law: str
    depths: Floats
    force: Floats
    radius: Floats
    errors: dict[str, Floats]
    branches: tuple[Branch | None, ...]
    notes: tuple[str, ...]


def compare(
    law: str, result: Result, parameters: Mapping[str, float] | None = None
) -> Comparison:
    """Compare a law with an experiment of the lab.

    Parameters
    ----------
    law : str
        A law of `pestle.particle`, such as "zunker2024" or "shahin2021+edmans2020".
    result : Result
        The experiment.
    parameters : mapping, optional
        Parameters besides modulus, Poisson ratio and yield stress; lengths in radii,
        stresses in moduli.
    """
    material = result.sphere.material
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        rule = make_law(law, material, parameters or {})
        points = [p for p in result.loading if p.depth >= LEAST_DEPTH]
        depths = np.array([p.depth for p in points])
        path = np.union1d(np.linspace(0.0, depths[-1], _POINTS), depths)
        curve = rule.follow(path, radius=1.0)
        at = np.searchsorted(path, depths)
        force, radius = curve.force[at], curve.contact_radius[at]
        branches = tuple(_unload(rule, b.start.depth) for b in result.branches)
    lab_force = np.array([p.force for p in points])
    lab_area = pi * np.array([p.radius for p in points]) ** 2
    area = pi * radius**2
    errors = {
        "force": force / lab_force - 1.0,
        "area": area / lab_area - 1.0,
        "pressure": force / area / (lab_force / lab_area) - 1.0,
    }
    notes = tuple(dict.fromkeys(str(entry.message) for entry in caught))
    return Comparison(law, depths, force, radius, errors, branches, notes)


def make_law(law: str, material: Material, parameters: Mapping[str, float]) -> Any:
    """Make a law with the lab's material; only parameters that it has are given.

    Parameters
    ----------
    law : str
        Name of the law, or the file of a fitted parameter set of one; behind a plus may
        stand the file of a set of a law of unloading.
    material : Material
        Material of the lab.
    parameters : mapping
        Others, with lengths in radii and stresses in moduli.
    """
    from pestle.particle import Cycle, build, fields

    first, _, second = law.partition("+")
    own = {
        "youngs_modulus": 1.0,
        "poisson_ratio": material.poisson_ratio,
        "yield_stress": material.yield_stress,
    }

    def made(name: str) -> Any:
        known = fields(name)
        return build(name, {**{k: own[k] for k in own if k in known}, **parameters})

    files = [part for part in (first, second) if part.endswith(".toml")]
    if not files:
        return made(law)
    from pestle.lab.fitted import from_file, loading_from_file

    loads = (
        loading_from_file(Path(first), **own)
        if first in files
        else getattr(made(first), "loading", None)
    )
    if loads is None or (second and loads.name == "zunker2024"):
        raise InputError(
            "law-unloads-itself",
            f"{first} unloads by itself and takes no parameter set for it",
            hint=f'write "{first}" alone',
        )
    if loads.name == "zunker2024":
        return loads
    back = None
    if second in files:
        back = from_file(Path(second), **own)
    elif second:
        back = made(f"shahin2021+{second}").unloading
    return Cycle(loading=loads, unloading=back)


def _unload(rule: Any, depth: float) -> Branch | None:
    """Unloading of a law from a depth; None if it only loads."""
    from pestle.particle import Loading

    only_loads = getattr(rule, "unloading", rule) is None
    if only_loads and not isinstance(rule, Loading):
        return None
    up = np.linspace(0.0, depth, _POINTS)
    # finer towards the peak: the stiffest laws give back a thousandth of the depth
    down = depth * (1.0 - np.linspace(0.0, 1.0, 4 * _POINTS) ** 3)
    forces = rule.follow(np.concatenate([up, down[1:]]), radius=1.0).force[
        len(up) - 1 :
    ]
    return branch_numbers(depth, down, forces)


def branch_numbers(depth: float, down: Floats, forces: Floats) -> Branch | None:
    """Power law of an unloading of a law; None if it has no force.

    Parameters
    ----------
    depth : float
        Where it begins [R].
    down, forces : array
        Falling displacements from there [R] and forces [E R^2].
    """
    if not forces[0] > 0.0:
        return None
    ends = np.flatnonzero(forces <= 0.0)
    last = int(ends[0]) if ends.size else len(down) - 1
    separation = float(down[last])
    if ends.size and last >= 2:  # between the last two points, by the power 3/2
        a, b = np.maximum(forces[last - 2 : last], 0.0) ** (2.0 / 3.0)
        slope = (a - b) / (down[last - 2] - down[last - 1])
        separation = max(separation, float(down[last - 1] - b / slope))
    d = np.append(down[:last], separation)
    f = np.append(forces[:last], 0.0)
    levels = np.arange(1, 101) / 100.0
    x = (d - separation) / (depth - separation)
    at = np.interp(levels, f[::-1] / f[0], x[::-1])
    alpha, r_squared = fit_exponent(at, levels)
    rho = 1.0 / (depth - separation)
    numbers = UnloadingNumbers(depth, separation, rho, alpha, r_squared, float(f[0]))
    return Branch(d, f, numbers)


def rows(found: Sequence[Comparison], result: Result) -> list[dict[str, Any]]:
    """Error table: one row for each law and quantity.

    Curves have the root mean square and the largest deviation; numbers of unloadings
    the same over the depths, relative for rho and absolute for alpha.
    """
    lab = [unloading_numbers(branch) for branch in result.branches]
    table = []
    for one in found:
        deviations = dict(one.errors)
        pairs = [(b.numbers, n) for b, n in zip(one.branches, lab, strict=True) if b]
        if pairs:
            deviations["rho"] = np.array([b.rho / n.rho - 1.0 for b, n in pairs])
            deviations["alpha"] = np.array([b.alpha - n.alpha for b, n in pairs])
        for quantity, values in deviations.items():
            good = values[np.isfinite(values)]
            if good.size:
                worst = good[np.argmax(np.abs(good))]
                row = {"law": one.law, "quantity": quantity, "points": good.size}
                row["mean"] = float(good.mean())
                row["rms"] = float(np.sqrt(np.mean(good**2)))
                row["largest"] = float(worst)
                table.append(row)
    return table
