"""Pull-off of the first group of flats from a loaded particle."""

from typing import NamedTuple

from pestle.errors import InputError
from pestle.particle.contact import Memory, plastic_part
from pestle.particle.solver import Particle
from pestle.reference import mdr, peeling
from pestle.reference.ellipse import Ellipse, of_sphere
from pestle.reference.mdr import PlasticContact


class PullOffPoint(NamedTuple):
    """Largest tension and separation while the flats are withdrawn."""

    force: float  # most tensile force met, negative [N]
    displacement: float  # delta_o there [m]
    radius: float  # contact radius there [m]
    force_separation: float  # force at the separation instability [N]
    displacement_separation: float  # delta_o there [m]
    radius_separation: float  # contact radius there [m]


def indenter(particle: Particle, group: int = 0) -> Ellipse:
    """Shape of a group's indenter in the MDR space.

    Parameters
    ----------
    particle : Particle
        The particle as it is now.
    group : int
        Which group of flats.

    Returns
    -------
    Ellipse
        Height A and width B [m].

    Examples
    --------
    >>> from pestle.particle import ParticleMaterial
    >>> material = ParticleMaterial(
    ...     youngs_modulus=1.0, poisson_ratio=0.3, yield_stress=0.1
    ... )
    >>> indenter(Particle(material, 1.0))
    Ellipse(height=4.0, width=2.0)
    """
    plastic = _plastic(particle, group)
    return of_sphere(particle.state.radius) if plastic is None else plastic.shape


def _plastic(particle: Particle, group: int) -> PlasticContact | None:
    state = particle.state
    flat = state.flats[group]
    memory = Memory(largest=flat.largest, area_offset=flat.area_offset)
    if not flat.yielded:
        return None
    return plastic_part(particle.material, state.radius, memory)


def pull_off(particle: Particle, group: int = 0) -> PullOffPoint:
    """Withdraw a group of flats until it separates; the particle itself stays.

    The radius does not change while flats are withdrawn, so that the closed forms of
    `pestle.reference.peeling` hold; under the rule "eq37" it may, and is refused.

    Parameters
    ----------
    particle : Particle
        A loaded particle; it is not moved.
    group : int
        Which group of flats is withdrawn.

    Returns
    -------
    PullOffPoint
        Forces, displacements and radii.

    Examples
    --------
    >>> from pestle.particle import ParticleMaterial
    >>> material = ParticleMaterial(
    ...     youngs_modulus=910.0,
    ...     poisson_ratio=0.3,
    ...     yield_stress=72.8,
    ...     work_of_adhesion=1.0,
    ... )
    >>> particle = Particle(material, 1.0, counts=(2,))
    >>> _ = particle.move([0.3])
    >>> round(pull_off(particle).force, 6)
    -26.998103
    """
    if particle.radius_rule == "eq37":
        raise InputError(
            "pull-off-needs-fixed-radius",
            "under radius rule 'eq37' the particle may grow while flats are withdrawn",
            hint="follow the path with small steps, or use radius rule 'plastic'",
        )
    state, plastic = particle.state, _plastic(particle, group)
    flat = state.flats[group]
    found = peeling.pull_off(
        indenter(particle, group),
        flat.contact_radius,
        modulus=particle.material.constants.modulus,
        work_of_adhesion=particle.material.work_of_adhesion,
    )

    def displacement(depth: float) -> float:
        if plastic is None:
            return depth - state.growth
        return mdr.overlap(depth, flat.largest, plastic) - state.growth

    return PullOffPoint(
        found.force,
        displacement(found.penetration),
        found.radius,
        found.force_separation,
        displacement(found.penetration_separation),
        found.radius_separation,
    )
