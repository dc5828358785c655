r"""The elliptical indenter of the MDR space pressed into a bed of springs.

A height A and a width B describe the ellipse, E* the springs.  For the intact sphere
A = 4R, B = 2R, Eq. (31); after yield A and B follow from pressure and contact radius,
Eq. (28) (A is the height and B the width, as in the paper's Appendix D).
All formulas are written without cancellation at small penetration.

Equation numbers: Zunker and Kamrin, J. Mech. Phys. Solids 183 (2024) 105492.
"""

from math import asin, pi, sin, sqrt
from typing import NamedTuple

import numpy as np

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(20)


class Ellipse(NamedTuple):
    """Indenter of the MDR space."""

    height: float  # A [m]
    width: float  # B [m]


def of_sphere(radius: float) -> Ellipse:
    """Indenter of an elastic sphere, Eq. (31): A = 4R, B = 2R.

    Parameters
    ----------
    radius : float
        R [m].

    Returns
    -------
    Ellipse
        Indenter with the sphere's curvature at its tip.

    Examples
    --------
    >>> of_sphere(1.0)
    Ellipse(height=4.0, width=2.0)
    """
    return Ellipse(4.0 * radius, 2.0 * radius)


def angle_minus_sine(angle: float) -> float:
    r"""Compute :math:`x - \sin x` to full relative accuracy.

    Parameters
    ----------
    angle : float
        x [-].

    Returns
    -------
    float
        Difference [-].

    Examples
    --------
    >>> round(angle_minus_sine(1e-3) / (1e-9 / 6.0), 9)
    0.99999995
    """
    if abs(angle) > 1.5:
        return angle - sin(angle)
    square, total = angle * angle, 1.0
    for n in range(12, 1, -1):
        total = 1.0 - total * square / ((2 * n) * (2 * n + 1))
    return angle * square / 6.0 * total


def profile(shape: Ellipse, distance: float) -> float:
    r"""Gap of the transformed indenter, Eq. (44).

    .. math:: g_{1D}(x) = \frac A2 - \frac AB\sqrt{\frac{B^2}{4} - x^2}

    Parameters
    ----------
    shape : Ellipse
        Indenter.
    distance : float
        x from the axis, at most B/2 [m].

    Returns
    -------
    float
        Gap [m].

    Examples
    --------
    >>> profile(Ellipse(4.0, 2.0), 1.0)
    2.0
    """
    half = 0.5 * shape.width
    root = sqrt(max((half - distance) * (half + distance), 0.0))
    return shape.height / shape.width * distance * distance / (half + root)


def slope(shape: Ellipse, distance: float) -> float:
    r"""Slope of the profile, :math:`dg_{1D}/dx = (A/B)\,x/\sqrt{B^2/4 - x^2}`.

    Parameters
    ----------
    shape : Ellipse
        Indenter.
    distance : float
        x from the axis, below B/2 [m].

    Returns
    -------
    float
        Slope [-].

    Examples
    --------
    >>> round(slope(Ellipse(4.0, 2.0), 0.6), 12)
    1.5
    """
    half = 0.5 * shape.width
    root = sqrt((half - distance) * (half + distance))
    return shape.height / shape.width * distance / root


def contact_radius(shape: Ellipse, penetration: float) -> float:
    r"""Contact radius without tension, :math:`a = (B/A)\sqrt{\delta_e(A-\delta_e)}`.

    Parameters
    ----------
    shape : Ellipse
        Indenter.
    penetration : float
        Depth of the tip in the springs [m], at most A/2.

    Returns
    -------
    float
        Root of g_1D(a) = penetration [m], zero without penetration.

    Examples
    --------
    >>> contact_radius(Ellipse(4.0, 2.0), 2.0)
    1.0
    """
    depth = min(max(penetration, 0.0), 0.5 * shape.height)
    return shape.width / shape.height * sqrt(depth * (shape.height - depth))


def force(shape: Ellipse, penetration: float, *, modulus: float) -> float:
    r"""Force of the springs without tension, Eq. (30).

    With :math:`\theta = \arccos(1 - 2\delta_e/A)` it reads
    :math:`F = \frac{E^*AB}{8}(2\theta - \sin 2\theta)`.

    Parameters
    ----------
    shape : Ellipse
        Indenter.
    penetration : float
        Depth of the tip in the springs [m], at most A/2.
    modulus : float
        E* [Pa].

    Returns
    -------
    float
        Force [N], zero without penetration.

    Examples
    --------
    >>> round(force(Ellipse(4.0, 2.0), 1e-6, modulus=0.75) / 1e-9, 6)
    1.0
    """
    depth = min(max(penetration, 0.0), 0.5 * shape.height)
    twice_theta = 4.0 * asin(sqrt(depth / shape.height))
    return modulus * shape.height * shape.width / 8.0 * angle_minus_sine(twice_theta)


def largest_force(shape: Ellipse, *, modulus: float) -> float:
    r"""Force at :math:`\delta_e = A/2`, Eq. (32): :math:`\pi E^* A B/8`.

    Parameters
    ----------
    shape : Ellipse
        Indenter.
    modulus : float
        E* [Pa].

    Returns
    -------
    float
        Force [N].

    Examples
    --------
    >>> round(largest_force(Ellipse(4.0, 2.0), modulus=1.0), 6)
    3.141593
    """
    return pi * modulus * shape.height * shape.width / 8.0


def stored_energy(
    shape: Ellipse, penetration: float, radius: float, *, modulus: float
) -> float:
    r"""Elastic energy of the springs within a contact radius.

    .. math:: U = E^* \int_0^a (\delta_e - g_{1D}(x))^2\,dx

    Without tension a is `contact_radius`; with adhesion it is the adhered radius, and
    the surface energy :math:`-\pi a^2 W` adds to it.

    Parameters
    ----------
    shape : Ellipse
        Indenter.
    penetration : float
        Depth of the tip in the springs [m], negative when lifted.
    radius : float
        Contact radius a, at most B/2 [m].
    modulus : float
        E* [Pa].

    Returns
    -------
    float
        Energy [J].

    Examples
    --------
    >>> shape = Ellipse(4.0, 2.0)
    >>> a = contact_radius(shape, 1e-6)
    >>> round(stored_energy(shape, 1e-6, a, modulus=0.75) / 4e-16, 5)
    1.0
    """
    end = asin(min(2.0 * radius / shape.width, 1.0))
    angle = 0.5 * end * (_NODES + 1.0)  # x = (B/2) sin(angle): smooth up to the equator
    stretch = penetration - shape.height * np.sin(0.5 * angle) ** 2
    integrand = stretch**2 * np.cos(angle)
    integral = 0.25 * end * shape.width * float(_WEIGHTS @ integrand)
    return modulus * integral
