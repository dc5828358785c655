"""Compaction curve, Heckel and Kawakita lines."""

from typing import TYPE_CHECKING

import numpy as np

from pestle.metrics.compaction import heckel, kawakita
from pestle.metrics.die_curves import DieCurves
from pestle.plots.style import (
    BLUE,
    INK,
    MEGA,
    MUTED,
    ORANGE,
    new_figure,
    stage_colour,
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
        parts = (
            (np.arange(curves.touch, peak + 1), "press", "loading"),
            (curves.unloading, "unload", "unloading"),
        )
        for rows, kind, label in parts:
            if len(rows) > 1:
                axes.plot(
                    curves.axial[rows] / MEGA,
                    curves.density[rows],
                    color=stage_colour(kind),
                    label=label,
                )
        stress, density = curves.axial[peak] / MEGA, curves.density[peak]
        axes.plot(stress, density, "o", color=INK, markersize=4.5)
        axes.annotate(
            f"D = {density:.3f} at {stress:.0f} MPa",
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
        axes.set_xlabel("axial stress [MPa]")
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
    title(axes, "Heckel, in-die")
    axes.plot(pressure[below] / MEGA, -np.log1p(-density[below]), color=BLUE)
    line = heckel(pressure, density)
    if line:
        span = np.array([line.low, line.high])
        axes.plot(
            span / MEGA,
            line.slope * span + line.intercept,
            color=ORANGE,
            linewidth=4.5,
            alpha=0.45,
            label=f"1/k = {line.yield_pressure / MEGA:.1f} MPa, A = "
            f"{line.intercept:.2f}",
        )
        axes.legend(loc="lower right", title=_fit(line.r_squared, line.low, line.high))
    axes.set_xlabel("axial stress P [MPa]")
    axes.set_ylabel("ln 1/(1 − D) [-]")
    axes.set_xlim(left=0.0)


def _kawakita(axes: "Axes", pressure: np.ndarray, density: np.ndarray) -> None:
    title(axes, "Kawakita, in-die")
    reduction = 1.0 - density[0] / density
    used = (reduction > 0.0) & (pressure > 0.02 * pressure.max())
    axes.plot(
        pressure[used] / MEGA, pressure[used] / reduction[used] / MEGA, color=BLUE
    )
    curve = kawakita(pressure, density, float(density[0]))
    if curve:
        span = np.array([curve.low, curve.high])
        axes.plot(
            span / MEGA,
            (span / curve.a + 1.0 / (curve.a * curve.b)) / MEGA,
            color=ORANGE,
            linewidth=4.5,
            alpha=0.45,
            label=f"a = {curve.a:.3f}, 1/b = {1 / curve.b / MEGA:.2f} MPa",
        )
        axes.legend(
            loc="lower right", title=_fit(curve.r_squared, curve.low, curve.high)
        )
    axes.set_xlabel("axial stress P [MPa]")
    axes.set_ylabel("P/C [MPa]")
    axes.set_xlim(left=0.0)
    axes.tick_params(colors=MUTED, labelcolor=INK)


def _fit(r_squared: float, low: float, high: float) -> str:
    return f"{low / MEGA:.3g}–{high / MEGA:.3g} MPa, R² = {r_squared:.4f}"
