r"""Shahin (2021), plastic and low-compressibility regimes: what both chapters share.

With :math:`y = x - x_{Hmax}`, :math:`f(y) = \tanh(qy) \cos(y - s)`:

.. math::
    H^{fp} &= H_{max} - p f^r                                        \tag{2.25} \\
    s &= y_{min} - \arctan[2q\,\mathrm{csch}(2 q y_{min})]           \tag{2.26} \\
    p &= (H_{max} - H_{min})/f(y_{min})^r                            \tag{2.32, 2.38}

f has its maximum at :math:`y_{min}`.  Simple compression ends as a disk, x_min = 1 with
H_min = 1.  A confined contact has its minimum where the relative densities of volume
and of surface multiply to :math:`\Gamma` (2.28), and there the mean of two estimates:
the simple law (2.33), and a curve as steep as that law at its point of inflection
(2.34)-(2.37).  (2.35) is evaluated as a ratio of :math:`f' f^{r-1}`, which is regular
where the inflection falls on y = 0 (r = 1, hydrostatic).
"""

from math import pi
from typing import Any, NamedTuple

import numpy as np

from pestle.particle.configuration import EXPONENTS
from pestle.particle.shahin2021_radius import Coefficients

GAMMA = 0.0593
"""Product of the relative densities at the minimum, mean of the simulations [-]."""


class Softening(NamedTuple):
    """The function f^r and where it begins."""

    start: Any  # x at H_max [-]
    q: Any
    r: Any
    s: Any

    def shape(self, x: Any) -> Any:
        """f(y) of (2.25) [-]."""
        y = x - self.start
        return np.tanh(self.q * y) * np.cos(y - self.s)

    def shape_slope(self, x: Any) -> Any:
        """f'(y), the bracket of (2.27) [-]."""
        y, q = x - self.start, self.q
        return q * np.cos(y - self.s) / np.cosh(q * y) ** 2 - np.tanh(q * y) * np.sin(
            y - self.s
        )

    def value(self, x: Any) -> Any:
        """f^r [-]."""
        return self.shape(x) ** self.r

    def slope(self, x: Any) -> Any:
        """r f' f^(r-1) (2.27) [-]."""
        return self.r * self.shape_slope(x) * self.shape(x) ** (self.r - 1.0)

    @property
    def inflection(self) -> Any:
        """Approximate x at the point of inflection (2.34), (D.6) [-]."""
        q2, r, t = 2.0 * self.q**2 + 3.0, self.r, np.tan(self.s)
        root = np.sqrt(
            3.0 * q2 * (r - 1.0) * (2.0 * r + 1.0) + 9.0 * (2.0 * r**2 - 1.0) * t**2
        )
        below = q2 * (2.0 * r + 1.0) + 3.0 * (r + 1.0) * t**2
        return self.start + (3.0 * r * t + root) / below


def softening(start: Any, lowest: Any, q: Any, r: Any) -> Softening:
    """Softening from x = `start` to its end at x = `lowest` (2.26)."""
    y = lowest - start
    return Softening(start, q, r, y - np.arctan(2.0 * q / np.sinh(2.0 * q * y)))


class Plastic(NamedTuple):
    """The plastic regime of a configuration."""

    softening: Softening
    lowest: Any  # x at H_min [-]
    hardness_max: Any
    hardness_min: Any
    p: Any
    simple: Softening
    p_simple: Any
    p_o: Any  # (2.35), none in simple compression
    estimates: tuple[Any, Any]  # H_min,1 (2.33) and H_min,2 (2.36)


def plastic(
    hardness_max: Any,
    start: Any,
    q: Any,
    r: Any,
    *,
    coefficients: Coefficients,
    configuration: str,
) -> Plastic:
    """Plastic regime from H_max at x = `start` down to H_min (2.25)-(2.38)."""
    simple = softening(start, 1.0, q, r)
    p_simple = (hardness_max - 1.0) / simple.value(1.0)  # (2.32)
    if configuration == "simple":
        one = np.ones_like(p_simple)
        return Plastic(
            simple, 1.0, hardness_max, one, p_simple, simple, p_simple, p_simple, (1, 1)
        )
    lowest = lowest_point(coefficients, configuration)
    soft = softening(start, lowest, q, r)
    p_o = p_simple * simple.slope(simple.inflection) / soft.slope(soft.inflection)
    first = hardness_max - p_simple * simple.value(lowest)  # (2.33)
    second = hardness_max - p_o * soft.value(lowest)  # (2.36)
    hardness_min = 0.5 * (first + second)  # (2.37)
    p = (hardness_max - hardness_min) / soft.value(lowest)  # (2.38)
    return Plastic(
        soft,
        lowest,
        hardness_max,
        hardness_min,
        p,
        simple,
        p_simple,
        p_o,
        (first, second),
    )


def density_product(x: Any, relative_radius: Any, contact: str) -> Any:
    """Product of the relative densities of volume and surface of a contact [-].

    Parameters
    ----------
    x, relative_radius : float or array
        Deformation of the moving contacts, and a/R of this one [-].
    contact : {"die", "hydrostatic", "die_secondary"}
        Moving contact of a die (C.1), of a hydrostatic cell (C.3), or standing contact
        of a die (2.52).
    """
    power = {"die": 1, "hydrostatic": 5, "die_secondary": 2}[contact]
    return pi**2 * relative_radius**2 / (144.0 * (1.0 - x) ** power)


def lowest_point(d: Coefficients, configuration: str) -> Any:
    """Deformation x at the minimum of hardness: the only root of (C.2) or (C.4) [-].

    Newton's method on x (D_1 - D_3 x + D_5 x^2)^2 = 144 Gamma (1 - x)^n / pi^2; the
    difference of the two sides rises with x, so that there is one root.
    """
    n = 2 * EXPONENTS[configuration] - 1
    c = 144.0 * GAMMA / pi**2
    x = np.full_like(np.asarray(d.d1, dtype=float), 0.15 if n > 1 else 0.3)
    for _ in range(40):
        g = d.d1 - x * (d.d3 - x * d.d5)
        excess = x * g**2 - c * (1.0 - x) ** n
        slope = g**2 + 2.0 * x * g * (2.0 * x * d.d5 - d.d3)
        slope = slope + c * n * (1.0 - x) ** (n - 1)
        x = np.clip(x - excess / slope, 1e-9, 1.0 - 1e-9)
    return x[()]
