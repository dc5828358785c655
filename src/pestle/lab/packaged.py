"""Tables of the published grids: those packaged with the lab, or of one's own study.

`pestle lab study` writes such tables; the first line of each says where its numbers
come from.  Lengths are in radii, stresses in Young's moduli unless a name says
otherwise.
"""

import tomllib
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np

from pestle.errors import InputError
from pestle.lab.mesh import Floats

_own: list[Path] = []


@dataclass(frozen=True, eq=False)
class Table:
    """Columns of numbers and where they come from.

    Parameters
    ----------
    note : str
        Command, version and cost.
    columns : dict
        An array a name.
    """

    note: str
    columns: dict[str, Floats]

    def __getitem__(self, name: str) -> Floats:
        return self.columns[name]

    def where(self, **values: float) -> "Table":
        """Only the rows in which columns have these values."""
        first = next(iter(self.columns.values()))
        keep = np.ones(len(first), dtype=bool)
        for name, value in values.items():
            keep &= np.isclose(self.columns[name], value, rtol=1e-4, atol=1e-9)
        return Table(self.note, {k: v[keep] for k, v in self.columns.items()})

    def values(self, name: str) -> list[float]:
        """Different values of a column, rising."""
        return [float(value) for value in np.unique(self.columns[name])]


def use(folder: Path | None) -> None:
    """Read tables from the folder of a study first; None: only the packaged ones."""
    if folder is not None and not list((folder / "tables").glob("*.csv")):
        raise InputError(
            "no-lab-tables",
            f"{folder} has no tables of a study",
            "--lab",
            "give the folder that `pestle lab study` wrote, such as "
            "runs/lab/edmans2020",
        )
    _own[:] = [] if folder is None else [folder]


def table(name: str) -> Table:
    """Table of a study, such as "edmans2020_unloading"."""
    for folder in _own:
        path = folder / "tables" / f"{name}.csv"
        if path.exists():
            return _read(path.read_text(encoding="utf-8"))
    return _packaged(name)


def parameter_set(name: str) -> dict[str, Any]:
    """Packaged parameter set that a study wrote, such as "edmans2020-lab"."""
    path = files("pestle.lab") / "data" / f"{name}.toml"
    return tomllib.loads(path.read_text("utf-8"))


@cache
def _packaged(name: str) -> Table:
    text = (files("pestle.lab") / "data" / f"{name}.csv").read_text("utf-8")
    return _read(text)


def _read(text: str) -> Table:
    note, header, *lines = text.splitlines()
    rows = np.array([line.split(",") for line in lines], dtype=float)
    columns = dict(zip(header.split(","), rows.T, strict=True))
    return Table(note.removeprefix("# "), columns)
