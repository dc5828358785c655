"""What is on the bench: a contact of two bodies, or a particle between flats.

Both follow paths of displacements, the last axis being the path, each from the virgin
state, and answer with the columns of a `Trace`.
"""

from dataclasses import dataclass
from functools import cached_property
from math import pi
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pestle.errors import InputError
from pestle.laws import Nothing, Pair, Parts, parts_of
from pestle.particle.configuration import checked
from pestle.particle.law import Curve
from pestle.particle.library import WholeLaw
from pestle.particle.zunker2024 import FLATS, Zunker2024, checked_flats

Array = NDArray[np.float64]


class Trace(NamedTuple):
    """What a path gives; nan where a law says nothing."""

    displacement: Array  # overlap of a pair, or of each moving flat [m]
    force: Array  # repulsion positive [N]
    contact_radius: Array  # [m]
    stored: Array  # recoverable energy of the contact [J]
    others: tuple[Curve, ...] = ()  # force and contact radius of further flats


@dataclass(frozen=True, kw_only=True)
class SingleParticle:
    """A particle between flats, or hitting one.

    Parameters
    ----------
    law : Cycle or Zunker2024
        Law of the particle.
    radius : float
        Radius [m].
    configuration : str
        "simple", "die" or "hydrostatic".
    density : float
        Density of the solid, for impacts [kg/m^3].
    flats : tuple of float
        Any other set of flats, for the exact MDR only: how far each moves over the
        displacement of the path, the first 1 [-].
    """

    law: WholeLaw
    radius: float
    configuration: str = "simple"
    density: float = 0.0
    flats: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        """Refuse flats that the law does not know."""
        if self.flats and not isinstance(self.law, Zunker2024):
            raise InputError(
                "configuration-without-law",
                f"{self.law.name} says nothing about a set of {len(self.flats)} flats",
                "--flats",
                "take zunker2024, or --configuration simple, die or hydrostatic",
            )
        if self.flats:
            checked_flats(self.flats)

    @property
    def name(self) -> str:
        """Name of the law."""
        return self.law.name

    @property
    def largest(self) -> float:
        """Displacement beyond which no law goes [m]."""
        return self.radius * (1.0 - 1e-9)

    @property
    def reach(self) -> float:
        """Farthest negative displacement at which a contact may pull [m]."""
        return 0.5 * self.radius if hasattr(self.law, "work_of_adhesion") else 0.0

    @property
    def mass(self) -> float:
        """Mass of the particle [kg]."""
        return self.density * 4.0 / 3.0 * pi * self.radius**3

    def follow(self, path: ArrayLike) -> Trace:
        """Follow paths of displacements [m]."""
        paths = np.asarray(path, dtype=float)
        if isinstance(self.law, Zunker2024):
            flats = self.flats or FLATS[checked(self.configuration)]
            rows = [
                self.law.on_flats(row, radius=self.radius, flats=flats)
                for row in paths.reshape(-1, paths.shape[-1])
            ]
            every = [
                Curve(
                    *(
                        np.reshape([part[:, n] for part in parts], paths.shape)
                        for parts in zip(*rows, strict=True)
                    )
                )
                for n in range(max(len(self.flats), 1))
            ]
        else:
            every = [
                self.law.follow(
                    paths, radius=self.radius, configuration=self.configuration
                )
            ]
        first, *others = every
        return Trace(paths, *first, np.full_like(first.force, np.nan), tuple(others))


@dataclass(frozen=True, kw_only=True)
class PairContact:
    """Two particles, or a particle and a wall, along their common normal.

    Parameters
    ----------
    law : object
        A pair law of `pestle.laws`, or one's own that is registered.
    pair : Pair
        The two materials.
    radius : float
        Radius of the particle [m].
    other_radius : float
        Radius of the second particle, 0 for a wall [m].
    """

    law: Any
    pair: Pair
    radius: float
    other_radius: float = 0.0

    @property
    def name(self) -> str:
        """Name of the law."""
        return str(self.law.name)

    @cached_property
    def parts(self) -> Parts:
        """Compiled parts of the law."""
        parts = parts_of(self.law)
        if parts.particle is not Nothing:
            raise InputError(
                "law-needs-its-particles",
                f"{self.name} has contacts that see each other: there is no single "
                "pair",
                hint="put the particle on the bench, such as zunker2024",
            )
        return parts

    @cached_property
    def constants(self) -> Any:
        """Constants of the law for this pair."""
        return self.law.constants(self.pair)

    @property
    def sizes(self) -> tuple[float, float, float]:
        """Reduced radius and both radii [m]."""
        a, b = self.radius, self.other_radius
        return (a if b == 0.0 else a * b / (a + b)), a, b

    @property
    def geometry(self) -> tuple[float, float, float, float]:
        """Sizes and reach, as the compiled loops take them [m]."""
        return (*self.sizes, self.reach)

    @property
    def largest(self) -> float:
        """Overlap beyond which the bench does not go [m]."""
        return self.sizes[0]

    @cached_property
    def reach(self) -> float:
        """Farthest negative overlap at which the contact may pull [m]."""
        from pestle.laws import Geometry

        g = Geometry(0.0, *self.sizes, 1.0, 0.0)
        return float(self.parts.reach(self.constants, g))

    @property
    def mass(self) -> float:
        """Reduced mass of the pair [kg]."""
        volumes = (4.0 / 3.0 * pi * r**3 for r in (self.radius, self.other_radius))
        first, second = (
            volume * solid.density
            for volume, solid in zip(
                volumes, (self.pair.first, self.pair.second), strict=True
            )
        )
        return first if self.other_radius == 0.0 else first * second / (first + second)

    def follow(self, path: ArrayLike) -> Trace:
        """Follow paths of overlaps [m]."""
        from pestle.bench.kernel import FORCE, RADIUS, STORED, follower

        paths = np.asarray(path, dtype=float)
        rows = np.ascontiguousarray(paths.reshape(-1, paths.shape[-1]))
        out = np.zeros((4, *rows.shape))
        follower(self.parts)(self.constants, self.geometry, rows, self.virgin, out)
        columns = out.reshape(4, *paths.shape)
        return Trace(paths, columns[FORCE], columns[RADIUS], columns[STORED])

    @property
    def virgin(self) -> Any:
        """State of a contact that has never touched."""
        state = self.parts.state
        return state(*(0.0 for _ in state._fields))  # type: ignore[attr-defined]


Subject = SingleParticle | PairContact
