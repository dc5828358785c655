r"""Zunker & Kamrin (2024), MDR: elastic-perfectly plastic adhesive spheres.

Each side of a contact is a particle against a rigid flat, mapped to an elliptic
indenter of height A and width B in a bed of springs (`_mdr_side`).  The apparent radius
R of a particle grows so that plastic flow keeps its volume; a bulk response sets in
where the free surface becomes small (`_mdr_particle`).  The flat between two particles
is placed so that both sides carry the same force (`_mdr_pair`).

References: W. Zunker, K. Kamrin, J. Mech. Phys. Solids 183 (2024) 105492 (Part I) and
105493 (Part II: bulk response); W. Zunker et al., Powder Technol. (2025) 120972.
The reading notes in the documentation say where we depart from print and why.
"""

import warnings
from dataclasses import dataclass
from math import inf, pi
from typing import ClassVar

from pestle.citations import cite
from pestle.errors import EnergyWarning
from pestle.laws._base import Geometry, Pair, Solid, register
from pestle.laws._mdr_indenter import hardening
from pestle.laws._mdr_pair import contact, wall
from pestle.laws._mdr_particle import Particle, Sums, update
from pestle.laws._mdr_quantities import Constants, State
from pestle.laws._options import PairLaw, choice, parameter
from pestle.reference.mdr import DECAY, RISE


@dataclass(frozen=True, slots=True, kw_only=True)
class Zunker2024(PairLaw):
    """Mechanically derived contact model (MDR): adhesion, growth and bulk response."""

    psi_b: float = parameter(
        "free-surface fraction below which the bulk response acts and R rests; the "
        "authors use 0.1 to 0.6",
        "1",
        0.0,
        1.0,
        "[)",
        default=0.5,
    )
    hardening_rise: float = parameter(
        "constant a of the pressure Y (a exp(-b x) + 1), (16)", ends="[)", default=RISE
    )
    hardening_decay: float = parameter(
        "constant b of the same, at most 20", "1", 0.0, 20.0, "[]", default=DECAY
    )
    radius_rule: str = choice(
        'growth of R: "plastic", only while a yielded contact moves inwards at its '
        'maximum, or "eq37" as printed, which can create energy',
        ("plastic", "eq37"),
        default="plastic",
    )

    name: ClassVar[str] = "zunker2024"
    summary: ClassVar[str] = "MDR: elastic-plastic adhesive spheres, large deformation"
    requires: ClassVar[tuple[str, ...]] = ("yield_stress",)
    validity: ClassVar[str] = (
        "E/Y of 6.25 to 200, displacement of a side to half its radius; adhesion with "
        "yielding needs 2 a_c >= 15 r_Ip, (F.7): see pestle.reference.validity"
    )
    citation: ClassVar[str] = cite("zunker2024", "zunker2024b")

    def _check(self) -> None:
        if self.radius_rule == "eq37":
            warnings.warn(
                "radius_rule = eq37: the particle grows in elastic cycles too and may "
                "create energy; use plastic",
                EnergyWarning,
                stacklevel=2,
            )

    def constants(self, pair: Pair) -> Constants:
        """Reduce two materials to the constants of their two sides."""
        one, two = self._side(pair.first, pair), self._side(pair.second, pair)
        both = (value for couple in zip(one, two, strict=True) for value in couple)
        always = float(self.radius_rule == "eq37")
        curve = self.hardening_rise, self.hardening_decay
        return Constants(*both, pair.work_of_adhesion, *curve, always)

    def _side(self, solid: Solid, pair: Pair) -> tuple[float, ...]:
        if solid.youngs_modulus == inf:
            return (0.0,) * 6
        flat = pair.second.compliance if pair.wall else 0.0
        modulus = 1.0 / (solid.compliance + flat)
        curve = self.hardening_rise, self.hardening_decay
        return (
            modulus,
            solid.yield_stress,
            solid.poisson_ratio,
            solid.shear_modulus,
            solid.bulk_modulus,
            yield_onset(modulus, solid.yield_stress, *curve),
        )

    def particle_constants(self, solid: Solid) -> tuple[float, float]:
        """kappa [Pa] and psi_b [-], as `update` reads them."""
        return solid.bulk_modulus, self.psi_b

    def particle(self, radius: float) -> Particle:
        """State of an undeformed particle of a radius [m]."""
        volume = 4 / 3 * pi * radius**3
        return Particle(radius, volume, 1.0, -1.0, *7 * (0.0,))


def yield_onset(
    modulus: float, yield_stress: float, rise: float = RISE, fall: float = DECAY
) -> float:
    """delta_Y / R, the root of (41) [-]; the sphere never yields beyond delta = R."""
    if 4.0 * modulus / (3.0 * pi) < 1.1 * yield_stress:
        return 1e3
    low, high = 0.0, 1.0
    for _ in range(200):  # bisection to the last bit
        x = 0.5 * (low + high)
        pressed = 4.0 * modulus / (3.0 * pi) * x**0.5
        low, high = (
            (low, x) if pressed > yield_stress * hardening(x, rise, fall) else (x, high)
        )
    return high


def reach(k: Constants, g: Geometry) -> float:
    """Farthest negative overlap at which a pair can still pull [m]."""
    return release(k.modulus_i, k.adhesion, g.radius_i) + (
        release(k.modulus_j, k.adhesion, g.radius_j) if g.radius_j > 0.0 else 0.0
    )


def release(modulus: float, adhesion: float, radius: float) -> float:
    """Negative overlap at which an elastic adhesive flat lets go, with a margin [m]."""
    if adhesion <= 0.0 or modulus <= 0.0:
        return 0.0
    length = (adhesion / modulus) ** 2 * radius
    return 2.5 * length ** (1.0 / 3.0)


register(
    Zunker2024,
    aliases=("mdr",),
    constants=Constants,
    state=State,
    contact=contact,
    wall=wall,
    reach=reach,
    particle=Particle,
    sums=Sums,
    update=update,
    screened=True,
)
