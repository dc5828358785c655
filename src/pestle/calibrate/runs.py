"""Runs of a calibration: what was measured, and what each run has for it.

Every run fills its die with its own seed: that of the case and the next ones, or the
one that `bulk.set` gives to all.  So runs scatter among each other as one of them does
about the measured powder.
"""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from pestle.calibrate.posterior import values_at
from pestle.errors import SimulationError
from pestle.sweep import Job, Outcome, finished
from pestle.sweep.jobs import identity, stored

if TYPE_CHECKING:
    from pestle.config.calibration import CalibrationSettings, Target

Array = NDArray[np.float64]
Say = Callable[[str], None]


@dataclass(frozen=True)
class Measured:
    """A number that runs are compared with."""

    label: str
    value: float
    deviation: float
    unit: str = "1"
    metric: str = ""
    curve: str = ""
    density: float = 0.0


def measured(settings: "CalibrationSettings") -> list[Measured]:
    """All numbers of the targets in SI units."""
    assert settings.bulk is not None
    return [m for target in settings.bulk.targets for m in _numbers(settings, target)]


def _numbers(settings: "CalibrationSettings", target: "Target") -> list[Measured]:
    from pestle.config.calibration import read_columns
    from pestle.config.study import number, unit_of

    if target.metric is not None:
        unit = unit_of(target.value)
        value, sigma = number(target.value, unit), number(target.deviation, unit)
        name = target.metric
        return [Measured(name, value, sigma, unit, metric=name)]
    assert target.curve is not None
    assert target.file is not None
    columns = read_columns(
        settings.resolve(target.file), {"relative_density": "1", target.curve: "Pa"}
    )
    order = np.argsort(columns["relative_density"])
    x, y = columns["relative_density"][order], columns[target.curve][order]
    sigma = number(target.deviation, "Pa")
    return [
        Measured(
            f"{target.curve} at density {d:.3f}",
            float(np.interp(d, x, y)),
            sigma,
            "Pa",
            curve=target.curve,
            density=float(d),
        )
        for d in np.linspace(x[0], x[-1], target.points)
    ]


def outputs_of(folder: Path, outcome: Outcome, wanted: list[Measured]) -> Array:
    """The numbers of a run that the targets ask for; NaN where it has none."""
    from pestle.config.calibration import CURVES
    from pestle.metrics.die_curves import die_curves
    from pestle.results.folder import RunFolder

    found = []
    curves = None
    if any(m.curve for m in wanted):
        with RunFolder(folder) as run:
            curves = die_curves(run)
    for m in wanted:
        if m.metric:
            entry = outcome.metrics.get(m.metric)
            found.append(float("nan") if entry is None else entry["value"])
        elif curves is None:
            found.append(float("nan"))
        else:
            rows = curves.loading
            y = getattr(curves, CURVES[m.curve])
            top = np.maximum.accumulate(curves.density[rows])
            found.append(float(np.interp(m.density, top, y[rows], right=np.nan)))
    return np.array(found)


class Runs:
    """Runs so far, as shares and outputs."""

    def __init__(
        self,
        settings: "CalibrationSettings",
        folder: Path,
        wanted: list[Measured],
        workers: int,
        scheduler: str | None,
        say: Say,
    ) -> None:
        self.settings, self.folder, self.wanted = settings, folder, wanted
        self.workers, self.scheduler, self.say = workers, scheduler, say
        self.shares = np.zeros((0, len(settings.parameters)))
        self.outputs = np.zeros((0, len(wanted)))
        self.asked = 0
        assert settings.bulk is not None
        self.set = settings.bulk.set
        self.path = str(settings.resolve(settings.bulk.case).resolve())
        self.seed = Job("", self.path, self.set, "").case().seed

    def add(self, shares: Array) -> None:
        """Compute runs at these shares; those that fail are left out."""
        jobs = [self._job(self.asked + k, row) for k, row in enumerate(shares)]
        found = {job.id: stored(Path(job.folder)) for job in jobs}
        missing = [job for job in jobs if found[job.id] is None]
        for name, outcome in finished(missing, self.workers, self.scheduler):
            found[name] = outcome
        self.asked += len(shares)
        for row, job in zip(shares, jobs, strict=True):
            known = found[job.id]
            if known is None or known.status != "done":
                reason = known.reason if known else "it did not end"
                self.say(f"run {job.id} is left out: {reason}")
                continue
            values = outputs_of(Path(job.folder), known, self.wanted)
            if not np.all(np.isfinite(values)):
                self.say(f"run {job.id} is left out: {self._lack(values)}")
                continue
            self.shares = np.vstack([self.shares, row])
            self.outputs = np.vstack([self.outputs, values])
        if len(self.shares) < 2 * len(self.settings.parameters):
            raise SimulationError(
                "too-few-runs-done",
                f"only {len(self.shares)} of {self.asked} runs can be used",
                str(self.folder),
                "narrower bounds, or another case; the runs' folders say what failed",
            )

    def _lack(self, values: Array) -> str:
        """What a run does not have, in words."""
        pairs = zip(self.wanted, values, strict=True)
        missing = [m for m, value in pairs if not np.isfinite(value)]
        text = f"it has no {', '.join(m.label for m in missing)}"
        further = "; press it further, by bulk.set or in the case"
        return text + (further if any(m.curve for m in missing) else "")

    def _job(self, number: int, row: Array) -> Job:
        values = values_at(self.settings.parameters, row[None, :])[0]
        changes = {"seed": self.seed + number, **self.set}
        for (key, p), value in zip(
            self.settings.parameters.items(), values, strict=True
        ):
            changes[key] = p.written(float(value))
        name = identity(Job("", self.path, changes, "").case())
        return Job(name, self.path, changes, str(self.folder.resolve() / "runs" / name))
