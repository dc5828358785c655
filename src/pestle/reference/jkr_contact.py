r"""JKR in terms of the overlap: the stable branch in closed, compilable form.

With a_c the radius at separation, t^2 = a/a_c and d the overlap over that there,

.. math:: a_c^3 = \frac{\pi W R^2}{8E^*}, \quad t^4 - 4t = 3d, \quad
    F = \frac{4E^*a^3}{3R} - \sqrt{8\pi W E^* a^3}

so one cube root and a few Newton steps give everything, at any overlap, with or without
adhesion.  No library call but the square root: a compiler turns it into SIMD.

Reference: K. L. Johnson, K. Kendall, A. D. Roberts, Proc. R. Soc. A 324 (1971) 301.
"""

from math import pi, sqrt

from pestle.reference.roots import cube_root


def separation_radius(modulus: float, radius: float, adhesion: float) -> float:
    """Contact radius where a contact held by displacement parts, a_c [m]."""
    return radius * cube_root(pi * adhesion / (8.0 * modulus * radius))


def separation_length(modulus: float, radius: float, adhesion: float) -> float:
    """Negative overlap at which a contact parts, 3 a_c^2/R [m]."""
    a = separation_radius(modulus, radius, adhesion)
    return 3.0 * a * (a / radius)


def scaled_root(d: float) -> float:
    """Larger root t of t^4 - 4 t = 3 d for d >= -1, below that 1 [-].

    In u = t - 1 it is u^2 (u^2 + 4 u + 6) = 3 (d + 1): no cancellation near separation.
    """
    y = 3.0 * max(d + 1.0, 0.0) + 1e-300
    v = sqrt(sqrt(y))
    v = min(v, sqrt(y / 6.0))
    u = sqrt(y / (6.0 + v * (4.0 + v)))
    for _ in range(4):
        q = u * u
        u -= (q * (q + 4.0 * u + 6.0) - y) / (4.0 * u * (q + 3.0 * u + 3.0))
    return 1.0 + u


def contact_radius(
    overlap: float, modulus: float, radius: float, adhesion: float
) -> float:
    """Contact radius a of a joined pair at an overlap, stable branch [m].

    Parameters
    ----------
    overlap : float
        Overlap [m]; below that of separation the radius there is given.
    modulus, radius, adhesion : float
        E* [Pa], R* [m], W [J/m^2].

    Returns
    -------
    float
        Contact radius [m].

    Examples
    --------
    >>> round(contact_radius(0.01, 1.0, 1.0, 0.0), 12)
    0.1
    """
    a = separation_radius(modulus, radius, adhesion)
    length = 3.0 * a * (a / radius)
    d = overlap / length if a > 0.0 else 0.0
    t = scaled_root(d)
    return a * t * t if a > 0.0 else sqrt(radius * max(overlap, 0.0))


def overlap_at(a: float, modulus: float, radius: float, adhesion: float) -> float:
    """Overlap at a contact radius, a^2/R - sqrt(2 pi W a/E) [m]."""
    return a * (a / radius) - sqrt(2.0 * pi * adhesion * a / modulus)


def force_at(a: float, modulus: float, radius: float, adhesion: float) -> float:
    """Normal force at a contact radius [N]."""
    hertz = 4.0 / 3.0 * modulus * a * a * (a / radius)
    return hertz - sqrt(8.0 * pi * adhesion * modulus * a) * a


def slope_at(a: float, modulus: float, radius: float, adhesion: float) -> float:
    """Slope dF/d(overlap) at a contact radius: 2 E a (s - 3 q)/(s - q) [N/m].

    s = a^1.5, q = a_c^1.5; negative below the largest tension, infinite at separation.
    """
    s = a * sqrt(a)
    q = radius * sqrt(pi * adhesion / (8.0 * modulus))
    return 2.0 * modulus * a * (s - 3.0 * q) / (s - q)


def stiffness_at(a: float, modulus: float, radius: float, adhesion: float) -> float:
    """Absolute slope, but at most Hertz's 2 E a: finite up to separation [N/m]."""
    s = a * sqrt(a)
    q = radius * sqrt(pi * adhesion / (8.0 * modulus))
    rise = abs(s - 3.0 * q)
    return 2.0 * modulus * a * rise / (max(s - q, rise) + 1e-300)


def energy_at(a: float, modulus: float, radius: float, adhesion: float) -> float:
    r"""Elastic energy less W times the area; 0 for parted surfaces [J].

    .. math::
        U = \frac{8E^*a^5}{15R^2} - \frac{2a^2}{3R}\sqrt{8\pi W E^* a^3} + \pi W a^2
    """
    flat = a * (a / radius)
    deep = 8.0 / 15.0 * modulus * a * flat * flat
    neck = sqrt(8.0 * pi * adhesion * modulus * a) * a * flat * (2.0 / 3.0)
    return deep - neck + pi * adhesion * a * a
