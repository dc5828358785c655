"""Forces on the walls, for runs without a die."""

from typing import TYPE_CHECKING

import numpy as np

from pestle.plots.style import literal, new_figure, style
from pestle.results import HistoryTable

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_MOST = 12


def wall_forces(history: HistoryTable) -> "Figure | None":
    """Size of each wall's force against its displacement, or against time.

    Returns
    -------
    Figure or None
        None without walls that have felt a force.
    """
    sizes = {
        wall: np.linalg.norm(
            [history[f"{wall}.force_{axis} [N]"] for axis in "xyz"], axis=0
        )
        for wall in history.walls
    }
    felt = [wall for wall, force in sizes.items() if force.any()][:_MOST]
    if not felt:
        return None
    moved = {wall: history[f"{wall}.displacement [m]"] for wall in felt}
    together = all(path.any() for path in moved.values())
    paths = list(moved.values()) if together else [history["time [s]"]]
    scale, unit = _prefix(max(float(np.max(np.abs(path))) for path in paths))
    with style():
        figure = new_figure(7.6, 4.0)
        axes = figure.add_subplot()
        for number, wall in enumerate(felt):
            along = (moved[wall] if together else history["time [s]"]) / scale
            dashes = "-" if number < 6 else "--"
            axes.plot(along, sizes[wall], dashes, label=literal(wall), linewidth=1.4)
        axes.set_xlabel(f"displacement [{unit}m]" if together else f"time [{unit}s]")
        axes.set_ylabel("force of the wall [N]")
        axes.legend(loc="upper left", ncols=2)
        return figure


def _prefix(largest: float) -> tuple[float, str]:
    """Factor and prefix that suit the largest number of an axis."""
    for scale, prefix in ((1.0, ""), (1e-3, "m"), (1e-6, "µ")):
        if largest >= 0.2 * scale:
            return scale, prefix
    return (1e-3, "m") if largest == 0.0 else (1e-6, "µ")
