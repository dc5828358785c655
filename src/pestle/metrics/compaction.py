r"""Compaction in a die: stresses, Heckel and Kawakita fits, ejection, recovery.

Stress is positive in compression. With the die radius :math:`R`, the distance of the
punches :math:`h` and the relative density :math:`D`,

.. math::
    \sigma_a = F_a / (\pi R^2), \quad \sigma_r = N_{die} / (2 \pi R h) \\
    \ln\frac{1}{1 - D} = k P + A \qquad \text{(Heckel; mean yield pressure } 1/k) \\
    \frac{P}{C} = \frac{P}{a} + \frac{1}{a b}, \quad C = 1 - D_0 / D
    \qquad \text{(Kawakita)}

Both fits here are *in-die*: density and pressure are taken under load.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class HeckelFit:
    """Straight line of ln 1/(1 - D) against pressure, in-die.

    Parameters
    ----------
    slope : float
        k [1/Pa].
    intercept : float
        A [-].
    low, high : float
        Range of pressure that was fitted [Pa].
    r_squared : float
        Part of the variance that the line explains [-].
    points : int
        Number of points [-].
    """

    slope: float
    intercept: float
    low: float
    high: float
    r_squared: float
    points: int

    @property
    def yield_pressure(self) -> float:
        """Mean yield pressure 1/k [Pa]."""
        return 1.0 / self.slope


@dataclass(frozen=True, slots=True, kw_only=True)
class KawakitaFit:
    """Straight line of P/C against pressure, in-die.

    Parameters
    ----------
    a : float
        Limit of the degree of volume reduction [-].
    b : float
        Reciprocal of the pressure that reaches half of it [1/Pa].
    initial_density : float
        Relative density D_0 that volume reduction is counted from [-].
    low, high : float
        Range of pressure that was fitted [Pa].
    r_squared : float
        Part of the variance that the line explains [-].
    points : int
        Number of points [-].
    """

    a: float
    b: float
    initial_density: float
    low: float
    high: float
    r_squared: float
    points: int


def axial_stress(force: Array, die_radius: float) -> Array:
    """Punch force over the cross-section of the die.

    Parameters
    ----------
    force : ndarray
        Force on the powder along the die, into the powder [N].
    die_radius : float
        Radius of the die [m].

    Returns
    -------
    ndarray
        Stress [Pa].

    Examples
    --------
    >>> round(float(axial_stress(np.array([100.0]), 2e-3)[0]))
    7957747
    """
    return np.asarray(force) / (np.pi * die_radius**2)


def die_wall_stress(normal_force: Array, die_radius: float, height: Array) -> Array:
    """Sum of the normal forces on the die over the wall between the punches.

    Parameters
    ----------
    normal_force : ndarray
        Sum of the normal contact forces on the die [N].
    die_radius : float
        Radius of the die [m].
    height : ndarray
        Height of the powder in the die [m].

    Returns
    -------
    ndarray
        Radial stress [Pa], NaN where there is no height.
    """
    area = 2.0 * np.pi * die_radius * np.asarray(height, dtype=np.float64)
    stress = np.full(area.shape, np.nan)
    np.divide(normal_force, area, out=stress, where=area > 0.0)
    return stress


def heckel(
    pressure: Array,
    density: Array,
    *,
    low: float | None = None,
    high: float | None = None,
) -> HeckelFit | None:
    """Fit the Heckel line to an in-die compaction curve.

    Parameters
    ----------
    pressure : ndarray
        Axial stress while loading [Pa].
    density : ndarray
        Relative density [-]; points at 1 or above (elastic compression of a dense
        tablet) are left out, for the logarithm ends there.
    low, high : float, optional
        Range of the fit [Pa]; 30 % and 90 % of the largest pressure if not given.

    Returns
    -------
    HeckelFit or None
        None with fewer than five points in the range or a slope that is not positive.

    Examples
    --------
    >>> p = np.linspace(0.0, 150e6, 200)
    >>> fit = heckel(p, 1.0 - np.exp(-(p / 80e6 + 0.5)))
    >>> round(fit.yield_pressure / 1e6, 6), round(fit.intercept, 6)
    (80.0, 0.5)
    """
    low, high = _range(pressure, low, high)
    use = _in_range(pressure, low, high) & (density < 1.0) & (density > 0.0)
    x, y = pressure[use], -np.log1p(-density[use])
    line = _line(x, y)
    if line is None or line[0] <= 0.0:
        return None
    slope, intercept, r_squared = line
    return HeckelFit(
        slope=slope,
        intercept=intercept,
        low=low,
        high=high,
        r_squared=r_squared,
        points=len(x),
    )


def kawakita(
    pressure: Array,
    density: Array,
    initial_density: float,
    *,
    low: float | None = None,
    high: float | None = None,
) -> KawakitaFit | None:
    """Fit the Kawakita line to an in-die compaction curve.

    Parameters
    ----------
    pressure : ndarray
        Axial stress while loading [Pa].
    density : ndarray
        Relative density [-].
    initial_density : float
        Relative density of the bed before compaction [-].
    low, high : float, optional
        Range of the fit [Pa]; 5 % and 100 % of the largest pressure if not given.

    Returns
    -------
    KawakitaFit or None
        None with fewer than five points in the range or a line without meaning.

    Examples
    --------
    >>> p = np.linspace(1e6, 150e6, 200)
    >>> reduction = 0.6 * 1e-7 * p / (1.0 + 1e-7 * p)
    >>> fit = kawakita(p, 0.4 / (1.0 - reduction), 0.4)
    >>> round(fit.a, 6), round(fit.b * 1e7, 6)
    (0.6, 1.0)
    """
    low, high = _range(pressure, low, high, parts=(0.05, 1.0))
    reduction = 1.0 - initial_density / np.maximum(density, 1e-12)
    use = _in_range(pressure, low, high) & (reduction > 0.0)
    x = pressure[use]
    line = _line(x, x / reduction[use])
    if line is None or line[0] <= 0.0 or line[1] <= 0.0:
        return None
    slope, intercept, r_squared = line
    return KawakitaFit(
        a=1.0 / slope,
        b=slope / intercept,
        initial_density=initial_density,
        low=low,
        high=high,
        r_squared=r_squared,
        points=len(x),
    )


def _range(
    pressure: Array,
    low: float | None,
    high: float | None,
    *,
    parts: tuple[float, float] = (0.3, 0.9),
) -> tuple[float, float]:
    peak = float(np.max(pressure, initial=0.0))
    return (
        parts[0] * peak if low is None else low,
        parts[1] * peak if high is None else high,
    )


def _in_range(pressure: Array, low: float, high: float) -> NDArray[np.bool_]:
    return (pressure >= low) & (pressure <= high) & (pressure > 0.0)


def _line(x: Array, y: Array) -> tuple[float, float, float] | None:
    """Least squares: slope, intercept and R^2, None if `x` has no extent."""
    if len(x) < 5 or np.ptp(x) <= 0.0:
        return None
    dx, dy = x - x.mean(), y - y.mean()
    slope = float(dx @ dy / (dx @ dx))
    rest = dy - slope * dx
    total = float(dy @ dy)
    r_squared = 1.0 - float(rest @ rest) / total if total > 0.0 else 1.0
    return slope, float(y.mean() - slope * x.mean()), r_squared


def ejection_stress(force: float, die_radius: float, height: float) -> float:
    """Ejection force over the wall that the tablet touches: F / (pi D h).

    Parameters
    ----------
    force : float
        Largest force of the lower punch during ejection [N].
    die_radius : float
        Radius of the die [m].
    height : float
        Height of the tablet in the die [m].

    Returns
    -------
    float
        Stress [Pa].
    """
    return force / (2.0 * np.pi * die_radius * height)


def work_of(force: Array, displacement: Array) -> float:
    """Work of a punch: integral of force over displacement (trapezoids).

    Parameters
    ----------
    force : ndarray
        Force on the powder, into the powder [N].
    displacement : ndarray
        Displacement into the powder [m].

    Returns
    -------
    float
        Work [J].
    """
    return float(np.trapezoid(force, displacement))
