r"""Edmans and Sinka (2020), section 5: a sphere of frictionless concentric cylinders.

Each cylinder is an elastic-perfectly plastic bar.  Dimensionless as in `edmans2020`:

.. math::
    r_m &= \sqrt{2 d - d^2}                                            \tag{13} \\
    r_p &= \sqrt{1 - [E(1-d)/(E-1)]^2}                                 \tag{14} \\
    F &= r_p^2 + E (r_m^2 - r_p^2)
        + 2E(d - 1)[\sqrt{1 - r_p^2} - \sqrt{1 - r_m^2}]               \tag{17} \\
    F &= E d^2 + \text{const} \quad \text{(unloading)}                 \tag{20}

and r_p = 0 up to first yield at d = 1/E, where F = E d^2.  Three ways to unload:

- "consistent": (20), F = F_max - E (d_max^2 - d^2) down to zero;
- "published": (21), F_max - E (d - d_max)^2, which does not follow from (20) and does
  not even retrace the elastic curve;
- "no_tension": (20) lets the core pull once the elastic annulus has left the wall, at
  d_max - (1 - d_max)/(E - 1); without that pull F = [1 - E (d_max - d)]^2 from there
  on, and rho = E exactly.

(12) and (16) count compression positive here.
"""

from dataclasses import dataclass
from math import pi
from typing import Any, ClassVar, Literal

import numpy as np

from pestle.laws._options import choice, parameter
from pestle.particle.edmans2020 import Edmans2020
from pestle.particle.law import (
    Array,
    Curve,
    Loading,
    Peak,
    Range,
    Unloading,
    register,
    warn_outside,
)

Variant = Literal["consistent", "published", "no_tension"]


def outer_radius(d: Any) -> Any:
    """Contact radius r_m (13) [-]."""
    return np.sqrt(d * (2.0 - d))


def plastic_radius(d: Any, e: Any) -> Any:
    """Radius r_p of the yielded core (14), zero up to d = 1/E and for E <= 1 [-]."""
    e = np.asarray(e, dtype=float)
    above = np.where(e > 1.0, e - 1.0, 1.0)
    inside = 1.0 - (e * (1.0 - d) / above) ** 2
    return np.where((e * d > 1.0) & (e > 1.0), np.sqrt(np.maximum(inside, 0.0)), 0.0)[
        ()
    ]


def loading_force(d: Any, e: Any) -> Any:
    """Force of loading (17) [-]."""
    core = plastic_radius(d, e) ** 2
    # the annulus: E (root_p - root_m)^2 with root_m = 1 - d, no difference of ones
    return core + e * (d - core / (1.0 + np.sqrt(1.0 - core))) ** 2


def elastic_strain(r: Any, d: Any) -> Any:
    """Axial strain of the elastic cylinder at a radius (12), tension positive [-]."""
    return (1.0 - d) / np.sqrt(1.0 - r**2) - 1.0


def core_strain(r: Any, d: Any, largest: Any, e: Any) -> Any:
    """Elastic axial strain of the yielded core in unloading (18), tension positive."""
    return -1.0 / e + (largest - d) / np.sqrt(1.0 - r**2)


def unloading_force(d: Any, largest: Any, e: Any, variant: str = "consistent") -> Any:
    """Force of unloading from d_max, never tension [-]."""
    force_max = loading_force(largest, e)
    if variant == "published":
        return np.maximum(force_max - e * (d - largest) ** 2, 0.0)
    elastic = force_max - e * (largest - d) * (largest + d)  # E d^2 up to yield
    if variant == "no_tension":
        alone = np.maximum(1.0 - e * (largest - d), 0.0) ** 2
        separated = (e * largest > 1.0) & (d < annulus_leaves(largest, e))
        return np.where(separated, alone, np.maximum(elastic, 0.0))[()]
    return np.where(d > 0.0, np.maximum(elastic, 0.0), 0.0)[()]


def annulus_leaves(largest: Any, e: Any) -> Any:
    """Displacement at which the elastic annulus leaves the wall in unloading [-]."""
    return largest - (1.0 - largest) / np.where(np.asarray(e) > 1.0, e - 1.0, 1.0)


def secant_stiffness(largest: Any, e: Any, variant: str = "consistent") -> Any:
    """Secant stiffness rho of unloading (22), (23); 1/d_max up to first yield [-]."""
    force_max = loading_force(largest, e)
    if variant == "published":
        rho = np.sqrt(e / force_max)
    elif variant == "no_tension":
        rho = np.broadcast_to(np.asarray(e, dtype=float), np.shape(force_max))
    else:
        rest = np.maximum(largest**2 - force_max / e, 0.0)
        rho = 1.0 / (largest - np.sqrt(rest))
    return np.where(np.asarray(e) * largest > 1.0, rho, 1.0 / largest)[()]


RADIUS = Range(0.0, 0.3, "the contact radius (13), Edmans and Sinka (2020), Fig. 15")


@register
@dataclass(frozen=True, kw_only=True)
class Cylinders2020(Loading):
    """Particle of frictionless concentric bars."""

    youngs_modulus: float = parameter("Young's modulus E", "Pa")
    yield_stress: float = parameter("uniaxial yield stress sigma_y", "Pa")

    name: ClassVar[str] = "cylinders2020"
    summary: ClassVar[str] = "concentric cylinders, explicit and simple, Eq. 17"
    validity: ClassVar[str] = (
        "a thought model: no lateral stress, so the hardness never exceeds sigma_y; "
        "contact radius good to x = 0.3"
    )
    citation: ClassVar[str] = Edmans2020.citation
    configurations: ClassVar[tuple[str, ...]] = ("simple",)

    def _curve(self, x: Array, radius: float, configuration: str) -> Curve:
        warn_outside(self.name, "x", x, RADIUS)
        force = loading_force(x, self.youngs_modulus / self.yield_stress)
        scale = pi * radius**2 * self.yield_stress
        return Curve(force * scale, outer_radius(x) * radius)


@register
@dataclass(frozen=True, kw_only=True)
class CylindersUnloading(Unloading):
    """Unloading of the concentric bars, scaled to the peak of any loading law."""

    youngs_modulus: float = parameter("Young's modulus E", "Pa")
    yield_stress: float = parameter("uniaxial yield stress sigma_y", "Pa")
    variant: str = choice(
        "unloading of the cylinders: Eq. 20, Eq. 21 as printed, or without tension",
        ("consistent", "published", "no_tension"),
        default="consistent",
    )

    name: ClassVar[str] = "cylinders2020"
    summary: ClassVar[str] = "unloading of concentric cylinders, three variants"
    validity: ClassVar[str] = (
        "a thought model; rho of 'consistent' is 0.75 to 1.39 times that of Eq. 3 for "
        "20 <= E/sigma_y <= 1000 and 0.1 <= x <= 0.5, of 'published' 0.02 to 0.57 times"
    )
    citation: ClassVar[str] = Edmans2020.citation

    def curve(self, displacement: Array, peak: Peak) -> Curve:
        """Force below a peak in proportion to the model's own, and its radius (13)."""
        e = self.youngs_modulus / self.yield_stress
        d, largest = displacement / peak.radius, peak.displacement / peak.radius
        own = unloading_force(d, largest, e, self.variant)
        part = own / loading_force(largest, e)
        narrowing = outer_radius(np.maximum(d, 0.0)) / outer_radius(largest)
        return Curve(peak.force * part, peak.contact_radius * narrowing)
