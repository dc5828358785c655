"""Shahin (2021), chapter 3, as a law; formulas in `shahin2021_hardening`."""

from dataclasses import dataclass
from math import pi
from typing import ClassVar, cast

import numpy as np

from pestle.errors import InputError
from pestle.laws._options import choice, parameter
from pestle.particle.law import Array, Curve, Loading, Range, register, warn_outside
from pestle.particle.shahin2021 import Shahin2021
from pestle.particle.shahin2021_hardening import Reading, hardness, parameters
from pestle.particle.shahin2021_radius import relative_radius

SIMPLE = Range(0.0, 0.5, "the 60 simulations of Shahin (2021), Table E.1")


@register
@dataclass(frozen=True, kw_only=True)
class Shahin2021Hardening(Loading):
    """Rigid-plastic particle with sigma = kappa eps^h."""

    strength: float = parameter("strength kappa of sigma = kappa eps^h", "Pa")
    hardening_exponent: float = parameter(
        "exponent h = 1/m; 0 is perfectly plastic", "1", 0.0, 1.0, ends="[]"
    )
    reading: str = choice(
        "reading of Eqs. 3.48-3.56",
        ("consistent", "literal", "frozen_min", "scaled"),
        default="consistent",
    )

    name: ClassVar[str] = "shahin2021_hardening"
    summary: ClassVar[str] = "rigid-plastic with power-law hardening, any confinement"
    validity: ClassVar[str] = (
        "0 <= h <= 1; E far above kappa; x <= 0.5 (simple), below zero porosity 0.476 "
        "(die), 0.194 (hydrostatic); hydrostatic with h >= 0.5 is up to 16 to 35 % low"
    )
    citation: ClassVar[str] = Shahin2021.citation

    def _curve(self, x: Array, radius: float, configuration: str) -> Curve:
        h = float(self.hardening_exponent)
        law = parameters(h, configuration, reading=cast(Reading, self.reading))
        if configuration == "simple":
            warn_outside(self.name, "x in simple compression", x, SIMPLE)
        if np.any(x >= law.zero_porosity):
            raise InputError(
                "beyond-zero-porosity",
                f"{self.name} has an infinite force at x = {np.max(x):.4g}: a rigid-"
                f"plastic particle fills its cell at x = {law.zero_porosity:.6g}",
                hint="stay below, or take shahin2021, whose particle is elastic",
            )
        a = relative_radius(x, law.radius) * radius
        return Curve(hardness(x, law).value * self.strength * pi * a**2, a)  # (3.45)
