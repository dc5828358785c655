"""Plain text for people: aligned tables, readable numbers; JSON for programs."""

import dataclasses
import json
import math
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import typer

_PREFIXES = {-9: "n", -6: "u", -3: "m", 0: "", 3: "k", 6: "M", 9: "G"}


def print_json(value: Any) -> None:
    """Print dataclasses, paths and numbers as JSON."""
    typer.echo(json.dumps(plain(value), indent=2))


def plain(value: Any) -> Any:
    """Reduce a value to what JSON can hold; not-a-number becomes null."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        value = dataclasses.asdict(value)
    if isinstance(value, dict):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, str | bool | int) or value is None:
        return value
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if hasattr(value, "tolist"):  # NumPy scalars and arrays
        return plain(value.tolist())
    return str(value)


def print_table(rows: Iterable[Sequence[str]]) -> None:
    """Print rows with aligned columns."""
    table = [list(row) for row in rows]
    widths = [max(len(row[c]) for row in table) for c in range(len(table[0]))]
    for row in table:
        cells = (cell.ljust(width) for cell, width in zip(row, widths, strict=True))
        typer.echo("  ".join(cells).rstrip())


def quantity(value: float, unit: str) -> str:
    """Write a value with an SI prefix.

    Examples
    --------
    >>> quantity(1.5e8, "Pa"), quantity(2.5e-8, "s"), quantity(1560.0, "kg/m^3")
    ('150 MPa', '25 ns', '1560 kg/m^3')
    """
    if unit in ("", "1"):
        return f"{value:.6g}"
    if unit not in ("Pa", "m", "s", "N") or value == 0 or not math.isfinite(value):
        return f"{value:.6g} {unit}"
    exponent = 3 * math.floor(math.log10(abs(value)) / 3 + 1e-12)
    exponent = min(9, max(-9, exponent))
    return f"{value / 10.0**exponent:.6g} {_PREFIXES[exponent]}{unit}"


def duration(seconds: float | None) -> str:
    """Write a time that a person waits.

    Examples
    --------
    >>> duration(3725.0), duration(75.0), duration(4.2)
    ('1 h 02 min', '1 min 15 s', '4 s')
    """
    if seconds is None or not math.isfinite(seconds):
        return "?"
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    if hours:
        return f"{hours} h {minutes:02d} min"
    return f"{minutes} min {rest:02d} s" if minutes else f"{rest} s"


def memory(size: float) -> str:
    """Write a number of bytes.

    Examples
    --------
    >>> memory(2_500_000)
    '2.5 MB'
    """
    for unit in ("B", "kB", "MB", "GB"):
        if size < 1000:
            return f"{size:.3g} {unit}"
        size /= 1000
    return f"{size:.3g} TB"


def shortened(path: Path) -> str:
    """Path relative to the working directory where that is shorter."""
    try:
        return str(path.resolve().relative_to(Path.cwd()))
    except ValueError:
        return str(path)
