r"""Walton and Braun (1986): stiff unloading after plastic loading, without adhesion.

.. math:: F = K_1\delta, \quad F = K_2(\delta - \delta_0), \quad K_1 = 2\pi p R^*, \quad
    K_2 = K_1/e^2
"""

from dataclasses import dataclass
from math import pi, sqrt
from typing import ClassVar, NamedTuple

from pestle.laws import Geometry, Pair, Response, register


class Constants(NamedTuple):
    """What the kernel needs of a pair of materials."""

    pressure: float  # p, mean pressure of the plastic contact [Pa]
    steeper: float  # K_2/K_1 [-]


class State(NamedTuple):
    """What a contact remembers; zero at first touch."""

    opens: float  # overlap at which the unloaded contact opens, delta_0 [m]


@dataclass(frozen=True, slots=True, kw_only=True)
class Walton1986:
    """Plastic contacts with the same restitution at any speed."""

    pressure: float  # [Pa]
    rebound: float = 0.5  # coefficient of restitution e [-]
    name: ClassVar[str] = "walton1986"
    summary: ClassVar[str] = "linear plastic loading, stiffer elastic unloading"

    def constants(self, pair: Pair) -> Constants:
        """Reduce a pair of materials to the constants of its contacts."""
        return Constants(self.pressure, 1.0 / self.rebound**2)


def contact(k: Constants, g: Geometry, s: State) -> tuple[Response, State]:
    """Force, contact radius, stiffness and stored energy at an overlap."""
    overlap = max(g.overlap, 0.0)
    soft = 2.0 * pi * k.pressure * g.radius
    stiff = soft * k.steeper
    force = min(soft * overlap, max(stiff * (overlap - s.opens), 0.0))
    opens = max(overlap - force / stiff, s.opens) if force > 0.0 else s.opens
    stiffness = stiff if force > 0.0 else 0.0
    a = sqrt(force / (pi * k.pressure))
    return Response(force, a, stiffness, 0.5 * force**2 / stiff, 1.0), State(opens)


register(Walton1986, constants=Constants, state=State, contact=contact)
