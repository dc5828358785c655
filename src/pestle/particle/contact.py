"""One flat on one particle: force, contact radius and memory at an apparent overlap."""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from pestle.errors import InputError, SimulationError
from pestle.reference import elasticity, hertz, mdr, peeling
from pestle.reference.ellipse import of_sphere
from pestle.reference.mdr import Constants, PlasticContact
from pestle.reference.peeling import Peel


@dataclass(frozen=True, kw_only=True)
class ParticleMaterial:
    """Material of a particle against rigid flats.

    Parameters
    ----------
    youngs_modulus, poisson_ratio : float
        E [Pa], nu [-].
    yield_stress : float
        Y [Pa].
    work_of_adhesion : float
        W of particle and flat, the paper's Delta gamma [J/m^2].
    hardening_rise, hardening_decay : float
        The two constants of the hardening curve (16); the paper's by default [-].

    Examples
    --------
    >>> material = ParticleMaterial(
    ...     youngs_modulus=1.5, poisson_ratio=0.25, yield_stress=0.1
    ... )
    >>> material.constants.bulk
    1.0
    """

    youngs_modulus: float
    poisson_ratio: float
    yield_stress: float
    work_of_adhesion: float = 0.0
    hardening_rise: float = mdr.RISE
    hardening_decay: float = mdr.DECAY

    def __post_init__(self) -> None:
        sane = {
            "youngs_modulus": 0.0 < self.youngs_modulus < float("inf"),
            "poisson_ratio": -1.0 < self.poisson_ratio < 0.5,
            "yield_stress": self.yield_stress > 0.0,
            "work_of_adhesion": 0.0 <= self.work_of_adhesion < float("inf"),
            "hardening_rise": 0.0 <= self.hardening_rise < float("inf"),
            "hardening_decay": 0.0 <= self.hardening_decay < float("inf"),
        }
        for name, holds in sane.items():
            if not holds:
                raise InputError(
                    "material-out-of-range",
                    f"{name} = {getattr(self, name)!r} is not possible for a particle",
                    hint="moduli and stresses are positive, -1 < poisson_ratio < 0.5, "
                    "the others >= 0",
                )

    @cached_property
    def constants(self) -> Constants:
        """Constants of the closed forms."""
        e, nu = self.youngs_modulus, self.poisson_ratio
        return Constants(
            elasticity.plane_strain_modulus(e, nu),
            elasticity.shear_modulus(e, nu),
            elasticity.bulk_modulus(e, nu),
            nu,
            self.yield_stress,
            self.hardening_rise,
            self.hardening_decay,
        )


class Memory(NamedTuple):
    """What a contact remembers."""

    largest: float = 0.0  # running maximum of the apparent overlap [m]
    radius: float = 0.0  # adhered contact radius [m]
    yielded: bool = False
    yield_overlap: float = 0.0  # delta_Y [m]
    area_offset: float = 0.0  # c_A [m^2]


class Contact(NamedTuple):
    """A contact at an overlap."""

    overlap: float  # apparent overlap [m]
    penetration: float  # elastic displacement of the indenter [m]
    force: float  # compression positive [N]
    radius: float  # contact radius [m]
    state: Peel
    memory: Memory


def plastic_part(
    material: ParticleMaterial, radius: float, memory: Memory
) -> PlasticContact:
    """Shape of a yielded contact at the largest overlap it remembers."""
    return mdr.plastic_contact(
        memory.largest,
        radius,
        area_offset=memory.area_offset,
        constants=material.constants,
    )


def evaluate(
    material: ParticleMaterial, radius: float, overlap: float, memory: Memory
) -> Contact:
    """Force and new memory of a contact; yield is left to `has_reached_yield`.

    Parameters
    ----------
    material : ParticleMaterial
        Material of the particle.
    radius : float
        Apparent radius R [m].
    overlap : float
        Apparent overlap [m].
    memory : Memory
        What the contact remembers.

    Returns
    -------
    Contact
        The contact with its updated memory.
    """
    found = respond(
        material.constants, material.work_of_adhesion, radius, overlap, memory
    )
    if beyond_equator(radius, found):
        raise equator_passed(radius, overlap)
    return found


def respond(
    k: Constants,
    work_of_adhesion: float,
    radius: float,
    overlap: float,
    memory: Memory,
) -> Contact:
    """Answer of a contact, as a compiler can take it; see `evaluate`."""
    largest = max(memory.largest, overlap)
    shape, depth = of_sphere(radius), overlap
    if memory.yielded:
        plastic = mdr.plastic_contact(
            largest, radius, area_offset=memory.area_offset, constants=k
        )
        shape, depth = plastic.shape, mdr.penetration(overlap, largest, plastic)
    adhered = peeling.adhere(
        shape,
        depth,
        memory.radius,
        modulus=k.modulus,
        work_of_adhesion=work_of_adhesion,
    )
    new = Memory(
        largest,
        adhered.radius,
        memory.yielded,
        memory.yield_overlap,
        memory.area_offset,
    )
    return Contact(overlap, depth, adhered.force, adhered.radius, adhered.state, new)


def beyond_equator(radius: float, contact: Contact) -> bool:
    """Tell whether an intact contact is pressed past the equator of its ellipse.

    A yielded one cannot be: it is at the equator at its running maximum.
    """
    deepest = 2.0 * radius * (1.0 + 1e-9)
    return not contact.memory.yielded and contact.penetration > deepest


def equator_passed(radius: float, overlap: float) -> SimulationError:
    """Error of a contact that is pressed past the equator of its ellipse."""
    return SimulationError(
        "beyond-equator",
        f"an overlap of {overlap:.6g} m presses an elastic particle of radius "
        f"{radius:.6g} m past the equator of its indenter",
        hint="stay below twice the radius",
    )


def has_reached_yield(
    k: Constants, radius: float, overlap: float, memory: Memory
) -> bool:
    """Tell whether an intact contact exceeds its yield pressure, Eqs. (40), (16)."""
    if memory.yielded or overlap <= 0.0:
        return False
    elastic = hertz.mean_pressure(overlap, radius, modulus=k.modulus)
    return elastic > mdr.hardening_pressure(
        memory.largest,
        radius,
        yield_stress=k.yield_stress,
        rise=k.rise,
        decay=k.decay,
    )


def yielded(k: Constants, radius: float, memory: Memory) -> Memory:
    """Memory of a contact after first yield at the present radius, Eqs. (41), (43)."""
    overlap = mdr.yield_overlap(
        radius,
        modulus=k.modulus,
        yield_stress=k.yield_stress,
        rise=k.rise,
        decay=k.decay,
    )
    offset = mdr.area_offset(overlap, radius)
    return Memory(memory.largest, memory.radius, True, overlap, offset)
