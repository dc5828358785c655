"""One straight leg of a path: steps, events and the return mapping of the radius."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil, inf, pi
from typing import TYPE_CHECKING, NamedTuple

from pestle.errors import SimulationError
from pestle.particle.contact import Contact, evaluate, has_reached_yield, yielded
from pestle.particle.state import virial
from pestle.reference import volume

if TYPE_CHECKING:
    from pestle.particle.solver import Particle

_SHORTEST = 1e-12  # shortest step, as a part of the leg [-]
_ROUND_OFF = 4e-16  # width of a bisected event, as a part of the leg [-]
_SLOPE_STEP = 1e-6  # step of one-sided derivatives, in radii [-]


class Point(NamedTuple):
    """A point of the path with everything the contacts remember."""

    displacements: tuple[float, ...]  # delta_o of every group [m]
    growth: float  # R - R_o [m]
    contacts: tuple[Contact, ...]


class Resolution(NamedTuple):
    """How finely a path is resolved, all in initial radii; 0 for round-off."""

    step: float = 0.004  # largest displacement between two checks for events [-]
    event: float = 0.0  # width to which yield, touch and separation are bisected [-]
    maximum: float = 0.0  # the same for the return to the running maximum [-]


class Flags(NamedTuple):
    """What stays the same between two events."""

    active: tuple[bool, ...]  # its cap counts: touches, adheres or is outside R
    over: tuple[bool, ...]  # intact, but beyond its yield pressure
    riding: tuple[bool, ...]  # moves outwards, kept at its maximum by a growing R
    growing: bool | None  # None while the radius rule does not act


class Leg:
    """A straight leg between two sets of displacements [m]."""

    def __init__(
        self, particle: Particle, start: Sequence[float], end: Sequence[float]
    ) -> None:
        self.material = particle.material
        self.initial_radius = particle.initial_radius
        self.counts = particle.counts
        self.rule = particle.radius_rule
        self.start, self.end = tuple(start), tuple(end)
        self.speeds = tuple(b - a for a, b in zip(start, end, strict=True))
        self.parts = max(abs(v) for v in self.speeds) / self.initial_radius
        self.resolution = particle.resolution

    def run(self, point: Point) -> Point:
        """Follow the leg from a point at its start to its end."""
        if self.parts == 0.0:
            return point
        parts = self.parts
        grid = max(1, ceil(parts / self.resolution.step - 1e-9))
        goals = [1.0 - i / grid for i in range(grid)]  # the next one last
        s = 0.0
        while goals:
            point = self.yield_where_due(point)
            far = goals[-1]
            end = self.trial(point, far)
            if end is None and far - s < _SHORTEST:
                raise self.singular(point)
            middle = 0.5 * (s + far)
            narrow = max(self.width(point, end, s, far) / parts, _ROUND_OFF)
            if end is None or (far - s > narrow and s < middle < far):
                goals.append(middle)
            else:
                s, point = goals.pop(), end
        return self.yield_where_due(point)

    def width(self, point: Point, end: Point | None, s: float, far: float) -> float:
        """Width to which a step must be bisected because of events in it [radii]."""
        if end is None:
            return 0.0
        before, after = self.flags(point, s), self.flags(end, far)
        if (
            before.active != after.active
            or any(after.over)
            or any(
                a and not b for a, b in zip(before.riding, after.riding, strict=True)
            )
            or {before.growing, after.growing} == {True, False}
        ):
            return self.resolution.event
        for c, goal, v in zip(point.contacts, end.contacts, self.speeds, strict=True):
            largest = c.memory.largest
            if v > 0.0 and c.overlap < largest < goal.overlap:
                return self.resolution.maximum
        return inf

    def trial(self, point: Point, s: float) -> Point | None:
        """Return the point at `s` by return mapping; None if the step is too long."""
        end = self.at(point, s, point.growth)
        ends = zip(self.active(point), self.active(end), strict=True)
        active = tuple(before or after for before, after in ends)
        if not self.acts(point, end):
            return end
        reference = self.potential(point, active)

        def rise(growth: float) -> float:
            return self.potential(self.at(point, s, growth), active) - reference

        fall = self.potential(end, active) - reference
        if fall >= 0.0:
            return end
        first, small = point.growth, 1e-7 * self.initial_radius
        most = 2.0 * self.resolution.step * self.initial_radius
        slope = (rise(first + small) - fall) / small
        guess = -1.25 * fall / slope if slope > 0.0 else inf
        while guess <= most:
            if rise(first + guess) >= 0.0:
                from scipy.optimize import brentq

                tiny = 1e-17 * self.initial_radius
                bound = first + guess
                growth = brentq(rise, first, bound, xtol=tiny, rtol=1e-15)
                return self.at(point, s, growth)
            guess *= 2.0
        return None

    def at(self, point: Point, s: float, growth: float) -> Point:
        """Return the point at `s` with a given growth, coming from another point."""
        displacements = (
            self.end
            if s == 1.0
            else tuple(a + s * v for a, v in zip(self.start, self.speeds, strict=True))
        )
        radius = self.initial_radius + growth
        contacts = tuple(
            evaluate(self.material, radius, d + growth, c.memory)
            for d, c in zip(displacements, point.contacts, strict=True)
        )
        return Point(displacements, growth, contacts)

    def potential(self, point: Point, active: tuple[bool, ...]) -> float:
        """Geometric plus elastically lost volume, less the initial one [m^3]."""
        r_o, u = self.initial_radius, point.growth
        radius = r_o + u
        shell = 4.0 / 3.0 * pi * u * (radius * radius + radius * r_o + r_o * r_o)
        caps = sum(
            n * volume.cap_volume(c.overlap, radius)
            for c, n, counts in zip(point.contacts, self.counts, active, strict=True)
            if counts
        )
        work = virial(point.contacts, self.counts, point.displacements, r_o)
        lost = volume.lost_volume(work, r_o, bulk=self.material.constants.bulk)
        return shell - caps + lost

    def flags(self, point: Point, s: float) -> Flags:
        """Flags of a point, seen in the direction of the leg."""
        radius = self.initial_radius + point.growth
        active = self.active(point)
        ahead = self.at(point, s + _SLOPE_STEP / self.parts, point.growth)
        growing = None
        if self.acts(point, ahead):
            growing = self.potential(ahead, active) < self.potential(point, active)
        return Flags(
            active,
            tuple(has_reached_yield(self.material, radius, c) for c in point.contacts),
            tuple(
                growing is True and v < 0.0 and c.overlap >= c.memory.largest
                for c, v in zip(point.contacts, self.speeds, strict=True)
            ),
            growing,
        )

    def active(self, point: Point) -> tuple[bool, ...]:
        """Tell the caps of which contacts count."""
        return tuple(
            c.penetration > 0.0 or c.radius > 0.0 or c.overlap <= 0.0
            for c in point.contacts
        )

    def acts(self, point: Point, end: Point) -> bool:
        """Tell whether the radius rule acts between two points."""
        if self.rule in ("eq37", "frozen"):
            return self.rule == "eq37"
        contacts = zip(point.contacts, end.contacts, self.speeds, strict=True)
        return any(
            v > 0.0
            and goal.overlap > c.memory.largest
            and (c.memory.yielded or self.rule == "loading")
            for c, goal, v in contacts
        )

    def yield_where_due(self, point: Point) -> Point:
        """Make the contacts yield that have reached their yield pressure."""
        radius = self.initial_radius + point.growth
        contacts = list(point.contacts)
        for i, c in enumerate(contacts):
            if has_reached_yield(self.material, radius, c):
                memory = yielded(self.material, radius, c.memory)
                contacts[i] = evaluate(self.material, radius, c.overlap, memory)
        return point._replace(contacts=tuple(contacts))

    def singular(self, point: Point) -> SimulationError:
        """Return the error of a path that cannot be followed further."""
        r_o = self.initial_radius
        reached = ", ".join(f"{d / r_o:.6g}" for d in point.displacements)
        return SimulationError(
            "radius-singular",
            "the apparent radius would grow without bound: the caps of the flats fill "
            "the particle",
            where=f"displacements of {reached} radii, "
            f"apparent radius {1.0 + point.growth / r_o:.6g} radii",
            hint="stop before; beyond this confinement a particle responds by its bulk "
            "modulus, which this single-particle model leaves out",
        )
