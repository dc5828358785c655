"""Bulk data: runs, a surrogate of their results, and the posterior by the surrogate.

New runs go where the posterior is and the surrogate is least certain.  It stops when,
over the posterior, what is unknown of the surrogate's mean is less than half a
measurement's deviation for every target.  The scatter from packing to packing is part
of the likelihood, but no number of runs takes it away.
"""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from pestle.calibrate.likelihood import Likelihood
from pestle.calibrate.posterior import Posterior, log_prior, sample
from pestle.calibrate.runs import Measured, Runs, Say, measured
from pestle.calibrate.surrogate import Surrogate, indices, train
from pestle.errors import InputError
from pestle.sweep.design import shares as spread_shares

if TYPE_CHECKING:
    from pestle.config.calibration import CalibrationSettings

Array = NDArray[np.float64]
ENOUGH = 0.5
"""Deviation of the surrogate over that of the measurement at which it is enough [-]."""
RUNS_EACH = 6
"""First runs for each parameter [-]."""


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
    cross_validation: Array  # error of runs left out one by one [deviations]


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
    table = Runs(settings, folder, wanted, workers, scheduler, say)
    table.add(shares)
    while True:
        surrogate = train(table.shares, table.outputs, settings.seed)
        likelihood = Likelihood.of(wanted, surrogate, table.shares, table.outputs)
        likely = _likely(settings, likelihood)
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
    start, spread = np.median(likely, axis=0), float(np.min(np.std(likely, axis=0)))
    posterior = sample(
        settings.parameters, likelihood, start, settings.seed, max(spread, 1e-4)
    )
    middle = np.median(posterior.shares, axis=0)[None, :]
    mean, error = likelihood.predict(middle)
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
        cross_validation=likelihood.left_out / likelihood.deviation,
    )


def _likely(settings: "CalibrationSettings", likelihood: Likelihood) -> Array:
    """Rough samples of the posterior: weighted points of a box that closes in."""
    count = len(settings.parameters)
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
