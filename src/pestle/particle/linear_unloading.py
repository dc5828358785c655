r"""Luding (2008), Walton and Braun (1986): linear unloading, the stiffer the later.

With the secant stiffness of loading k_1 = F_max/d_max,

.. math::
    k_2 &= k_1 + (k_{2,max} - k_1) \min(d_{max}/d_c^*, 1)   \tag{7, Luding} \\
    k_2 &= k_1 + S F_{max}                                  \tag{Walton and Braun} \\
    F &= F_{max} - k_2 (d_{max} - d), \quad k_2/k_1 = \rho d_{max}    \tag{8}

Equations as numbered by Edmans and Sinka (2020), who print (7) without the cap.

References: S. Luding, Granul. Matter 10 (2008) 235-246; O. R. Walton and R. L. Braun,
J. Rheol. 30 (1986) 949-980.
"""

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from pestle.citations import cite
from pestle.laws._options import parameter
from pestle.particle.law import Array, Curve, Peak, Unloading, register


def luding_stiffness(k1: Any, k2_max: Any, largest: Any, transition: Any) -> Any:
    """Unloading stiffness k_2, at most k_2max (7); any unit of stiffness.

    Examples
    --------
    >>> float(luding_stiffness(1.0, 5.0, 0.4, 0.2))
    5.0
    """
    return k1 + (k2_max - k1) * np.minimum(largest / transition, 1.0)


def walton_stiffness(k1: Any, slope: Any, force_max: Any) -> Any:
    """Unloading stiffness k_2 = k_1 + S F_max; `slope` S [1/displacement]."""
    return k1 + slope * force_max


@register
@dataclass(frozen=True, kw_only=True)
class Luding2008(Unloading):
    """Linear unloading whose stiffness rises with the largest displacement."""

    stiffness_ratio: float = parameter(
        "largest unloading stiffness over secant loading stiffness, k_2max/k_1",
        "1",
        1.0,
    )
    transition: float = parameter(
        "displacement d_c* over the radius at which it is reached", "1"
    )

    name: ClassVar[str] = "luding2008"
    summary: ClassVar[str] = "linear unloading, stiffer with displacement, Eq. 7"
    validity: ClassVar[str] = (
        "a rule with two free numbers; the ratio k_2/k_1 of simulations is not linear "
        "in displacement (Edmans and Sinka 2020, Fig. 10)"
    )
    citation: ClassVar[str] = cite("luding2008")

    def curve(self, displacement: Array, peak: Peak) -> Curve:
        """Force below a peak; this law has no contact radius."""
        k1 = peak.force / peak.displacement
        k2 = luding_stiffness(
            k1,
            self.stiffness_ratio * k1,
            peak.displacement,
            self.transition * peak.radius,
        )
        return _line(displacement, peak, k2)


@register
@dataclass(frozen=True, kw_only=True)
class Walton1986(Unloading):
    """Linear unloading whose stiffness rises with the largest force."""

    stiffening: float = parameter(
        "rise S of the unloading stiffness with the largest force", "1/m"
    )

    name: ClassVar[str] = "walton1986"
    summary: ClassVar[str] = "linear unloading, stiffer with force"
    validity: ClassVar[str] = (
        "a rule with one free number; the ratio k_2/k_1 of simulations is not linear "
        "in force (Edmans and Sinka 2020, Fig. 11)"
    )
    citation: ClassVar[str] = cite("walton1986")

    def curve(self, displacement: Array, peak: Peak) -> Curve:
        """Force below a peak; this law has no contact radius."""
        k1 = peak.force / peak.displacement
        k2 = walton_stiffness(k1, self.stiffening, peak.force)
        return _line(displacement, peak, k2)


def _line(displacement: Array, peak: Peak, k2: Any) -> Curve:
    value = np.maximum(peak.force - k2 * (peak.displacement - displacement), 0.0)
    return Curve(value, np.full_like(value, np.nan))
