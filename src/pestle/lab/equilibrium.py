"""Equilibrium of a sphere under a flat: Newton's method and an exact active set.

The flat lies at z = depth and pushes nodes of the surface upwards. Its conditions,

    gap = z + u_z - depth >= 0,   force >= 0,   force gap = 0,

are met by choosing at every iteration which nodes touch: those that touched and are
pushed, and those that did not and are now below the flat. There is no penalty.
Reference: M. Hintermueller, K. Ito and K. Kunisch, SIAM J. Optim. 13 (2002) 865-888.
"""

from dataclasses import dataclass

import numpy as np

from pestle.lab.assembly import Answer, Assembly, Booleans, Inverted
from pestle.lab.mesh import Floats

TOLERANCE = 1e-6
"""Largest free residual over the force of the flat [-]."""
GAP = 1e-10
"""Largest distance of a touching node from the flat [R]."""
_ITERATIONS = 25
_HALVINGS = 6
_GROWTH, _SMALL = 5.0, 0.01  # a residual above both has never come down again


class NotConverged(Exception):
    """A step has no equilibrium within reach; the message says why."""


@dataclass(frozen=True, eq=False)
class Equilibrium:
    """A converged state.

    Parameters
    ----------
    depth : float
        Displacement of the flat [R].
    u : array (nodes, 2)
        Displacements [R].
    active : array of bool
        Which nodes of the surface touch.
    pushes : array
        Force of the flat on each node of the surface [E R^2].
    answer : Answer
        Forces, state, stress of the elements; without stiffness.
    residuals : tuple of float
        Free residual over the force at each iteration [-].
    """

    depth: float
    u: Floats
    active: Booleans
    pushes: Floats
    answer: Answer
    residuals: tuple[float, ...]

    @property
    def force(self) -> float:
        """Force of the flat [E R^2]."""
        return float(self.pushes[self.active].sum())


def _is_lost(residuals: list[float]) -> bool:
    """Tell a residual that would not come down again."""
    now = residuals[-1]
    if len(residuals) < 3:
        return bool(np.isnan(now))
    return not now <= max(_GROWTH * max(residuals[:2]), _SMALL)


class Contact:
    """A sphere on a flat: finds equilibria.

    Parameters
    ----------
    assembly : Assembly
        The elements.
    """

    def __init__(self, assembly: Assembly) -> None:
        self.assembly = assembly
        mesh = assembly.mesh
        self.held = np.zeros(assembly.size, dtype=bool)
        self.held[2 * mesh.axis] = True
        self.held[2 * mesh.equator + 1] = True
        self.surface = 2 * mesh.surface + 1
        self.heights = mesh.points[mesh.surface, 1]
        self.open = ~self.held[self.surface]

    def equilibrium(
        self,
        depth: float,
        *,
        guess: Floats,
        active: Booleans,
        state: Floats,
        least_force: float,
    ) -> Equilibrium:
        """Find the equilibrium at a depth of the flat.

        Parameters
        ----------
        depth : float
            Displacement of the flat [R].
        guess : array (nodes, 2)
            Displacements to start from [R].
        active : array of bool
            Nodes that touch at the start.
        state : array
            State of the material at the last equilibrium.
        least_force : float
            Residuals are compared with the force, but with no less than this [E R^2].

        Raises
        ------
        NotConverged
            If there is none, or none was found.
        """
        u, residuals = guess, list[float]()
        change = np.zeros(self.assembly.size)
        for _ in range(_ITERATIONS):
            u, answer = self._damped(u, change, state)
            pushes = answer.force[self.surface]
            gap = self.heights + u[self.assembly.mesh.surface, 1] - depth
            chosen = self.open & np.where(active, pushes > 0.0, gap < 0.0)
            if not residuals:  # the forces are those of the last depth
                chosen = chosen | (self.open & active)
            same = bool((chosen == active).all())
            active = chosen
            fixed = self.held.copy()
            fixed[self.surface[active]] = True
            free = np.where(fixed, 0.0, -answer.force)
            force = max(float(pushes[active].sum()), least_force)
            size = float(np.linalg.norm(free))
            residuals.append(size / force if force > 0.0 else np.inf)
            worst = float(np.abs(gap[active]).max(initial=0.0))
            if same and residuals[-1] < TOLERANCE and worst < GAP:
                bare = answer._replace(matrix=None)
                return Equilibrium(depth, u, active, pushes, bare, tuple(residuals))
            if _is_lost(residuals):
                break
            change = np.zeros(self.assembly.size)
            change[self.surface[active]] = -gap[active]
            assert answer.matrix is not None
            change = self.assembly.solve(answer.matrix, free, fixed, change)
        raise NotConverged(
            f"the residual is {residuals[-1]:.1e} of the force after "
            f"{len(residuals)} iterations"
        )

    def _damped(
        self, u: Floats, change: Floats, state: Floats
    ) -> tuple[Floats, Answer]:
        """Add a change, halved until no element is inside out."""
        step = change.reshape(-1, 2)
        for _ in range(_HALVINGS):
            try:
                return u + step, self.assembly.evaluate(u + step, state)
            except Inverted:
                step = 0.5 * step
        raise NotConverged("an element is turned inside out")
