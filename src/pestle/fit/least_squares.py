r"""Least squares of a particle law's parameters against a measured curve.

Forces have errors of one size, displacements none.  With the residuals r at the best
parameters and their Jacobian J,

.. math::
    s^2 = \frac{r^T r}{n - p}, \quad C = s^2 (J^T J)^{-1}, \quad
    p_i \pm t_{0.975,\,n-p} \sqrt{C_{ii}}

are the 95 % intervals of a law that is linear near its optimum.  They know nothing of a
law that is wrong: look at the residuals.
"""

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pestle.errors import InputError, PestleError, did_you_mean
from pestle.particle import library
from pestle.particle.law import no_range_warnings

Array = NDArray[np.float64]

FACTORS = (0.3, 1.0, 3.0)
"""Starts that are tried for each parameter, as factors of the given or guessed one."""
BLIND = 1e-9
"""Relative change of the force by that of a parameter which the curve does not see."""


@dataclass(frozen=True, kw_only=True)
class Curve:
    """A measured curve of one particle between two platens.

    Parameters
    ----------
    approach : array
        How far the platens have approached since touch, in the order of time [m].
    force : array
        Force of a platen [N].
    diameter : float
        Diameter of the particle before [m].
    """

    approach: Array
    force: Array
    diameter: float

    def __post_init__(self) -> None:
        """Refuse curves that cannot be fitted."""
        whole = np.all(np.isfinite(self.approach)) and np.all(np.isfinite(self.force))
        if len(self.approach) != len(self.force) or len(self.force) < 3 or not whole:
            raise InputError(
                "no-curve",
                f"{len(self.approach)} displacements and {len(self.force)} forces are "
                "not a curve",
                hint="at least three points with a finite number for each",
            )
        if not self.diameter > 0.0 or np.max(self.approach) >= self.diameter:
            raise InputError(
                "diameter-out-of-range",
                f"platens that approach by {np.max(self.approach):.4g} m do not fit a "
                f"particle of diameter {self.diameter:.4g} m",
                hint="displacement is that of one platen towards the other, in the "
                "unit of its column",
            )

    @property
    def displacement(self) -> Array:
        """Displacement of each platen towards the centre, half the approach [m]."""
        return 0.5 * np.asarray(self.approach, dtype=float)

    @property
    def radius(self) -> float:
        """Radius of the particle [m]."""
        return 0.5 * self.diameter


@dataclass(frozen=True, kw_only=True)
class Fit:
    """What a fit found."""

    law: str
    names: tuple[str, ...]
    values: Array
    fixed: dict[str, Any]
    covariance: Array
    predicted: Array  # force of the law at the points [N]
    residuals: Array  # measured minus predicted [N]
    at_bound: tuple[str, ...]
    curve: Curve = field(repr=False)

    @property
    def degrees(self) -> int:
        """Points less fitted parameters."""
        return len(self.residuals) - len(self.names)

    @property
    def errors(self) -> Array:
        """Standard errors."""
        return np.sqrt(np.diag(self.covariance))

    @property
    def noise(self) -> float:
        """Standard deviation of the residuals s [N]."""
        return float(np.sqrt(self.residuals @ self.residuals / self.degrees))

    @property
    def correlation(self) -> Array:
        """Correlation of the parameters."""
        return self.covariance / np.outer(self.errors, self.errors)

    def interval(self, level: float = 0.95) -> Array:
        """Lower and upper end of each parameter at a level of confidence."""
        from scipy.stats import t

        width = t.ppf(0.5 + 0.5 * level, self.degrees) * self.errors
        return np.stack([self.values - width, self.values + width], axis=1)

    def parameters(self) -> dict[str, Any]:
        """All parameters of the law, fitted and fixed."""
        return {
            **self.fixed,
            **dict(zip(self.names, self.values.tolist(), strict=True)),
        }


def fit(
    law: str,
    curve: Curve,
    vary: Sequence[str],
    *,
    fixed: Mapping[str, Any] | None = None,
    start: Mapping[str, float] | None = None,
    bounds: Mapping[str, tuple[float, float]] | None = None,
) -> Fit:
    """Fit some parameters of a law to a curve of simple compression.

    Parameters
    ----------
    law : str
        Loading law, with one of unloading where the curve unloads.
    curve : Curve
        The measurement.
    vary : sequence of str
        Parameters to fit.
    fixed : mapping
        Values of the others.
    start, bounds : mapping
        Where to begin and between which values; by default a guess from the curve, and
        the law's own limits.
    """
    fixed, start = dict(fixed or {}), dict(start or {})
    limits = _limits(law, vary, fixed, bounds or {})
    model = _Model(law, curve, tuple(vary), fixed)
    first = np.array([start.get(name, _guess(name, curve)) for name in vary])
    first = np.clip(first, *_inner(limits))
    with no_range_warnings():  # what is tried on the way need not be in range
        scale, best = _best_start(model, first, limits, tried=set(start))
        values, jacobian = _solve(model, best, limits, scale)
    return _result(model, values, jacobian, limits)


@dataclass(frozen=True)
class _Model:
    law: str
    curve: Curve
    names: tuple[str, ...]
    fixed: dict[str, Any]

    def force(self, values: Array) -> Array:
        """Force of the law at the points of the curve."""
        given = {**self.fixed, **dict(zip(self.names, values, strict=True))}
        law = library.build(self.law, given)
        at = {"radius": self.curve.radius, "configuration": "simple"}
        return law.follow(self.curve.displacement, **at).force  # type: ignore[arg-type]

    def residuals(self, values: Array) -> Array:
        """Measured less computed force, over the largest measured one.

        Where a law does not exist, such as below its smallest modulus, the residuals
        are large, so that the search turns back.
        """
        scale = float(np.max(np.abs(self.curve.force)))
        try:
            force = self.force(values)
        except PestleError:
            return np.full(len(self.curve.force), 1e3)
        return (self.curve.force - force) / scale


def _limits(
    law: str,
    vary: Sequence[str],
    fixed: Mapping[str, Any],
    bounds: Mapping[str, tuple[float, float]],
) -> Array:
    known = library.fields(law)
    for name in (*vary, *fixed, *bounds):
        if name not in known or (name in vary and "low" not in known[name].metadata):
            numbers = [k for k, entry in known.items() if "low" in entry.metadata]
            raise InputError(
                "unknown-law-parameter",
                f"{law} has no number {name!r} to fit or fix",
                hint=did_you_mean(name, numbers),
            )
    if not vary or set(vary) & set(fixed) or len(set(vary)) < len(vary):
        raise InputError(
            "nothing-to-fit",
            f"{', '.join(vary) or 'nothing'} to fit with "
            "{', '.join(fixed) or 'nothing'} fixed",
            hint="name each parameter once, and at least one to fit",
        )
    own = [(known[n].metadata["low"], known[n].metadata["high"]) for n in vary]
    pairs = [
        (max(low, bounds[n][0]), min(high, bounds[n][1]))
        if n in bounds
        else (low, high)
        for n, (low, high) in zip(vary, own, strict=True)
    ]
    for name, (low, high) in zip(vary, pairs, strict=True):
        if not low < high:
            raise InputError(
                "empty-bounds",
                f"{name} has no value between {low:g} and {high:g}",
                hint="bounds must rise and lie within those of the law",
            )
    return np.array(pairs, dtype=float)


def _inner(limits: Array) -> tuple[Array, Array]:
    """Bounds moved inwards by a little: a law may not exist on them."""
    low, high = limits.T
    finite = np.isfinite(high)
    width = np.where(finite, np.where(finite, high, 0.0) - low, np.abs(low))
    return low + 1e-6 * width + 1e-300, np.where(finite, high - 1e-6 * width, high)


def _guess(name: str, curve: Curve) -> float:
    """Start of a parameter from the size of the curve."""
    top = int(np.argmax(curve.force))
    x = max(curve.displacement[top] / curve.radius, 1e-9)
    pressure = float(curve.force[top]) / (3.0 * np.pi * curve.radius**2 * 2.0 * x)
    by_name = {
        "youngs_modulus": 300.0 * pressure,
        "yield_stress": pressure,
        "strength": 2.0 * pressure,
        "poisson_ratio": 0.3,
        "hardening_exponent": 0.3,
        "exponent": 1.3,
        "stiffness_ratio": 20.0,
        "transition": 0.1,
        "stiffening": 20.0 / (float(curve.force[top]) * curve.radius),
        "work_of_adhesion": 1e-3 * pressure * curve.radius,
    }
    return float(by_name.get(name, 1.0))


def _best_start(
    model: _Model, first: Array, limits: Array, *, tried: set[str]
) -> tuple[Array, Array]:
    """Best of a grid of starts around the first, and the scale of each parameter.

    A parameter whose start was given stays there.
    """
    low, high = _inner(limits)
    choices = [(1.0,) if name in tried else FACTORS for name in model.names]
    grid = [np.clip(first * f, low, high) for f in itertools.product(*choices)]
    costs = [float(np.sum(model.residuals(point) ** 2)) for point in grid]
    best = grid[int(np.argmin(costs))]
    return np.maximum(np.abs(best), 1e-3 * np.abs(first) + 1e-300), best


def _solve(
    model: _Model, start: Array, limits: Array, scale: Array
) -> tuple[Array, Array]:
    """Best parameters, and the derivative of the force by them."""
    from scipy.optimize import least_squares

    low, high = _inner(limits)

    def scaled(u: Array) -> Array:
        return model.residuals(u * scale)

    found = least_squares(
        scaled,
        start / scale,
        jac="3-point",
        bounds=(low / scale, high / scale),
        xtol=1e-10,
        ftol=1e-12,
        gtol=1e-12,
        max_nfev=200,
    )
    size = float(np.max(np.abs(model.curve.force)))
    return found.x * scale, np.asarray(found.jac) * size / scale


def _result(model: _Model, values: Array, jacobian: Array, limits: Array) -> Fit:
    low, high = _inner(limits)
    predicted = model.force(values)
    residuals = model.curve.force - predicted
    bound = tuple(
        name
        for name, value, a, b in zip(model.names, values, low, high, strict=True)
        if value - a < 1e-5 * abs(value) or b - value < 1e-5 * abs(value)
    )
    return Fit(
        law=model.law,
        names=model.names,
        values=values,
        fixed=model.fixed,
        covariance=_covariance(model, values, jacobian, residuals),
        predicted=predicted,
        residuals=residuals,
        at_bound=bound,
        curve=model.curve,
    )


def _covariance(
    model: _Model, values: Array, jacobian: Array, residuals: Array
) -> Array:
    """Covariance of the parameters, where the curve tells them apart."""
    number, count = jacobian.shape
    if number <= count:
        raise InputError(
            "too-few-points",
            f"{number} points cannot give {count} parameters and their errors",
            hint="fix some parameters or measure more points",
        )
    norms = np.linalg.norm(jacobian, axis=0)
    effect = norms * np.abs(values) / np.linalg.norm(model.curve.force)
    if np.any(effect < BLIND) or np.linalg.cond(jacobian / norms) > 1e8:
        raise InputError(
            "parameters-not-told-apart",
            f"the curve does not fix {', '.join(model.names)} each by itself",
            hint="fit fewer parameters and fix the others",
        )
    inverse = np.linalg.inv((jacobian / norms).T @ (jacobian / norms))
    variance = residuals @ residuals / (number - count)
    return np.asarray(variance * inverse / np.outer(norms, norms))
