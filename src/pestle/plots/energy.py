"""The energy ledger: where the work went."""

from typing import TYPE_CHECKING

import numpy as np

from pestle.metrics.numerics_metrics import put_in
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


def energy_ledger(history: HistoryTable, start: int = 0) -> "Figure":
    """Energy put in (line) against where it is (areas), and what is missing.

    Parameters
    ----------
    history : HistoryTable
        The history.
    start : int
        First row that is shown: the end of a long filling, for example.
    """
    with style():
        figure = new_figure(9.2, 4.2)
        upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=[3.4, 1.0])
        work = put_in(history)
        time = (history["time [s]"] - history["time [s]"][start]) / MILLI
        scale, unit = _unit(float(np.max(np.abs(work), initial=0.0)))
        parts = [history[f"energy.{name} [J]"][start:] for name, *_ in _SINKS]
        _stack(upper, time[start:], parts, scale)
        upper.plot(time[start:], work[start:] / scale, color=INK, label="put in")
        upper.set_ylabel(f"energy [{unit}]")
        upper.legend(loc="upper left", ncols=2)
        title(lower, "What the ledger cannot account for")
        largest = max(float(np.max(np.abs(work))), 1e-300)
        residual = 100.0 * history["energy.residual [J]"][start:] / largest
        lower.plot(time[start:], residual, color=RED)
        lower.axhline(0.0, color=INK, linewidth=0.6)
        lower.set_ylabel("% of work")
        lower.set_xlabel("time after filling [ms]" if start else "time [ms]")
        if time[-1] > time[start]:
            lower.set_xlim(time[start], time[-1])
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
