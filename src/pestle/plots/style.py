"""One look for all figures: colours that work on light and dark pages.

A figure is drawn in the light colours below. ``to_svg`` turns each of them into a CSS
variable of the page with that colour as fall-back, so that the same SVG follows a dark
page and stands on its own.
"""

import io
import re
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.resources import files
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

INK = "#22262f"
MUTED = "#6b7280"
GRID = "#e4e2dc"
BLUE = "#2f6f9f"
ORANGE = "#d1702a"
GREEN = "#3f8f6b"
PURPLE = "#7a5199"
RED = "#b8405e"
SAND = "#c9a15a"
GREY = "#9aa3ad"

VARIABLES = {
    INK: "--ink",
    MUTED: "--muted",
    GRID: "--grid",
    BLUE: "--blue",
    ORANGE: "--orange",
    GREEN: "--green",
    PURPLE: "--purple",
    RED: "--red",
    SAND: "--sand",
    GREY: "--grey",
}
"""CSS variable of the report for each colour."""

STAGE_COLOURS = {
    "fill": SAND,
    "press": ORANGE,
    "hold": RED,
    "unload": BLUE,
    "eject": GREEN,
    "relax": GREY,
    "crush": PURPLE,
}
"""Colour of each kind of process step."""

MILLI, MICRO = 1e-3, 1e-6


@contextmanager
def style() -> Iterator[None]:
    """Draw figures in the common look, without a display."""
    import matplotlib as mpl

    sheet = files("pestle.plots") / "pestle.mplstyle"
    with mpl.rc_context(fname=str(sheet)):
        yield


def new_figure(width: float = 6.4, height: float = 4.0) -> "Figure":
    """Make a figure of this size [inch] that no window manager knows of."""
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height), layout="constrained")


def stage_colour(kind: str, name: str = "") -> str:
    """Colour of a kind of process step; its name decides where the kind does not."""
    return STAGE_COLOURS.get(kind, STAGE_COLOURS.get(name, MUTED))


def stress_unit(largest: float) -> tuple[float, str]:
    """Unit [Pa] that suits stresses up to the largest, and its name.

    Examples
    --------
    >>> stress_unit(1.5e8)
    (1000000.0, 'MPa')
    """
    for unit, name in ((1e6, "MPa"), (1e3, "kPa")):
        if largest >= 2.0 * unit:
            return unit, name
    return 1.0, "Pa"


def literal(text: str) -> str:
    r"""Name from a file as a label: short, and a dollar sign is no formula.

    Examples
    --------
    >>> literal("_wall$1")
    ' _wall\\$1'
    """
    short = text[:40].replace("$", r"\$")
    return f" {short}" if short.startswith("_") else short


def title(axes: "Axes", text: str) -> None:
    """Small heading above the axes, from the left."""
    axes.set_title(text, loc="left", fontsize=10, fontweight="bold", color=INK, pad=8)


def to_svg(figure: "Figure", name: str) -> str:
    """Figure as an SVG element for a page.

    Parameters
    ----------
    figure : Figure
        The figure, drawn with the colours of this module.
    name : str
        Unique on the page: keeps the ids of figures apart.
    """
    import matplotlib as mpl

    file = io.StringIO()
    with mpl.rc_context({"svg.hashsalt": name, "svg.fonttype": "none"}):
        figure.savefig(
            file,
            format="svg",
            transparent=True,
            metadata={"Date": None, "Creator": None, "Format": None, "Type": None},
        )
    text = file.getvalue()
    text = text[text.index("<svg") :]
    text = re.sub(r"<metadata>.*?</metadata>", "", text, flags=re.S)
    text = re.sub(r'\bid="', f'id="{name}-', text)
    text = re.sub(r'(xlink:href="|href="|url\()#', rf"\1#{name}-", text)
    for colour, variable in VARIABLES.items():
        text = re.sub(f"{colour}(?![0-9a-f])", f"var({variable}, {colour})", text)
    return re.sub(r"font: ([^;\"]*?)'DejaVu Sans'[^;\"]*", r"font: \1var(--sans)", text)
