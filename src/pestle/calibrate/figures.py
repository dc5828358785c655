"""Figures of a calibration: samples against each other, data against the fit."""

from typing import TYPE_CHECKING, Any

import numpy as np

from pestle.calibrate.posterior import Posterior
from pestle.plots.style import BLUE, GREEN, GRID, MUTED, ORANGE, new_figure, style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from pestle.calibrate.bulk import BulkResult

PREFIXES = {"Pa": ((1e9, "GPa"), (1e6, "MPa"), (1e3, "kPa"))}


def draw_posterior(found: Posterior) -> "Figure":
    """Histogram of each parameter and samples of each pair."""
    count = len(found.names)
    side = 2.1 * count + 0.6
    with style():
        figure = new_figure(side, side)
        axes = np.atleast_2d(figure.subplots(count, count, squeeze=False))
        for i in range(count):
            for j in range(count):
                _panel(axes[i, j], found, i, j)
    return figure


def _panel(ax: Any, found: Posterior, i: int, j: int) -> None:
    if j > i:
        ax.axis("off")
        return
    x, label = scaled(found, j)
    if i == j:
        ax.hist(x, bins=40, color=BLUE, density=True)
        ax.set_yticks([])
    else:
        y, other = scaled(found, i)
        some = slice(None, None, max(len(x) // 2000, 1))
        ax.plot(x[some], y[some], ".", color=BLUE, markersize=1.5, alpha=0.4)
        if j == 0:
            ax.set_ylabel(other)
    if i == len(found.names) - 1:
        ax.set_xlabel(label)
    ax.tick_params(labelsize=7)


def scaled(found: Posterior, column: int) -> tuple[Any, str]:
    """Samples of a parameter in a readable unit, and its label."""
    values, unit = found.values[:, column], found.units[column]
    short = found.names[column].rpartition(".")[2]
    for factor, name in PREFIXES.get(unit, ()):
        if np.median(np.abs(values)) >= factor:
            return values / factor, f"{short} [{name}]"
    return values, short if unit == "1" else f"{short} [{unit}]"


def draw_targets(result: "BulkResult") -> "Figure":
    """Differences of prediction and measurement in deviations of the measurement."""
    sigma = np.array([m.deviation for m in result.measured])
    value = np.array([m.value for m in result.measured])
    rows = np.arange(len(sigma))
    with style():
        figure = new_figure(6.4, 0.34 * len(rows) + 1.2)
        ax = figure.subplots()
        ax.axvspan(-1.96, 1.96, color=GRID, linewidth=0, zorder=0)
        ax.errorbar(
            (result.predicted - value) / sigma,
            rows,
            xerr=1.96 * result.error / sigma,
            fmt="o",
            color=ORANGE,
            markersize=4,
        )
        ax.axvline(0.0, color=MUTED, linewidth=0.6)
        ax.set_yticks(rows, [m.label for m in result.measured], fontsize=7)
        ax.invert_yaxis()
        ax.set_xlabel("predicted less measured / deviation of the measurement [-]")
    return figure


def draw_sensitivity(result: "BulkResult") -> "Figure":
    """Total Sobol indices of every target."""
    total = np.array(result.sensitivity["total"])
    rows = np.arange(len(total))
    names = [name.rpartition(".")[2] for name in result.posterior.names]
    colours = (BLUE, ORANGE, GREEN, MUTED)
    height = 0.8 / len(names)
    with style():
        figure = new_figure(6.4, 0.4 * len(rows) + 1.4)
        ax = figure.subplots()
        for k, name in enumerate(names):
            ax.barh(
                rows + (k - 0.5 * (len(names) - 1)) * height,
                total[:, k],
                height,
                color=colours[k % len(colours)],
                label=name,
            )
        ax.set_yticks(rows, [m.label for m in result.measured], fontsize=7)
        ax.invert_yaxis()
        ax.set_xlabel("total Sobol index [-]")
        ax.legend(
            frameon=False,
            fontsize=7,
            loc="lower left",
            bbox_to_anchor=(0.0, 1.0),
            ncols=4,
        )
    return figure
