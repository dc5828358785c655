"""Zunker and Kamrin (2024) as a law of a single particle: the exact solver of MDR.

It follows a path with all its memory, so that it needs no law of unloading.  Points are
computed one after the other, each from the state before.  Besides the three
configurations it takes any set of flats: contacts see each other through the volume
only, so that their directions do not matter.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf
from typing import ClassVar, cast

import numpy as np
from numpy.typing import ArrayLike

from pestle.citations import cite
from pestle.errors import InputError
from pestle.laws._options import choice, parameter
from pestle.particle.configuration import checked
from pestle.particle.contact import ParticleMaterial
from pestle.particle.law import Array, Curve, Loading, register
from pestle.particle.solver import Particle
from pestle.particle.state import RadiusRule
from pestle.reference.mdr import DECAY, RISE

FLATS = {
    "simple": (1.0, 1.0),
    "die": (1.0, 1.0, 0.0, 0.0, 0.0, 0.0),
    "hydrostatic": (1.0,) * 6,
}
"""How far each flat of a configuration moves, over the displacement of the path."""


def checked_flats(flats: Sequence[float]) -> tuple[float, ...]:
    """Return a set of flats, or say what is wrong with it."""
    moves = tuple(float(move) for move in flats)
    if not moves or moves[0] != 1.0 or not all(-inf < move < inf for move in moves):
        raise InputError(
            "flats-without-path",
            f"flats {', '.join(f'{move:g}' for move in moves) or 'none'} do not begin "
            "with the one that the path describes",
            hint="write 1 first, then how far each other flat moves in proportion: "
            "1,0,0 is one flat that moves and two that stand",
        )
    return moves


@register
@dataclass(frozen=True, kw_only=True)
class Zunker2024(Loading):
    """Elastic-plastic adhesive particle that keeps its volume (MDR)."""

    youngs_modulus: float = parameter("Young's modulus E", "Pa")
    poisson_ratio: float = parameter("Poisson ratio nu", "1", -1.0, 0.5)
    yield_stress: float = parameter("uniaxial yield stress Y", "Pa")
    work_of_adhesion: float = parameter(
        "work of adhesion W of particle and flat", "J/m^2", ends="[]", default=0.0
    )
    hardening_rise: float = parameter(
        "constant a of the pressure Y (a exp(-b x) + 1), Eq. (16)",
        "1",
        ends="[]",
        default=RISE,
    )
    hardening_decay: float = parameter(
        "constant b of the same", "1", ends="[]", default=DECAY
    )
    radius_rule: str = choice(
        "when the apparent radius may grow",
        ("plastic", "loading", "eq37", "frozen"),
        default="plastic",
    )

    name: ClassVar[str] = "zunker2024"
    summary: ClassVar[str] = "MDR, solved exactly: loading, unloading, adhesion"
    validity: ClassVar[str] = (
        "elastic-perfectly plastic, up to the fill of the cell; contacts see each "
        "other through the volume only"
    )
    citation: ClassVar[str] = cite("zunker2024")

    def _curve(self, x: Array, radius: float, configuration: str) -> Curve:
        order = np.argsort(x, axis=None)
        path = np.ravel(x)[order] * radius
        out = self.on_flats(path, radius=radius, flats=FLATS[configuration])
        back = np.empty_like(order)
        back[order] = np.arange(order.size)
        return Curve(*(part[back, 0].reshape(np.shape(x)) for part in out))

    def follow(
        self,
        displacement: ArrayLike,
        *,
        radius: float,
        configuration: str = "simple",
    ) -> Curve:
        """Force and contact radius of one moving flat along one path.

        Parameters
        ----------
        displacement : array
            Of each moving flat, one path from the virgin state on [m].
        radius : float
            Radius of the particle [m].
        configuration : {"simple", "die", "hydrostatic"}
            How many flats there are and which move.
        """
        flats = FLATS[checked(configuration)]
        force, contact = self.on_flats(displacement, radius=radius, flats=flats)
        return Curve(force[:, 0], contact[:, 0])

    def on_flats(
        self, displacement: ArrayLike, *, radius: float, flats: Sequence[float]
    ) -> Curve:
        """Force and contact radius of every flat of any set along one path.

        Parameters
        ----------
        displacement : array
            Of the first flat, one path of n points from the virgin state on [m].
        radius : float
            Radius of the particle [m].
        flats : sequence of float
            How far each flat moves over the displacement; the first is 1 [-].

        Returns
        -------
        Curve
            Arrays of n rows, a column for every flat.
        """
        path = np.asarray(displacement, dtype=float)
        if path.ndim != 1:
            raise InputError(
                "one-path-only",
                f"{self.name} follows one path at a time, not an array of shape "
                f"{path.shape}",
                hint="call it once for each path",
            )
        material = ParticleMaterial(
            youngs_modulus=float(self.youngs_modulus),
            poisson_ratio=float(self.poisson_ratio),
            yield_stress=float(self.yield_stress),
            work_of_adhesion=float(self.work_of_adhesion),
            hardening_rise=float(self.hardening_rise),
            hardening_decay=float(self.hardening_decay),
        )
        every = checked_flats(flats)
        moves = list(dict.fromkeys(every))  # flats that move alike are one group
        counts = [every.count(move) for move in moves]
        rule = cast(RadiusRule, self.radius_rule)
        particle = Particle(material, radius, counts=counts, radius_rule=rule)
        trace = particle.trace(np.multiply.outer(path, moves))
        group = [moves.index(move) for move in every]
        return Curve(trace.force[:, group], trace.contact_radius[:, group])
