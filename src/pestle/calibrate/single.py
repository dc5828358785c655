r"""One particle: least squares for the start, then the posterior.

The noise has one size that is unknown; with a prior 1/sigma it integrates out:

.. math:: \ln L = -\frac{n}{2} \ln \sum_i (F_i - F(\delta_i))^2
"""

from typing import TYPE_CHECKING, Any

import numpy as np

from pestle.calibrate.posterior import Array, Posterior, sample, values_at
from pestle.errors import PestleError
from pestle.fit import Curve, Fit, fit
from pestle.particle import library
from pestle.particle.law import no_range_warnings

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
        return np.array([self._one(row) for row in rows])

    def _one(self, values: Array) -> float:
        given = {**self.fixed, **dict(zip(self.parameters, values, strict=True))}
        curve = self.curve
        try:
            law = library.build(self.law, given)
            force = law.follow(
                curve.displacement, radius=curve.radius, configuration="simple"
            ).force
        except PestleError:  # the law does not exist there
            return -np.inf
        total = float(np.sum((curve.force - force) ** 2))
        return -0.5 * len(curve.force) * float(np.log(max(total, 1e-300)))
