"""The numbers of an unloading: secant stiffness and exponent of a power law.

Equations: B. D. Edmans and I. C. Sinka, Powder Technology 374 (2020) 618-631.
"""

from typing import NamedTuple

import numpy as np

from pestle.lab.mesh import Floats
from pestle.lab.sphere import Unloading

_LEVELS = 100


class UnloadingNumbers(NamedTuple):
    """Power law F = F_max ((d - d_0)/(d_max - d_0))^alpha, Eqs. (1), (2)."""

    depth: float  # d_max [R]
    separation: float  # d_0 [R]
    rho: float  # 1/(d_max - d_0) [1/R]
    alpha: float  # exponent [-]
    r_squared: float  # coefficient of determination [-]
    force: float  # F_max [E R^2]


def unloading_numbers(branch: Unloading) -> UnloadingNumbers:
    """Fit the power law to a branch of the lab."""
    depths = np.array([p.depth for p in branch.points])
    forces = np.array([p.force for p in branch.points])
    return power_law(depths, forces, branch.separation)


def power_law(depths: Floats, forces: Floats, separation: float) -> UnloadingNumbers:
    """Fit the power law at 100 equal steps of the force, as the paper does.

    Parameters
    ----------
    depths, forces : array
        From the largest depth to the last contact [R, E R^2].
    separation : float
        Depth at which the relaxed sphere just touches the flat [R].
    """
    depth, force = float(depths[0]), float(forces[0])
    x = np.append((depths - separation) / (depth - separation), 0.0)
    y = np.append(forces / force, 0.0)
    levels = np.arange(1, _LEVELS + 1) / _LEVELS
    alpha, r_squared = fit_exponent(np.interp(levels, y[::-1], x[::-1]), levels)
    rho = 1.0 / (depth - separation)
    return UnloadingNumbers(depth, separation, rho, alpha, r_squared, force)


def fit_exponent(x: Floats, y: Floats) -> tuple[float, float]:
    """Exponent of y = x^alpha by least squares, and its R^2.

    Examples
    --------
    >>> x = np.linspace(0.01, 1.0, 100)
    >>> alpha, r_squared = fit_exponent(x, x**1.5)
    >>> round(alpha, 6), round(r_squared, 9)
    (1.5, 1.0)
    """
    from scipy.optimize import minimize_scalar

    def loss(alpha: float) -> float:
        return float(np.sum((y - x**alpha) ** 2))

    best = minimize_scalar(loss, bounds=(0.3, 6.0), method="bounded")
    total = float(np.sum((y - y.mean()) ** 2))
    return float(best.x), 1.0 - float(best.fun) / total
