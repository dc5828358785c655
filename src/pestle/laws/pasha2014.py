r"""Pasha et al. (2014), full version: linear, elastic up to yield, plastic, adhesive.

.. math::
    f = k_e\alpha + \tfrac89 f_{ce}, \quad f = f_y + k_p(\alpha-\alpha_y), \quad
    f = k_e(\alpha-\alpha_p)

with one elastic stiffness k_e; tension grows to f_cp (`pestle.reference.pasha2014`),
falls along -k_e and ends at 5/9 f_cp.  As published f_cp vanishes just after yield,
which would create energy: here it never falls below that of the unyielded contact.  A
parted contact attaches again at 8/9 f_cp and is as new below zero overlap; the paper is
silent on both.  The tangential spring takes a = k/(2 E*).

Reference: M. Pasha et al., Granul. Matter 16 (2014) 151-162; from a digest, not checked
against print.
"""

from dataclasses import dataclass
from typing import ClassVar, NamedTuple

from pestle.citations import cite
from pestle.errors import InputError
from pestle.laws._base import Geometry, Pair, Response, register
from pestle.laws._options import PairLaw, parameter
from pestle.reference.pasha2014 import Full, full_line, full_yield_overlap


class Constants(NamedTuple):
    """What the kernel needs of a pair of materials."""

    elastic: float  # k_e [N/m]
    plastic: float  # k_p [N/m]
    yield_force: float  # f_y [N]
    adhesion: float  # Gamma [J/m^2]
    modulus: float  # E* [Pa]


class State(NamedTuple):
    """What a contact remembers; zero before the first touch."""

    peak: float  # alpha_max once yielded [m]
    attached: float  # 1 in contact


@dataclass(frozen=True, slots=True, kw_only=True)
class Pasha2014(PairLaw):
    """Linear elastic-plastic adhesive contacts with given stiffnesses."""

    elastic_stiffness: float = parameter("k_e, elastic loading and unloading", "N/m")
    plastic_stiffness: float = parameter("k_p, loading beyond yield", "N/m")
    yield_force: float = parameter("f_y, force at yield", "N", ends="[)", default=0.0)

    name: ClassVar[str] = "pasha2014"
    summary: ClassVar[str] = "linear elastic-plastic adhesive, stiffnesses given"
    validity: ClassVar[str] = "a rule: stiffnesses are calibrated"
    linear: ClassVar[bool] = True
    citation: ClassVar[str] = cite("pasha2014")

    def _check(self) -> None:
        ke, kp = self.elastic_stiffness, self.plastic_stiffness
        if not ke >= kp:
            raise InputError(
                "soft-unloading",
                f"plastic_stiffness {kp:g} N/m is above elastic_stiffness {ke:g} N/m",
                "law.plastic_stiffness",
                "a contact that unloads softer than it loads creates energy",
            )

    def constants(self, pair: Pair) -> Constants:
        """Reduce a pair of materials to the constants of its contacts."""
        return Constants(
            self.elastic_stiffness,
            self.plastic_stiffness,
            self.yield_force,
            pair.work_of_adhesion,
            pair.modulus,
        )


def contact(k: Constants, g: Geometry, s: State) -> tuple[Response, State]:
    """Force, stiffness, stored energy and new state at an overlap."""
    full = Full(k.elastic, k.plastic, k.adhesion, g.radius, k.yield_force)
    before = max(s.peak, full_yield_overlap(full))
    yields = g.overlap > before
    u = full_line(full, max(before, g.overlap), True)
    flat = yields or s.peak > 0.0
    touch = u.rest + 8.0 / 9.0 * u.pull_off / k.elastic if flat else 0.0
    on = g.overlap >= (u.leave if s.attached > 0.0 else touch)
    pulls = g.overlap <= u.turn
    back = k.elastic * (g.overlap - u.rest)
    force = u.pull_off - k.elastic * (g.overlap - u.turn) if pulls else back
    parting = 137.0 / 162.0 * u.pull_off * u.pull_off / k.elastic
    given = 0.5 * (g.overlap - u.leave) * (force + 5.0 / 9.0 * u.pull_off)
    stored = given if pulls else 0.5 * force * force / k.elastic - parting
    slope = (k.plastic if yields else k.elastic) if on else 0.0
    peak = g.overlap if yields else s.peak
    return (
        Response(
            force if on else 0.0,
            0.5 * slope / k.modulus,
            slope,
            stored if on else 0.0,
            1.0,
        ),
        State(peak if on or g.overlap >= 0.0 else 0.0, 1.0 if on else 0.0),
    )


def reach(k: Constants, g: Geometry) -> float:
    """Negative overlap at which an unyielded contact parts, the farthest of all [m]."""
    full = Full(k.elastic, k.plastic, k.adhesion, g.radius, k.yield_force)
    return -full_line(full, 0.0, True).leave


register(Pasha2014, constants=Constants, state=State, contact=contact, reach=reach)
