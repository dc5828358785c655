r"""Thornton and Ning (1998): elastic-plastic adhesive spheres, and their impact.

JKR until the pressure in the middle reaches p_y; beyond, the force grows with the
contact radius by one of three variants, while the overlap stays that of JKR; unloading
is JKR on a flatter sphere of radius R_p.  Formulas are re-derived from a digest of the
paper, not checked against print; of the three variants `tangent` is the one that
reproduces the printed curves of Ning (1995).

.. math::
    p_y = \frac{2E^*a_y}{\pi R} - \sqrt{\frac{2WE^*}{\pi a_y}}, \quad
    P = P_y + \pi p_y(a^2-a_y^2) - \tfrac23\sqrt{2\pi WE^*}(a^{3/2}-a_y^{3/2})

.. math::
    R_p = \frac{R P_1}{P(a_*) + \sqrt{4P_cP_1}}, \quad P_1 = \frac{4E^*a_*^3}{3R}, \quad
    P_c = \tfrac32\pi WR

Reference: C. Thornton, Z. Ning, Powder Technol. 99 (1998) 154-162.
"""

from math import pi, sqrt
from typing import NamedTuple

import numpy as np

from pestle.reference.jkr_contact import (
    contact_radius,
    energy_at,
    force_at,
    overlap_at,
    separation_radius,
)
from pestle.reference.nan2022_energy import bisect
from pestle.reference.roots import cube_root

TANGENT, EXACT, AY_OVER_A = 0.0, 1.0, 2.0
VARIANTS = ("tangent", "exact", "ay_over_a")


def yield_radius(
    modulus: float, radius: float, adhesion: float, pressure: float
) -> float:
    """Contact radius a_y at which the middle yields [m].

    With y = sqrt(a/R): y^3 - p y - q = 0, Newton from above.
    """
    p = 0.5 * pi * pressure / modulus
    q = sqrt(0.5 * pi * adhesion / (modulus * radius))
    y = sqrt(p) + cube_root(q)
    for _ in range(7):
        y -= (y * (y * y - p) - q) / (3.0 * y * y - p)
    return radius * y * y


def plastic_force(
    a: float,
    yields: float,
    modulus: float,
    radius: float,
    adhesion: float,
    pressure: float,
    variant: float,
) -> tuple[float, float]:
    """Force and its slope dP/da at a contact radius beyond yield [N], [N/m].

    Parameters
    ----------
    a, yields : float
        Contact radius and a_y [m].
    modulus, radius, adhesion, pressure : float
        E* [Pa], R* [m], W [J/m^2], p_y [Pa].
    variant : float
        Index of `VARIANTS`.

    Returns
    -------
    tuple of float
        P [N] and dP/da [N/m].
    """
    neck = sqrt(2.0 * pi * adhesion * modulus)
    if variant == TANGENT:
        more = a * sqrt(a) - yields * sqrt(yields)
        start = force_at(yields, modulus, radius, adhesion)
        flat = pi * pressure * (a + yields) * (a - yields)
        force = start + flat - 2.0 / 3.0 * neck * more
        return force, 2.0 * pi * pressure * a - neck * sqrt(a)
    # pressure b sqrt(1 - x^2) - g/sqrt(1 - x^2), cut off at p_y within x^2 = 1 - u^2
    b = 2.0 * modulus * a / (pi * radius)
    g = sqrt(2.0 * adhesion * modulus / (pi * a))
    whole = (pressure + sqrt(pressure * pressure + 4.0 * b * g)) / (2.0 * b)
    u = whole if variant == EXACT else yields / a
    edge = b * u * u * u / 1.5 - 2.0 * g * u
    force = pi * a * a * ((1.0 - u * u) * pressure + edge)
    slope = (
        pi * a * (2.0 * (1.0 - u * u) * pressure + 2.0 * b * u * u * u - 3.0 * g * u)
    )
    loose = 2.0 * pi * a * a * (b * u * u - u * pressure - g)  # dP/du, 0 if exact
    return force, slope - (loose * u / a if variant == AY_OVER_A else 0.0)


def flattened_radius(
    a: float, force: float, modulus: float, radius: float, adhesion: float
) -> float:
    """Radius R_p of the sphere that unloads from a contact radius and force [m]."""
    hertz = 4.0 / 3.0 * modulus * a * a * (a / radius)
    return radius * hertz / (force + sqrt(8.0 * pi * adhesion * modulus * a) * a)


def overlap_slope(a: float, modulus: float, radius: float, adhesion: float) -> float:
    """Slope d(overlap)/da of a loading contact, 2 a/R - sqrt(pi W/(2 E a)) [-]."""
    return 2.0 * a / radius - sqrt(0.5 * pi * adhesion / (modulus * a))


class Sphere(NamedTuple):
    """A pair of spheres with its yield point. SI units."""

    modulus: float  # E* [Pa]
    radius: float  # R* [m]
    adhesion: float  # W [J/m^2]
    pressure: float  # p_y [Pa]
    variant: float  # index of VARIANTS
    yields: float  # a_y [m]
    start: float  # contact radius at first touch, overlap 0 [m]


def sphere(
    modulus: float, radius: float, adhesion: float, pressure: float, variant: str
) -> Sphere:
    """Sphere of given constants and variant ("tangent", "exact" or "ay_over_a")."""
    return Sphere(
        modulus,
        radius,
        adhesion,
        pressure,
        float(VARIANTS.index(variant)),
        yield_radius(modulus, radius, adhesion, pressure),
        contact_radius(0.0, modulus, radius, adhesion),
    )


class Peak(NamedTuple):
    """The turning point of an impact and its unloading branch."""

    radius: float  # a_* [m]
    overlap: float  # alpha_max [m]
    force: float  # [N]
    flattened: float  # R_p [m]
    rest: float  # overlap without force on unloading [m]
    pull_off: float  # largest tension on unloading [N]


def peak(s: Sphere, a: float) -> Peak:
    """Everything at the largest contact radius of a loading [m]."""
    k = (s.modulus, s.radius, s.adhesion)
    yields = a > s.yields
    force = _force(s, a) if yields else force_at(a, *k)
    flat = flattened_radius(a, force, *k) if yields else s.radius
    top = overlap_at(a, *k)
    free = flat * cube_root(4.5 * pi * s.adhesion / (s.modulus * flat))
    shift = a * a * (1.0 / s.radius - 1.0 / flat)
    rest = shift + overlap_at(free, s.modulus, flat, s.adhesion)
    return Peak(a, top, force, flat, rest, 1.5 * pi * s.adhesion * flat)


def _force(s: Sphere, a: float) -> float:
    return plastic_force(a, s.yields, *s[:4], s.variant)[0]


def loading_work(s: Sphere, a: float) -> float:
    """Work from the first touch (overlap 0) to a contact radius [J]."""
    k = (s.modulus, s.radius, s.adhesion)
    elastic = min(max(s.yields, s.start), a)
    work = energy_at(elastic, *k) - energy_at(s.start, *k)
    if a > elastic:
        nodes, weights = np.polynomial.legendre.leggauss(60)
        half = 0.5 * (a - elastic)
        for x, w in zip(elastic + half * (nodes + 1.0), half * weights, strict=True):
            work += w * _force(s, x) * overlap_slope(x, *s[:3])
    return float(work)


def rebound_energy(s: Sphere, a: float) -> float:
    """Work given back from the largest contact radius until the surfaces part [J]."""
    p = peak(s, a)
    k = (s.modulus, p.flattened, s.adhesion)
    return energy_at(a, *k) - energy_at(separation_radius(*k), *k)


def impact(s: Sphere, mass: float, velocity: float) -> tuple[float, Peak]:
    """Restitution of an impact at a velocity [m/s], 0 if it sticks, and its peak."""
    energy = 0.5 * mass * velocity**2
    high = max(2.0 * s.start, s.yields)
    while loading_work(s, high) < energy:
        high *= 2.0
    a = bisect(lambda a: loading_work(s, a) - energy, s.start, high)
    back = max(rebound_energy(s, a), 0.0)
    return sqrt(back / energy), peak(s, a)


def plastic_sticking_velocity(s: Sphere, mass: float) -> float:
    """Velocity up to which an impact sticks, V_ys [m/s]."""
    if s.adhesion == 0.0:
        return 0.0
    high = 2.0 * s.start
    while rebound_energy(s, high) < 0.0:
        high *= 2.0
    a = bisect(lambda a: rebound_energy(s, a), s.start, high)
    return sqrt(2.0 * loading_work(s, a) / mass)


def restitution_without_adhesion(ratio: float) -> float:
    """Their (44): restitution at V_y/V_i = ratio [-]; 1 below yield."""
    r = min(ratio, 1.0)
    inner = r / (r + 2.0 * sqrt(1.2 - 0.2 * r * r))
    return sqrt(1.2 * sqrt(3.0)) * sqrt(1.0 - r * r / 6.0) * sqrt(sqrt(inner))


def restitution_fast(ratio: float) -> float:
    """Their (46): limit of (44) far above yield, 1.185 r^(1/4) [-]."""
    return 1.185 * sqrt(sqrt(ratio))


def restitution_with_adhesion(ratio: float, sticking_ratio: float) -> float:
    """Their (78): e^2 = e_44^2 - (V_s/V_i)^2, 0 where that is negative [-]."""
    plain = restitution_without_adhesion(ratio)
    return sqrt(max(plain**2 - sticking_ratio**2, 0.0))
