r"""Derjaguin, Muller and Toporov (1975): Hertz with a constant attraction.

.. math::
    F = \tfrac43 E^*\sqrt{R^*}\,\delta^{3/2} - 2\pi W R^*, \quad a = \sqrt{R^*\delta},
    \quad U = \tfrac25 F_H \delta - 2\pi W R^*\delta

The force jumps to the pull-off force at touch and back to zero at separation, both at
zero overlap; nothing is lost.  Valid for hard, small, weakly sticking spheres: Tabor's
number well below 1 (else JKR).  Also known as the DMT-Maugis simplification: the radius
is Hertz's.

Reference: B. V. Derjaguin, V. M. Muller, Yu. P. Toporov, J. Colloid Interface Sci. 53
(1975) 314-326.
"""

from dataclasses import dataclass
from math import pi, sqrt
from typing import ClassVar, NamedTuple

from pestle.citations import cite
from pestle.laws._base import Geometry, Nothing, Pair, Response, register
from pestle.laws._options import PairLaw


class Constants(NamedTuple):
    """What the kernel needs of a pair of materials."""

    modulus: float  # E* [Pa]
    adhesion: float  # W [J/m^2]


@dataclass(frozen=True, slots=True, kw_only=True)
class DMT(PairLaw):
    """Elastic spheres with a constant attraction while they touch."""

    name: ClassVar[str] = "dmt"
    summary: ClassVar[str] = "elastic spheres with a constant attraction (DMT)"
    validity: ClassVar[str] = "elastic; Tabor's number well below 1"
    citation: ClassVar[str] = cite("derjaguin1975")

    def constants(self, pair: Pair) -> Constants:
        """Reduce a pair of materials to the constants of its contacts."""
        return Constants(pair.modulus, pair.work_of_adhesion)


def contact(k: Constants, g: Geometry, s: Nothing) -> tuple[Response, Nothing]:
    """Force, contact radius, stiffness and energy at an overlap."""
    overlap = max(g.overlap, 0.0)
    a = sqrt(g.radius * overlap)
    hertz = 4.0 / 3.0 * k.modulus * a * overlap
    pull = 2.0 * pi * k.adhesion * g.radius if g.overlap > 0.0 else 0.0
    stored = (0.4 * hertz - pull) * overlap
    return Response(hertz - pull, a, 2.0 * k.modulus * a, stored, 1.0), s


register(DMT, constants=Constants, state=Nothing, contact=contact)
