"""One sphere between flats: loading, and unloading from any depth of it."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from pestle.errors import InputError, SimulationError
from pestle.lab.assembly import Assembly, Booleans
from pestle.lab.equilibrium import Contact, Equilibrium, NotConverged
from pestle.lab.material import Material
from pestle.lab.measure import contact_radius
from pestle.lab.mesh import Fineness, Floats, Mesh, quarter_disc

DEEPEST = 0.6
"""Largest depth of the flat [R]."""
_EDGES_AT_START = 2.5  # edges in contact at the first step
_EDGE_SHARE = 0.5  # growth of sqrt(2 depth) in a step, in edges at the rim
_FINEST = 2.0**-12  # smallest step, as a part of the regular one
_UNLOADING_STEPS = 40
_RELEASE = 1e-3  # below this part of the largest force the sphere is let go


@dataclass(frozen=True, eq=False)
class Moment:
    """An equilibrium on a path and what led to it.

    Parameters
    ----------
    equilibrium : Equilibrium
        Displacements, contact, stresses.
    before : Moment, optional
        The moment before it, without its own past; None at the start.
    work : float
        Work of the flat, trapezoidal in its displacement [E R^3].
    elastic, plastic : float
        Work of the stresses on elastic and on plastic strains [E R^3].
    radius : tuple of float
        Contact radius and its bracket [R].
    """

    equilibrium: Equilibrium
    before: "Moment | None"
    work: float
    elastic: float
    plastic: float
    radius: tuple[float, float, float]

    @property
    def depth(self) -> float:
        """Displacement of the flat [R]."""
        return self.equilibrium.depth

    @property
    def force(self) -> float:
        """Force of the flat [E R^2]."""
        return self.equilibrium.force

    @property
    def area(self) -> float:
        """Contact area [R^2]."""
        return float(np.pi * self.radius[0] ** 2)

    @property
    def iterations(self) -> int:
        """Newton iterations of the step."""
        return len(self.equilibrium.residuals) - 1

    @property
    def point(self) -> "Point":
        """Its numbers."""
        works = self.work, self.elastic, self.plastic
        return Point(self.depth, self.force, *self.radius, *works, self.iterations)


class Point(NamedTuple):
    """Numbers of a moment, without its fields."""

    depth: float  # displacement of the flat [R]
    force: float  # [E R^2]
    radius: float  # contact radius [R]
    inner: float  # its bracket [R]
    outer: float
    work: float  # of the flat [E R^3]
    elastic: float  # work on elastic strains [E R^3]
    plastic: float  # work on plastic strains [E R^3]
    iterations: int  # of Newton's method


@dataclass(frozen=True, eq=False)
class Unloading:
    """A branch from a depth to separation.

    Parameters
    ----------
    start : Moment
        Where it began.
    points : tuple of Point
        From the start to the last contact.
    relaxed : Moment
        The sphere without forces.
    """

    start: Moment
    points: tuple[Point, ...]
    relaxed: Moment

    @property
    def separation(self) -> float:
        """Depth of the flat at which the relaxed sphere just touches it, d_0 [R]."""
        return self.relaxed.depth


class Sphere:
    """An elastic-plastic sphere of radius 1 and modulus 1 between rigid flats.

    By symmetry a quarter of its section between one flat and the equator.

    Parameters
    ----------
    material : Material
        Its material.
    mesh : str or Fineness
        How fine: "coarse", "medium", "fine".

    Examples
    --------
    >>> sphere = Sphere(Material(200.0, 0.3))
    >>> moment = sphere.load_to(0.001)
    >>> round(moment.force, 6)
    3.5e-05
    """

    def __init__(self, material: Material, mesh: str | Fineness = "coarse") -> None:
        self.material = material
        self.mesh: Mesh = quarter_disc(mesh)
        self.assembly = Assembly(self.mesh, material)
        self.contact = Contact(self.assembly)
        self._fraction = 1.0

    @cached_property
    def first_depth(self) -> float:
        """Depth of the first step: 2.5 edges in contact [R]."""
        return 0.5 * float(_EDGES_AT_START * self.mesh.edges[0]) ** 2

    def touch(self, depth: float) -> Moment:
        """Press an intact sphere to a depth [R] in one step: for small depths."""
        mesh = self.mesh
        active = mesh.points[mesh.surface, 1] < 0.6 * depth
        try:
            found = self._virgin(
                self.contact, depth, np.zeros_like(mesh.points), active
            )
        except NotConverged:
            found = self._approached(depth, active)
        radius = contact_radius(mesh, found.u, found.active, depth)
        elastic, plastic = self._works(None, found)
        return Moment(found, None, 0.5 * found.force * depth, elastic, plastic, radius)

    def _virgin(
        self, contact: Contact, depth: float, guess: Floats, active: Booleans
    ) -> Equilibrium:
        """Equilibrium of an intact sphere at a depth."""
        return contact.equilibrium(
            depth,
            guess=guess,
            active=active,
            state=self.assembly.fresh_state(),
            least_force=0.0,
        )

    def _approached(self, depth: float, active: Booleans) -> Equilibrium:
        """First touch of a hard sphere, through softer ones at the same depth."""
        guess, found = np.zeros_like(self.mesh.points), None
        for material in self.material.stiffening():
            contact = Contact(Assembly(self.mesh, material))
            try:
                found = self._virgin(contact, depth, guess, active)
            except NotConverged as error:
                raise _stuck(None, "the first touch", str(error)) from error
            guess, active = found.u, found.active
        assert found is not None
        return found

    def load_to(self, depth: float, start: Moment | None = None) -> Moment:
        """Press the flat to a depth [R] and return the end."""
        return list(self.load([depth], start))[-1]

    def load(
        self, depths: Sequence[float], start: Moment | None = None
    ) -> Iterator[Moment]:
        """Press the flat deeper and deeper; stops at every given depth on its way.

        Parameters
        ----------
        depths : sequence of float
            Depths that are met exactly, rising [R].
        start : Moment, optional
            Where to go on from; by default an intact sphere.

        Yields
        ------
        Moment
            Every step.

        Raises
        ------
        InputError
            If a depth is outside of what the mesh or the method can do.
        SimulationError
            If a step does not converge.
        """
        self._check(depths)
        moment = start
        for depth in depths:
            while moment is None or moment.depth < depth * (1.0 - 1e-12):
                moment = self._load_step(moment, depth)
                yield moment

    def unload(self, start: Moment) -> Unloading:
        """Withdraw the flat until the sphere is free.

        Parameters
        ----------
        start : Moment
            A moment of the loading.
        """
        points = [start.point]
        e_star, (a, _, _) = self.material.plane_strain_modulus, start.radius
        step = start.force / (2.0 * e_star * a) / _UNLOADING_STEPS
        target = start.force / _UNLOADING_STEPS
        last = start
        while last.force > _RELEASE * start.force:
            step, moment = self._unload_step(last, step, start.force)
            if not moment.equilibrium.active.any():
                break
            points.append(moment.point)
            drop = last.force - moment.force
            wish = min(target, 0.5 * moment.force)
            step *= float(np.clip(wish / max(drop, 1e-300), 0.25, 4.0))
            last = moment
        return Unloading(start, tuple(points), self._release(last, start.force))

    def _check(self, depths: Sequence[float]) -> None:
        for depth in depths:
            if not 0.0 < depth <= DEEPEST:
                raise InputError(
                    "depth-out-of-range",
                    f"a depth of {depth:g} R is not possible",
                    hint=f"the flat moves by more than 0 and at most {DEEPEST:g} R: "
                    "beyond that elements turn inside out",
                )
            if depth < self.first_depth:
                raise InputError(
                    "mesh-too-coarse",
                    f"at a depth of {depth:g} R the contact is narrower than "
                    f"{_EDGES_AT_START:g} edges of the mesh {self.mesh.name!r}",
                    hint=f"its smallest depth is {self.first_depth:.2g} R; use a finer "
                    "mesh or one with a shorter first edge",
                )
        if list(depths) != sorted(depths):
            raise InputError(
                "depths-not-rising",
                f"the depths {', '.join(f'{d:g}' for d in depths)} do not rise",
                hint="sort them: one loading serves all of them",
            )

    def _load_step(self, moment: Moment | None, depth: float) -> Moment:
        """One step towards a depth, shortened until it converges."""
        if moment is None:
            return self.touch(min(depth, self.first_depth))
        regular = self._regular_step(moment)
        reason = ""
        while self._fraction >= _FINEST:
            left = depth - moment.depth
            step = self._fraction * regular
            goal = depth if step > 0.75 * left else moment.depth + step
            goal = moment.depth + 0.5 * left if 0.75 * left < step < left else goal
            try:
                result = self._advance(moment, goal, least=0.0)
            except NotConverged as error:
                reason = str(error)
                self._fraction *= 0.5
                continue
            self._fraction = min(1.0, 1.5 * self._fraction)
            return result
        self._fraction = 1.0
        raise _stuck(moment, "loading", reason)

    def _regular_step(self, moment: Moment) -> float:
        """Step that lets sqrt(2 depth) grow by half an edge at the rim [R]."""
        last = int(np.flatnonzero(moment.equilibrium.active)[-1])
        edges = self.mesh.edges
        edge = float(edges[min(last, len(edges) - 1)])
        root = np.sqrt(2.0 * moment.depth) + _EDGE_SHARE * edge
        return float(0.5 * root**2 - moment.depth)

    def _unload_step(
        self, moment: Moment, step: float, largest: float
    ) -> tuple[float, Moment]:
        reason, regular = "", step
        while step >= _FINEST * regular:
            try:
                return step, self._advance(moment, moment.depth - step, largest * 1e-3)
            except NotConverged as error:
                reason = str(error)
                step *= 0.5
        raise _stuck(moment, "unloading", reason)

    def _advance(self, moment: Moment, depth: float, least: float) -> Moment:
        """Equilibrium at the next depth, from a straight extrapolation."""
        now, before = moment.equilibrium, moment.before
        guess = now.u
        if (
            before is not None
            and (depth - now.depth) * (now.depth - before.depth) > 0.0
        ):
            ratio = (depth - now.depth) / (now.depth - before.depth)
            guess = now.u + ratio * (now.u - before.equilibrium.u)
        found = self.contact.equilibrium(
            depth,
            guess=guess,
            active=now.active,
            state=now.answer.state,
            least_force=least,
        )
        return self._moment(moment, found)

    def _release(self, moment: Moment, largest: float) -> Moment:
        """Let the sphere go: no contact; the depth becomes that of its lowest point."""
        now = moment.equilibrium
        try:
            found = self.contact.equilibrium(
                -np.inf,
                guess=now.u,
                active=np.zeros_like(now.active),
                state=now.answer.state,
                least_force=1e-3 * largest,
            )
        except NotConverged as error:
            raise _stuck(moment, "the release", str(error)) from error
        surface = self.mesh.surface
        lowest = float((self.mesh.points[surface, 1] + found.u[surface, 1]).min())
        return self._moment(moment, replace(found, depth=lowest))

    def _moment(self, before: Moment, found: Equilibrium) -> Moment:
        force = 0.5 * (before.force + found.force)
        elastic, plastic = self._works(before, found)
        return Moment(
            found,
            replace(before, before=None),
            before.work + force * (found.depth - before.depth),
            before.elastic + elastic,
            before.plastic + plastic,
            contact_radius(self.mesh, found.u, found.active, found.depth),
        )

    def _works(self, before: Moment | None, found: Equilibrium) -> tuple[float, float]:
        """Work of a step on elastic and plastic strains [E R^3]."""
        state, stress = found.answer.state, found.answer.stress
        if before is None:
            old_state, old_stress = self.assembly.fresh_state(), np.zeros_like(stress)
            old_stress[:, :, 6] = 1.0
        else:
            old = before.equilibrium.answer
            old_state, old_stress = old.state, old.stress
        volume = 0.5 * (stress[:, :, 6] + old_stress[:, :, 6]) * self.assembly.weights
        flow = 0.5 * self.material.flow_stress(state[:, :, 4])
        flow = flow + 0.5 * self.material.flow_stress(old_state[:, :, 4])
        plastic = volume * flow * (state[:, :, 4] - old_state[:, :, 4])
        elastic = volume * (stress[:, :, 5] - old_stress[:, :, 5])
        return float(elastic.sum()), float(plastic.sum())


def _stuck(moment: Moment | None, where: str, reason: str) -> SimulationError:
    reached = 0.0 if moment is None else moment.depth
    return SimulationError(
        "lab-not-converged",
        f"{where} stopped at a depth of {reached:.4g} R: {reason}",
        where=f"depth {reached:.6g} R",
        hint="what was reached is kept; a finer mesh, hardening or a lower modulus "
        "ratio makes the problem easier",
    )
