r"""Hertz: an elastic sphere on a flat, or two spheres with R* and E*.

Equation numbers: Zunker and Kamrin, J. Mech. Phys. Solids 183 (2024) 105492.
`overlap` is the approach of the bodies [m], `radius` is R (R* of a pair) [m],
`modulus` is the composite plane-strain modulus E* [Pa].
"""

from math import pi, sqrt


def force(overlap: float, radius: float, *, modulus: float) -> float:
    r"""Normal force, Eq. (25): :math:`F = \frac43 E^* \sqrt R\,\delta^{3/2}`.

    Parameters
    ----------
    overlap, radius : float
        Approach [m] and radius [m].
    modulus : float
        E* [Pa].

    Returns
    -------
    float
        Force [N], zero without overlap.

    Examples
    --------
    >>> round(force(0.01, 1.0, modulus=0.75), 12)
    0.001
    """
    depth = max(overlap, 0.0)
    return 4.0 / 3.0 * modulus * sqrt(radius * depth) * depth


def contact_radius(overlap: float, radius: float) -> float:
    r"""Contact radius, Eq. (23): :math:`a = \sqrt{R\delta}`.

    Parameters
    ----------
    overlap, radius : float
        Approach [m] and radius [m].

    Returns
    -------
    float
        a [m].

    Examples
    --------
    >>> contact_radius(0.01, 1.0)
    0.1
    """
    return sqrt(radius * max(overlap, 0.0))


def mean_pressure(overlap: float, radius: float, *, modulus: float) -> float:
    r"""Mean contact pressure, Eq. (40): :math:`4E^*/(3\pi)\sqrt{\delta/R}`.

    Parameters
    ----------
    overlap, radius : float
        Approach [m] and radius [m].
    modulus : float
        E* [Pa].

    Returns
    -------
    float
        Force over contact area [Pa].

    Examples
    --------
    >>> round(mean_pressure(0.01, 1.0, modulus=3.0), 6)
    0.127324
    """
    return 4.0 * modulus / (3.0 * pi) * sqrt(max(overlap, 0.0) / radius)


def pressure(
    distance: float, overlap: float, radius: float, *, modulus: float
) -> float:
    r"""Contact pressure at a distance r from the axis, Eq. (20).

    .. math:: p = \frac{2E^*}{\pi\sqrt R}\sqrt{\delta - r^2/R}

    Parameters
    ----------
    distance : float
        r [m].
    overlap, radius : float
        Approach [m] and radius [m].
    modulus : float
        E* [Pa].

    Returns
    -------
    float
        Pressure [Pa], zero outside the contact.

    Examples
    --------
    >>> round(pressure(0.0, 0.01, 1.0, modulus=3.0), 6)
    0.190986
    >>> pressure(0.2, 0.01, 1.0, modulus=3.0)
    0.0
    """
    inside = max(overlap - distance * (distance / radius), 0.0)
    return 2.0 * modulus / pi * sqrt(inside / radius)


def stiffness(overlap: float, radius: float, *, modulus: float) -> float:
    r"""Normal stiffness :math:`dF/d\delta = 2E^* a`.

    Parameters
    ----------
    overlap, radius : float
        Approach [m] and radius [m].
    modulus : float
        E* [Pa].

    Returns
    -------
    float
        Stiffness [N/m].

    Examples
    --------
    >>> stiffness(0.01, 1.0, modulus=3.0)
    0.6000000000000001
    """
    return 2.0 * modulus * contact_radius(overlap, radius)


def stored_energy(overlap: float, radius: float, *, modulus: float) -> float:
    r"""Elastic energy :math:`\frac25 F\delta`.

    Parameters
    ----------
    overlap, radius : float
        Approach [m] and radius [m].
    modulus : float
        E* [Pa].

    Returns
    -------
    float
        Energy [J].

    Examples
    --------
    >>> round(stored_energy(0.01, 1.0, modulus=0.75), 12)
    4e-06
    """
    return 0.4 * force(overlap, radius, modulus=modulus) * max(overlap, 0.0)
