r"""Etsion, Kligerman and Kadin (2005): unloading of an elastic-plastic sphere.

.. math::
    \frac{1}{\rho} &= [1 - (1 - \hat d^{-0.28})(1 - \hat d^{-0.69})] d_{max},
        \quad \hat d = d_{max}/d_c                                     \tag{9} \\
    \alpha &= 1.5\, \hat d^{-0.0331}                                   \tag{6}

Equations as numbered by Edmans and Sinka (2020), with their power law (2) and their
d_c (5).  Fitted for 297 <= E/sigma_y <= 2464 and d_max/d_c <= 170.  Up to first yield
everything is recovered, rho = 1/d_max.

Reference: I. Etsion, Y. Kligerman and Y. Kadin, Int. J. Solids Struct. 42 (2005)
3716-3729.
"""

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from pestle.citations import cite
from pestle.laws._options import parameter
from pestle.particle import edmans2020
from pestle.particle.law import (
    Array,
    Curve,
    Peak,
    Range,
    Unloading,
    register,
    warn_outside,
)


def secant_stiffness(largest: Any, d_c: Any) -> Any:
    """Secant stiffness rho of unloading (9) [-]."""
    ratio = np.maximum(largest / d_c, 1.0)
    left = 1.0 - (1.0 - ratio**-0.28) * (1.0 - ratio**-0.69)
    return 1.0 / (left * largest)


def exponent(largest: Any, d_c: Any) -> Any:
    """Exponent alpha as fitted (6), without limits [-]."""
    return 1.5 * (largest / d_c) ** -0.0331


SOURCE = "Etsion et al. (2005), as said by Edmans and Sinka (2020)"
RATIO, DEPTH = Range(297.0, 2464.0, SOURCE), Range(0.0, 170.0, SOURCE)


@register
@dataclass(frozen=True, kw_only=True)
class Etsion2005(Unloading):
    """Power law fitted to finite elements at small displacements of hard spheres."""

    youngs_modulus: float = parameter("Young's modulus E", "Pa")
    poisson_ratio: float = parameter("Poisson ratio nu", "1", -1.0, 0.5)
    yield_stress: float = parameter("uniaxial yield stress sigma_y", "Pa")

    name: ClassVar[str] = "etsion2005"
    summary: ClassVar[str] = "unloading of hard spheres at small displacement"
    validity: ClassVar[str] = "297 <= E/sigma_y <= 2464, peaks up to 170 d_c"
    citation: ClassVar[str] = cite("etsion2005")

    def curve(self, displacement: Array, peak: Peak) -> Curve:
        """Force below a peak; this law has no contact radius."""
        e = self.youngs_modulus / self.yield_stress
        d_c = edmans2020.first_yield(e, self.poisson_ratio)
        largest = peak.displacement / peak.radius
        warn_outside(self.name, "E/sigma_y", e, RATIO)
        warn_outside(self.name, "d_max/d_c", largest / d_c, DEPTH)
        alpha = exponent(np.maximum(largest, d_c), d_c)
        law = edmans2020.Unloading(secant_stiffness(largest, d_c), alpha)
        return edmans2020.power_law(displacement, peak, law)
