"""What is reproduced: an item a figure or table of a paper, made by one function."""

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pestle.errors import InputError, did_you_mean

Array = NDArray[np.float64]

OURS, PRINTED, POINTS, LIMIT = "ours", "printed", "points", "limit"
LAB = "lab"
"""What a line shows: our reading; the equation as printed; numbers that the paper
prints; a limit, or another law for comparison; our finite elements."""


@dataclass(frozen=True)
class Line:
    """A curve or a set of points.

    Parameters
    ----------
    x, y : array
        In the units of the panel's axes.
    label : str
        For the legend; empty for none.
    kind : str
        OURS, PRINTED, POINTS, LIMIT or LAB.
    number : int
        Colour; those of one material or rule are alike.
    """

    x: Any
    y: Any
    label: str = ""
    kind: str = OURS
    number: int = 0


@dataclass(frozen=True)
class Panel:
    """One set of axes.

    Parameters
    ----------
    xlabel, ylabel : str
        With the unit in brackets.
    lines : sequence of Line
        Curves.
    title : str
        Letter and words of the panel.
    scales : tuple of str
        "linear" or "log" of both axes.
    xlim, ylim : tuple of float, optional
        Limits.
    regions : tuple, optional
        x, y and a number a cell of the plane, and what the numbers mean.
    """

    xlabel: str
    ylabel: str
    lines: Sequence[Line] = ()
    title: str = ""
    scales: tuple[str, str] = ("linear", "linear")
    xlim: tuple[float, float] | None = None
    ylim: tuple[float, float] | None = None
    regions: tuple[Array, Array, Array, Sequence[str]] | None = None


@dataclass(frozen=True)
class Result:
    """A figure (panels) or a table (columns), and how it agrees with print.

    Parameters
    ----------
    said : str
        A sentence or two on agreement, and on what differs from print.
    panels : sequence of Panel
        Of a figure.
    columns : mapping
        Of a table, by name with the unit in brackets.
    across : int
        Panels side by side.
    """

    said: str
    panels: Sequence[Panel] = ()
    columns: Mapping[str, Sequence[Any]] = field(default_factory=dict)
    across: int = 3


@dataclass(frozen=True)
class Item:
    """A figure or table of a paper."""

    key: str  # such as "figure-8" or "table-3.1"
    title: str
    make: Callable[[], Result]


@dataclass
class Paper:
    """A paper and what of it is reproduced; functions register as items.

    Parameters
    ----------
    name : str
        Author and year, as its law is named.
    reference : str
        The citation in a line.
    """

    name: str
    reference: str
    items: dict[str, Item] = field(default_factory=dict)

    def item(
        self, key: str, title: str
    ) -> Callable[[Callable[[], Result]], Callable[[], Result]]:
        """Register a function as the maker of a figure or table; a decorator."""

        def keep(make: Callable[[], Result]) -> Callable[[], Result]:
            self.items[key] = Item(key, title, make)
            return make

        return keep

    def ordered(self) -> list[Item]:
        """Figures, then tables, by their numbers."""
        return sorted(self.items.values(), key=lambda item: _order(item.key))

    def find(self, text: str) -> list[Item]:
        """Items that a text such as "8", "Fig. 8", "table 2" or "figure-8" means."""
        wanted = text.lower().replace(" ", "").replace("-", "").replace("_", "")
        wanted = wanted.replace("fig.", "figure")
        if wanted.startswith("fig") and not wanted.startswith("figure"):
            wanted = wanted.replace("fig", "figure", 1)
        plain = {key: key.replace("-", "").lower() for key in self.items}
        found = [
            item
            for key, item in self.items.items()
            if wanted in (plain[key], key.partition("-")[2].lower())
        ]
        if not found:
            raise InputError(
                "unknown-figure",
                f"{text!r} is none of the figures and tables of {self.name} that are "
                "recomputed",
                hint=did_you_mean(text, self.items),
            )
        return found


def _order(key: str) -> tuple[str, list[tuple[int, str]]]:
    kind, _, number = key.partition("-")
    parts = re.findall(r"\d+|\D+", number.replace(".", ""))
    if "." in number:
        parts = number.split(".")
    return kind, [(int(p), "") if p.isdigit() else (10**6, p) for p in parts]
