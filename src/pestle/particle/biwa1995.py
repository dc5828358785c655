r"""Biwa and Storakers (1995): similarity law of rigid-plastic power-law spheres.

.. math::
    P &= \eta_P\, a^{2+h}, \quad a = \sqrt{2 c^2 \gamma/A}            \tag{2.4, 2.5} \\
    \eta_P &= \pi k A^h (\kappa_1^{-m} + \kappa_2^{-m})^{-h}, \quad
        k = 3 \cdot 6^{-h}, \quad c^2 = 1.43\, e^{-0.97 h}            \tag{2.8}

h = 1/m; at h = 0 the weaker sphere decides.  The radius corrected for the curvature of
a true sphere solves :math:`\gamma = (a^2 A/2 + a^4 B/8)/c^2` (B.22): closed (B.24), or
as its series (B.25), of which Shahin's radius (2.13) is a generalisation.

Numbers of equations are those of M. B. Shahin, thesis, Purdue University (2021);
S. Biwa and B. Storakers, J. Mech. Phys. Solids 43 (1995) 1303-1333.
"""

from dataclasses import dataclass
from math import exp, pi
from typing import Any, ClassVar, NamedTuple

import numpy as np

from pestle.citations import cite
from pestle.laws._options import choice, parameter
from pestle.particle.law import Array, Curve, Loading, Range, register, warn_outside


def area_ratio(h: float) -> float:
    """Ratio c^2 of true to nominal contact area at the exponent h [-]."""
    return 1.43 * exp(-0.97 * h)


def pressure_factor(h: float) -> float:
    """Factor k of the mean pressure at the exponent h [-]."""
    return 3.0 * 6.0**-h


class Two(NamedTuple):
    """Sums of the radii of two spheres."""

    a: float  # 1/R_1 + 1/R_2 [1/m]
    b: float  # 1/R_1^3 + 1/R_2^3 [1/m^3]


def two(radius_1: float, radius_2: float) -> Two:
    """A (2.7) and B (2.13) of two spheres [1/m], [1/m^3]."""
    return Two(1.0 / radius_1 + 1.0 / radius_2, radius_1**-3 + radius_2**-3)


def joint_strength(strength_1: float, strength_2: float, h: float) -> float:
    """Strength of a pair, (kappa_1^-m + kappa_2^-m)^-h (B.12) [Pa].

    Examples
    --------
    >>> joint_strength(100.0, 60.0, 0.0), joint_strength(50.0, 50.0, 1.0)
    (60.0, 25.0)
    """
    low, high = sorted((strength_1, strength_2))
    if h == 0.0:
        return low
    return low * (1.0 + (low / high) ** (1.0 / h)) ** -h  # no power overflows


def force_factor(h: float, strength_1: float, strength_2: float, a: float) -> float:
    """Factor eta_P of the force (2.8) [N/m^(2+h)]."""
    joint = joint_strength(strength_1, strength_2, h)
    return pi * pressure_factor(h) * a**h * joint


def contact_radius(gamma: Any, geometry: Two, h: float) -> Any:
    """Contact radius at an approach gamma (2.5) [m]."""
    return np.sqrt(2.0 * area_ratio(h) / geometry.a * gamma)


def contact_radius_closed(gamma: Any, geometry: Two, h: float) -> Any:
    """Contact radius corrected for curvature (B.24) [m]."""
    a, b = geometry
    s = 2.0 * b * area_ratio(h) * gamma
    return np.sqrt(2.0 / b * s / (np.sqrt(a**2 + s) + a))  # no difference of equals


def contact_radius_series(gamma: Any, geometry: Two, h: float) -> Any:
    """Three terms of the series of the corrected radius (B.25) [m]."""
    a, b = geometry
    c2 = area_ratio(h)
    first = np.sqrt(2.0 * c2 * gamma / a)
    z = b * c2 * gamma / a**2
    return first * (1.0 - z / 4.0 + 7.0 / 32.0 * z**2)


def hardness(x: Any, h: float) -> Any:
    """Mean pressure over kappa for equal spheres, P/(kappa pi a^2) (3.44) [-]."""
    return pressure_factor(h) * (2.0 * area_ratio(h) * x) ** (0.5 * h)


SMALL = Range(0.0, 0.03, "small strain: the law leaves simulations at 3 % (Fig. 2.1)")


@register
@dataclass(frozen=True, kw_only=True)
class Biwa1995(Loading):
    """Rigid-plastic particle with sigma = kappa eps^h; contacts know of no other."""

    strength: float = parameter("strength kappa of sigma = kappa eps^h", "Pa")
    hardening_exponent: float = parameter(
        "exponent h = 1/m; 0 is perfectly plastic", "1", 0.0, 1.0, ends="[]"
    )
    curvature: str = choice(
        "correction of the radius for curvature: none, Eq. B.24 or Eq. B.25",
        ("none", "closed", "series"),
        default="none",
    )

    name: ClassVar[str] = "biwa1995"
    summary: ClassVar[str] = "similarity law of power-law plasticity, small strain"
    validity: ClassVar[str] = (
        "small strain, x <= 0.03; contacts independent of each other and of the walls"
    )
    citation: ClassVar[str] = cite("biwa1995")

    def _curve(self, x: Array, radius: float, configuration: str) -> Curve:
        warn_outside(self.name, "x", x, SMALL)
        h, pair = float(self.hardening_exponent), two(radius, radius)
        formula = {
            "none": contact_radius,
            "closed": contact_radius_closed,
            "series": contact_radius_series,
        }[self.curvature]
        a = formula(2.0 * radius * x, pair, h)  # a flat is the mid-plane of two spheres
        eta = pi * pressure_factor(h) * (0.5 * pair.a) ** h * self.strength  # (3.42)
        return Curve(eta * a ** (2.0 + h), a)
