"""What `pestle bench` does once the laws are set up: run, print, write."""

import warnings
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from math import radians
from pathlib import Path
from typing import Any

import numpy as np
import typer

from pestle.bench import (
    Collision,
    Displacement,
    Force,
    Impact,
    PairContact,
    collide,
    drive,
    restitution,
    sticking_velocity,
    write_table,
)
from pestle.bench.drive import Waypoint
from pestle.bench.subject import Subject
from pestle.cli.printing import print_table, quantity, shortened
from pestle.errors import InputError
from pestle.units import dimension, split, to_si

Files = tuple[Path | None, Path | None]
"""Table and figure."""

NUMBER_OF_VELOCITIES = 61


@contextmanager
def plain_warnings() -> Iterator[None]:
    """Say what laws warn about in words, without the line of our source."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        yield
    for text in dict.fromkeys(str(each.message) for each in caught):
        typer.echo(f"warning: {text}", err=True)


def waypoints(text: str, subjects: Mapping[str, Subject]) -> list[Waypoint]:
    """Read waypoints such as "0.3, 0" or "10 um, 0 N"."""
    radius = next(iter(subjects.values())).radius
    return [_waypoint(part.strip(), radius) for part in text.split(",")]


def _waypoint(text: str, radius: float) -> Waypoint:
    number, unit = split(text)
    if not unit:
        return Displacement(number * radius)
    kind = dimension(text)
    if kind == "m":
        return Displacement(to_si(text, "m"))
    if kind == "N":
        return Force(to_si(text, "N"))
    raise InputError(
        "wrong-unit",
        f"{text!r} is neither a displacement nor a force",
        "--path",
        'write "0.3" (over the radius), "10 um" or "2 mN"',
    )


def velocities(text: str) -> Any:
    """Read two velocities; as many between them as the curve has points."""
    ends = [to_si(part.strip(), "m/s") for part in text.split(",")]
    if len(ends) != 2 or not 0.0 < ends[0] < ends[1]:
        raise InputError(
            "bad-range",
            f"{text!r} is not a range of velocities",
            "--impact",
            'two rising velocities: --impact "0.01 m/s, 10 m/s"',
        )
    return np.geomspace(ends[0], ends[1], NUMBER_OF_VELOCITIES)


def drive_all(
    subjects: Mapping[str, Subject],
    points_of_path: Sequence[Waypoint],
    *,
    points: int,
    files: Files,
) -> None:
    """Drive every law along the path."""
    runs = {
        name: drive(each, points_of_path, points=points)
        for name, each in subjects.items()
    }
    rows = [("law", "largest force", "at", "work done", "given back", "last force")]
    for name, run in runs.items():
        force, d = run.trace.force, run.trace.displacement
        top = int(np.argmax(force))
        done = float(np.max(run.work))
        rows.append(
            (
                name,
                quantity(float(force[top]), "N"),
                quantity(float(d[top]), "m"),
                f"{done:.4g} J",
                f"{100.0 * (1.0 - run.work[-1] / done):.3g} %" if done > 0.0 else "-",
                quantity(float(force[-1]), "N"),
            )
        )
    print_table(rows)
    table = {name: run.columns() for name, run in runs.items()}
    radius = next(iter(subjects.values())).radius
    if files[1] is not None:
        from pestle.bench.figure import draw_runs

        _save(files[1], draw_runs(runs, radius=radius))
    _write(files[0], table)


def impact_all(
    subjects: Mapping[str, Subject],
    speeds: Any,
    *,
    oblique: tuple[float, float, float],
    files: Files,
) -> None:
    """Let every law hit a wall or its like."""
    angle, friction, damping = oblique
    impacts: dict[str, Impact | Collision] = {}
    rows = [("law", "sticks below", *(f"e at {v:.3g} m/s" for v in speeds[::20]))]
    for name, each in subjects.items():
        if angle == 0.0 and damping == 0.0:
            impacts[name] = restitution(each, speeds)
        elif isinstance(each, PairContact):
            impacts[name] = collide(
                each,
                speeds,
                radians(angle),
                friction=friction,
                damping_ratio=damping,
            )
        else:
            raise InputError(
                "no-tangential-law",
                f"{name} is a law of a particle: it has no friction and no damping",
                "--angle",
                "take a pair law for oblique or damped impacts",
            )
        stick = sticking_velocity(each)
        shown = [f"{e:.4f}" for e in impacts[name].restitution[::20]]
        rows.append((name, f"{stick:.4g} m/s" if stick > 0.0 else "never", *shown))
    print_table(rows)
    if files[1] is not None:
        from pestle.bench.figure import draw_impacts

        _save(files[1], draw_impacts(impacts))
    _write(files[0], {name: impact.columns() for name, impact in impacts.items()})


def _write(path: Path | None, tables: Mapping[str, Mapping[str, Any]]) -> None:
    """Write one table of all laws, with a column that names the law."""
    if path is None:
        return
    keys = list(dict.fromkeys(key for table in tables.values() for key in table))
    columns: dict[str, Any] = {"law": []}
    for name, table in tables.items():
        length = len(next(iter(table.values())))
        columns["law"] += [name] * length
        for key in keys:
            values = table.get(key, np.full(length, np.nan))
            columns.setdefault(key, []).extend(values)
    write_table(path, {key: np.asarray(values) for key, values in columns.items()})
    typer.echo(f"table: {shortened(path)}")


def _save(path: Path, figure: Any) -> None:
    if path.suffix not in (".svg", ".png", ".pdf"):
        raise InputError(
            "unknown-figure-format",
            f"{path.name} has no suffix of a figure",
            "--figure",
            "take .svg, .png or .pdf",
        )
    try:
        figure.savefig(path, dpi=200)
    except OSError as error:
        what = f"{path}: {error.strerror}"
        raise InputError("unwritable", what, "--figure") from None
    typer.echo(f"figure: {shortened(path)}")
