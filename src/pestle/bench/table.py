"""Write columns as CSV, Parquet or NetCDF, by the suffix of the file."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from pestle.errors import InputError, did_you_mean

Columns = Mapping[str, Any]
"""Columns of equal length by name; units stand in brackets behind the name."""


def write_table(path: Path, columns: Columns) -> None:
    """Write columns to a file of the kind that its suffix names.

    Parameters
    ----------
    path : Path
        ``.csv``, ``.parquet`` (needs pyarrow) or ``.nc``.
    columns : mapping of str to array
        Columns by name.
    """
    writers: dict[str, Callable[[Path, Columns], None]] = {
        ".csv": _csv,
        ".parquet": _parquet,
        ".nc": _netcdf,
    }
    if path.suffix not in writers:
        raise InputError(
            "unknown-table-format",
            f"{path.name} has no suffix of a table",
            hint=did_you_mean(path.suffix, writers),
        )
    try:
        writers[path.suffix](path, columns)
    except OSError as error:
        raise InputError("unwritable", f"{path}: {error.strerror}", "--out") from None


def _csv(path: Path, columns: Columns) -> None:
    rows = zip(*columns.values(), strict=True)
    lines = [",".join(columns)]
    lines += [",".join(map(_shown, row)) for row in rows]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _shown(value: Any) -> str:
    return value if isinstance(value, str) else repr(float(value)).removesuffix(".0")


def _parquet(path: Path, columns: Columns) -> None:
    try:
        import pyarrow as pa
        from pyarrow import parquet
    except ImportError:
        raise InputError(
            "missing-package",
            "a Parquet file needs the package pyarrow",
            hint='install it with: pip install "pestle[parquet]"',
        ) from None
    parquet.write_table(pa.table({k: pa.array(v) for k, v in columns.items()}), path)


def _netcdf(path: Path, columns: Columns) -> None:
    """NetCDF 3 with one dimension; texts become lists of an attribute."""
    from scipy.io import netcdf_file

    with netcdf_file(path, "w") as file:
        file.createDimension("point", len(next(iter(columns.values()))))
        for name, values in columns.items():
            label, _, unit = name.partition(" [")
            data = np.asarray(values)
            if data.dtype.kind in "US":
                known = sorted(set(data.tolist()))
                data = np.array([known.index(v) for v in data.tolist()], dtype="i4")
                setattr(file, f"{label}_names", ", ".join(known))
            kind = "i4" if data.dtype.kind == "i" else "f8"
            variable = file.createVariable(label, kind, ("point",))
            variable[:] = data
            setattr(variable, "units", unit.rstrip("]") or "1")  # noqa: B010
