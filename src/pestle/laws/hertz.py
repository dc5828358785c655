r"""Hertz (1881): frictionless elastic spheres.

.. math::
    F = \tfrac43 E^* \sqrt{R^*}\,\delta^{3/2}, \quad a = \sqrt{R^*\delta}, \quad
    \frac{dF}{d\delta} = 2 E^* a, \quad U = \tfrac25 F \delta

Valid while a is small against R* and nothing yields.  With the engine's tangential
spring 8 G* a and Coulomb's limit this is the Hertz-Mindlin law.

Reference: H. Hertz, J. reine angew. Math. 92 (1881) 156-171.
"""

from dataclasses import dataclass
from math import sqrt
from typing import ClassVar, NamedTuple

from pestle.citations import cite
from pestle.laws._base import Geometry, Nothing, Pair, Response, register
from pestle.laws._options import PairLaw


class Constants(NamedTuple):
    """What the kernel needs of a pair of materials."""

    modulus: float  # E* [Pa]


@dataclass(frozen=True, slots=True, kw_only=True)
class Hertz(PairLaw):
    """Elastic spheres without adhesion; with the engine's friction: Hertz-Mindlin."""

    name: ClassVar[str] = "hertz"
    summary: ClassVar[str] = "elastic spheres; with friction: Hertz-Mindlin"
    validity: ClassVar[str] = "contact radius small against R*, nothing yields"
    citation: ClassVar[str] = cite("hertz1881")

    def constants(self, pair: Pair) -> Constants:
        """Reduce a pair of materials to the constants of its contacts."""
        return Constants(pair.modulus)


def contact(k: Constants, g: Geometry, s: Nothing) -> tuple[Response, Nothing]:
    """Force, contact radius, stiffness and energy at an overlap."""
    overlap = max(g.overlap, 0.0)
    a = sqrt(g.radius * overlap)
    force = 4.0 / 3.0 * k.modulus * a * overlap
    return Response(force, a, 2.0 * k.modulus * a, 0.4 * force * overlap, 1.0), s


register(Hertz, constants=Constants, state=Nothing, contact=contact)
