r"""Nan, Goh and Rahman (2022): linear elastic-plastic adhesive contact.

Straight lines: jump-in to -8/9 f_ce at touch, k_el up to yield, k_p beyond, unloading
along k_e, which grows with the largest overlap, down to the pull-off force f_cp, then a
rising adhesive line -k_c until the contact parts at 5/9 f_cp.  A parted contact
attaches again at alpha_c0.  All parameters follow from the material:

.. math::
    k_{el} = \pi R^* p_y \;(52), \quad f_y = f_{y0}\sqrt{\frac{6}{5}\frac{k_{el}}
    {\pi R^* p_y}} \;(28), \quad k_e = k_{el}\sqrt{\alpha_{max}/\alpha_y} \;(46), \quad
    p_y = 1.295\,e^{0.736\nu}\sigma_y \;(32)

.. math::
    \frac{f_{cp}}{f_{ce}} = \tfrac12\Big(\sqrt{A^2 + 4\tfrac{k_e}{k_{el}}
    (\tfrac{\alpha_p}{\alpha_0}A+1)} - A\Big) \;(59), \quad
    A = \frac{96}{56\,k_e/k_c+17} \;(56)

The closed forms are those of `pestle.reference.nan2022`; docs/papers/nan2022 says where
we depart from print.  Damping (24)-(26): the engine's 2 gamma sqrt(m* k_n), times beta
after yield.  Friction (21)-(23): a = k_n/(2 E*) makes the engine's spring k_t = 4 G*/E*
k_n, limited by mu |f|.  Valid for a cohesion-yield number above 0.00115: below, (36)
has no answer and k_e/k_c is held at 0.01.

Reference: W. Nan, W. P. Goh, M. T. Rahman, Powder Technol. 406 (2022) 117634.
"""

import warnings
from dataclasses import dataclass
from math import inf, pi
from typing import ClassVar, NamedTuple

from pestle.citations import cite
from pestle.errors import EnergyWarning
from pestle.laws._base import Geometry, Pair, Response, register
from pestle.laws._options import PairLaw, choice, flag, parameter
from pestle.reference.nan2022 import RULES, Contact, respond, stiffness_ratio, unloading
from pestle.reference.nan2022 import contact as complete
from pestle.reference.nan2022_energy import yield_pressure, yield_pressure_chang

LEAST_RATIO = 0.01  # of k_e/k_c, where (36) gives less or a negative number [-]
NEVER = 1e6  # times p_y, the pressure of a contact that does not yield [-]
PRESSURES = {"jackson_green": yield_pressure, "chang": yield_pressure_chang}


class Constants(NamedTuple):
    """What the kernel needs of a pair of materials."""

    modulus: float  # E* [Pa]
    adhesion: float  # Gamma [J/m^2]
    pressure: float  # p_y of the softer body [Pa]
    elastic: float  # k_el/(pi R* p_y) [-]
    plastic: float  # k_p/k_el [-]
    rule: float  # of the pull-off force
    damping: float  # factor after yield [-]
    forget: float  # overlap where a parted contact forgets [m]


class State(NamedTuple):
    """What a contact remembers; zero before the first touch."""

    peak: float  # alpha_max once yielded [m]
    attached: float  # cs, 1 in contact


@dataclass(frozen=True, slots=True, kw_only=True)
class Nan2022(PairLaw):
    """Linear elastic-plastic adhesive contacts with parameters from the material."""

    pull_off: str = choice("rule of the pull-off force", RULES, default="nan59")
    pressure_rule: str = choice(
        "p_y from Y, (32) or (33)", tuple(PRESSURES), default="jackson_green"
    )
    yields: bool = flag("false: elastic at any force, with the same k_el", default=True)
    elastic_ratio: float = parameter("k_el over pi R* p_y; 1 is (52)", default=1.0)
    plastic_ratio: float = parameter("k_p over k_el", "1", 0.0, 1.0, "(]", default=1.0)
    damping_after_yield: float = parameter(
        "beta of (26), on the damping of yielded contacts", ends="[)", default=0.1
    )
    alpha_forget: float = parameter(
        "below it a parted contact is as new", "m", -inf, 0.0, "(]", default=0.0
    )

    name: ClassVar[str] = "nan2022"
    summary: ClassVar[str] = "linear elastic-plastic adhesive, all from material data"
    validity: ClassVar[str] = (
        "overlaps small against R*; cohesion-yield number above 0.00115"
    )
    linear: ClassVar[bool] = True
    requires: ClassVar[tuple[str, ...]] = ("yield_stress",)
    citation: ClassVar[str] = cite("nan2022")

    def _check(self) -> None:
        if self.pull_off == "pasha61":
            what = "pull_off = pasha61: a slightly yielded contact loses its adhesion "
            what += "and creates energy; use nan59"
            warnings.warn(what, EnergyWarning, stacklevel=2)

    def constants(self, pair: Pair) -> Constants:
        """Reduce a pair of materials to the constants of its contacts."""
        rule = PRESSURES[self.pressure_rule]
        sides = pair.first, pair.second
        raised = 1.0 if self.yields else NEVER
        return Constants(
            pair.modulus,
            pair.work_of_adhesion,
            raised * min(rule(s.yield_stress, s.poisson_ratio) for s in sides),
            self.elastic_ratio / raised,
            self.plastic_ratio,
            float(RULES.index(self.pull_off)),
            self.damping_after_yield,
            self.alpha_forget,
        )


def parameters(k: Constants, radius: float) -> Contact:
    """Complete contact of a reduced radius [m]."""
    elastic = k.elastic * pi * radius * k.pressure
    ratio = stiffness_ratio(k.modulus, radius, k.adhesion, elastic)
    stiff = elastic, k.plastic * elastic, max(ratio, LEAST_RATIO)
    return complete(k.modulus, radius, k.adhesion, k.pressure, *stiff, k.rule)


def contact(k: Constants, g: Geometry, s: State) -> tuple[Response, State]:
    """Force, stiffness, stored energy and new state at an overlap."""
    c = parameters(k, g.radius)
    r = respond(c, g.overlap, s.peak, s.attached, k.forget)
    damping = k.damping if r.peak > 0.0 else 1.0
    a = 0.5 * r.stiffness / k.modulus
    return (
        Response(r.force, a, r.stiffness, r.stored, damping),
        State(r.peak, r.attached),
    )


def reach(k: Constants, g: Geometry) -> float:
    """Farthest negative overlap at which a contact pulls or remembers [m]."""
    c = parameters(k, g.radius)
    if stiffness_ratio(k.modulus, g.radius, k.adhesion, c.elastic) < LEAST_RATIO:
        warnings.warn(
            f"nan2022: at R* = {g.radius:.3g} m the cohesion-yield number is below "
            "0.00115, where (36) has no answer (Nan et al. 2022); k_e/k_c is held at "
            f"{LEAST_RATIO}",
            stacklevel=2,
        )
    leave = [unloading(c, c.yield_overlap * 1.01**n).leave for n in range(500)]
    return max(-min(leave), -k.forget, 0.0)


register(Nan2022, constants=Constants, state=State, contact=contact, reach=reach)
