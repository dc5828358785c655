r"""Edmans and Sinka (2020): secant stiffness and power law of unloading.

Dimensionless: d = delta/R, E = Young's modulus/sigma_y, F = force/(pi R^2 sigma_y).

.. math::
    \rho &= 1/(d_{max} - d_0)                                          \tag{1} \\
    F &= F_{max} [\rho (d - d_0)]^\alpha, \quad d > d_0                \tag{2} \\
    \rho &= \frac{1}{d_{max}} + \phi E (\gamma_1 d_{max}
        + \gamma_2 d_{max}^{-\gamma_3} + \gamma_4 \nu)                 \tag{3} \\
    \phi &= H(d_{max} - d_c) \Big(1 - \frac{d_c}
        {\gamma_5 d_{max} + (1 - \gamma_5) d_c}\Big)                   \tag{4} \\
    d_c &= \Big(\frac{2.8 \pi (0.454 + 0.41 \nu)(1 - \nu^2)}{2 E}\Big)^2 \tag{5}

Print swaps the constants of (5); Chang's 0.454 + 0.41 nu is used.  The paper has no
closed form for alpha: here, Etsion's exponent (6) between that of Hertz up to d_c and
the 1 of a bar, or a number of one's own.

Reference: B. D. Edmans and I. C. Sinka, Powder Technol. 374 (2020) 618-631.
"""

from dataclasses import dataclass
from math import pi
from typing import Any, ClassVar, NamedTuple

import numpy as np

from pestle.citations import cite
from pestle.laws._options import parameter
from pestle.particle.law import Array, Curve, Peak, Range, register, warn_outside
from pestle.particle.law import Unloading as UnloadingLaw

GAMMAS = (2.9932, 0.1206, 0.4865, 0.2563, 0.3429)
"""gamma_1 to gamma_5 of Table 1."""


def first_yield(e: Any, nu: Any) -> Any:
    """Displacement at first yield d_c (5), with Chang's constants [-]."""
    return (2.8 * pi * (0.454 + 0.41 * nu) * (1.0 - nu**2) / (2.0 * e)) ** 2


def yielded_fraction(largest: Any, d_c: Any) -> Any:
    """Transition phi from elastic to plastic unloading (4) [-].

    With y = (d_max - d_c)/d_c it is gamma_5 y/(1 + gamma_5 y), zero up to d_c.
    """
    y = np.maximum(largest / d_c - 1.0, 0.0)
    return GAMMAS[4] * y / (1.0 + GAMMAS[4] * y)


def secant_stiffness(largest: Any, e: Any, nu: Any) -> Any:
    """Secant stiffness rho of unloading (3) [-]."""
    g1, g2, g3, g4, _ = GAMMAS
    phi = yielded_fraction(largest, first_yield(e, nu))
    return 1.0 / largest + phi * e * (g1 * largest + g2 * largest**-g3 + g4 * nu)


def exponent(largest: Any, e: Any, nu: Any) -> Any:
    """Exponent alpha: 1.5 up to d_c, beyond it Etsion's but at least 1 [-]."""
    ratio = np.maximum(largest / first_yield(e, nu), 1.0)
    return np.maximum(1.5 * ratio**-0.0331, 1.0)


class Unloading(NamedTuple):
    """Where and how an unloading curve ends."""

    rho: Any  # secant stiffness [-]
    alpha: Any  # exponent [-]


def force(d: Any, largest: Any, force_max: Any, law: Unloading) -> Any:
    """Force of the power law at a displacement d (2); any unit of force."""
    return force_max * _remaining(d, largest, law) ** law.alpha


def stiffness(d: Any, largest: Any, force_max: Any, law: Unloading) -> Any:
    """Derivative of the force with d; any unit of force."""
    left = _remaining(d, largest, law)
    with np.errstate(divide="ignore"):
        slope = law.alpha * law.rho * left ** (law.alpha - 1.0)
    return np.where(left > 0.0, force_max * slope, 0.0)[()]


def work(force_max: Any, law: Unloading) -> Any:
    """Work given back from d_max to d_0: F_max/(rho (1 + alpha)); any unit of force."""
    return force_max / (law.rho * (1.0 + law.alpha))


def _remaining(d: Any, largest: Any, law: Unloading) -> Any:
    """Part of the recovered displacement that is left, rho (d - d_0) [-]."""
    return np.maximum(1.0 - law.rho * (largest - d), 0.0)


SOURCE = "the 560 simulations of Edmans and Sinka (2020)"
RATIO, POISSON = Range(1.0, 1000.0, SOURCE), Range(0.0, 0.45, SOURCE)
DISPLACEMENT = Range(0.01, 0.5, SOURCE)


@register
@dataclass(frozen=True, kw_only=True)
class Edmans2020(UnloadingLaw):
    """Power law with a secant stiffness fitted to finite elements."""

    youngs_modulus: float = parameter("Young's modulus E", "Pa")
    poisson_ratio: float = parameter("Poisson ratio nu", "1", -1.0, 0.5)
    yield_stress: float = parameter("uniaxial yield stress sigma_y", "Pa")
    exponent: float | None = parameter(
        "exponent alpha of unloading; by default 1.5 up to first yield, then Etsion's, "
        "at least 1",
        "1",
        default=None,
    )

    name: ClassVar[str] = "edmans2020"
    summary: ClassVar[str] = "unloading from large deformation: power law, Eqs. 2-5"
    validity: ClassVar[str] = (
        "1 <= E/sigma_y <= 1000, 0 <= nu <= 0.45, peaks at 0.01 <= x <= 0.5; perfectly "
        "plastic, no adhesion; the contact radius in unloading is not given"
    )
    citation: ClassVar[str] = cite("edmans2020")

    def curve(self, displacement: Array, peak: Peak) -> Curve:
        """Force below a peak (2); this law has no contact radius."""
        e, largest = self.youngs_modulus / self.yield_stress, _over_radius(peak)
        for quantity, value, limits in (
            ("E/sigma_y", e, RATIO),
            ("poisson_ratio", self.poisson_ratio, POISSON),
            ("x at the peak", largest, DISPLACEMENT),
        ):
            warn_outside(self.name, quantity, value, limits)
        at = largest, e, self.poisson_ratio
        alpha = exponent(*at) if self.exponent is None else self.exponent
        law = Unloading(secant_stiffness(*at), alpha)
        return power_law(displacement, peak, law)


def power_law(displacement: Array, peak: Peak, law: Unloading) -> Curve:
    """Force of the power law (2) for a peak with units [N]."""
    value = force(displacement / peak.radius, _over_radius(peak), peak.force, law)
    return Curve(value, np.full_like(value, np.nan))


def _over_radius(peak: Peak) -> Array:
    return np.asarray(peak.displacement / peak.radius)
