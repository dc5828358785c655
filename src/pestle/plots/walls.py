"""Forces on the walls, for runs without a die."""

from typing import TYPE_CHECKING

import numpy as np

from pestle.plots.style import MILLI, literal, new_figure, style
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
    with style():
        figure = new_figure(7.6, 4.0)
        axes = figure.add_subplot()
        for number, wall in enumerate(felt):
            along = moved[wall] if together else history["time [s]"]
            dashes = "-" if number < 6 else "--"
            axes.plot(
                along / MILLI, sizes[wall], dashes, label=literal(wall), linewidth=1.4
            )
        axes.set_xlabel("displacement [mm]" if together else "time [ms]")
        axes.set_ylabel("force of the wall [N]")
        axes.legend(loc="upper left", ncols=2)
        return figure
