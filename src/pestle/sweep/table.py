"""The table of a study: a row a run, values and metrics as columns.

Nothing in it depends on when or where a run was computed, so that two tables of one
study are equal byte by byte.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pestle.config.study import unit_of
from pestle.errors import PestleError

if TYPE_CHECKING:
    from pestle.sweep.study import Row

TABLE = "table.parquet"


def columns(rows: Sequence["Row"]) -> dict[str, list[Any]]:
    """Columns of the table; a value that a run does not have is None.

    Parameters
    ----------
    rows : sequence of Row
        Runs of the study with their outcomes.
    """
    table: dict[str, list[Any]] = {
        "run": [row.number for row in rows],
        "point": [row.point for row in rows],
        "seed": [row.seed for row in rows],
        "status": [row.outcome.status for row in rows],
        "reason": [row.outcome.reason for row in rows],
        "folder": [row.link for row in rows],
    }
    for key in rows[0].values if rows else ():
        if key != "seed":
            table |= _varied(key, [row.values[key] for row in rows])
    table["steps"] = [row.outcome.steps or None for row in rows]
    units: dict[str, str] = {}
    for row in rows:
        for key, metric in row.outcome.metrics.items():
            units.setdefault(key, metric["unit"])
    for key, unit in units.items():
        found = [row.outcome.metrics.get(key) for row in rows]
        table[f"{key} [{unit}]"] = [m and m["value"] for m in found]
    return table


def _varied(key: str, values: list[Any]) -> dict[str, list[Any]]:
    """Column of a varied value: numbers in SI units, or words."""
    from pestle.units import to_si

    unit = next((u for value in values if (u := unit_of(value))), "")
    try:
        numbers = [to_si(value, unit or "1") for value in values]
    except PestleError:
        return {key: [str(value) for value in values]}
    return {f"{key} [{unit}]" if unit else key: numbers}


def write(path: Path, rows: Sequence["Row"]) -> None:
    """Write the table in one piece."""
    import pyarrow as pa
    from pyarrow import parquet

    found = {key: pa.array(values) for key, values in columns(rows).items()}
    draft = path.with_name(path.name + ".new")
    try:
        parquet.write_table(pa.table(found), draft)
        draft.replace(path)
    except OSError as error:
        draft.unlink(missing_ok=True)
        raise PestleError(
            "table-not-written",
            f"{path} cannot be written: {error}",
            hint="make room, then give the same command: finished runs are kept",
        ) from error
