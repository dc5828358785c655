"""Shahin (2021), chapter 2, as a law: elastic-perfectly plastic particle.

Formulas: `shahin2021_hardness` (five regimes), `shahin2021_plastic` (minimum of the
hardness), `shahin2021_radius`, `shahin2021_secondary` (standing contacts of a die).
"""

from dataclasses import dataclass
from math import pi
from typing import Any, ClassVar

import numpy as np

from pestle.citations import cite
from pestle.errors import InputError
from pestle.laws._options import parameter
from pestle.particle.law import Array, Curve, Loading, Range, register, warn_outside
from pestle.particle.shahin2021_hardness import (
    Parameters,
    hardness,
    material_numbers,
    parameters,
    smallest_lambda,
)
from pestle.particle.shahin2021_radius import relative_radius

SOURCE = "the 51 simulations of Shahin (2021), Table A.1"
LAMBDA = Range(117.24, 5933.40, SOURCE)
POISSON = Range(0.2, 0.48, SOURCE)
SIMPLE = Range(0.0, 0.5, SOURCE)


@register
@dataclass(frozen=True, kw_only=True)
class Shahin2021(Loading):
    """Elastic-perfectly plastic particle up to and beyond closure of the pores."""

    youngs_modulus: float = parameter("Young's modulus E", "Pa")
    poisson_ratio: float = parameter("Poisson ratio nu", "1", -1.0, 0.5)
    yield_stress: float = parameter("uniaxial yield stress sigma_y", "Pa")

    name: ClassVar[str] = "shahin2021"
    summary: ClassVar[str] = "elastic-perfectly plastic, five regimes, any confinement"
    validity: ClassVar[str] = (
        "117 <= E/((1 - nu^2) sigma_y) <= 5933 and 0.2 <= nu <= 0.48 (Table A.1); "
        "simple compression to x = 0.5, die and hydrostatic a little beyond zero "
        "porosity; above 22.09 the law is C1"
    )
    citation: ClassVar[str] = cite("shahin2021")

    def parameters(self, configuration: str = "simple") -> Parameters:
        """All numbers that the law derives from its material (2.14)-(2.47)."""
        lam, zeta = material_numbers(
            self.youngs_modulus, self.poisson_ratio, self.yield_stress
        )
        law = parameters(lam, zeta, configuration)
        start = law.onset
        if np.any(start.at_yield >= start.at_max):
            raise InputError(
                "law-without-plastic-regime",
                f"{self.name} has no plastic regime at E/((1 - nu^2) sigma_y) = "
                f"{np.min(lam):.4g}",
                hint=f"it needs at least {smallest_lambda():.2f}; such a particle is "
                "elastic",
            )
        c1 = Range(smallest_lambda(), np.inf, "Shahin (2021), Eq. 2.24")
        warn_outside(self.name, "lambda with a finite slope at H_max", lam, c1)
        warn_outside(self.name, "lambda", lam, LAMBDA)
        warn_outside(self.name, "poisson_ratio", self.poisson_ratio, POISSON)
        return law

    def _curve(self, x: Array, radius: float, configuration: str) -> Curve:
        law = self.parameters(configuration)
        if configuration == "simple":
            warn_outside(self.name, "x in simple compression", x, SIMPLE)
        a = relative_radius(x, law.radius) * radius
        force: Any = hardness(x, law).value * self.yield_stress * pi * a**2  # (2.12)
        return Curve(force, a)
