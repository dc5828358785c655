r"""Walton and Braun (1986): plastic along one line, elastic along a steeper one.

.. math::
    F = K_1\delta, \quad F = K_2(\delta - \delta_0) \text{ while unloaded}, \quad
    \delta_0 = (1 - K_1/K_2)\,\delta_{max}

With a constant K_2 the restitution is sqrt(K_1/K_2) at any speed; with
K_2 = K_1 + S F_max it falls with speed.  No elastic range, no adhesion.  The tangential
spring takes a = k/(2 E*), so that k_t/k_n = 4 G*/E*.

Reference: O. R. Walton, R. L. Braun, J. Rheol. 30 (1986) 949-980; the formulas are the
commonly used ones, not checked against print.
"""

from dataclasses import dataclass
from math import sqrt
from typing import ClassVar, NamedTuple

from pestle.citations import cite
from pestle.errors import InputError
from pestle.laws._base import Geometry, Pair, Response, register
from pestle.laws._options import PairLaw, parameter


class Constants(NamedTuple):
    """What the kernel needs of a pair of materials."""

    loading: float  # K_1 [N/m]
    unloading: float  # constant part of K_2 [N/m]
    steepening: float  # S K_1: K_2 = unloading + S K_1 delta_max [N/m^2]
    modulus: float  # E* [Pa]


class State(NamedTuple):
    """What a contact remembers; zero at first touch."""

    peak: float  # largest overlap [m]


@dataclass(frozen=True, slots=True, kw_only=True)
class WaltonBraun1986(PairLaw):
    """Linear plastic loading, stiffer linear unloading."""

    loading_stiffness: float = parameter("K_1, stiffness of loading", "N/m")
    unloading_stiffness: float | None = parameter(
        "K_2, constant, of unloading; none: K_1 + S F_max", "N/m", default=None
    )
    steepening: float = parameter(
        "S of K_2 = K_1 + S F_max", "1/m", ends="[)", default=0.0
    )

    name: ClassVar[str] = "walton_braun1986"
    summary: ClassVar[str] = "linear plastic loading, stiffer unloading; no adhesion"
    validity: ClassVar[str] = "a rule: stiffnesses are calibrated"
    linear: ClassVar[bool] = True
    citation: ClassVar[str] = cite("walton1986")

    def _check(self) -> None:
        k1, k2 = self.loading_stiffness, self.unloading_stiffness
        if k2 is not None and k2 < k1:
            raise InputError(
                "soft-unloading",
                f"unloading_stiffness {k2:g} N/m is below loading_stiffness {k1:g} N/m",
                "law.unloading_stiffness",
                "a contact that unloads softer than it loads creates energy",
            )
        if k2 is not None and self.steepening > 0.0:
            raise InputError(
                "bad-steepening",
                f"steepening {self.steepening:g} 1/m stands beside a given K_2",
                "law.steepening",
                "give either unloading_stiffness or steepening",
            )

    def constants(self, pair: Pair) -> Constants:
        """Reduce a pair of materials to the constants of its contacts."""
        k1, k2 = self.loading_stiffness, self.unloading_stiffness
        return Constants(
            k1, k1 if k2 is None else k2, self.steepening * k1, pair.modulus
        )


def contact(k: Constants, g: Geometry, s: State) -> tuple[Response, State]:
    """Force, contact radius, stiffness and energy at an overlap."""
    touching = g.overlap > 0.0
    peak = max(s.peak, g.overlap)
    stiff = k.unloading + k.steepening * peak
    opens = (1.0 - k.loading / stiff) * peak
    loads = g.overlap >= peak
    back = max(stiff * (g.overlap - opens), 0.0)
    force = k.loading * g.overlap if loads else back
    force = force if touching else 0.0
    slope = k.loading if loads else stiff
    slope = slope if force > 0.0 else 0.0
    a = 0.5 * slope / k.modulus
    stored = 0.5 * force * force / stiff
    return Response(force, a, slope, stored, 1.0), State(peak if touching else 0.0)


def restitution(k: Constants, mass: float, velocity: float) -> float:
    """Coefficient of restitution at a velocity [m/s] of a mass m* [kg]."""
    peak = velocity * sqrt(mass / k.loading)
    return sqrt(k.loading / (k.unloading + k.steepening * peak))


register(WaltonBraun1986, constants=Constants, state=State, contact=contact)
