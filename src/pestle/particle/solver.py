r"""Exact path of a particle between flats, without a step error.

The radius rule (37) is the differential of :math:`\Phi = V_{geo} + V^e`, the geometric
volume plus the elastically lost one.  While the rule acts, R grows just enough to keep
:math:`\Phi` from falling.  A step is therefore a return mapping: freeze R; if
:math:`\Phi` fell, raise R until it is restored.  Between events (yield, loading along
the running maximum, touch, separation, start and stop of growth) that is exact for
steps of any size; events are bisected to round-off.

Radius rules: "plastic" acts only while a yielded contact moves inwards at its running
maximum, "loading" while any contact does, "eq37" always (as printed; it can create
energy), "frozen" never.
"""

import warnings
from collections.abc import Iterable, Sequence
from math import inf
from typing import NamedTuple, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pestle.errors import EnergyWarning, InputError, SimulationError, did_you_mean
from pestle.particle import leg
from pestle.particle.contact import (
    Contact,
    Memory,
    ParticleMaterial,
    equator_passed,
    evaluate,
)
from pestle.particle.leg import Resolution, Setting
from pestle.particle.state import ParticleState, RadiusRule, snapshot
from pestle.reference import volume
from pestle.reference.peeling import Peel

EXACT = Resolution()

Array = NDArray[np.float64]


class Trace(NamedTuple):
    """Ends of the legs of a path."""

    force: Array  # of each flat of every group; (legs, groups) [N]
    contact_radius: Array  # (legs, groups) [m]
    radius: Array  # apparent radius R; (legs,) [m]


class Particle:
    """A sphere between rigid flats that move along its radii.

    Parameters
    ----------
    material : ParticleMaterial
        Material of the particle.
    radius : float
        Initial radius R_o [m].
    counts : sequence of int
        Numbers of flats that move alike: ``(2,)`` uniaxial, ``(2, 4)`` a die with
        cubic faces, ``(6,)`` hydrostatic, ``(1, 1, 1)`` three independent flats.
    radius_rule : {"plastic", "loading", "eq37", "frozen"}
        When the apparent radius may grow.
    resolution : Resolution
        How finely the path is resolved; the default leaves no step error.

    Examples
    --------
    >>> material = ParticleMaterial(
    ...     youngs_modulus=1.0, poisson_ratio=0.3, yield_stress=0.005
    ... )
    >>> particle = Particle(material, 1.0, counts=(2,))
    >>> round(particle.move([0.3]).flats[0].force, 9)
    0.01368035
    """

    def __init__(
        self,
        material: ParticleMaterial,
        radius: float,
        *,
        counts: Sequence[int] = (2,),
        radius_rule: RadiusRule = "plastic",
        resolution: Resolution = EXACT,
    ) -> None:
        if radius_rule not in get_args(RadiusRule):
            raise InputError(
                "unknown-radius-rule",
                f"there is no radius rule {radius_rule!r}",
                hint=did_you_mean(str(radius_rule), get_args(RadiusRule)),
            )
        if not radius > 0.0 or not counts or min(counts) < 1:
            raise InputError(
                "particle-out-of-range",
                f"a particle of radius {radius!r} m with {list(counts)!r} flats is "
                "not possible",
                hint="the radius is positive, every group has at least one flat",
            )
        if radius_rule == "eq37":
            warnings.warn(
                "radius rule eq37 grows the particle in elastic cycles too and can "
                "create energy; use it to reproduce the paper only",
                EnergyWarning,
                stacklevel=2,
            )
        self.material = material
        self.initial_radius = radius
        self.counts = tuple(counts)
        self.radius_rule = radius_rule
        self.resolution = resolution
        self._setting = Setting(
            material.constants,
            float(material.work_of_adhesion),
            float(radius),
            leg.RULES.index(radius_rule),
            Resolution(*map(float, resolution)),
        )
        self._counts = np.array(self.counts, dtype=float)
        self._point = np.zeros((len(self.counts), leg.COLUMNS))
        contact = evaluate(material, radius, 0.0, Memory())
        for group in range(len(self.counts)):
            leg.put(self._point, group, contact)

    @property
    def state(self) -> ParticleState:
        """The particle as it is now."""
        return snapshot(
            self.material,
            self.initial_radius,
            float(self._point[0, leg.GROWTH]),
            contacts=[_contact(row) for row in self._point.tolist()],
            counts=self.counts,
            displacements=self._point[:, leg.DISPLACEMENT].tolist(),
        )

    def copy(self) -> "Particle":
        """Return an independent particle in the same state."""
        twin = object.__new__(Particle)
        twin.__dict__.update(self.__dict__)
        return twin

    def move(self, displacements: Sequence[float]) -> ParticleState:
        """Move every group of flats along a straight leg to a displacement.

        Parameters
        ----------
        displacements : sequence of float
            delta_o of every group at the end, positive inwards [m].

        Returns
        -------
        ParticleState
            The particle at the end of the leg.

        Raises
        ------
        SimulationError
            Where the growth of the radius becomes singular (confined particle).
        """
        self.trace([displacements])
        return self.state

    def trace(self, path: ArrayLike) -> Trace:
        """Move along straight legs, as `move` does, and return numbers for each end.

        Parameters
        ----------
        path : array
            Displacements of every group at the ends of the legs; (legs, groups) [m].
        """
        from pestle.particle._compile import compiled

        targets = np.asarray(path, dtype=float)
        if targets.ndim != 2 or targets.shape[1] != len(self.counts):
            raise InputError(
                "wrong-number-of-flats",
                f"{np.shape(path)[-1]} displacements for {len(self.counts)} groups",
                hint="give one displacement for each group of flats",
            )
        impossible = targets[~((targets < self.initial_radius) & (targets > -inf))]
        if impossible.size:
            raise InputError(
                "flat-beyond-centre",
                f"a displacement of {impossible[0]:.6g} m is not possible for a "
                f"particle of radius {self.initial_radius:.6g} m",
                hint="displacements are finite and below the initial radius",
            )
        out = np.empty((len(targets), *self._point.shape))
        trouble = np.zeros(3)
        done = compiled(leg.follow_path)(
            self._setting, self._counts, self._point, targets, out, trouble
        )
        if done:
            self._point = out[done - 1].copy()
        if done < len(targets):
            raise self._error(out[done], trouble)
        return Trace(
            out[:, :, leg.FORCE],
            out[:, :, leg.RADIUS],
            self.initial_radius + out[:, 0, leg.GROWTH],
        )

    def _error(self, point: Array, trouble: Array) -> SimulationError:
        """Error of a path that cannot be followed further."""
        r_o = self.initial_radius
        if trouble[0] == leg.EQUATOR:
            return equator_passed(trouble[2], trouble[1])
        if trouble[0] == leg.CRUSHED:
            return volume.crushed(trouble[1], r_o)
        reached = ", ".join(f"{d / r_o:.6g}" for d in point[:, leg.DISPLACEMENT])
        return SimulationError(
            "radius-singular",
            "the apparent radius would grow without bound: the caps of the flats fill "
            "the particle",
            where=f"displacements of {reached} radii, "
            f"apparent radius {1.0 + point[0, leg.GROWTH] / r_o:.6g} radii",
            hint="stop before; beyond this confinement a particle responds by its bulk "
            "modulus, which this single-particle model leaves out",
        )


def _contact(row: list[float]) -> Contact:
    """Contact in a row of a point, in plain numbers."""
    memory = Memory(
        row[leg.LARGEST],
        row[leg.RADIUS],
        row[leg.YIELDED] > 0.0,
        row[leg.YIELD_OVERLAP],
        row[leg.AREA_OFFSET],
    )
    peel = Peel(int(row[leg.STATE]))
    overlap, depth, force, radius = row[: leg.STATE]
    return Contact(overlap, depth, force, radius, peel, memory)


def follow(particle: Particle, path: Iterable[Sequence[float]]) -> list[ParticleState]:
    """Move a particle along straight legs and return its state after each.

    Parameters
    ----------
    particle : Particle
        The particle; it is moved.
    path : iterable of sequences of float
        Displacements of every group at the end of each leg [m].

    Returns
    -------
    list of ParticleState
        One a leg.

    Examples
    --------
    >>> material = ParticleMaterial(
    ...     youngs_modulus=1.0, poisson_ratio=0.3, yield_stress=0.05
    ... )
    >>> die = Particle(material, 1.0, counts=(2, 4))
    >>> [round(s.radius, 6) for s in follow(die, [(0.1, 0.0), (0.2, 0.0)])]
    [1.00187, 1.01663]
    """
    return [particle.move(displacements) for displacements in path]
