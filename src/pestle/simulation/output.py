"""Files of a run: case, provenance, history, frames, stages, metrics."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pestle.engine import scratch as ct
from pestle.engine import step as st
from pestle.engine import walls as wl
from pestle.results import provenance
from pestle.results.stages import write_stages
from pestle.results.write import History, ResultFile
from pestle.simulation.build import surfaces_of
from pestle.simulation.tables import (
    contact_table,
    coordination,
    mesh_table,
    particle_table,
    solid_volumes,
)
from pestle.simulation.watch import energies

if TYPE_CHECKING:
    from pestle.simulation.runner import Runner

ENERGIES = (
    "kinetic",
    "stored",
    "gravity",
    "wall_work",
    "contact_dissipation",
    "friction",
    "damping",
    "residual",
)


class Output:
    """Open files of a run; a resumed run forgets what it will write again."""

    def __init__(
        self, run: "Runner", *, threads: int = 1, after: int | None = None
    ) -> None:
        folder = run.out
        self.folder = folder
        columns = self._columns(run)
        if after is None:
            record = provenance.collect(
                case_text=_text(run),
                canonical=run.case.canonical(),
                seed=run.case.seed,
                threads=threads,
            )
            record["particle_materials"] = list(run.case.powders)
            provenance.write_provenance(folder / "provenance.json", record)
            (folder / "case.toml").write_text(run.case.to_toml(), encoding="utf-8")
            self.history = History(folder / "history.csv", columns)
            self.results = ResultFile(folder / "results.vtkhdf", provenance=record)
        else:
            self.history = History(folder / "history.csv", columns, mode="a")
            self.history.truncate_after(after)
            self.results = ResultFile(folder / "results.vtkhdf", mode="a")
            self.results.truncate_after(after)

    def __enter__(self) -> "Output":
        return self

    def __exit__(self, *_: object) -> None:
        self.history.close()

    def _columns(self, run: "Runner") -> list[str]:
        columns = ["time [s]"]
        for name in run.walls:
            columns.append(f"{name}.displacement [m]")
            columns += [f"{name}.force_{axis} [N]" for axis in "xyz"]
        columns += [f"energy.{part} [J]" for part in ENERGIES]
        columns += ["relative_density [-]", "coordination [-]"]
        columns += [f"{name}.normal_force [N]" for name in run.walls]
        for name in run.walls:
            columns += [f"{name}.torque_{axis} [N m]" for axis in "xyz"]
            columns += [f"{name}.power [W]", f"{name}.work [J]"]
        columns += [
            "step",
            "stage",
            "height [m]",
            "time_step [s]",
            "inertial_number [-]",
        ]
        return [*columns, "energy.negative_increments [J]", "imbalance [-]"]

    def row(self, run: "Runner", stage: str) -> None:
        """Write one row of the history."""
        e = run.engine
        if self.memory_step(run) == run.steps:
            return
        run.memory["row"] = run.steps
        values: list[float | str] = [e.time]
        for w in range(len(run.walls)):
            values += [float(e.move[w, wl.DISPLACEMENT]), *map(float, e.total[w, :3])]
        parts = energies(run)
        values += [parts[name] for name in ENERGIES]
        volume, height = enclosed(run)
        solid = float(np.sum(np.sort(solid_volumes(e))))
        values += [solid / volume if volume else float("nan"), coordination(e)]
        values += [float(e.total[w, 3]) for w in range(len(run.walls))]
        for w in range(len(run.walls)):
            values += map(float, e.total[w, wl.TORQUE : wl.TOTALS])
            values.append(float(wl.wall_power(e.wall, e.move, e.body, e.total, w)))
            values.append(float(e.total[w, wl.WORK]))
        values += [run.steps, stage, height, float(e.clock[st.DT_LAST])]
        values += [inertial_number(run), float(e.sums[st.NEGATIVE]), imbalance(run)]
        self.history.row(values)

    @staticmethod
    def memory_step(run: "Runner") -> int:
        """Step of the last row."""
        return int(run.memory.get("row", -1))

    def frame(self, run: "Runner", stage: str) -> None:
        """Write one frame of the results, unless this step has one of this stage."""
        key = f"{run.steps} {stage}"
        if run.memory.get("frame") == key:
            return
        run.memory["frame"] = key
        contacts = contact_table(run.engine)
        particles = particle_table(run.engine, contacts)
        self.results.append(
            run.steps,
            run.engine.time,
            stage,
            particles,
            contacts,
            mesh_table(run.engine, surfaces_of(run.case, run.walls)),
        )

    def stages(self, stages: list[dict[str, Any]]) -> None:
        """Write the list of stages."""
        write_stages(self.folder / "stages.json", stages)

    def flush(self) -> None:
        """Hand the history to the operating system."""
        self.history.flush()

    def finish(self, run: "Runner", spent: float) -> None:
        """Write the stages and the time that the run took."""
        self.stages(run.stages)
        record = provenance.read_provenance(self.folder / "provenance.json")
        taken = float(record.get("wall_time_s") or 0.0) + spent
        record |= {
            "wall_time_s": taken,
            "steps": run.steps,
            "particles": len(run.engine.pos),
        }
        provenance.write_provenance(self.folder / "provenance.json", record)

    def metrics(self) -> dict[str, Any]:
        """Compute metrics.json and return it."""
        from pestle.metrics.summary import summarise, write_metrics
        from pestle.results.folder import RunFolder

        with RunFolder(self.folder) as folder:
            summary = summarise(folder)
        write_metrics(self.folder, summary)
        return summary.as_dict()


def _text(run: "Runner") -> str:
    source: Path | None = run.case.source
    return source.read_text(encoding="utf-8") if source else run.case.to_toml()


def enclosed(run: "Runner") -> tuple[float, float]:
    """Volume between die and punches, walls or box edges [m^3], and punch gap [m]."""
    e, case = run.engine, run.case
    if case.die is not None:
        low = float(e.wall[run.wall("lower_punch"), 3])
        upper = run.wall("upper_punch")
        if e.wall[upper, wl.ACTIVE] == 0.0:
            return 0.0, float("nan")
        gap = float(e.wall[upper, 3]) - low
        return case.die.area * gap, gap
    if case.box is not None and all(case.box.periodic):
        return float(np.prod(e.box[0])), float("nan")
    spans = []
    for axis in range(3):
        along = [w for w in e.wall if w[0] == 0.0 and abs(w[4 + axis]) > 1 - 1e-12]
        low_ = [w[1 + axis] for w in along if w[4 + axis] > 0]
        high = [w[1 + axis] for w in along if w[4 + axis] < 0]
        if not low_ or not high:
            return 0.0, float("nan")
        spans.append(min(high) - max(low_))
    return float(np.prod(spans)), float("nan")


def inertial_number(run: "Runner") -> float:
    """I = rate d sqrt(rho/p) of the driven punch: quasi-static below 1e-3 [-]."""
    e, case = run.engine, run.case
    if case.die is None:
        return float("nan")
    _, height = enclosed(run)
    w = run.wall("upper_punch")
    pressure = abs(float(e.total[w, 2])) / case.die.area
    if not height > 0.0 or pressure <= 0.0:
        return float("nan")
    rate = abs(float(e.move[w, wl.VELOCITY])) / height
    diameter = 2.0 * float(e.pos[:, 3].mean())
    density = float(e.vel[:, 3].sum() / solid_volumes(e).sum())
    return rate * diameter * float(np.sqrt(density / pressure))


def imbalance(run: "Runner") -> float:
    """Mean difference of the forces of a contact's sides over its mean force [-]."""
    e = run.engine
    sums = e.parts.sums._fields  # type: ignore[attr-defined]
    if "imbalance" not in sums:
        return float("nan")
    column = ct.COLUMNS + sums.index("imbalance")
    rows = np.concatenate(
        [
            e.buf[e.offset[c] : e.offset[c] + e.chunks[c + 1] - e.chunks[c], column]
            for c in range(len(e.chunks) - 1)
        ]
    )
    force = float(np.sum(np.abs(e.hist[:, 4])))
    return 0.5 * float(np.sum(rows)) / force if force > 0.0 else 0.0
