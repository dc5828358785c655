"""Read the particles of a case from a CSV file, every number checked."""

import csv
import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from pestle.config.file import read_text
from pestle.config.geometry import AnyWall, CylinderWall, PlaneWall
from pestle.errors import InputError, did_you_mean

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

COLUMNS = ("id", "radius_m", "density_kg_m3", "x_m", "y_m", "z_m")
"""Columns of the file; a column `MATERIAL` may follow."""

MATERIAL = "material"
"""Column that names the material of each particle."""

LARGEST_FILE = 4_000_000_000
"""Largest particle file [bytes]."""


@dataclass(frozen=True, slots=True)
class ParticleTable:
    """Particles as they stand in a file."""

    id: NDArray[np.int64]
    """Identifiers, unique."""
    radius: NDArray[np.float64]
    """Radius [m]."""
    density: NDArray[np.float64]
    """True density [kg/m^3]."""
    position: NDArray[np.float64]
    """Positions, one row a particle [m]."""
    material: NDArray[np.int64]
    """Number of each particle's material in `materials`, 0 without a column."""
    materials: tuple[str, ...] = ()
    """Names of the column material as they appear, empty without one."""


def read_particles(path: Path, known: "Collection[str]" = ()) -> ParticleTable:
    """Read a file with the columns `COLUMNS`; raises `InputError` with the line.

    Parameters
    ----------
    path : Path
        CSV file.
    known : collection of str
        Names that the column material may hold.
    """
    lines = read_text(path, LARGEST_FILE).splitlines()
    reader = csv.reader(lines)
    header = [name.strip() for name in next(reader, [])]
    for name in COLUMNS:
        if name not in header:
            what = f"the column {name} is missing"
            hint = f"columns: {', '.join(COLUMNS)}"
            raise InputError("bad-particle-file", what, f"{path}:1", hint)
    for name in header:
        if name not in (*COLUMNS, MATERIAL) or header.count(name) > 1:
            what = f'unknown or repeated column "{name}"'
            hint = did_you_mean(name, (*COLUMNS, MATERIAL))
            raise InputError("bad-particle-file", what, f"{path}:1", hint)
    order = [header.index(name) for name in COLUMNS]
    named = header.index(MATERIAL) if MATERIAL in header else None
    names: dict[str, int] = {}
    rows, material = [], []
    for row in filter(None, reader):
        where = f"{path}:{reader.line_num}"
        rows.append(_row(row, order, len(header), where))
        name = "" if named is None else _material(row[named], known, where)
        material.append(names.setdefault(name, len(names)))
    if not rows:
        raise InputError("bad-particle-file", "there are no particles", str(path))
    table = np.array(rows, dtype=np.float64)
    ids = table[:, 0].astype(np.int64)
    unique, counts = np.unique(ids, return_counts=True)
    if len(unique) < len(ids):
        twice = unique[counts > 1][0]
        what = f"the id {twice} is given {counts.max()} times"
        raise InputError("bad-particle-file", what, str(path), "ids are unique")
    return ParticleTable(
        ids,
        table[:, 1],
        table[:, 2],
        table[:, 3:6],
        np.array(material, np.int64),
        () if named is None else tuple(names),
    )


def check_inside(
    table: ParticleTable, walls: "Mapping[str, AnyWall]", path: Path
) -> None:
    """Refuse particles whose centre lies behind a wall."""
    for name, wall in walls.items():
        if not isinstance(wall, PlaneWall | CylinderWall):
            continue  # a body has powder on all its sides
        depth = _depth(wall, table.position)
        behind = np.flatnonzero(depth <= 0.0)
        if behind.size:
            first = behind[0]
            raise InputError(
                "particle-behind-wall",
                f"the centre of particle {table.id[first]} lies {-depth[first]:g} m "
                f'behind the wall "{name}" ({behind.size} particles do)',
                str(path),
                "the normal of a plane points into the powder; check units and origin",
            )


def _depth(
    wall: PlaneWall | CylinderWall, position: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Distance of each centre from the wall, positive on the powder's side [m]."""
    away = position - np.array(wall.point)
    if isinstance(wall, PlaneWall):
        return np.asarray(away @ np.array(wall.normal))
    axis = np.array(wall.axis)
    along = away @ axis
    radial = np.linalg.norm(away - along[:, None] * axis, axis=1)
    is_beside = (along >= wall.bottom) & (along <= wall.top)
    return np.where(is_beside, wall.radius - radial, np.inf)


def _material(text: str, known: "Collection[str]", where: str) -> str:
    name = text.strip()
    if name not in known:
        what = f'material = "{name[:40]}": there is no such material in the case'
        raise InputError("unknown-material", what, where, did_you_mean(name, known))
    return name


def _row(row: list[str], order: list[int], width: int, where: str) -> list[float]:
    if len(row) != width:
        what = f"{len(row)} values instead of {width}"
        raise InputError("bad-particle-file", what, where)
    values = []
    for name, column in zip(COLUMNS, order, strict=True):
        try:
            number = float(row[column])
        except ValueError:
            number = math.nan
        reason = _refused(name, number)
        if reason:
            what = f'{name} = "{row[column][:40]}" {reason}'
            raise InputError("bad-particle-file", what, where)
        values.append(number)
    return values


def _refused(name: str, number: float) -> str | None:
    if not math.isfinite(number):
        return "is not a finite number"
    if name == "id" and (number != int(number) or not 0 <= number < 2**53):
        return "must be a whole number from 0"
    if name == "radius_m" and not 0.0 < number <= 1e5:
        return "must be greater than 0 and at most 1e5 m"
    if name == "density_kg_m3" and not 0.0 < number <= 1e6:
        return "must be greater than 0 and at most 1e6 kg/m^3"
    if name in ("x_m", "y_m", "z_m") and abs(number) > 1e5:
        return "must be within 1e5 m"
    return None
