"""Die and hydrostatic compaction of one sphere: equilibria and paths of an octant.

Six flats around the sphere, by symmetry three on an eighth of it.  In a die the one on
z moves, those on x and y stand; hydrostatically all move alike.  Contact as in
`equilibrium`: an exact active set, a node may touch several flats.
"""

from collections.abc import Callable
from math import pi
from typing import NamedTuple

import numpy as np

from pestle.errors import InputError, SimulationError, did_you_mean
from pestle.lab.assembly import Answer, Booleans, Inverted
from pestle.lab.equilibrium import GAP, TOLERANCE, NotConverged
from pestle.lab.material import Material
from pestle.lab.measure import contact_area
from pestle.lab.mesh import Floats
from pestle.lab.octant import SolidAssembly, octant

DEEPEST = {
    "simple": 0.6,
    "die": 1.0 - pi / 6.0,
    "hydrostatic": 1.0 - (pi / 6.0) ** (1.0 / 3.0),
}
"""Displacement at which a sphere of constant volume fills its cell; simple: 0.6 [R]."""
_MOVING: dict[str, tuple[int, ...]] = {
    "simple": (2,),
    "die": (2,),
    "hydrostatic": (0, 1, 2),
}
_STANDING: dict[str, tuple[int, ...]] = {
    "simple": (),
    "die": (0, 1),
    "hydrostatic": (),
}
_ITERATIONS, _PATIENCE = 25, 80
_SHORT = 0.003  # largest displacement in a patient iteration [R]
_STEP = 0.04  # growth of sqrt(2 depth) in a step
_FINEST = 2.0**-9


class Flat(NamedTuple):
    """One flat of the whole sphere."""

    force: float  # [E R^2]
    area: float  # estimate, see `contact_area` [R^2]
    inner_area: float  # faces with all corners touching [R^2]
    outer_area: float  # faces with any corner touching [R^2]


class ConfinedPoint(NamedTuple):
    """An equilibrium of a sphere between six flats."""

    depth: float  # displacement of the moving flats [R]
    primary: Flat
    secondary: Flat
    iterations: int


class _State(NamedTuple):
    depth: float
    u: Floats
    active: Booleans  # (3, surface nodes)
    state: Floats


class Confined:
    """A sphere in a die, under hydrostatic or simple compression.

    Parameters
    ----------
    material : Material
        Its material.
    configuration : {"die", "hydrostatic", "simple"}
        Which flats there are and which move.
    edges, layers : int
        See `octant`.
    first : float, optional
        First edge at the poles [R], by default 0.48 over the number of edges, at most
        0.08.
    """

    def __init__(
        self,
        material: Material,
        configuration: str,
        *,
        edges: int = 6,
        layers: int = 6,
        first: float | None = None,
    ) -> None:
        if configuration not in _MOVING:
            raise InputError(
                "unknown-configuration",
                f"there is no configuration {configuration!r}",
                hint=did_you_mean(configuration, _MOVING),
            )
        self.material, self.configuration = material, configuration
        first = min(0.08, 0.48 / edges) if first is None else first
        self.mesh = octant(edges, layers, first)
        self.assembly = SolidAssembly(self.mesh, material)
        self._fraction = 1.0
        self.first_depth = 0.5 * (2.5 * first) ** 2
        points = self.mesh.points
        self.held = np.zeros(self.assembly.size, dtype=bool)
        for axis in range(3):
            self.held[3 * np.flatnonzero(points[:, axis] < 1e-9) + axis] = True
        self.unknowns = 3 * self.mesh.surface + np.arange(3)[:, None]
        present = np.zeros((3, 1), dtype=bool)
        present[[*_MOVING[configuration], *_STANDING[configuration]]] = True
        self.open = ~self.held[self.unknowns] & present
        self.moving = _MOVING[configuration]

    def load(
        self, depth: float, progress: Callable[[ConfinedPoint], None] | None = None
    ) -> list[ConfinedPoint]:
        """Press to a depth and return all steps.

        Parameters
        ----------
        depth : float
            Displacement of the moving flats at the end [R].
        progress : callable, optional
            Called after every step.

        Raises
        ------
        InputError
            If the sphere fills its cell before, or the mesh is too coarse.
        ConfinedStop
            If it cannot go on; it holds what was reached.
        """
        limit = DEEPEST[self.configuration]
        if not self.first_depth <= depth < limit:
            raise InputError(
                "depth-out-of-range",
                f"a depth of {depth:g} R is not possible in {self.configuration} "
                "compression",
                hint=f"between {self.first_depth:.3g} R (2.5 edges in contact) and "
                f"{limit:.4g} R (the sphere fills its cell, or elements turn over)",
            )
        fresh = self.assembly.fresh_state()
        nothing = np.zeros_like(self.open)
        zero = np.zeros_like(self.mesh.points)
        now, before = _State(0.0, zero, nothing, fresh), None
        points: list[ConfinedPoint] = []
        while now.depth < depth * (1.0 - 1e-12):
            now, before, point = self._step(now, before, depth, points)
            points.append(point)
            if progress:
                progress(point)
        return points

    def _step(
        self,
        now: _State,
        before: _State | None,
        end: float,
        points: list[ConfinedPoint],
    ) -> tuple[_State, _State | None, ConfinedPoint]:
        """One step, shortened until it converges."""
        if now.depth == 0.0:
            new, point = self._touch(now, points)
            return new, None, point
        regular = 0.5 * (np.sqrt(2.0 * now.depth) + _STEP) ** 2 - now.depth
        reason = ""
        while self._fraction >= _FINEST:
            goal = min(end, now.depth + self._fraction * regular)
            try:
                new, point = self._equilibrium(now, before, goal)
            except NotConverged as error:
                reason = str(error)
                self._fraction *= 0.5
                continue
            self._fraction = min(1.0, 1.5 * self._fraction)
            return new, now, point
        raise ConfinedStop(self.configuration, now.depth, reason, points)

    def _touch(
        self, now: _State, points: list[ConfinedPoint]
    ) -> tuple[_State, ConfinedPoint]:
        """First touch; of a hard sphere through softer ones at the same depth."""
        own = self.assembly
        try:
            return self._equilibrium(now, None, self.first_depth)
        except NotConverged:
            pass
        new, guess = None, now
        try:
            for material in self.material.stiffening():
                self.assembly = SolidAssembly(self.mesh, material)
                new = self._equilibrium(guess, None, self.first_depth, patient=True)
                guess = now._replace(u=new[0].u, active=new[0].active)
        except NotConverged as error:
            raise ConfinedStop(self.configuration, 0.0, str(error), points) from error
        finally:
            self.assembly = own
        assert new is not None
        return new

    def _equilibrium(
        self,
        now: _State,
        before: _State | None,
        depth: float,
        *,
        patient: bool = False,
    ) -> tuple[_State, ConfinedPoint]:
        """Newton's method; if patient in short steps, which may go uphill."""
        flats = np.zeros((3, 1))
        flats[list(self.moving)] = depth
        heights = self.mesh.points[self.mesh.surface].T
        u, active = now.u, now.active
        if before is not None:
            ratio = (depth - now.depth) / (now.depth - before.depth)
            u = now.u + ratio * (now.u - before.u)
        if now.depth == 0.0:
            active = self.open & (1.0 - heights < 0.6 * flats)
        change = np.zeros(self.assembly.size)
        sizes: list[float] = []
        for count in range(_PATIENCE if patient else _ITERATIONS):
            u, answer = self._damped(u, change, now.state)
            pushes = -answer.force[self.unknowns]
            gap = 1.0 - flats - heights - u[self.mesh.surface].T
            chosen = self.open & np.where(active, pushes > 0.0, gap < 0.0)
            if count == 0:
                chosen |= self.open & active
            same, active = bool((chosen == active).all()), chosen
            fixed = self.held.copy()
            fixed[self.unknowns[active]] = True
            free = np.where(fixed, 0.0, -answer.force)
            force = float(pushes[active].sum())
            size = float(np.linalg.norm(free))
            sizes.append(size / force if force > 0.0 else np.inf)
            worst = float(np.abs(gap[active]).max(initial=0.0))
            if same and sizes[-1] < TOLERANCE and worst < GAP:
                new = _State(depth, u, active, answer.state)
                return new, self._point(new, pushes, count)
            worst_allowed = 1e6 if patient else max(5.0 * max(sizes[:2]), 0.05)
            if count > 2 and not sizes[-1] <= worst_allowed:
                break
            change = np.zeros(self.assembly.size)
            change[self.unknowns[active]] = gap[active]
            assert answer.matrix is not None
            change = self.assembly.solve(answer.matrix, free, fixed, change)
            if patient:
                change *= min(1.0, _SHORT / float(np.abs(change).max()))
        raise NotConverged(f"the residual is {sizes[-1]:.1e} of the force")

    def _damped(
        self, u: Floats, change: Floats, state: Floats
    ) -> tuple[Floats, Answer]:
        """Add a change, halved until no element is inside out."""
        step = change.reshape(-1, 3)
        for _ in range(6):
            try:
                return u + step, self.assembly.evaluate(u + step, state)
            except Inverted:
                step = 0.5 * step
        raise NotConverged("an element is turned inside out")

    def _point(self, new: _State, pushes: Floats, count: int) -> ConfinedPoint:
        flats = [self._flat(new, pushes, axis) for axis in range(3)]
        return ConfinedPoint(new.depth, flats[2], flats[0], count)

    def _flat(self, new: _State, pushes: Floats, axis: int) -> Flat:
        """Force and area of a flat; an octant has a quarter of it."""
        surface, active = self.mesh.surface, new.active[axis]
        touching = np.zeros(len(self.mesh.points), dtype=bool)
        touching[surface[active]] = True
        force = np.zeros(len(self.mesh.points))
        force[surface[active]] = pushes[axis, active]
        areas = contact_area(self.mesh, new.u, force, touching, axis)
        return Flat(4.0 * float(force.sum()), *(4.0 * area for area in areas))


class ConfinedStop(SimulationError):
    """A compaction that cannot go on; `points` is what was reached."""

    def __init__(
        self, configuration: str, depth: float, reason: str, points: list[ConfinedPoint]
    ) -> None:
        super().__init__(
            "lab-not-converged",
            f"{configuration} compression stopped at a depth of {depth:.4g} R: "
            f"{reason}",
            where=f"depth {depth:.6g} R",
            hint="what was reached is kept; near the fill of the cell forces rise "
            "steeply: stop before",
        )
        self.points = points
