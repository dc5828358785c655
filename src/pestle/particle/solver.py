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
from typing import get_args

from pestle.errors import EnergyWarning, InputError, did_you_mean
from pestle.particle.contact import Memory, ParticleMaterial, evaluate
from pestle.particle.leg import Leg, Point, Resolution
from pestle.particle.state import ParticleState, RadiusRule, snapshot

EXACT = Resolution()


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
        rest = (0.0,) * len(counts)
        contact = evaluate(material, radius, 0.0, Memory())
        self._point = Point(rest, 0.0, (contact,) * len(counts))

    @property
    def state(self) -> ParticleState:
        """The particle as it is now."""
        return snapshot(
            self.material,
            self.initial_radius,
            self._point.growth,
            contacts=self._point.contacts,
            counts=self.counts,
            displacements=self._point.displacements,
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
        if len(displacements) != len(self.counts):
            raise InputError(
                "wrong-number-of-flats",
                f"{len(displacements)} displacements for {len(self.counts)} groups",
                hint="give one displacement for each group of flats",
            )
        target = tuple(float(d) for d in displacements)
        for d in target:
            if not -inf < d < self.initial_radius:
                raise InputError(
                    "flat-beyond-centre",
                    f"a displacement of {d:.6g} m is not possible for a particle of "
                    f"radius {self.initial_radius:.6g} m",
                    hint="displacements are finite and below the initial radius",
                )
        leg = Leg(self, self._point.displacements, target)
        self._point = leg.run(self._point)
        return self.state


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
