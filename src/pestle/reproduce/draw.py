"""Draw a reproduced figure: panels in a grid, one look for what the lines mean."""

from math import ceil
from typing import TYPE_CHECKING, Any

import numpy as np

from pestle.plots.style import (
    BLUE,
    GREEN,
    GREY,
    INK,
    ORANGE,
    PURPLE,
    RED,
    SAND,
    new_figure,
    style,
    title,
)
from pestle.reproduce.item import LAB, LIMIT, OURS, POINTS, PRINTED, Line, Panel, Result

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLOURS = (BLUE, ORANGE, GREEN, PURPLE, RED, SAND, GREY)
DASHES = ("-", "--", "-.", (0, (1, 1)), (0, (5, 1, 1, 1, 1, 1)), (0, (8, 2)))
MARKERS = ("o", "s", "^", "D", "v", "x")
SHADES = ("#efd98a", "#9cc3de", "#2f6f9f", "#1d3f5c")


def draw(result: Result) -> "Figure":
    """Draw the panels of a result."""
    panels = result.panels
    across = min(result.across, len(panels))
    down = ceil(len(panels) / across)
    with style():
        figure = new_figure(min(3.3 * across, 9.9) + 0.4, 2.9 * down + 0.3)
        grid = figure.subplots(down, across, squeeze=False)
        for axes, panel in zip(grid.flat, panels, strict=False):
            _panel(axes, panel)
        for axes in grid.flat[len(panels) :]:
            axes.set_axis_off()
    return figure


def _panel(axes: "Axes", panel: Panel) -> None:
    for line in panel.lines:
        axes.plot(line.x, line.y, label=line.label or None, **_look(line))
    if panel.regions:
        _regions(axes, panel)
    axes.set_xscale(panel.scales[0])
    axes.set_yscale(panel.scales[1])
    if panel.xlim:
        axes.set_xlim(*panel.xlim)
    if panel.ylim:
        axes.set_ylim(*panel.ylim)
    axes.set_xlabel(panel.xlabel)
    axes.set_ylabel(panel.ylabel)
    if panel.title:
        title(axes, panel.title)
    if any(line.label for line in panel.lines):
        axes.legend(frameon=False, fontsize=7, handlelength=2.6)


def _look(line: Line) -> dict[str, Any]:
    colour = COLOURS[line.number % len(COLOURS)]
    if line.kind == POINTS:
        marker = MARKERS[line.number % len(MARKERS)]
        face = colour if marker == "x" else "none"
        return {
            "color": colour,
            "marker": marker,
            "markerfacecolor": face,
            "linestyle": "none",
            "markersize": 5,
        }
    if line.kind == PRINTED:
        return {"color": colour, "linestyle": (0, (2, 2)), "linewidth": 1.0}
    if line.kind == LIMIT:
        dash = DASHES[line.number % len(DASHES)]
        return {"color": INK, "linestyle": dash, "linewidth": 0.9, "zorder": 3}
    if line.kind == LAB:
        dash = "-" if line.number < len(COLOURS) else "--"
        dots = "." if len(line.x) <= 25 else ""
        return {
            "color": colour,
            "linestyle": dash,
            "linewidth": 0.8,
            "marker": dots,
            "markersize": 3,
        }
    assert line.kind == OURS
    dash = DASHES[line.number % len(DASHES)]
    return {"color": colour, "linestyle": dash, "linewidth": 1.6}


def _regions(axes: "Axes", panel: Panel) -> None:
    from matplotlib.colors import BoundaryNorm, ListedColormap
    from matplotlib.patches import Patch

    assert panel.regions is not None
    x, y, numbers, names = panel.regions
    edges = np.arange(len(names) + 1) - 0.5
    axes.pcolormesh(
        x,
        y,
        numbers,
        cmap=ListedColormap(SHADES[: len(names)]),
        norm=BoundaryNorm(edges, len(names)),
        shading="nearest",
        rasterized=True,
    )
    patches = [
        Patch(facecolor=shade, edgecolor=INK, linewidth=0.4, label=name)
        for shade, name in zip(SHADES, names, strict=False)
        if np.any(numbers == list(names).index(name))
    ]
    axes.legend(handles=patches, fontsize=7, loc="upper left", framealpha=0.9)
