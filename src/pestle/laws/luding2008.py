r"""Luding (2008): piecewise linear, plastic, with adhesion that grows with plasticity.

.. math::
    f = \begin{cases} k_1\delta & k_2(\delta-\delta_0) \ge k_1\delta \\
    k_2(\delta-\delta_0) & k_1\delta > k_2(\delta-\delta_0) > -k_c\delta \\
    -k_c\delta & -k_c\delta \ge k_2(\delta-\delta_0) \end{cases} \tag{6}

delta_0 = (1 - k_1/k_2) delta_max; k_2 rises linearly from k_1 to its largest value at
delta* = k_2/(k_2-k_1) phi_f 2 a_1 a_2/(a_1+a_2) (7, 8).  On the last line delta_max is
lowered and k_2 kept, so that a contact loaded again follows k_2.  Contacts part at zero
overlap; there is no elastic range.  The tangential spring takes a = k/(2 E*).

Reference: S. Luding, Granul. Matter 10 (2008) 235-246.
"""

import warnings
from dataclasses import dataclass
from math import sqrt
from typing import ClassVar, NamedTuple

from pestle.citations import cite
from pestle.errors import EnergyWarning, InputError
from pestle.laws._base import Geometry, Pair, Response, register
from pestle.laws._options import PairLaw, flag, parameter


class Constants(NamedTuple):
    """What the kernel needs of a pair of materials."""

    loading: float  # k_1 [N/m]
    unloading: float  # largest k_2 [N/m]
    cohesive: float  # k_c [N/m]
    depth: float  # delta*/(2 R*) [-]
    hold: float  # 1: k_2 of a contact never falls, 0: it follows delta_max
    modulus: float  # E* [Pa]


class State(NamedTuple):
    """What a contact remembers; zero at first touch."""

    peak: float  # delta_max [m]
    stiff: float  # k_2 so far [N/m]


@dataclass(frozen=True, slots=True, kw_only=True)
class Luding2008(PairLaw):
    """Linear elastic-plastic adhesive contacts."""

    loading_stiffness: float = parameter("k_1, plastic loading", "N/m")
    unloading_stiffness: float = parameter("k_2, unloading after deep loading", "N/m")
    cohesive_stiffness: float = parameter(
        "k_c, adhesive line", "N/m", ends="[)", default=0.0
    )
    plasticity_depth: float = parameter(
        "phi_f, overlap over the radius where k_2 is largest; 0: always",
        ends="[)",
        default=0.0,
    )
    hold_stiffness: bool = flag(
        "a contact never loses k_2; else k_2 follows delta_max", default=True
    )

    name: ClassVar[str] = "luding2008"
    summary: ClassVar[str] = "linear elastic-plastic, adhesion grows with plasticity"
    validity: ClassVar[str] = "a rule: stiffnesses are calibrated"
    linear: ClassVar[bool] = True
    citation: ClassVar[str] = cite("luding2008")

    def _check(self) -> None:
        k1, k2 = self.loading_stiffness, self.unloading_stiffness
        if not k2 > k1:
            raise InputError(
                "soft-unloading",
                f"unloading_stiffness {k2:g} N/m is not above loading_stiffness {k1:g}",
                "law.unloading_stiffness",
                "usually 2 to 10 times the loading stiffness",
            )
        if not self.hold_stiffness and self.plasticity_depth > 0.0:
            warnings.warn(
                "hold_stiffness = false: contacts that were pulled and pressed again "
                "give back energy that the ledger does not hold",
                EnergyWarning,
                stacklevel=2,
            )

    def constants(self, pair: Pair) -> Constants:
        """Reduce a pair of materials to the constants of its contacts."""
        k1, k2 = self.loading_stiffness, self.unloading_stiffness
        depth = k2 / (k2 - k1) * self.plasticity_depth  # (8)
        return Constants(
            k1,
            k2,
            self.cohesive_stiffness,
            depth,
            float(self.hold_stiffness),
            pair.modulus,
        )


def unloading(k: Constants, radius: float, peak: float) -> float:
    """k_2 of (7) after loading to an overlap, at a reduced radius [N/m]."""
    deep = 2.0 * radius * k.depth
    part = peak / deep if deep > 0.0 else 1.0
    return k.loading + (k.unloading - k.loading) * min(part, 1.0)


def contact(k: Constants, g: Geometry, s: State) -> tuple[Response, State]:
    """Force, contact radius, stiffness and energy at an overlap."""
    x = max(g.overlap, 0.0)
    loads = x > s.peak
    held = max(k.hold * s.stiff, k.loading)
    k2 = max(unloading(k, g.radius, x), held) if loads else max(s.stiff, k.loading)
    peak = max(x, s.peak)
    opens = (1.0 - k.loading / k2) * peak
    line = k2 * (x - opens)
    pulls = line < -k.cohesive * x
    force = k.loading * x if loads else line
    force = -k.cohesive * x if pulls else force
    steeper = max(k2 - k.loading, 1e-300)
    peak = (k2 + k.cohesive) * x / steeper if pulls else peak
    opens = (1.0 - k.loading / k2) * peak
    turn = k2 * opens / (k2 + k.cohesive)
    ahead = 0.5 * k.cohesive * turn * opens  # work of parting
    stored = -0.5 * k.cohesive * x * x if pulls else 0.5 * force * force / k2 - ahead
    slope = k.loading if loads else (k.cohesive if pulls else k2)
    on = x > 0.0
    slope = slope if on else 0.0
    return (
        Response(
            force if on else 0.0,
            0.5 * slope / k.modulus,
            slope,
            stored if on else 0.0,
            1.0,
        ),
        State(peak if on else 0.0, k2 if on else 0.0),
    )


def restitution(k: Constants, radius: float, mass: float, velocity: float) -> float:
    """Coefficient of restitution at a velocity [m/s] of a mass m* [kg]."""
    k1, kc = k.loading, k.cohesive
    k2 = unloading(k, radius, velocity * sqrt(mass / k1))
    kept = k1 / k2 - kc / k1 * (k2 - k1) ** 2 / (k2 * (k2 + kc))
    return sqrt(max(kept, 0.0))


register(Luding2008, constants=Constants, state=State, contact=contact)
