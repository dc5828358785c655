"""Law and lab in one figure."""

from collections.abc import Sequence
from math import pi
from typing import TYPE_CHECKING

import numpy as np

from pestle.lab.compare import Comparison
from pestle.lab.press import Result
from pestle.plots.style import new_figure, style, title

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def draw(found: Sequence[Comparison], result: Result) -> "Figure":
    """Draw force, area, mean pressure and unloadings of laws and lab.

    The band around the lab's area is the bracket of its contact radius.

    Parameters
    ----------
    found : sequence of Comparison
        The laws.
    result : Result
        The experiment.
    """
    ratio = result.sphere.material.modulus_ratio
    depth = np.array([p.depth for p in result.loading])
    force = np.array([p.force for p in result.loading])
    area = np.array([p.radius for p in result.loading]) ** 2
    low, high = (
        np.array([getattr(p, n) for p in result.loading]) ** 2
        for n in ("inner", "outer")
    )
    with style():
        figure = new_figure(9.0, 7.0)
        loads, areas, pressures, unloads = figure.subplots(2, 2).ravel()
        loads.plot(depth, force * ratio, "k.", ms=3, label="lab")
        areas.fill_between(depth, low, high, color="0.85", lw=0)
        areas.plot(depth, area, "k.", ms=3, label="lab")
        pressures.plot(depth, force / (pi * area) * ratio, "k.", ms=3, label="lab")
        for branch in result.branches:
            top = branch.points[0].force
            x = [(branch.start.depth - p.depth) * ratio for p in branch.points]
            unloads.plot(x, [p.force / top for p in branch.points], "k.", ms=3)
        for number, one in enumerate(found):
            colour = f"C{number}"
            loads.plot(one.depths, one.force * ratio, color=colour, label=one.law)
            areas.plot(one.depths, one.radius**2, color=colour)
            mean = one.force / (pi * one.radius**2) * ratio
            pressures.plot(one.depths, mean, color=colour)
            for piece in one.branches:
                if piece is not None:
                    x = (piece.depths[0] - piece.depths) * ratio
                    unloads.plot(x, piece.forces / piece.forces[0], color=colour)
        words = ("force [Y R²]", "contact area [π R²]", "mean pressure [Y]")
        for axes, text in zip((loads, areas, pressures), words, strict=True):
            title(axes, text)
            axes.set_xlabel("displacement of the flat [R]")
            axes.set_ylim(bottom=0.0)
        title(unloads, "unloading: force over its peak [-]")
        unloads.set_xlabel("withdrawn [R Y/E]")
        unloads.set_ylim(bottom=0.0)
        loads.legend()
    return figure
