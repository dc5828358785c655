r"""Mesarovic and Johnson (2000): elastic unloading from a uniform pressure.

.. math::
    \frac{F}{F_{max}} = \frac{2}{\pi}
        \Big[\arcsin \hat a - \hat a \sqrt{1 - \hat a^2}\Big], \quad
        \hat a = a/a_{max}                                             \tag{10}

as numbered by Edmans and Sinka (2020), who print the second factor of the second term
as a power.  Shrinking circles are flat punches of stiffness 2 E* a; integrating
dF = 2 E* a d(delta) from a_max gives the displacement

.. math:: \delta_{max} - \delta = \frac{2 p a_{max}}{E^*} \sqrt{1 - \hat a^2},
    \quad p = F_{max}/(\pi a_{max}^2)

so that the force is explicit in delta.

Reference: S. Dj. Mesarovic and K. L. Johnson, J. Mech. Phys. Solids 48 (2000)
2009-2033.
"""

from dataclasses import dataclass
from math import pi
from typing import Any, ClassVar

import numpy as np

from pestle.citations import cite
from pestle.laws._options import parameter
from pestle.particle.law import Array, Curve, Peak, Unloading, register, warn_once


def force_ratio(radius_ratio: Any) -> Any:
    """Force over its largest at a ratio of contact radii (10) [-].

    Examples
    --------
    >>> round(float(force_ratio(0.5)), 6), float(force_ratio(1.0))
    (0.057669, 1.0)
    """
    a = np.clip(radius_ratio, 0.0, 1.0)
    return 2.0 / pi * (np.arcsin(a) - a * np.sqrt(1.0 - a**2))


def recovered(force_max: Any, radius_max: Any, modulus: float) -> Any:
    """Displacement that a full unloading gives back, 2 p a_max/E* [m]."""
    return 2.0 * force_max / (pi * radius_max * modulus)


def radius_ratio(left: Any) -> Any:
    """Ratio of contact radii while a part `left` of the recovery is to come [-]."""
    gone = 1.0 - np.clip(left, 0.0, 1.0)
    return np.sqrt(1.0 - gone**2)


@register
@dataclass(frozen=True, kw_only=True)
class Mesarovic2000(Unloading):
    """Elastic unloading of a contact whose pressure has become uniform."""

    youngs_modulus: float = parameter("Young's modulus E", "Pa")
    poisson_ratio: float = parameter("Poisson ratio nu", "1", -1.0, 0.5)

    name: ClassVar[str] = "mesarovic2000"
    summary: ClassVar[str] = "elastic unloading from a uniform pressure, with radius"
    validity: ClassVar[str] = (
        "fully plastic contacts that are small against the particle; at x = 0.5 only "
        "for soft particles (Edmans and Sinka 2020, Fig. 13)"
    )
    citation: ClassVar[str] = cite("mesarovic2000")

    def curve(self, displacement: Array, peak: Peak) -> Curve:
        """Force and contact radius below a peak (10)."""
        modulus = self.youngs_modulus / (1.0 - self.poisson_ratio**2)
        back = recovered(peak.force, peak.contact_radius, modulus)
        if np.any((back > peak.displacement) & (peak.displacement > 0.0)):
            warn_once(
                self.name,
                "uniform pressure",
                "a contact would give back more than it was pressed: its pressure is "
                "not uniform, it is still elastic (Mesarovic and Johnson 2000)",
            )
        left = 1.0 - (peak.displacement - displacement) / back
        ratio = radius_ratio(left)
        return Curve(peak.force * force_ratio(ratio), peak.contact_radius * ratio)
