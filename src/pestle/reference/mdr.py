r"""MDR contact of one elastic-plastic particle with one rigid flat, closed forms.

`overlap` is the apparent overlap delta = delta_o + R - R_o, `largest` its running
maximum delta_max, `radius` the apparent radius R, `modulus` the composite plane-strain
modulus E* [Pa].

Equation numbers: Zunker and Kamrin, J. Mech. Phys. Solids 183 (2024) 105492.
"""

from math import exp, pi, sqrt
from typing import NamedTuple

from pestle.reference import ellipse, hertz
from pestle.reference.ellipse import Ellipse

RISE, DECAY = 1.75, 4.4
"""Constants of the hardening curve, Eq. (16) [-]."""


def hardening_pressure(
    largest: float,
    radius: float,
    *,
    yield_stress: float,
    rise: float = RISE,
    decay: float = DECAY,
) -> float:
    r"""Mean pressure of a yielding contact, Eq. (16) with :math:`\delta_{max}/R`.

    .. math:: p_Y = Y(1.75\,e^{-4.4\delta_{max}/R} + 1)

    Parameters
    ----------
    largest, radius : float
        Largest apparent overlap [m] and apparent radius [m].
    yield_stress : float
        Y [Pa].
    rise, decay : float
        The constants 1.75 and 4.4, or those of one's own material [-].

    Returns
    -------
    float
        p_Y [Pa].

    Examples
    --------
    >>> hardening_pressure(0.0, 1.0, yield_stress=2.0)
    5.5
    """
    return yield_stress * (rise * exp(-decay * largest / radius) + 1.0)


def yield_overlap(
    radius: float,
    *,
    modulus: float,
    yield_stress: float,
    rise: float = RISE,
    decay: float = DECAY,
) -> float:
    r"""Overlap at first yield: root of Eq. (41), Hertz pressure = hardening pressure.

    Parameters
    ----------
    radius : float
        Apparent radius R [m].
    modulus, yield_stress : float
        E* [Pa] and Y [Pa].
    rise, decay : float
        Constants of the hardening curve (16) [-].

    Returns
    -------
    float
        delta_Y [m].

    Examples
    --------
    >>> round(yield_overlap(1.0, modulus=1 / 0.91, yield_stress=0.005), 12)
    0.000864984301
    """
    slope = 4.0 * modulus / (3.0 * pi * yield_stress)
    s = 1.0 / slope  # s = sqrt(delta_Y/R); the hardening curve lies above Y
    for _ in range(100):
        excess = rise * exp(-decay * s * s)
        step = (slope * s - 1.0 - excess) / (slope + 2.0 * decay * s * excess)
        new = min(max(s - step, 1.0 / slope), (1.0 + rise) / slope)
        if abs(new - s) <= 1e-16 * s:
            break
        s = new
    return radius * s * s


def area_offset(yield_overlap: float, radius: float) -> float:
    r"""Offset of the contact area that makes it continuous at yield, Eq. (43).

    .. math:: c_A = \pi(\delta_Y^2 - \delta_Y R)

    Parameters
    ----------
    yield_overlap, radius : float
        delta_Y [m] and R at yield [m].

    Returns
    -------
    float
        c_A [m^2].

    Examples
    --------
    >>> round(area_offset(0.01, 1.0), 9)
    -0.031101767
    """
    return pi * yield_overlap * (yield_overlap - radius)


def largest_radius(largest: float, radius: float, *, area_offset: float) -> float:
    r"""Contact radius of a yielding contact, Eq. (36).

    .. math:: a_{max} = \sqrt{2\delta_{max}R - \delta_{max}^2 + c_A/\pi}

    Parameters
    ----------
    largest, radius : float
        Largest apparent overlap [m] and apparent radius [m].
    area_offset : float
        c_A [m^2].

    Returns
    -------
    float
        a_max [m].

    Examples
    --------
    >>> round(largest_radius(0.1, 1.0, area_offset=0.0) ** 2, 12)
    0.19
    """
    return sqrt(largest * (2.0 * radius - largest) + area_offset / pi)


class PlasticContact(NamedTuple):
    """Shape and elastic range of a yielded contact at its largest overlap."""

    pressure: float  # p_Y [Pa]
    radius: float  # a_max [m]
    shape: Ellipse  # A, B [m]
    largest_force: float  # F_max [N]
    depth: float  # z_R, depth of the particle's centre in the half-space [m]
    correction: float  # delta_R, displacement of that centre, negative [m]
    plastic_overlap: float  # overlap at which the unloaded contact opens [m]


def centre_displacement(
    depth: float, radius: float, *, pressure: float, shear: float, poisson_ratio: float
) -> float:
    r"""Displacement of the particle's centre in the half-space, Eq. (34).

    .. math:: \delta_R = p\,\frac{2a^2(\nu-1) - z(2\nu-1)(\sqrt{a^2+z^2} - z)}
                                {2G\sqrt{a^2+z^2}}

    Minus the Boussinesq displacement on the axis under a uniform pressure on a disc.

    Parameters
    ----------
    depth, radius : float
        z_R [m] and a_max [m].
    pressure : float
        F_max/(pi a_max^2) [Pa].
    shear, poisson_ratio : float
        Constants of the particle itself: G [Pa], nu [-].

    Returns
    -------
    float
        delta_R [m], negative.

    Examples
    --------
    >>> centre_displacement(0.0, 1.0, pressure=1.0, shear=1.0, poisson_ratio=0.25)
    -0.75
    """
    a, z, nu = radius, depth, poisson_ratio
    reach = sqrt(a * a + z * z)
    beyond = a * a / (reach + z) if z > 0.0 else reach - z
    top = 2.0 * a * a * (nu - 1.0) - z * (2.0 * nu - 1.0) * beyond
    return pressure * top / (2.0 * shear * reach)


class Constants(NamedTuple):
    """Constants of a particle against a rigid flat."""

    modulus: float  # E* = E/(1 - nu^2) [Pa]
    shear: float  # G [Pa]
    bulk: float  # kappa [Pa]
    poisson_ratio: float  # nu [-]
    yield_stress: float  # Y [Pa]
    rise: float = RISE  # of the hardening curve, Eq. (16) [-]
    decay: float = DECAY  # the same


def plastic_contact(
    largest: float, radius: float, *, area_offset: float, constants: Constants
) -> PlasticContact:
    r"""Shape, force and corrections of a yielded contact, Eqs. (28), (32)-(36).

    Parameters
    ----------
    largest, radius : float
        Largest apparent overlap [m] and apparent radius [m].
    area_offset : float
        c_A [m^2].
    constants : Constants
        Material of the particle.

    Returns
    -------
    PlasticContact
        Everything that unloading needs.

    Examples
    --------
    >>> k = Constants(1 / 0.91, 1 / 2.6, 1 / 1.2, 0.3, 0.005)
    >>> round(plastic_contact(0.1, 1.0, area_offset=-0.0027, constants=k).radius, 5)
    0.4349
    """
    k = constants
    pressure = hardening_pressure(
        largest, radius, yield_stress=k.yield_stress, rise=k.rise, decay=k.decay
    )
    a = largest_radius(largest, radius, area_offset=area_offset)
    shape = Ellipse(4.0 * pressure / k.modulus * a, 2.0 * a)
    force = ellipse.largest_force(shape, modulus=k.modulus)
    depth = radius - largest + 0.5 * shape.height
    correction = centre_displacement(
        depth,
        a,
        pressure=force / (pi * a * a),
        shear=k.shear,
        poisson_ratio=k.poisson_ratio,
    )
    opening = largest - 0.5 * shape.height - correction
    return PlasticContact(pressure, a, shape, force, depth, correction, opening)


def penetration(overlap: float, largest: float, contact: PlasticContact) -> float:
    r"""Elastic displacement of the indenter, Eq. (35), without cancellation.

    .. math:: \delta^e_{1D} = \frac A2 + \frac{\delta-\delta_{max}}{1+2\delta_R/A}

    Parameters
    ----------
    overlap, largest : float
        Apparent overlap and its largest value [m].
    contact : PlasticContact
        Shape at the largest overlap.

    Returns
    -------
    float
        Penetration [m], negative where the contact is open.

    Examples
    --------
    >>> k = Constants(1 / 0.91, 1 / 2.6, 1 / 1.2, 0.3, 0.005)
    >>> c = plastic_contact(0.1, 1.0, area_offset=-0.0027, constants=k)
    >>> abs(penetration(c.plastic_overlap, 0.1, c)) < 1e-12
    True
    """
    height = contact.shape.height
    return 0.5 * height + (overlap - largest) / (
        1.0 + 2.0 * contact.correction / height
    )


def overlap(penetration: float, largest: float, contact: PlasticContact) -> float:
    """Apparent overlap at a penetration, the inverse of `penetration`.

    Parameters
    ----------
    penetration, largest : float
        Elastic displacement of the indenter and largest apparent overlap [m].
    contact : PlasticContact
        Shape at the largest overlap.

    Returns
    -------
    float
        Apparent overlap [m].

    Examples
    --------
    >>> k = Constants(1 / 0.91, 1 / 2.6, 1 / 1.2, 0.3, 0.005)
    >>> c = plastic_contact(0.1, 1.0, area_offset=-0.0027, constants=k)
    >>> round(overlap(penetration(0.099, 0.1, c), 0.1, c), 12)
    0.099
    """
    height = contact.shape.height
    factor = 1.0 + 2.0 * contact.correction / height
    return largest + factor * (penetration - 0.5 * height)


class YieldPoint(NamedTuple):
    """First yield of a contact, seen from both sides."""

    overlap: float  # delta_Y [m]
    area_offset: float  # c_A [m^2]
    radius: float  # Hertz contact radius [m]
    pressure: float  # p_Y [Pa]
    force_plastic: float  # force after yield [N]
    force_elastic: float  # force of the elastic ellipse before yield [N]
    radius_elastic: float  # its contact radius [m]


def yield_point(radius: float, *, modulus: float, yield_stress: float) -> YieldPoint:
    """First yield; force and radius jump up there because the sphere is an ellipse.

    Parameters
    ----------
    radius : float
        Apparent radius R [m].
    modulus, yield_stress : float
        E* [Pa] and Y [Pa].

    Returns
    -------
    YieldPoint
        Overlap, areas and forces at yield.

    Examples
    --------
    >>> y = yield_point(1.0, modulus=1 / 0.91, yield_stress=0.08)
    >>> y.force_plastic > y.force_elastic
    True
    """
    overlap = yield_overlap(radius, modulus=modulus, yield_stress=yield_stress)
    a = hertz.contact_radius(overlap, radius)
    pressure = hardening_pressure(overlap, radius, yield_stress=yield_stress)
    sphere = ellipse.of_sphere(radius)
    return YieldPoint(
        overlap,
        area_offset(overlap, radius),
        a,
        pressure,
        pressure * pi * a * a,
        ellipse.force(sphere, overlap, modulus=modulus),
        ellipse.contact_radius(sphere, overlap),
    )
