"""Depth at first yield, from the stresses of an elastic sphere."""

from collections.abc import Sequence
from math import pi
from typing import NamedTuple

import numpy as np

from pestle.lab.material import Material
from pestle.lab.mesh import Fineness
from pestle.lab.sphere import Moment, Sphere

_ELASTIC = 0.05  # a modulus ratio without yield
_EDGES = 40  # edges in contact of a mesh made for a depth
_SHALLOW = 0.02  # below this depth a mesh is made for it [R]


class FirstYield(NamedTuple):
    """Where an elastic sphere reaches a yield stress first."""

    modulus_ratio: float  # E/Y [-]
    depth: float  # of the flat [R]
    height: float  # of the place below the flat [a]


def first_yield(
    poisson_ratio: float, ratios: Sequence[float], deepest: float = 0.5
) -> list[FirstYield]:
    """Depths at which the largest von Mises stress is E over each ratio.

    At small depths a mesh with 40 edges in contact is pressed once, and the stress
    taken to grow as the root of the depth; deeper, one elastic loading is read.  Ratios
    that do not yield up to the deepest depth are left out.

    Parameters
    ----------
    poisson_ratio : float
        nu [-].
    ratios : sequence of float
        E/Y [-].
    deepest : float
        End of the elastic loading [R].
    """
    material = Material(_ELASTIC, poisson_ratio)
    curve: list[tuple[float, float, float]] = []
    found = []
    for ratio in sorted(ratios, reverse=True):
        guess = (2.8 * pi * 0.577 * (1.0 - poisson_ratio**2) / (2.0 * ratio)) ** 2
        if guess < _SHALLOW:
            edge = np.sqrt(guess) / _EDGES
            sphere = Sphere(material, Fineness(80, 8, 50, float(edge), 0.06))
            _, stress, height = _largest(sphere, sphere.touch(guess))
            found.append(FirstYield(ratio, guess / (ratio * stress) ** 2, height))
            continue
        if not curve:
            sphere = Sphere(material, "medium")
            curve = [_largest(sphere, moment) for moment in sphere.load([deepest])]
        depths, stresses, heights = np.array(curve).T
        if stresses[-1] >= 1.0 / ratio:
            last = int(np.argmax(stresses >= 1.0 / ratio))
            part = slice(last - 1, last + 1)
            depth = float(np.interp(1.0 / ratio, stresses[part], depths[part]))
            found.append(FirstYield(ratio, depth, float(heights[last])))
    return found


def _largest(sphere: Sphere, moment: Moment) -> tuple[float, float, float]:
    """Depth, largest von Mises stress [E], its element's distance from the flat [a]."""
    mesh, found = sphere.mesh, moment.equilibrium
    mises = found.answer.stress[:, :, 4]
    element = int(np.argmax(mises.max(axis=1)))
    place = (mesh.points + found.u)[mesh.cells[element], 1].mean()
    height = (place - moment.depth) / moment.radius[0]
    return moment.depth, float(mises.max()), float(height)
