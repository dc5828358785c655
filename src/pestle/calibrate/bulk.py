r"""Bulk data: runs, a surrogate of their results, and the posterior by the surrogate.

.. math::
    \ln L = -\frac12 \sum_k \left[\frac{(y_k - \mu_k)^2}{\sigma_k^2 + s_k^2}
    + \ln(\sigma_k^2 + s_k^2)\right]

with the measured y_k and their deviation sigma_k, and mean mu_k and deviation s_k of
the surrogate.  New runs go where the posterior is and the surrogate is least certain.
It stops when, over the posterior, what is unknown of mu_k is less than half a
measurement's deviation for every target.  The scatter of runs with another packing is
part of s_k, but no number of runs takes it away.
"""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from pestle.calibrate.posterior import Posterior, log_prior, sample, values_at
from pestle.calibrate.surrogate import Surrogate, indices, left_out, train
from pestle.errors import InputError, SimulationError
from pestle.sweep import Job, Outcome, finished
from pestle.sweep.design import shares as spread_shares
from pestle.sweep.jobs import identity, stored

if TYPE_CHECKING:
    from pestle.config.calibration import CalibrationSettings, Target

Array = NDArray[np.float64]
ENOUGH = 0.5
"""Deviation of the surrogate over that of the measurement at which it is enough [-]."""
RUNS_EACH = 6
"""First runs for each parameter [-]."""


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


@dataclass(frozen=True)
class BulkResult:
    """What a calibration with bulk data found."""

    posterior: Posterior
    measured: list[Measured]
    predicted: Array  # of the surrogate at the median, a mean for each target
    error: Array  # its standard deviation
    shares: Array  # of the runs
    outputs: Array  # of the runs
    runs: int
    failed: int
    converged: bool
    sensitivity: dict[str, Any]
    cross_validation: Array  # root mean square error, left out one by one [scale]


Say = Callable[[str], None]


def measured(settings: "CalibrationSettings") -> list[Measured]:
    """All numbers of the targets in SI units."""
    assert settings.bulk is not None
    return [m for target in settings.bulk.targets for m in _numbers(settings, target)]


def _numbers(settings: "CalibrationSettings", target: "Target") -> list[Measured]:
    from pestle.config.calibration import CURVES, read_columns
    from pestle.config.study import number, unit_of

    if target.metric is not None:
        unit = unit_of(target.value)
        value, sigma = number(target.value, unit), number(target.deviation, unit)
        name = target.metric
        return [Measured(name, value, sigma, unit, metric=name)]
    assert target.curve is not None
    assert target.file is not None
    unit = CURVES[target.curve]
    columns = read_columns(
        settings.resolve(target.file), {"relative_density": "1", target.curve: unit}
    )
    order = np.argsort(columns["relative_density"])
    x, y = columns["relative_density"][order], columns[target.curve][order]
    sigma = number(target.deviation, unit)
    return [
        Measured(
            f"{target.curve} at density {d:.3f}",
            float(np.interp(d, x, y)),
            sigma,
            unit,
            curve=target.curve,
            density=float(d),
        )
        for d in np.linspace(x[0], x[-1], target.points)
    ]


def outputs_of(folder: Path, outcome: Outcome, wanted: list[Measured]) -> Array:
    """The numbers of a run that the targets ask for; NaN where it has none."""
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
            y = curves.axial if m.curve == "axial_stress" else curves.radial
            top = np.maximum.accumulate(curves.density[rows])
            found.append(float(np.interp(m.density, top, y[rows])))
    return np.array(found)


def calibrate(
    settings: "CalibrationSettings",
    folder: Path,
    *,
    workers: int,
    scheduler: str | None = None,
    say: Say = lambda text: None,
) -> BulkResult:
    """Run, learn, sample, until the surrogate is good enough.

    Parameters
    ----------
    settings : CalibrationSettings
        With data of the bulk.
    folder : Path
        Where the runs are, or will be.
    workers : int
        Processes on this machine [-].
    scheduler : str, optional
        Address of a Dask scheduler.
    say : callable
        Told what happens, in sentences.
    """
    data = settings.bulk
    assert data is not None
    wanted = measured(settings)
    count = len(settings.parameters)
    first = data.first or RUNS_EACH * count
    if first > data.most:
        raise InputError(
            "too-few-runs",
            f"{first} first runs are more than the most, {data.most}",
            "bulk.most",
        )
    guess = min(first + 4 * count, data.most)
    say(f"{first} runs first, probably {guess} in all, at most {data.most}")
    shares = np.array(spread_shares("latin_hypercube", count, first, settings.seed))
    table = _Table(settings, folder, wanted, workers, scheduler, say)
    table.add(shares)
    while True:
        surrogate = train(table.shares, table.outputs, settings.seed)
        likely = _likely(settings, surrogate, wanted)
        ratio = _uncertain(surrogate, likely, wanted)
        converged = ratio <= ENOUGH
        say(
            f"{len(table.shares)} runs: surrogate adds {ratio:.2f} deviations of the "
            f"measurements{', enough' if converged else ''}"
        )
        if converged or table.asked >= data.most:
            break
        more = min(max(2, workers), data.most - table.asked)
        table.add(_next(surrogate, likely, wanted, more, table.shares))
    posterior = _posterior(settings, surrogate, wanted, likely)
    sigma = np.array([m.deviation for m in wanted])
    middle = np.median(posterior.shares, axis=0)[None, :]
    mean, error = surrogate.predict(middle)
    errors = left_out(table.shares, table.outputs, surrogate) * surrogate.scale / sigma
    return BulkResult(
        posterior=posterior,
        measured=wanted,
        predicted=mean[0],
        error=error[0],
        shares=table.shares,
        outputs=table.outputs,
        runs=table.asked,
        failed=table.asked - len(table.shares),
        converged=bool(converged),
        sensitivity=indices(surrogate, posterior.names, settings.seed),
        cross_validation=np.sqrt(np.mean(errors**2, axis=0)),
    )


class _Table:
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

    def add(self, shares: Array) -> None:
        """Compute runs at these shares; those that fail are left out."""
        jobs = [self._job(row) for row in shares]
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
                lack = [
                    m.label
                    for m, v in zip(self.wanted, values, strict=True)
                    if not np.isfinite(v)
                ]
                self.say(f"run {job.id} is left out: it has no {', '.join(lack)}")
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

    def _job(self, row: Array) -> Job:
        data = self.settings.bulk
        assert data is not None
        values = values_at(self.settings.parameters, row[None, :])[0]
        changes = dict(data.set)
        for (key, p), value in zip(
            self.settings.parameters.items(), values, strict=True
        ):
            changes[key] = p.written(float(value))
        path = str(self.settings.resolve(data.case).resolve())
        name = identity(Job("", path, changes, "").case())
        return Job(name, path, changes, str(self.folder.resolve() / "runs" / name))


def _likelihood(
    surrogate: Surrogate, wanted: list[Measured]
) -> Callable[[Array], Array]:
    """Logarithm of the likelihood of many rows of shares, by the surrogate."""
    target = np.array([m.value for m in wanted])
    sigma = np.array([m.deviation for m in wanted])

    def likelihood(shares: Array) -> Array:
        mean, error = surrogate.predict(shares)
        variance = sigma**2 + error**2
        return np.asarray(
            -0.5 * np.sum((target - mean) ** 2 / variance + np.log(variance), axis=1)
        )

    return likelihood


def _likely(
    settings: "CalibrationSettings", surrogate: Surrogate, wanted: list[Measured]
) -> Array:
    """Rough samples of the posterior: weighted points of a box that closes in."""
    count = len(settings.parameters)
    likelihood = _likelihood(surrogate, wanted)
    low, high = np.zeros(count), np.ones(count)
    random = np.random.default_rng(settings.seed)
    for turn in range(3):
        unit = spread_shares("latin_hypercube", count, 2000, settings.seed + turn)
        shares = low + (high - low) * np.array(unit)
        weight = likelihood(shares) + log_prior(settings.parameters, shares)
        weight = np.exp(weight - weight.max())
        found = shares[random.choice(len(shares), 1000, p=weight / weight.sum())]
        margin = 0.3 * np.ptp(found, axis=0) + 0.02
        low = np.maximum(found.min(axis=0) - margin, 0.0)
        high = np.minimum(found.max(axis=0) + margin, 1.0)
    return np.asarray(found)


def _posterior(
    settings: "CalibrationSettings",
    surrogate: Surrogate,
    wanted: list[Measured],
    likely: Array,
) -> Posterior:
    likelihood = _likelihood(surrogate, wanted)
    start, spread = np.median(likely, axis=0), float(np.min(np.std(likely, axis=0)))
    return sample(
        settings.parameters, likelihood, start, settings.seed, max(spread, 1e-4)
    )


def _uncertain(surrogate: Surrogate, likely: Array, wanted: list[Measured]) -> float:
    """Largest mean deviation of the surrogate over that of a measurement [-]."""
    error = surrogate.unknown(likely)
    sigma = np.array([m.deviation for m in wanted])
    return float(np.max(np.mean(error, axis=0) / sigma))


def _next(
    surrogate: Surrogate,
    likely: Array,
    wanted: list[Measured],
    count: int,
    done: Array,
) -> Array:
    """Points of the posterior where the surrogate knows least, spread out."""
    error = surrogate.unknown(likely)
    sigma = np.array([m.deviation for m in wanted])
    need = np.max(error / sigma, axis=1)
    taken, chosen = done, []
    for _ in range(count):
        apart = np.min(np.linalg.norm(likely[:, None] - taken[None], axis=2), axis=1)
        best = int(np.argmax(need * np.minimum(apart / 0.1, 1.0)))
        chosen.append(likely[best])
        taken = np.vstack([taken, likely[best]])
    return np.array(chosen)
