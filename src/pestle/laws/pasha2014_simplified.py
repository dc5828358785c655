r"""Pasha et al. (2014), simplified: plastic from the first touch, adhesive, linear.

.. math::
    f = k_p\alpha + f_0, \quad f = k_e(\alpha-\alpha_p), \quad
    f_{cp} = f_{0p} - k_{cp}\alpha_{cp}, \quad
    k_e = k_p + \frac{2R^*\alpha_{max}-\alpha_{max}^2}{R^{*2}}(\hat k-k_p)

k_e is constant or grows as the last formula says, up to k^ at alpha_max = R*.  Tension
falls along -k_e beyond f_cp and ends at 5/9 of it.  A parted contact attaches again at
8/9 f_cp and is as new below zero overlap; the paper is silent on both.

A contact that is drawn together by f_0 along k_p and pulled off along the steeper k_e
can give more than it takes; such parameters are taken with a warning.  The printed set
(k_p = 210, k_cp = 20, k_e = 1500 N/m, f_0 = -2.1, f_0p = -4 uN) is one, by 8 %.

Reference: M. Pasha et al., Granul. Matter 16 (2014) 151-162; from a digest, not checked
against print.
"""

import warnings
from dataclasses import dataclass, field
from typing import ClassVar, NamedTuple

from pestle.errors import EnergyWarning, InputError
from pestle.laws._base import Geometry, Pair, Response, register
from pestle.laws._plot import Drawn
from pestle.reference.pasha2014 import PARTING, Line, Simple, simple_line


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
class Pasha2014Simplified(Drawn):
    """Linear plastic adhesive contacts without an elastic range.

    Parameters
    ----------
    plastic_stiffness, cohesive_stiffness : float
        k_p and k_cp [N/m].
    touch_force, pull_off_force : float
        -f_0 and -f_0p: tensions at first touch and of the line of pull-off points, as
        positive numbers [N].
    elastic_stiffness : float
        k_e [N/m]; None: growing with the largest overlap.
    stiffest : float
        k^ of the growing k_e [N/m].
    """

    plastic_stiffness: float = field(
        metadata={"help": "k_p, loading [N/m]", "unit": "N/m"}
    )
    cohesive_stiffness: float = field(
        default=0.0, metadata={"help": "k_cp of the pull-off points", "unit": "N/m"}
    )
    touch_force: float = field(
        default=0.0, metadata={"help": "-f_0, tension at first touch", "unit": "N"}
    )
    pull_off_force: float = field(
        default=0.0, metadata={"help": "-f_0p, least pull-off force", "unit": "N"}
    )
    elastic_stiffness: float | None = field(
        default=None, metadata={"help": "constant k_e of unloading", "unit": "N/m"}
    )
    stiffest: float | None = field(
        default=None, metadata={"help": "k_e at an overlap of R*", "unit": "N/m"}
    )

    name: ClassVar[str] = "pasha2014_simplified"
    summary: ClassVar[str] = "linear plastic adhesive without an elastic range"
    validity: ClassVar[str] = "a rule: stiffnesses are calibrated"
    linear: ClassVar[bool] = True
    citation: ClassVar[str] = (
        "@article{pasha2014, author={Pasha, M. and Dogbe, S. and Hare, C. and "
        "Hassanpour, A. and Ghadiri, M.}, title={A linear model of elasto-plastic and "
        "adhesive contact deformation}, journal={Granular Matter}, volume={16}, "
        "pages={151--162}, year={2014}, doi={10.1007/s10035-013-0476-y}}"
    )

    def __post_init__(self) -> None:
        """Check the options."""
        kp = self.plastic_stiffness
        stiff = self.elastic_stiffness or self.stiffest
        if (self.elastic_stiffness is None) == (self.stiffest is None):
            raise InputError(
                "one-stiffness",
                "give elastic_stiffness or stiffest, one of them",
                "law.elastic_stiffness",
            )
        if stiff is None or not stiff > kp > 0.0:
            raise InputError(
                "soft-unloading",
                f"plastic_stiffness {kp:g} N/m is not between 0 and that of unloading",
                "law.plastic_stiffness",
                "a contact that unloads softer than it loads creates energy",
            )
        if not self.pull_off_force >= self.touch_force >= 0.0:
            raise InputError(
                "bad-pull-off",
                f"pull_off_force {self.pull_off_force:g} N is below "
                f"touch_force {self.touch_force:g} N, or one is negative",
                "law.pull_off_force",
            )
        if self._gains():
            warnings.warn(
                "touch_force is large for the stiffnesses: contacts drawn together and "
                "pulled off slowly may create energy",
                EnergyWarning,
                stacklevel=2,
            )

    def _gains(self) -> bool:
        """Whether jumping in gives more than parting from f = 0 takes."""
        k = Simple(*self._numbers(), 1.0)
        if self.touch_force == 0.0 or k.elastic == 0.0:
            return False
        u = simple_line(k, -k.first / k.plastic)
        return bond(k, u) > PARTING * u.pull_off**2 / k.elastic

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


def bond(k: Simple, u: Line) -> float:
    """Adhesive part of the stored energy, negative of what is stored at alpha_p [J].

    At least W5, so that no contact wins by attaching again; and so much that the way
    in, which is drawn by f_0 along the softer k_p, takes nothing from nowhere.
    """
    fresh = simple_line(k, 0.0)
    first = 32.0 / 81.0 * fresh.pull_off * fresh.pull_off / fresh.stiffness
    way = (0.5 * k.plastic * u.peak + k.first) * u.peak
    lost = way + 0.5 * k.first * k.first / fresh.stiffness
    lost -= 0.5 * u.force * u.force / u.stiffness
    again = 32.0 / 81.0 * u.pull_off * u.pull_off / u.stiffness
    return max(again, first - lost)


def contact(k: Constants, g: Geometry, s: State) -> tuple[Response, State]:
    """Force, stiffness, stored energy and new state at an overlap."""
    simple = Simple(
        k.plastic, k.cohesive, k.first, k.pull, k.elastic, k.stiffest, g.radius
    )
    loads = g.overlap >= s.peak
    peak = max(s.peak, g.overlap, 0.0)
    u = simple_line(simple, peak)
    touch = u.rest + 8.0 / 9.0 * u.pull_off / u.stiffness if s.peak > 0.0 else 0.0
    on = g.overlap >= (u.leave if s.attached > 0.0 else touch)
    pulls = g.overlap <= u.turn
    back = u.stiffness * (g.overlap - u.rest)
    force = u.pull_off - u.stiffness * (g.overlap - u.turn) if pulls else back
    paid = bond(simple, u)
    turned = 0.5 * u.pull_off * u.pull_off / u.stiffness
    fell = 0.5 * (u.turn - g.overlap) * (force + u.pull_off)
    elastic = turned - fell if pulls else 0.5 * force * force / u.stiffness
    slope = (k.plastic if loads else u.stiffness) if on else 0.0
    return (
        Response(
            force if on else 0.0,
            0.5 * slope / k.modulus,
            slope,
            elastic - paid if on else 0.0,
            1.0,
        ),
        State(peak if on or g.overlap >= 0.0 else 0.0, 1.0 if on else 0.0),
    )


def reach(k: Constants, g: Geometry) -> float:
    """Negative overlap at which a barely loaded contact parts, the farthest [m]."""
    simple = Simple(
        k.plastic, k.cohesive, k.first, k.pull, k.elastic, k.stiffest, g.radius
    )
    leave = [simple_line(simple, g.radius * n / 1000.0).leave for n in range(200)]
    return max(-min(leave), 0.0)


register(
    Pasha2014Simplified, constants=Constants, state=State, contact=contact, reach=reach
)
