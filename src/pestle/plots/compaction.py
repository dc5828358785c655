"""Compaction curve, Heckel and Kawakita lines."""

from typing import TYPE_CHECKING

import numpy as np

from pestle.metrics.compaction import HeckelFit, KawakitaFit, heckel, kawakita
from pestle.metrics.die_curves import DieCurves
from pestle.plots.style import (
    BLUE,
    INK,
    MUTED,
    ORANGE,
    new_figure,
    stage_colour,
    stress_unit,
    style,
    title,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def compaction_curve(
    curves: DieCurves, tablet_density: float | None = None
) -> "Figure":
    """Relative density against axial stress: up, hold, and back.

    Parameters
    ----------
    curves : DieCurves
        Stresses and densities over time.
    tablet_density : float, optional
        Relative density of the free tablet, marked at zero stress [-].
    """
    with style():
        figure = new_figure()
        axes = figure.add_subplot()
        peak = curves.peak
        unit, name = stress_unit(float(curves.axial[peak]))
        parts = (
            (np.arange(curves.touch, peak + 1), "press", "loading"),
            (curves.unloading, "unload", "unloading"),
        )
        for rows, kind, label in parts:
            if len(rows) > 1:
                axes.plot(
                    curves.axial[rows] / unit,
                    curves.density[rows],
                    color=stage_colour(kind),
                    label=label,
                )
        stress, density = curves.axial[peak] / unit, curves.density[peak]
        axes.plot(stress, density, "o", color=INK, markersize=4.5)
        axes.annotate(
            f"D = {density:.3f} at {stress:.0f} {name}",
            (stress, density),
            xytext=(-8, 9),
            textcoords="offset points",
            ha="right",
            color=INK,
        )
        if tablet_density is not None:
            axes.plot(
                0.0,
                tablet_density,
                "D",
                color=stage_colour("eject"),
                markersize=6,
                clip_on=False,
                zorder=5,
                label=f"free tablet, D = {tablet_density:.3f}",
            )
        axes.margins(y=0.12)
        axes.set_xlim(left=0.0)
        axes.set_xlabel(f"axial stress [{name}]")
        axes.set_ylabel("relative density [-]")
        axes.legend(loc="lower right")
        return figure


def heckel_and_kawakita(curves: DieCurves) -> "Figure":
    """Both linear forms of the loading curve, with the fitted ranges."""
    with style():
        figure = new_figure(9.2, 3.8)
        left, right = figure.subplots(1, 2)
        rows = curves.loading
        pressure, density = curves.axial[rows], curves.density[rows]
        _heckel(left, pressure, density)
        _kawakita(right, pressure, density)
        return figure


def _heckel(axes: "Axes", pressure: np.ndarray, density: np.ndarray) -> None:
    below = density < 1.0
    unit, name = stress_unit(float(np.max(pressure, initial=0.0)))
    title(axes, "Heckel, in-die")
    axes.plot(pressure[below] / unit, -np.log1p(-density[below]), color=BLUE)
    line = heckel(pressure, density)
    if line:
        span = np.array([line.low, line.high])
        axes.plot(
            span / unit,
            line.slope * span + line.intercept,
            color=ORANGE,
            linewidth=4.5,
            alpha=0.45,
            label=f"1/k = {line.yield_pressure / unit:.4g} {name}, A = "
            f"{line.intercept:.2f}",
        )
        axes.legend(loc="lower right", title=_fit(line))
    axes.set_xlabel(f"axial stress P [{name}]")
    axes.set_ylabel("ln 1/(1 − D) [-]")
    axes.set_xlim(left=0.0)


def _kawakita(axes: "Axes", pressure: np.ndarray, density: np.ndarray) -> None:
    title(axes, "Kawakita, in-die")
    reduction = 1.0 - density[0] / density
    unit, name = stress_unit(float(np.max(pressure, initial=0.0)))
    used = (reduction > 0.0) & (pressure > 0.02 * pressure.max())
    axes.plot(
        pressure[used] / unit, pressure[used] / reduction[used] / unit, color=BLUE
    )
    curve = kawakita(pressure, density, float(density[0]))
    if curve:
        span = np.array([curve.low, curve.high])
        axes.plot(
            span / unit,
            (span / curve.a + 1.0 / (curve.a * curve.b)) / unit,
            color=ORANGE,
            linewidth=4.5,
            alpha=0.45,
            label=f"a = {curve.a:.3f}, 1/b = {1 / curve.b / unit:.3g} {name}",
        )
        axes.legend(loc="lower right", title=_fit(curve))
    axes.set_xlabel(f"axial stress P [{name}]")
    axes.set_ylabel(f"P/C [{name}]")
    axes.set_xlim(left=0.0)
    axes.tick_params(colors=MUTED, labelcolor=INK)


def _fit(line: HeckelFit | KawakitaFit) -> str:
    unit, name = stress_unit(line.high)
    span = f"{line.low / unit:.3g}–{line.high / unit:.3g} {name}"
    return f"{span}, R² = {line.r_squared:.4f}"
