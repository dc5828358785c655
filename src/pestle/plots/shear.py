"""Yield locus of a shear cell, and shear stress against the angle."""

from math import atan2, degrees
from typing import TYPE_CHECKING

import numpy as np

from pestle.metrics.shear_cell import ShearCurve, shear_test
from pestle.plots.style import literal, new_figure, stress_unit, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from pestle.metrics.shear_cell import ShearTest


def shear_cell(curves: list[ShearCurve]) -> "Figure | None":
    """Shear stress against angle, and yield locus with Mohr circles; None without."""
    if not curves:
        return None
    unit, name = stress_unit(max(float(curve.normal.max()) for curve in curves))
    with style():
        figure = new_figure(9.0, 4.2)
        along, locus = figure.subplots(1, 2)
        for curve in curves:
            width = max(len(curve.angle) // 50, 1)
            keep = len(curve.angle) // width * width
            angle, shear = (
                values[:keep].reshape(-1, width).mean(axis=1)
                for values in (curve.angle, curve.shear)
            )
            dashes = "--" if curve.role == "pre-shear" else "-"
            text = literal(f"{curve.stage}, {curve.normal.mean() / unit:.3g} {name}")
            along.plot(
                np.degrees(angle), shear / unit, dashes, label=text, linewidth=1.2
            )
        along.set_xlabel("angle turned [deg]")
        along.set_ylabel(f"shear stress [{name}]")
        along.set_ylim(bottom=0.0)
        along.legend(fontsize=7, loc="lower right", ncols=2)
        _locus(locus, shear_test(curves), unit)
        locus.set_xlabel(f"normal stress [{name}]")
        locus.set_ylabel(f"shear stress [{name}]")
        return figure


def _locus(axes: "Axes", test: "ShearTest", unit: float) -> None:
    steady, peaks, line = test.steady / unit, test.peaks / unit, test.locus
    if len(steady):
        axes.plot(steady[:, 0], steady[:, 1], "s", label="pre-shear, steady")
    if len(peaks):
        normal, shear, error = peaks.T
        axes.errorbar(normal, shear, error, fmt="o", markersize=4, label="yield points")
    if line is not None:
        most = 1.1 * max(float(p[:, 0].max()) for p in (peaks, steady) if len(p))
        start = max(-line.cohesion / line.slope / unit, -0.1 * most)
        ends = np.array([min(start, 0.0), most])
        axes.plot(
            ends,
            line.cohesion / unit + line.slope * ends,
            label="yield locus",
            zorder=1,
        )
        if len(test.steady):
            _circle(axes, *line.consolidation(*test.steady[:, :2].mean(axis=0)), unit)
        strength, error = line.strength
        if strength > 2.0 * error:
            _circle(axes, 0.0, strength, unit)
        angle = degrees(atan2(line.slope, 1.0))
        axes.set_title(f"{angle:.1f} deg, cohesion {line.cohesion:.3g} Pa", fontsize=9)
    axes.set_aspect("equal")
    axes.set_ylim(bottom=0.0)
    axes.legend(fontsize=7, loc="upper left")


def _circle(axes: "Axes", low: float, high: float, unit: float) -> None:
    """Upper half of a Mohr circle."""
    t = np.linspace(0.0, np.pi, 91)
    middle, radius = 0.5 * (low + high) / unit, 0.5 * (high - low) / unit
    axes.plot(
        middle + radius * np.cos(t), radius * np.sin(t), color="0.6", linewidth=0.9
    )
