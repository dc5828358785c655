"""What a particle between flats looks like at one moment."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import pi
from typing import Literal

from pestle.particle.contact import Contact, ParticleMaterial
from pestle.reference import volume
from pestle.reference.peeling import Peel

RadiusRule = Literal["plastic", "loading", "eq37", "frozen"]


@dataclass(frozen=True, slots=True, kw_only=True)
class FlatState:
    """A flat, or a group of flats that move alike.

    Parameters
    ----------
    count : int
        Number of flats in the group.
    displacement, overlap, largest : float
        delta_o, delta and delta_max [m].
    penetration : float
        Elastic displacement of the MDR indenter [m].
    force, contact_radius : float
        Of each flat [N], [m].
    yielded : bool
        Whether the contact has yielded.
    yield_overlap, area_offset : float
        delta_Y [m] and c_A [m^2], zero before yield.
    peel : Peel
        State of adhesion.
    """

    count: int
    displacement: float
    overlap: float
    largest: float
    penetration: float
    force: float
    contact_radius: float
    yielded: bool
    yield_overlap: float
    area_offset: float
    peel: Peel

    @property
    def area(self) -> float:
        """Contact area [m^2]."""
        return pi * self.contact_radius**2

    @property
    def pressure(self) -> float:
        """Mean contact pressure, zero without contact [Pa]."""
        return self.force / self.area if self.contact_radius > 0.0 else 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class ParticleState:
    """A particle and its flats.

    Parameters
    ----------
    initial_radius, growth : float
        R_o and R - R_o [m].
    volume_ratio : float
        V/V_o by Eqs. (38), (39) [-].
    flats : tuple of FlatState
        One a group.
    """

    initial_radius: float
    growth: float
    volume_ratio: float
    flats: tuple[FlatState, ...]

    @property
    def radius(self) -> float:
        """Apparent radius R [m]."""
        return self.initial_radius + self.growth


def virial(
    contacts: Sequence[Contact],
    counts: Sequence[int],
    displacements: Sequence[float],
    initial_radius: float,
) -> float:
    """Forces times branch lengths R_o - delta_o [J]."""
    return sum(
        n * c.force * (initial_radius - d)
        for c, n, d in zip(contacts, counts, displacements, strict=True)
    )


def snapshot(
    material: ParticleMaterial,
    initial_radius: float,
    growth: float,
    *,
    contacts: Sequence[Contact],
    counts: Sequence[int],
    displacements: Sequence[float],
) -> ParticleState:
    """Collect the state of a particle."""
    lost = volume.lost_volume(
        virial(contacts, counts, displacements, initial_radius),
        initial_radius,
        bulk=material.constants.bulk,
    )
    flats = tuple(
        FlatState(
            count=n,
            displacement=d,
            overlap=c.overlap,
            largest=c.memory.largest,
            penetration=c.penetration,
            force=c.force,
            contact_radius=c.radius,
            yielded=c.memory.yielded,
            yield_overlap=c.memory.yield_overlap,
            area_offset=c.memory.area_offset,
            peel=c.state,
        )
        for c, n, d in zip(contacts, counts, displacements, strict=True)
    )
    return ParticleState(
        initial_radius=initial_radius,
        growth=growth,
        volume_ratio=1.0 - lost / volume.sphere_volume(initial_radius),
        flats=flats,
    )
