r"""Pasha et al. (2014), simplified: plastic from the first touch, adhesive, linear.

.. math::
    f = k_p\alpha + f_0, \quad f = k_e(\alpha-\alpha_p), \quad
    f_{cp} = f_{0p} - k_{cp}\alpha_{cp}, \quad
    k_e = k_p + \frac{2R^*\alpha_{max}-\alpha_{max}^2}{R^{*2}}(\hat k-k_p)

k_e is constant or grows as said, up to k^ at alpha_max = R*.  Tension falls along -k_e
beyond f_cp and ends at 5/9 of it.  A parted contact attaches again at 8/9 f_cp and is
as new below zero overlap; the paper is silent on both.

A contact that is drawn together by f_0 along k_p and pulled off along the steeper k_e
can give more than it takes; such parameters are taken with a warning.  The printed set
(k_p = 210, k_cp = 20, k_e = 1500 N/m, f_0 = -2.1, f_0p = -4 uN) is one, by 8 %.

Reference: M. Pasha et al., Granul. Matter 16 (2014) 151-162; from a digest, not checked
against print.
"""

import warnings
from dataclasses import dataclass
from typing import ClassVar, NamedTuple

from pestle.citations import cite
from pestle.errors import EnergyWarning, InputError
from pestle.laws._base import Geometry, Pair, Response, register
from pestle.laws._options import PairLaw, parameter
from pestle.reference.pasha2014 import Simple, simple_bond, simple_gains, simple_line


class Constants(NamedTuple):
    """What the kernel needs of a pair of materials."""

    plastic: float  # k_p [N/m]
    cohesive: float  # k_cp [N/m]
    first: float  # f_0, negative [N]
    pull: float  # f_0p, negative [N]
    elastic: float  # k_e, 0: growing [N/m]
    stiffest: float  # k^ [N/m]
    modulus: float  # E* [Pa]


class State(NamedTuple):
    """What a contact remembers; zero before the first touch."""

    peak: float  # alpha_max [m]
    attached: float  # 1 in contact


@dataclass(frozen=True, slots=True, kw_only=True)
class Pasha2014Simplified(PairLaw):
    """Linear plastic adhesive contacts without an elastic range."""

    plastic_stiffness: float = parameter("k_p, loading", "N/m")
    cohesive_stiffness: float = parameter(
        "k_cp of the line of pull-off points", "N/m", ends="[)", default=0.0
    )
    touch_force: float = parameter(
        "-f_0, tension at first touch", "N", ends="[)", default=0.0
    )
    pull_off_force: float = parameter(
        "-f_0p, least pull-off force", "N", ends="[)", default=0.0
    )
    elastic_stiffness: float | None = parameter("constant k_e", "N/m", default=None)
    stiffest: float | None = parameter(
        "k^, at an overlap of R*, of a growing k_e", "N/m", default=None
    )

    name: ClassVar[str] = "pasha2014_simplified"
    summary: ClassVar[str] = "linear plastic adhesive without an elastic range"
    validity: ClassVar[str] = "a rule: stiffnesses are calibrated"
    linear: ClassVar[bool] = True
    citation: ClassVar[str] = cite("pasha2014")

    def _check(self) -> None:
        kp = self.plastic_stiffness
        stiff = self.elastic_stiffness or self.stiffest
        if stiff is None or None not in (self.elastic_stiffness, self.stiffest):
            what = "give elastic_stiffness or stiffest, one of them"
            raise InputError("one-stiffness", what, "law.elastic_stiffness")
        if not stiff > kp:
            raise InputError(
                "soft-unloading",
                f"plastic_stiffness {kp:g} N/m is not below that of unloading",
                "law.plastic_stiffness",
                "a contact that unloads softer than it loads creates energy",
            )
        pull, touch = self.pull_off_force, self.touch_force
        if not pull >= touch:
            what = f"pull_off_force {pull:g} N is below touch_force {touch:g} N"
            raise InputError("bad-pull-off", what, "law.pull_off_force")
        if simple_gains(Simple(*self._numbers(), 1.0)):
            what = "touch_force is large for the stiffnesses: contacts drawn together "
            what += "and pulled off slowly may create energy"
            warnings.warn(what, EnergyWarning, stacklevel=2)

    def _numbers(self) -> tuple[float, float, float, float, float, float]:
        return (
            self.plastic_stiffness,
            self.cohesive_stiffness,
            -self.touch_force,
            -self.pull_off_force,
            self.elastic_stiffness or 0.0,
            self.stiffest or 0.0,
        )

    def constants(self, pair: Pair) -> Constants:
        """Reduce a pair of materials to the constants of its contacts."""
        return Constants(*self._numbers(), pair.modulus)


def constants_of(k: Constants, radius: float) -> Simple:
    """Constants of a contact of a reduced radius [m]."""
    return Simple(k.plastic, k.cohesive, k.first, k.pull, k.elastic, k.stiffest, radius)


def contact(k: Constants, g: Geometry, s: State) -> tuple[Response, State]:
    """Force, stiffness, stored energy and new state at an overlap."""
    simple = constants_of(k, g.radius)
    loads = g.overlap >= s.peak
    peak = max(s.peak, g.overlap, 0.0)
    u = simple_line(simple, peak)
    touch = u.rest + 8.0 / 9.0 * u.pull_off / u.stiffness if s.peak > 0.0 else 0.0
    on = g.overlap >= (u.leave if s.attached > 0.0 else touch)
    if not on:
        kept = peak if g.overlap >= 0.0 else 0.0
        return Response(0.0, 0.0, 0.0, 0.0, 1.0), State(kept, 0.0)
    pulls = g.overlap <= u.turn
    back = u.stiffness * (g.overlap - u.rest)
    force = u.pull_off - u.stiffness * (g.overlap - u.turn) if pulls else back
    paid = simple_bond(simple, u)
    turned = 0.5 * u.pull_off * u.pull_off / u.stiffness
    fell = 0.5 * (u.turn - g.overlap) * (force + u.pull_off)
    elastic = turned - fell if pulls else 0.5 * force * force / u.stiffness
    slope = k.plastic if loads else u.stiffness
    return (
        Response(force, 0.5 * slope / k.modulus, slope, elastic - paid, 1.0),
        State(peak, 1.0),
    )


def reach(k: Constants, g: Geometry) -> float:
    """Negative overlap at which a barely loaded contact parts, the farthest [m]."""
    simple = constants_of(k, g.radius)
    leave = [simple_line(simple, g.radius * n / 1000.0).leave for n in range(200)]
    return max(-min(leave), 0.0)


register(
    Pasha2014Simplified, constants=Constants, state=State, contact=contact, reach=reach
)
