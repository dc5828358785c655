"""What LAMMPS wrote, in our files: history, results, stages."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from pestle.lammps.deck import CONTACTS, LOG, PARTICLES, Deck
from pestle.lammps.support import walls_of
from pestle.results.write import History, ResultFile
from pestle.simulation.output import ENERGIES

if TYPE_CHECKING:
    from pestle.config import Case

Array = npt.NDArray[Any]
PER_WALL = 5
"""Columns of the log for each wall."""


def read_log(path: Path, width: int) -> Array:
    """Rows of numbers of a log, a step once, in order."""
    rows: dict[int, list[float]] = {}
    on = False
    for line in path.read_text(encoding="utf-8", errors="replace").splitlines():
        words = line.split()
        if words[:1] == ["Step"]:
            on = True
        elif words[:2] == ["Loop", "time"]:
            on = False
        elif on and len(words) == width:
            try:
                rows[int(words[0])] = [float(word) for word in words]
            except ValueError:
                continue  # a warning as long as a row
    return np.array([rows[step] for step in sorted(rows)])


def stage_of(deck: Deck, step: int) -> int:
    """Number of the stage that a step belongs to; its last step is still its own."""
    for leg in deck.legs:
        if step <= leg.first + leg.steps:
            return leg.stage
    return deck.legs[-1].stage


def write_history(case: "Case", deck: Deck, folder: Path) -> None:
    """Write history.csv; what LAMMPS does not know stands there as nan."""
    names = list(case.all_walls)
    rows = read_log(folder / LOG, 3 + PER_WALL * len(names))
    columns = ["time [s]"]
    for name in names:
        columns.append(f"{name}.displacement [m]")
        columns += [f"{name}.force_{axis} [N]" for axis in "xyz"]
    columns += [f"energy.{part} [J]" for part in ENERGIES]
    columns += ["relative_density [-]", "coordination [-]"]
    columns += [f"{name}.normal_force [N]" for name in names]
    columns += ["step", "stage", "height [m]", "time_step [s]", "inertial_number [-]"]
    columns += ["energy.negative_increments [J]", "imbalance [-]"]
    table = case.read_particles()
    solid = float(np.sum(4.0 / 3.0 * np.pi * table.radius**3))
    nan = float("nan")
    with History(folder / "history.csv", columns) as history:
        for row in rows:
            step = int(row[0])
            walls = row[1:-2].reshape(-1, PER_WALL)
            moved = dict(zip(names, walls[:, 0], strict=True))
            volume, height = enclosed(case, moved)
            values: list[float | str] = [step * deck.time_step]
            values += [float(x) for wall in walls for x in wall[:4]]
            values += [float(row[-2]), *[nan] * (len(ENERGIES) - 1)]
            values += [solid / volume if volume > 0.0 else nan, float(row[-1])]
            values += [float(wall[4]) for wall in walls]
            stage = case.stage_names[stage_of(deck, step)]
            values += [step, stage, height, deck.time_step, nan, nan, nan]
            history.row(values)


def enclosed(case: "Case", moved: dict[str, float]) -> tuple[float, float]:
    """Volume between die and punches or between walls [m^3], and punch gap [m]."""
    if case.die is not None:
        gap = case.die.height - moved["lower_punch"] - moved["upper_punch"]
        return case.die.area * gap, gap
    spans = []
    for axis in range(3):
        low: list[float] = []
        high: list[float] = []
        for name, wall in case.walls.items():
            if wall.kind == "plane" and abs(wall.normal[axis]) > 1.0 - 1e-12:
                place = wall.point[axis] + wall.normal[axis] * moved[name]
                (low if wall.normal[axis] > 0.0 else high).append(place)
        if not low or not high:
            return 0.0, float("nan")
        spans.append(min(high) - max(low))
    return float(np.prod(spans)), float("nan")


def frames(path: Path) -> Iterator[tuple[int, Array]]:
    """Step and rows of every frame of a dump."""
    with path.open(encoding="utf-8") as file:
        while line := file.readline():
            if line.startswith("ITEM: TIMESTEP"):
                step = int(file.readline())
            elif line.startswith("ITEM: NUMBER"):
                count = int(file.readline())
            elif line.startswith(("ITEM: ATOMS", "ITEM: ENTRIES")):
                rows = [file.readline().split() for _ in range(count)]
                width = len(line.split()) - 2
                yield step, np.array(rows, float).reshape(count, width)


def write_results(
    case: "Case", deck: Deck, folder: Path, record: dict[str, Any]
) -> None:
    """Write results.vtkhdf: particles, and the contacts of pairs."""
    file = ResultFile(folder / "results.vtkhdf", provenance=record)
    ids = np.asarray(case.read_particles().id)
    first = np.asarray(case.read_particles().radius)
    contacts = dict(frames(folder / CONTACTS))
    done: set[int] = set()
    for step, rows in frames(folder / PARTICLES):
        if step in done:
            continue
        done.add(step)
        order = np.argsort(rows[:, 0])
        rows = rows[order]
        count = len(rows)
        particles = {
            "id": ids,
            "position": rows[:, 2:5],
            "radius": rows[:, 5],
            "radius_initial": first,
            "velocity": rows[:, 6:9],
            "angular_velocity": rows[:, 9:12],
            "material": rows[:, 1].astype(np.int64) - 1,
            "stress": np.full((count, 3, 3), np.nan),
            "plastic_contacts": np.zeros(count, np.int64),
            "psi": np.full(count, np.nan),
        }
        tables = [_pairs(rows, ids, contacts.get(step, np.zeros((0, 9))))]
        tables += _walls(case, deck, step, rows, ids)
        touching = {k: np.concatenate([t[k] for t in tables]) for k in tables[0]}
        stage = case.stage_names[stage_of(deck, step)]
        file.append(step, step * deck.time_step, stage, particles, touching)


def _pairs(rows: Array, ids: Array, found: Array) -> dict[str, Array]:
    """Contacts of pairs; LAMMPS names particles from 1."""
    one, two = (found[:, c].astype(np.int64) - 1 for c in (0, 1))
    vector = rows[one, 2:5] - rows[two, 2:5]
    distance = np.linalg.norm(vector, axis=1)
    ra, rb = rows[one, 5], rows[two, 5]
    near = 0.5 * (distance + (ra**2 - rb**2) / np.maximum(distance, 1e-300))
    force = found[:, 3:6] + found[:, 6:9]
    overlap = ra + rb - distance
    return _contacts(ids[one], ids[two], force, vector, (ra, near, overlap))


def _walls(
    case: "Case", deck: Deck, step: int, rows: Array, ids: Array
) -> list[dict[str, Array]]:
    """Contacts with each wall."""
    found = []
    powders = len(case.powders)
    forces = rows[:, 12:].reshape(len(rows), -1, powders, 3).sum(axis=2)
    for number, (name, wall) in enumerate(walls_of(case).items()):
        axis = np.array(wall.normal if wall.kind == "plane" else wall.axis)
        moved = displacement(deck, name, step)
        vector = rows[:, 2:5] - (np.array(wall.point) + axis * moved)
        along = (vector @ axis)[:, None] * axis
        if wall.kind == "plane":
            vector, distance = along, vector @ axis
        else:
            vector = along - vector
            distance = wall.radius - np.linalg.norm(vector, axis=1)
        on = np.any(forces[:, number] != 0.0, axis=1)
        second = np.full(np.count_nonzero(on), -1 - number)
        radius, near = rows[on, 5], distance[on]
        shape = radius, near, radius - near
        found.append(_contacts(ids[on], second, forces[on, number], vector[on], shape))
    return found


def _contacts(
    first: Array,
    second: Array,
    force: Array,
    vector: Array,
    shape: tuple[Array, Array, Array],
) -> dict[str, Array]:
    """Columns of contacts; the area is that of the spheres' common circle."""
    radius, near, overlap = shape
    normal = vector / np.maximum(np.linalg.norm(vector, axis=1), 1e-300)[:, None]
    area = np.pi * np.maximum(radius**2 - near**2, 0.0)
    push = np.sum(force * normal, axis=1)
    return {
        "first": first,
        "second": second,
        "force": force,
        "normal": normal,
        "overlap": overlap,
        "flat": near,
        "area": area,
        "pressure": np.divide(push, area, out=np.zeros_like(area), where=area > 0.0),
        "yielded": np.zeros(len(first), np.int64),
    }


def displacement(deck: Deck, name: str, step: int) -> float:
    """Displacement of a wall at a step [m]."""
    for leg in deck.legs:
        if step <= leg.first + leg.steps:
            return leg.at(name, step - leg.first, deck.time_step)
    raise ValueError(f"the deck has no step {step}")


def stages(case: "Case", deck: Deck, notes: list[str]) -> list[dict[str, Any]]:
    """Entries of stages.json."""
    found = []
    for number, name in enumerate(case.stage_names):
        mine = [leg for leg in deck.legs if leg.stage == number]
        begin, end = mine[0].first, mine[-1].first + mine[-1].steps
        found.append(
            {
                "name": name,
                "step": case.process[number].step,
                "start_step": begin,
                "end_step": end,
                "start_time": begin * deck.time_step,
                "end_time": end * deck.time_step,
                "end_reason": "the prescribed motion ended",
                "info": {"warnings": notes} if number == 0 else {},
            }
        )
    return found
