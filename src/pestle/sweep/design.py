"""Points of a study: all combinations of values, or a spread over their space.

Latin hypercubes and Sobol sequences are those of `scipy.stats.qmc`; a value that is
chosen from an array takes equal shares of its axis.
"""

from itertools import product
from typing import TYPE_CHECKING, Any

from pestle.config.study import MOST_RUNS, Interval
from pestle.errors import InputError

if TYPE_CHECKING:
    from pestle.config.study import StudySettings

Point = dict[str, Any]
"""Values by key of the case."""


def points(study: "StudySettings") -> list[Point]:
    """Points of a study, without replicates.

    Parameters
    ----------
    study : StudySettings
        What is varied, and how.

    Returns
    -------
    list of dict
        Values as a case file takes them, by key; the same for the same study.
    """
    count = size(study)
    if count * study.replicates > MOST_RUNS:
        raise InputError(
            "too-many-runs",
            f"{count} points and {study.replicates} replicates are more than "
            f"{MOST_RUNS} runs",
            str(study.source),
            'fewer values, or design = "sobol"',
        )
    if study.design == "grid":
        axes = [grid_values(values) for values in study.vary.values()]
        return [dict(zip(study.vary, row, strict=True)) for row in product(*axes)]
    rows = shares(study.design, len(study.vary), count, study.seed)
    return [
        {
            key: value_at(values, share)
            for (key, values), share in zip(study.vary.items(), row, strict=True)
        }
        for row in rows
    ]


def size(study: "StudySettings") -> int:
    """Number of points."""
    from math import prod

    if study.samples is not None:
        return study.samples
    return prod(
        values.points or 1 if isinstance(values, Interval) else len(values)
        for values in study.vary.values()
    )


def grid_values(values: list[Any] | Interval) -> list[Any]:
    """Values of one key in a grid."""
    if isinstance(values, list):
        return values
    count = values.points or 1
    places = [k / (count - 1) for k in range(count)] if count > 1 else [0.5]
    return [values.written(values.at(place)) for place in places]


def value_at(values: list[Any] | Interval, share: float) -> Any:
    """Value at a share between 0 and 1 of an axis."""
    if isinstance(values, Interval):
        return values.written(values.at(share))
    return values[min(int(share * len(values)), len(values) - 1)]


def shares(design: str, axes: int, count: int, seed: int) -> list[list[float]]:
    """Points of a Latin hypercube or Sobol sequence in the unit cube [-]."""
    from scipy.stats import qmc

    if design == "sobol":
        rows = qmc.Sobol(axes, rng=seed).random_base2(count.bit_length() - 1)
    else:
        rows = qmc.LatinHypercube(axes, rng=seed).random(count)
    return [[float(value) for value in row] for row in rows]
