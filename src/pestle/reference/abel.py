r"""Transforms between an axisymmetric contact and its MDR image, Section 3.

Each takes a plain function and evaluates one point.  Substitutions remove the square
roots from the kernels, so that smooth functions come out to about 1e-12.

Equation numbers: Zunker and Kamrin, J. Mech. Phys. Solids 183 (2024) 105492; the
forward transform of displacements, misprinted as (10a), is the derivation's own.
"""

from collections.abc import Callable
from itertools import pairwise
from math import asin, cos, pi, sin, sqrt

Profile = Callable[[float], float]


def _integral(function: Profile, end: float, *breaks: float) -> float:
    from scipy.integrate import quad

    edges = [0.0, *sorted(b for b in breaks if 0.0 < b < end), end]
    # full_output: round-off near the tolerance is expected and not worth a warning
    return sum(
        quad(function, low, high, epsabs=0.0, epsrel=1e-12, limit=200, full_output=1)[0]
        for low, high in pairwise(edges)
        if high > low
    )


def line_load(pressure: Profile, radius: float, x: float) -> float:
    r"""Load of the springs under a pressure, Eq. (17).

    .. math:: q_{1D}(x) = 2\int_x^a \frac{r\,p(r)}{\sqrt{r^2-x^2}}\,dr

    Parameters
    ----------
    pressure : callable
        p [Pa] against the distance from the axis [m].
    radius : float
        Contact radius a [m].
    x : float
        Position [m].

    Returns
    -------
    float
        q_1D [N/m], zero outside the contact.

    Examples
    --------
    >>> round(line_load(lambda r: 2.0, 0.6, 0.0), 12)
    2.4
    """
    x = abs(x)
    if x >= radius:
        return 0.0
    half = sqrt((radius - x) * (radius + x))

    def integrand(angle: float) -> float:
        return pressure(sqrt(x * x + (half * sin(angle)) ** 2)) * cos(angle)

    return 2.0 * half * _integral(integrand, 0.5 * pi)


def pressure(slope: Profile, radius: float, r: float, *, edge: float = 0.0) -> float:
    r"""Pressure under a load of the springs, Eq. (9).

    .. math:: p(r) = -\frac1\pi\int_r^a\frac{q'(x)}{\sqrt{x^2-r^2}}\,dx
              + \frac{q(a)}{\pi\sqrt{a^2-r^2}}

    Parameters
    ----------
    slope : callable
        Derivative of q_1D [Pa] against x [m].
    radius : float
        Contact radius a [m].
    r : float
        Distance from the axis, below a [m].
    edge : float
        q_1D at the edge, not zero under a punch or with adhesion [N/m].

    Returns
    -------
    float
        Pressure [Pa].

    Examples
    --------
    >>> round(pressure(lambda x: -2.0 * x, 1.0, 0.0) * pi, 9)
    2.0
    """
    half = sqrt((radius - r) * (radius + r))

    def integrand(t: float) -> float:
        x = sqrt(r * r + t * t)
        return slope(x) / x if x > 0.0 else 0.0

    return (edge / half - _integral(integrand, half)) / pi


def profile(slope: Profile, x: float) -> float:
    r"""Gap of the MDR indenter from the slope of the 3-D gap, Eq. (4).

    .. math:: g_{1D}(x) = |x|\int_0^{|x|}\frac{g'_{3D}(r)}{\sqrt{x^2-r^2}}\,dr

    Parameters
    ----------
    slope : callable
        Derivative of the 3-D gap [-] against the distance from the axis [m].
    x : float
        Position [m].

    Returns
    -------
    float
        Gap [m].

    Examples
    --------
    >>> round(profile(lambda r: r, 0.5), 12)
    0.25
    """
    x = abs(x)
    return x * _integral(lambda angle: slope(x * sin(angle)), 0.5 * pi)


def gap(profile: Profile, r: float) -> float:
    r"""3-D gap from the MDR indenter, Eq. (5).

    .. math:: g_{3D}(r) = \frac2\pi\int_0^r\frac{g_{1D}(x)}{\sqrt{r^2-x^2}}\,dx

    Parameters
    ----------
    profile : callable
        Gap of the indenter [m] against x [m].
    r : float
        Distance from the axis [m].

    Returns
    -------
    float
        Gap [m].

    Examples
    --------
    >>> round(gap(lambda x: x * x, 0.5), 12)
    0.125
    """
    return 2.0 / pi * _integral(lambda angle: profile(r * sin(angle)), 0.5 * pi)


def surface(spring: Profile, radius: float, r: float) -> float:
    r"""Surface displacement from that of the springs, Eq. (10b).

    .. math:: w_{3D}(r) = \frac2\pi\int_0^{\min(r,a)}\frac{w_{1D}(x)}{\sqrt{r^2-x^2}}dx

    Parameters
    ----------
    spring : callable
        Displacement of the springs [m] against x [m]; zero beyond the contact.
    radius : float
        Contact radius a [m].
    r : float
        Distance from the axis [m].

    Returns
    -------
    float
        Displacement [m].

    Examples
    --------
    >>> round(surface(lambda x: 1.0, 1.0, 2.0), 12)
    0.333333333333
    """
    end = 0.5 * pi if r <= radius else asin(radius / r)
    return 2.0 / pi * _integral(lambda angle: spring(r * sin(angle)), end)


def spring(
    slope: Profile, centre: float, x: float, *, breaks: tuple[float, ...] = ()
) -> float:
    r"""Displacement of the springs from that of the surface; corrects Eq. (10a).

    .. math:: w_{1D}(x) = w_{3D}(0) + |x|\int_0^{|x|}\frac{w'_{3D}(r)}{\sqrt{x^2-r^2}}dr

    Parameters
    ----------
    slope : callable
        Derivative of the surface displacement [-] against the distance r [m].
    centre : float
        Surface displacement on the axis [m].
    x : float
        Position [m].
    breaks : tuple of float
        Distances at which the slope jumps or is singular, such as the edge [m].

    Returns
    -------
    float
        Displacement [m].

    Examples
    --------
    >>> round(spring(lambda r: -r, 1.0, 0.5), 12)
    0.75
    """
    x = abs(x)
    if x == 0.0:
        return centre
    angles = [asin(b / x) for b in breaks if b < x]
    return centre + x * _integral(lambda t: slope(x * sin(t)), 0.5 * pi, *angles)
