"""Stresses over time and the stress path."""

from typing import TYPE_CHECKING

import numpy as np

from pestle.metrics.die_curves import DieCurves
from pestle.plots.style import (
    BLUE,
    INK,
    MILLI,
    MUTED,
    ORANGE,
    PURPLE,
    literal,
    new_figure,
    stage_colour,
    stress_unit,
    style,
    title,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def stress_paths(curves: DieCurves) -> "Figure":
    """Left: stresses over time. Right: radial against axial stress."""
    with style():
        figure = new_figure(9.2, 3.9)
        if not np.isfinite(curves.radial).any():
            _over_time(figure.add_subplot(), curves)
            return figure
        left, right = figure.subplots(1, 2, width_ratios=[1.25, 1.0])
        _over_time(left, curves)
        _path(right, curves)
        return figure


def _over_time(axes: "Axes", curves: DieCurves) -> None:
    title(axes, "Stresses over time")
    unit, name = stress_unit(float(curves.axial[curves.peak]))
    last = _last_row(curves)
    rows = np.arange(max(curves.touch - 5, 0), last + 1)
    time = (curves.time[rows] - curves.time[curves.touch]) / MILLI
    mark_stages(axes, time, [(curves.stages[row], curves.kinds[row]) for row in rows])
    series = (
        (curves.axial, ORANGE, "upper punch"),
        (curves.transmitted, BLUE, "lower punch"),
        (_wall(curves), PURPLE, "die wall"),
    )
    for stress, colour, label in series:
        if np.isfinite(stress[rows]).any():
            axes.plot(time, stress[rows] / unit, color=colour, label=label)
    axes.set_xlabel("time since the punch met the powder [ms]")
    axes.set_ylabel(f"stress [{name}]")
    axes.set_xlim(time[0], time[-1])
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + 0.08 * (high - low))
    axes.legend(loc="best")


def _last_row(curves: DieCurves) -> int:
    """Last row that belongs to the die: the tablet is then outside."""
    outside = curves.rows_of("relax", "crush")
    outside = outside[outside > curves.release]
    return int(outside[0]) - 1 if len(outside) else len(curves.time) - 1


def _wall(curves: DieCurves) -> np.ndarray:
    """Die-wall stress while the tablet is wholly in the die."""
    ejecting = curves.rows_of("eject")
    wall = curves.radial.copy()
    wall[ejecting] = np.nan
    wall[curves.release + 1 :] *= curves.height[curves.release + 1 :]
    wall[curves.release + 1 :] /= curves.height[curves.release]
    return wall


def mark_stages(axes: "Axes", time: np.ndarray, stages: list[tuple[str, str]]) -> None:
    """Shade the stages (name, kind) of the process and name them along the top."""
    changes = [0, *[n for n in range(1, len(stages)) if stages[n] != stages[n - 1]]]
    ends = [*changes[1:], len(stages) - 1]
    whole = time[-1] - time[0]
    for start, end in zip(changes, ends, strict=True):
        name, kind = stages[start]
        colour = stage_colour(kind, name)
        axes.axvspan(time[start], time[end], color=colour, alpha=0.07, linewidth=0)
        if time[end] - time[start] > 0.07 * whole:
            axes.text(
                0.5 * (time[start] + time[end]),
                0.985,
                literal(name),
                transform=axes.get_xaxis_transform(),
                ha="center",
                va="top",
                fontsize=8,
                color=colour,
            )


def _path(axes: "Axes", curves: DieCurves) -> None:
    title(axes, "Stress path in the die")
    unit, name = stress_unit(float(curves.axial[curves.peak]))
    parts = (
        (np.arange(curves.touch, curves.peak + 1), "press", "loading"),
        (curves.unloading, "unload", "unloading"),
    )
    for rows, kind, label in parts:
        if len(rows) > 1:
            axes.plot(
                curves.axial[rows] / unit,
                curves.radial[rows] / unit,
                color=stage_colour(kind),
                label=label,
            )
    peak = np.array([0.0, curves.axial[curves.peak] / unit])
    axes.plot(peak, peak, color=MUTED, linewidth=1, linestyle=(0, (4, 3)))
    axes.text(
        0.72 * peak[1],
        0.74 * peak[1],
        "radial = axial",
        color=MUTED,
        fontsize=8,
        ha="right",
    )
    if curves.is_released and curves.release > curves.peak:
        stress = curves.radial[curves.release] / unit
        axes.plot(
            0.0,
            stress,
            "o",
            color=INK,
            markersize=4.5,
            clip_on=False,
            zorder=5,
            label=f"residual, {stress:.3g} {name}",
        )
    axes.set_xlabel(f"axial stress [{name}]")
    axes.set_ylabel(f"radial stress [{name}]")
    axes.set_xlim(left=0.0)
    axes.set_ylim(bottom=0.0)
    axes.legend(loc="upper left", bbox_to_anchor=(0.0, 0.97))
