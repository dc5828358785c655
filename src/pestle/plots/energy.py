"""The energy ledger: where the work went."""

from typing import TYPE_CHECKING

import numpy as np

from pestle.plots.style import (
    BLUE,
    GREEN,
    GREY,
    INK,
    MILLI,
    ORANGE,
    RED,
    SAND,
    new_figure,
    style,
    title,
)
from pestle.results import HistoryTable

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_SINKS = (
    ("contact_dissipation", "plastic contacts", ORANGE),
    ("friction", "friction", SAND),
    ("damping", "damping", GREY),
    ("stored", "stored in contacts", BLUE),
    ("kinetic", "kinetic", GREEN),
)


def energy_ledger(history: HistoryTable) -> "Figure":
    """Work put in (line) against where it is (areas), and what is missing."""
    with style():
        figure = new_figure(9.2, 4.2)
        upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=[3.4, 1.0])
        time = history["time [s]"] / MILLI
        put_in = history["energy.wall_work [J]"] + history["energy.gravity [J]"]
        scale, unit = _unit(float(np.max(np.abs(put_in), initial=0.0)))
        parts = [history[f"energy.{name} [J]"] for name, *_ in _SINKS]
        _stack(upper, time, parts, scale)
        upper.plot(time, put_in / scale, color=INK, label="work put in")
        upper.set_ylabel(f"energy [{unit}]")
        upper.legend(loc="upper left", ncols=2)
        title(lower, "What the ledger cannot account for")
        largest = max(float(np.max(np.abs(put_in))), 1e-300)
        residual = 100.0 * history["energy.residual [J]"] / largest
        lower.plot(time, residual, color=RED)
        lower.axhline(0.0, color=INK, linewidth=0.6)
        lower.set_ylabel("% of work")
        lower.set_xlabel("time [ms]")
        lower.set_xlim(time[0], time[-1])
        return figure


def _stack(
    axes: object, time: np.ndarray, parts: list[np.ndarray], scale: float
) -> None:
    """Areas on top of each other; a sum that dips below zero stays visible."""
    from matplotlib.axes import Axes

    assert isinstance(axes, Axes)
    base = np.zeros(len(time))
    for values, (_, label, colour) in zip(parts, _SINKS, strict=True):
        top = base + values / scale
        axes.fill_between(
            time, base, top, color=colour, alpha=0.55, linewidth=0, label=label
        )
        base = top


def _unit(largest: float) -> tuple[float, str]:
    for scale, unit in ((1.0, "J"), (1e-3, "mJ"), (1e-6, "µJ")):
        if largest >= scale:
            return scale, unit
    return 1e-9, "nJ"
