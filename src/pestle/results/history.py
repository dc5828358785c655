"""``history.csv``: one row every few steps, readable in any spreadsheet."""

import csv
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from pestle.errors import InputError, did_you_mean

TEXT_COLUMNS = ("stage",)
"""Columns that hold words; every other one holds numbers."""

STEP = "step"


class History:
    """A history file to which rows are appended.

    Parameters
    ----------
    path : Path
        The file, usually ``history.csv``.
    columns : Sequence of str
        Names with their unit in brackets; "step" must be one of them.
    mode : {"w", "a"}
        Begin anew, or continue; the columns must then be those of the file.

    Examples
    --------
    >>> import tempfile
    >>> folder = tempfile.TemporaryDirectory()
    >>> path = Path(folder.name) / "history.csv"
    >>> with History(path, ["time [s]", "step", "stage"]) as history:
    ...     history.row([0.0, 0, "fill"])
    ...     history.row([0.1, 1, "press"])
    >>> history.truncate_after(0)
    >>> read_history(path)["time [s]"]
    array([0.])
    >>> folder.cleanup()
    """

    def __init__(
        self,
        path: Path | str,
        columns: Sequence[str],
        mode: Literal["w", "a"] = "w",
    ) -> None:
        self.path = Path(path)
        self.columns = tuple(columns)
        if STEP not in self.columns:
            raise ValueError(f'a history needs a column "{STEP}"')
        if mode == "w":
            self.path.parent.mkdir(parents=True, exist_ok=True)
            self.path.write_text(_line(self.columns), encoding="utf-8")
        else:
            self._cut_unfinished_row()
        self._file = self.path.open("a", encoding="utf-8", newline="")

    def __enter__(self) -> "History":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def row(self, values: Iterable[float | str]) -> None:
        """Append one row; numbers are written so that they read back exactly."""
        line = [_text(value) for value in values]
        if len(line) != len(self.columns):
            raise ValueError(f"{len(line)} values for {len(self.columns)} columns")
        self._file.write(_line(line))

    def flush(self) -> None:
        """Hand what was written to the operating system."""
        self._file.flush()

    def close(self) -> None:
        """Flush and close; ``truncate_after`` opens the file again."""
        self._file.close()

    def truncate_after(self, step: int) -> None:
        """Forget every row of a later step than `step`."""
        was_open = not self._file.closed
        self._file.close()
        place = self.columns.index(STEP)
        with self.path.open(encoding="utf-8", newline="") as file:
            header, *rows = [line for line in file if line.endswith("\n")]
        kept = [row for row in rows if _step(row, place) <= step]
        _replace(self.path, header + "".join(kept))
        if was_open:
            self._file = self.path.open("a", encoding="utf-8", newline="")

    def _cut_unfinished_row(self) -> None:
        """Drop half a row that a killed process left behind."""
        found = read_columns(self.path)
        if found != self.columns:
            raise InputError(
                "history-columns",
                f"the columns of {self.path.name} are not those of this case",
                str(self.path),
                "continue with the case file that began the run",
            )
        text = self.path.read_text(encoding="utf-8")
        whole = text[: text.rfind("\n") + 1]
        if whole != text:
            _replace(self.path, whole)


def _replace(path: Path, text: str) -> None:
    draft = path.with_name(path.name + ".new")
    draft.write_text(text, encoding="utf-8", newline="")
    draft.replace(path)


def _text(value: float | str) -> str:
    if isinstance(value, str):
        return value
    if isinstance(value, int | np.integer):
        return str(int(value))
    return repr(float(value))


def _line(values: Iterable[str]) -> str:
    return ",".join(_quoted(value) for value in values) + "\n"


def _quoted(text: str) -> str:
    clean = text.replace("\r", " ").replace("\n", " ")
    if '"' in clean or "," in clean:
        return '"' + clean.replace('"', '""') + '"'
    return clean


def _step(row: str, place: int) -> float:
    try:
        return float(next(csv.reader([row]))[place])
    except (IndexError, ValueError, StopIteration):
        return math.inf  # a damaged row is not worth keeping


@dataclass(frozen=True, slots=True)
class HistoryTable:
    """The columns of a history; a missing one is an error that names the nearest.

    Parameters
    ----------
    columns : dict of str to ndarray
        Numbers by column name (with unit), words for the stage.
    source : str
        The file, for messages.
    """

    columns: dict[str, NDArray[np.float64]]
    stages: tuple[str, ...]
    source: str = "history.csv"

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        if name not in self.columns:
            raise InputError(
                "history-column-missing",
                f'there is no column "{name}"',
                self.source,
                did_you_mean(name, self.columns),
            )
        return self.columns[name]

    def __contains__(self, name: object) -> bool:
        return name in self.columns

    def __len__(self) -> int:
        return len(next(iter(self.columns.values()), []))

    @property
    def walls(self) -> tuple[str, ...]:
        """Names of the walls, in the order of the file."""
        end = ".displacement [m]"
        return tuple(name.removesuffix(end) for name in self.columns if end in name)

    def in_stage(self, name: str) -> NDArray[np.bool_]:
        """Rows that belong to the stage of this name."""
        return np.array([stage == name for stage in self.stages], dtype=np.bool_)


def read_columns(path: Path) -> tuple[str, ...]:
    """Read the column names of a history."""
    try:
        with path.open(encoding="utf-8", newline="") as file:
            header = next(csv.reader(file), None)
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise InputError(
            "history-unreadable", f"{path.name} cannot be read: {error}", str(path)
        ) from error
    if not header or STEP not in header:
        raise InputError(
            "history-foreign",
            f"{path.name} is not a history of pestle: it has no step column",
            str(path),
        )
    return tuple(header)


def read_history(path: Path | str) -> HistoryTable:
    """Read a history; half a row at the end (of a killed run) is left out."""
    path = Path(path)
    names = read_columns(path)
    rows: list[list[str]] = []
    with path.open(encoding="utf-8", errors="replace", newline="") as file:
        lines = (line for line in file if line.endswith("\n"))
        reader = csv.reader(lines)
        next(reader, None)
        for row in reader:
            if len(row) != len(names):
                raise _damaged(path, reader.line_num, f"{len(row)} values")
            rows.append(row)
    columns, stages = {}, ("",) * len(rows)
    for place, name in enumerate(names):
        words = [row[place] for row in rows]
        if name in TEXT_COLUMNS:
            stages = tuple(words)
        else:
            columns[name] = _numbers(path, name, words)
    return HistoryTable(columns, stages, str(path))


def _numbers(path: Path, name: str, words: list[str]) -> NDArray[np.float64]:
    try:
        return np.array([float(word) for word in words], dtype=np.float64)
    except ValueError:
        bad = next(i for i, word in enumerate(words) if not _is_number(word))
        raise _damaged(
            path, bad + 2, f'"{words[bad][:40]}" in column "{name}"'
        ) from None


def _is_number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True


def _damaged(path: Path, line: int, what: str) -> InputError:
    return InputError(
        "history-damaged",
        f"{path.name} is damaged: {what}",
        f"{path}:{line}",
        "restore the file, or continue the run with --resume",
    )
