"""Walton, Braun (1986): F = K1 d, back K2 (d - d0), K1 = 2 pi p R, K2 = K1/e^2."""

from dataclasses import dataclass
from math import pi, sqrt
from typing import NamedTuple

from pestle.laws import Geometry, Pair, Response, register


class Constants(NamedTuple):  # of a pair of materials
    pressure: float  # p, mean pressure of the plastic contact [Pa]
    steeper: float  # K2/K1 [-]


class State(NamedTuple):  # of a contact; all zero at first touch
    opens: float  # overlap at which the unloaded contact opens, d0 [m]


@dataclass(frozen=True, kw_only=True)
class Walton1986:  # the options
    pressure: float  # [Pa]
    rebound: float = 0.5  # coefficient of restitution e [-]
    name = "walton1986"
    summary = "linear plastic loading, stiffer elastic unloading"

    def constants(self, pair: Pair) -> Constants:
        return Constants(self.pressure, 1.0 / self.rebound**2)


def contact(k: Constants, g: Geometry, s: State) -> tuple[Response, State]:
    overlap, soft = max(g.overlap, 0.0), 2.0 * pi * k.pressure * g.radius
    stiff = soft * k.steeper
    force = min(soft * overlap, max(stiff * (overlap - s.opens), 0.0))
    slope = 0.0 if force == 0.0 else (soft if force == soft * overlap else stiff)
    opens = max(overlap - force / stiff, s.opens) if overlap > 0.0 else 0.0
    a, stored = sqrt(force / (pi * k.pressure)), 0.5 * force**2 / stiff
    return Response(force, a, slope, stored, 1.0), State(opens)


register(Walton1986, constants=Constants, state=State, contact=contact)
