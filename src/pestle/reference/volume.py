r"""Volumes of a deformed particle and the growth of its apparent radius.

The particle is a sphere of apparent radius R cut by flats.  Plastic flow keeps volume,
so that what the caps lose beyond the elastic volume change must reappear as growth of
R, Eq. (37), the differential of geometric plus elastically lost volume.
`displacement` is delta_o, the approach of a flat to the particle's centre measured from
touch with the sphere of initial radius R_o; `overlap` is delta_o + R - R_o.

Equation numbers: Zunker and Kamrin, J. Mech. Phys. Solids 183 (2024) 105492.
"""

from collections.abc import Sequence
from math import pi, sqrt
from typing import NamedTuple

from pestle.errors import SimulationError


def sphere_volume(radius: float) -> float:
    r"""Volume of a sphere, :math:`\frac43\pi R^3`.

    Parameters
    ----------
    radius : float
        R [m].

    Returns
    -------
    float
        Volume [m^3].

    Examples
    --------
    >>> round(sphere_volume(1.0), 6)
    4.18879
    """
    return 4.0 / 3.0 * pi * radius**3


def cap_volume(overlap: float, radius: float) -> float:
    r"""Volume that a flat cuts from the sphere, :math:`\frac\pi3\delta^2(3R-\delta)`.

    Parameters
    ----------
    overlap, radius : float
        Apparent overlap [m] and apparent radius [m].

    Returns
    -------
    float
        Volume [m^3], zero without overlap.

    Examples
    --------
    >>> round(cap_volume(1.0, 1.0) / sphere_volume(1.0), 12)
    0.5
    """
    depth = max(overlap, 0.0)
    return pi / 3.0 * depth * depth * (3.0 * radius - depth)


def geometric_volume(overlaps: Sequence[float], radius: float) -> float:
    """Volume of the sphere cut by flats, Eq. (C.1); the caps must not meet.

    Parameters
    ----------
    overlaps : sequence of float
        Apparent overlap of every flat [m].
    radius : float
        Apparent radius [m].

    Returns
    -------
    float
        Volume [m^3].

    Examples
    --------
    >>> geometric_volume([1.0, 1.0], 1.0)
    0.0
    """
    return sphere_volume(radius) - sum(cap_volume(d, radius) for d in overlaps)


def lost_volume(virial: float, initial_radius: float, *, bulk: float) -> float:
    r"""Elastic volume loss, the limit of Eqs. (38), (39) for small steps.

    With :math:`S = \sum F(R_o - \delta_o)` the volume solves
    :math:`V = V_o(1 - S/(3\kappa V))`; returned is :math:`V_o - V`.

    Parameters
    ----------
    virial : float
        S, forces times branch lengths, compression positive [J].
    initial_radius : float
        R_o [m].
    bulk : float
        kappa [Pa].

    Returns
    -------
    float
        Volume [m^3], negative under tension.

    Raises
    ------
    SimulationError
        If the forces exceed what the relation can balance.

    Examples
    --------
    >>> round(lost_volume(0.3, 1.0, bulk=1.0), 6)
    0.102509
    """
    if virial_ratio(virial, initial_radius, bulk=bulk) > 1.0:
        raise crushed(virial, initial_radius)
    return lost_volume_within(virial, initial_radius, bulk=bulk)


def crushed(virial: float, initial_radius: float) -> SimulationError:
    """Error of forces that a particle's volume cannot balance.

    Parameters
    ----------
    virial, initial_radius : float
        S [J] and R_o [m].

    Returns
    -------
    SimulationError
        The error.

    Examples
    --------
    >>> crushed(1.0, 1.0).id
    'particle-crushed'
    """
    return SimulationError(
        "particle-crushed",
        f"forces times branch lengths of {virial:.6g} J exceed what the particle's "
        f"volume of {sphere_volume(initial_radius):.6g} m^3 can balance elastically",
        hint="stop at a smaller displacement, or use the correct bulk modulus",
    )


def virial_ratio(virial: float, initial_radius: float, *, bulk: float) -> float:
    r"""Virial over the largest that a particle can balance, :math:`4S/(3\kappa V_o)`.

    Parameters
    ----------
    virial : float
        S, forces times branch lengths, compression positive [J].
    initial_radius : float
        R_o [m].
    bulk : float
        kappa [Pa].

    Returns
    -------
    float
        Ratio [-]; beyond 1 there is no volume.

    Examples
    --------
    >>> round(virial_ratio(3.0, 1.0, bulk=1.0), 12)
    0.954929658551
    """
    return 4.0 * virial / (3.0 * bulk * sphere_volume(initial_radius))


def lost_volume_within(virial: float, initial_radius: float, *, bulk: float) -> float:
    """Elastic volume loss where `virial_ratio` is known to be at most 1.

    Parameters
    ----------
    virial : float
        S, forces times branch lengths, compression positive [J].
    initial_radius : float
        R_o [m].
    bulk : float
        kappa [Pa].

    Returns
    -------
    float
        Volume [m^3]; no meaning beyond.

    Examples
    --------
    >>> round(lost_volume_within(0.3, 1.0, bulk=1.0), 6)
    0.102509
    """
    q = virial_ratio(virial, initial_radius, bulk=bulk)
    return 0.5 * sphere_volume(initial_radius) * q / (1.0 + sqrt(max(1.0 - q, 0.0)))


class RadiusStep(NamedTuple):
    """Result of one explicit update."""

    volume: float  # V after the step [m^3]
    lost: float  # elastic volume change, positive in compression [m^3]
    growth: float  # Delta R before the maximum with zero is taken [m]


def radius_step(
    radius: float,
    volume: float,
    *,
    flats: Sequence[tuple[float, float, float]],
    initial_radius: float,
    bulk: float,
) -> RadiusStep:
    r"""One explicit update of Eqs. (37)-(39) as in Appendix E.

    .. math:: \Delta R = \frac{\Delta V^e - \sum\pi\Delta\delta_o
              (2\delta_oR_o - \delta_o^2 + R^2 - R_o^2)}{2\pi R\sum\delta - 4\pi R^2}

    Parameters
    ----------
    radius, volume : float
        R [m] and V [m^3] before the step.
    flats : sequence of (displacement, increment, force)
        Of every active flat: delta_o after the step [m], its change [m], force [N].
    initial_radius, bulk : float
        R_o [m] and kappa [Pa].

    Returns
    -------
    RadiusStep
        Volume, elastic volume change and growth.

    Examples
    --------
    >>> flats = [(0.1, 0.001, 0.0066)] * 2
    >>> step = radius_step(1.0, 4.18, flats=flats, initial_radius=1.0, bulk=1 / 1.2)
    >>> round(step.growth, 9)
    0.000461728
    """
    r, r_o = radius, initial_radius
    virial = sum(f * (r_o - d) for d, _, f in flats)
    new = sphere_volume(r_o) * (1.0 - virial / (3.0 * bulk * volume))
    lost = volume - new
    cut = sum(pi * dd * (r - r_o + d) * (r + r_o - d) for d, dd, _ in flats)
    overlaps = sum(d + r - r_o for d, _, _ in flats)
    growth = (lost - cut) / (2.0 * pi * r * (overlaps - 2.0 * r))
    return RadiusStep(new, lost, growth)
