"""Profile of a heap with the lines that give its angle of repose."""

from typing import TYPE_CHECKING

import numpy as np

from pestle.metrics.heap import Heap
from pestle.plots.style import MILLI, new_figure, style

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def heap_profile(heap: Heap) -> "Figure":
    """Heights of the surface against radius, with a line for each sector."""
    with style():
        figure = new_figure(7.6, 3.6)
        axes = figure.add_subplot()
        flank = heap.radius[heap.fitted] / MILLI
        for height, slope, base in zip(heap.height, heap.slope, heap.base, strict=True):
            axes.plot(heap.radius / MILLI, height / MILLI, ".", color="0.6", zorder=1)
            if np.isfinite(slope) and len(flank):
                ends = flank[[0, -1]]
                axes.plot(ends, base / MILLI - slope * ends, linewidth=0.8)
        axes.plot(
            heap.radius / MILLI, heap.profile / MILLI, "k-", label="mean", linewidth=1.2
        )
        angle, error = heap.angle
        axes.set_title(f"angle of repose {angle:.1f} ± {error:.1f} deg", fontsize=9)
        axes.set_xlabel("distance from the axis [mm]")
        axes.set_ylabel("height of the surface [mm]")
        axes.set_ylim(bottom=0.0)
        axes.set_aspect("equal")
        axes.legend()
        return figure
