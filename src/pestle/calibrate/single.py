r"""One particle: least squares for the start, then the posterior.

The noise has one size that is unknown; with a prior 1/sigma it integrates out:

.. math:: \ln L = -\frac{n}{2} \ln \sum_i (F_i - F(\delta_i))^2
"""

from contextlib import suppress
from typing import TYPE_CHECKING, Any

import numpy as np

from pestle.calibrate.posterior import Array, Posterior, sample, values_at
from pestle.errors import PestleError
from pestle.fit import Curve, Fit, fit
from pestle.particle import library
from pestle.particle.law import no_range_warnings
from pestle.particle.zunker2024 import Zunker2024

if TYPE_CHECKING:
    from pestle.config.calibration import CalibrationSettings, Parameter


def calibrate(settings: "CalibrationSettings") -> tuple[Fit, Posterior]:
    """Least squares and posterior of a particle's curve.

    Parameters
    ----------
    settings : CalibrationSettings
        With data of one particle.
    """
    from pestle.config.calibration import read_columns

    data = settings.particle
    assert data is not None
    read = {"displacement": "m", "force": "N"}
    columns = read_columns(settings.resolve(data.file), read)
    curve = Curve(
        approach=columns["displacement"], force=columns["force"], diameter=data.diameter
    )
    fixed = fixed_values(data.law, data.fixed)
    bounds = {name: p.ends for name, p in settings.parameters.items()}
    best = fit(data.law, curve, list(settings.parameters), fixed=fixed, bounds=bounds)
    start = shares_of(settings.parameters, best.values)
    likelihood = _Likelihood(data.law, curve, fixed, settings.parameters)
    with no_range_warnings():
        found = sample(settings.parameters, likelihood, start, settings.seed, 1e-3)
    return best, found


def fixed_values(law: str, given: dict[str, Any]) -> dict[str, Any]:
    """Fixed parameters of a law in SI units."""
    from pestle.config.study import number

    known = library.fields(law)
    found = {}
    for name, value in given.items():
        unit = known[name].metadata.get("unit", "1") if name in known else None
        found[name] = value if unit is None else number(value, unit)
    return found


def shares_of(parameters: "dict[str, Parameter]", values: Array) -> Array:
    """Shares of values, within the intervals."""
    found = [
        p.share(float(v)) for p, v in zip(parameters.values(), values, strict=True)
    ]
    return np.clip(found, 1e-3, 1.0 - 1e-3)


class _Likelihood:
    """Likelihood of many rows of shares."""

    def __init__(
        self,
        law: str,
        curve: Curve,
        fixed: dict[str, Any],
        parameters: "dict[str, Parameter]",
    ) -> None:
        self.law, self.curve, self.fixed = law, curve, fixed
        self.parameters = parameters

    def __call__(self, shares: Array) -> Array:
        rows = values_at(self.parameters, shares)
        if self.law != Zunker2024.name:  # a formula takes all rows at once ...
            with suppress(PestleError):  # ... where the law exists for all of them
                return self._at(rows.T[:, :, None])
        return np.array([self._one(row) for row in rows])

    def _one(self, values: Array) -> Array:
        try:
            return self._at(values)
        except PestleError:  # the law does not exist there
            return np.array(-np.inf)

    def _at(self, values: Array) -> Array:
        """Likelihood of parameters, each a number or a column of numbers."""
        given = {**self.fixed, **dict(zip(self.parameters, values, strict=True))}
        curve = self.curve
        law = library.build(self.law, given)
        path = np.broadcast_to(
            curve.displacement, (*values.shape[1:-1], len(curve.displacement))
        )
        force = law.follow(path, radius=curve.radius, configuration="simple").force
        total = np.sum((curve.force - force) ** 2, axis=-1)
        return np.asarray(-0.5 * len(curve.force) * np.log(np.maximum(total, 1e-300)))
