"""pestle fit: parameters of a law from the compression of one particle."""

import csv
import re
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from pestle.cli.options import AsJson
from pestle.errors import InputError, did_you_mean

if TYPE_CHECKING:
    from pestle.fit import Curve, Fit

KINDS = {"displacement": "m", "force": "N"}
"""Columns that are read, and their SI units."""


def fit(
    data: Annotated[
        Path,
        typer.Argument(
            metavar="CSV",
            help='Columns "displacement [um]" (approach of the platens since touch) '
            'and "force [mN]", in any unit; a row a point, in the order of time.',
            show_default=False,
        ),
    ],
    law: Annotated[
        str,
        typer.Argument(
            help="Law of a particle, see `pestle bench`; with one of unloading behind "
            "a plus where the curve unloads.",
            show_default=False,
        ),
    ],
    diameter: Annotated[
        str,
        typer.Option(help='Diameter of the particle: "180 um".', show_default=False),
    ],
    vary: Annotated[
        str,
        typer.Option(help="Parameters to fit, by commas.", show_default=False),
    ],
    settings: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="KEY=VALUE",
            help="Value of another parameter. May be repeated.",
            show_default=False,
        ),
    ] = None,
    start: Annotated[
        list[str] | None,
        typer.Option(
            metavar="KEY=VALUE",
            help="Where a parameter begins, instead of a guess. May be repeated.",
            show_default=False,
        ),
    ] = None,
    bounds: Annotated[
        list[str] | None,
        typer.Option(
            metavar="KEY=LOW:HIGH",
            help="Between which values it is sought. May be repeated.",
            show_default=False,
        ),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR",
            help="Write material set, numbers, residuals and a figure there.",
            show_default=False,
        ),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Fit a law to force against displacement of one particle between two platens.

    Prints values, standard errors, 95 % intervals and correlations.
    """
    from pestle import fit as fitting
    from pestle.cli.bench_run import plain_warnings
    from pestle.cli.printing import print_json, shortened
    from pestle.cli.quantities import pair, quantity
    from pestle.particle import library

    known = library.fields(law)
    units = {k: f.metadata.get("unit", "1") for k, f in known.items()}
    curve = read(data, quantity(diameter, "m", "--diameter"))
    ranges = dict(pair(text, "--bounds") for text in bounds or [])
    with plain_warnings():
        result = fitting.fit(
            law,
            curve,
            [name.strip() for name in vary.split(",")],
            fixed=_numbers(settings, units, "--set"),
            start=_numbers(start, units, "--start"),
            bounds={key: _range(v, units.get(key, "1")) for key, v in ranges.items()},
        )
        if as_json:
            print_json(fitting.summary(result))
        else:
            _print(result, units)
        if out is not None:
            for path in fitting.save(result, out, source=data.name):
                typer.echo(f"wrote {shortened(path)}", err=as_json)


def _numbers(
    texts: list[str] | None, units: dict[str, str], where: str
) -> dict[str, Any]:
    from pestle.cli.quantities import pair, quantity

    pairs = [pair(text, where) for text in texts or []]
    return {
        key: quantity(value, units[key], f"{where} {key}") if key in units else value
        for key, value in pairs
    }


def _range(text: str, unit: str) -> tuple[float, float]:
    from pestle.cli.quantities import quantity

    low, colon, high = text.partition(":")
    if not colon:
        raise InputError(
            "bad-range", f"{text!r} is no LOW:HIGH", "--bounds", "--bounds nu=0.1:0.4"
        )
    return quantity(low, unit, "--bounds"), quantity(high, unit, "--bounds")


def read(path: Path, diameter: float) -> "Curve":
    """Read a curve; units stand in brackets behind the names of the columns."""
    import numpy as np

    from pestle.cli.quantities import quantity
    from pestle.fit import Curve

    try:
        rows = list(csv.reader(path.read_text(encoding="utf-8-sig").splitlines()))
    except (OSError, UnicodeDecodeError) as error:
        raise InputError("unreadable-curve", f"{path}: {error}") from None
    head = [name.strip() for name in rows[0]] if rows else []
    columns = {}
    for kind, unit in KINDS.items():
        at, factor = _column(path, head, kind)
        columns[kind] = np.array(
            [
                _cell(row, at, f"{path}:{n}") * quantity(f"1 {factor}", unit, str(path))
                for n, row in enumerate(rows[1:], 2)
                if any(cell.strip() for cell in row)
            ]
        )
    return Curve(
        approach=columns["displacement"], force=columns["force"], diameter=diameter
    )


def _column(path: Path, head: list[str], kind: str) -> tuple[int, str]:
    for number, name in enumerate(head):
        match = re.fullmatch(rf"{kind}\s*\[(.+)\]", name)
        if match:
            return number, match[1]
    raise InputError(
        "missing-column",
        f'{path} has no column "{kind} [unit]"',
        f"{path}:1",
        did_you_mean(kind, head) if head else "the file is empty",
    )


def _cell(row: list[str], at: int, where: str) -> float:
    try:
        return float(row[at])
    except (ValueError, IndexError):
        shown = row[at] if at < len(row) else "nothing"
        raise InputError(
            "not-a-number", f"{shown!r} stands where a number should", where
        ) from None


def _print(result: "Fit", units: dict[str, str]) -> None:
    from pestle.cli.printing import print_table, quantity

    rows = [("parameter", "value", "standard error", "95 % interval")]
    for name, value, error, (low, high) in zip(
        result.names, result.values, result.errors, result.interval(), strict=True
    ):
        unit = units[name]
        ends = f"{quantity(low, unit)} to {quantity(high, unit)}"
        rows.append((name, quantity(value, unit), quantity(error, unit), ends))
    print_table(rows)
    noise = quantity(result.noise, "N")
    typer.echo(f"residuals: {noise} standard deviation over {len(result.residuals)}")
    for i, first in enumerate(result.names):
        for j, second in enumerate(result.names[:i]):
            both = f"{second} with {first}"
            typer.echo(f"correlation: {both} {result.correlation[i, j]:+.3f}")
    for name in result.at_bound:
        typer.echo(f"warning: {name} lies at its bound; its error means nothing")
