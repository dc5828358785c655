r"""Johnson, Kendall and Roberts (1971): elastic spheres with adhesion.

.. math::
    F = \frac{4E^*a^3}{3R^*} - \sqrt{8\pi W E^* a^3}, \quad
    \delta = \frac{a^2}{R^*} - \sqrt{\frac{2\pi W a}{E^*}}

A contact is made at touch (overlap 0, force -8/9 of the pull-off force) and held along
the stable branch through the largest tension 3/2 pi W R* to the separation at
-3 a_c^2/R*, where 5/9 of it is left: pull-off under force and under displacement both.
Solved exactly by one cube root and Newton steps (`pestle.reference.jkr_contact`).

The slope dF/d(overlap) is infinite at separation; the stiffness that damping, friction
and time step see is its absolute value, at most Hertz's 2 E* a.  Valid for soft, large,
sticky spheres: Tabor's number well above 1 (else DMT).

Reference: K. L. Johnson, K. Kendall, A. D. Roberts, Proc. R. Soc. A 324 (1971) 301.
"""

from dataclasses import dataclass
from typing import ClassVar, NamedTuple

from pestle.citations import cite
from pestle.laws._base import Geometry, Pair, Response, register
from pestle.laws._options import PairLaw
from pestle.reference.jkr_contact import (
    contact_radius,
    energy_at,
    force_at,
    separation_length,
    stiffness_at,
)


class Constants(NamedTuple):
    """What the kernel needs of a pair of materials."""

    modulus: float  # E* [Pa]
    adhesion: float  # W [J/m^2]


class State(NamedTuple):
    """What a contact remembers; zero before the first touch."""

    attached: float  # 1 in contact


@dataclass(frozen=True, slots=True, kw_only=True)
class JKR(PairLaw):
    """Elastic spheres with adhesion, exact."""

    name: ClassVar[str] = "jkr"
    summary: ClassVar[str] = "elastic spheres with adhesion (JKR), exact"
    validity: ClassVar[str] = "elastic; Tabor's number well above 1"
    citation: ClassVar[str] = cite("johnson1971")

    def constants(self, pair: Pair) -> Constants:
        """Reduce a pair of materials to the constants of its contacts."""
        return Constants(pair.modulus, pair.work_of_adhesion)


def contact(k: Constants, g: Geometry, s: State) -> tuple[Response, State]:
    """Force, contact radius, stiffness and energy at an overlap."""
    least = -separation_length(k.modulus, g.radius, k.adhesion)
    on = g.overlap >= (least if s.attached > 0.0 else 0.0)
    a = contact_radius(g.overlap, k.modulus, g.radius, k.adhesion)
    force = force_at(a, k.modulus, g.radius, k.adhesion)
    stored = energy_at(a, k.modulus, g.radius, k.adhesion)
    slope = stiffness_at(a, k.modulus, g.radius, k.adhesion)
    held = 1.0 if on else 0.0  # a factor, not a branch: the loop stays SIMD
    return Response(force * held, a * held, slope * held, stored * held, 1.0), State(
        held
    )


def reach(k: Constants, g: Geometry) -> float:
    """Negative overlap at which a contact parts [m]."""
    return separation_length(k.modulus, g.radius, k.adhesion)


register(JKR, constants=Constants, state=State, contact=contact, reach=reach)
