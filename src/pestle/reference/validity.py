r"""Where the adhesive MDR contact can be trusted, Appendix F.

Large plastic flow makes the relaxed profile concave near the axis, out to
`peak_radius`; a contact that breaks inside that ring is described wrongly.  And the
plastic zone at the edge must stay small against the contact: small-scale yielding, SSY.

Equation numbers: Zunker and Kamrin, J. Mech. Phys. Solids 183 (2024) 105492.
"""

from math import pi
from typing import Literal

PEAK_ONSET = 0.135  # delta_Xi/R_o [-]
SSY_RATIO = 15.0  # least 2 a_c/r_Ip [-], Eq. (F.7)

Reason = Literal["ok", "peak", "ssy", "both"]


def peak_radius(
    displacement: float, initial_radius: float, *, yield_overlap: float
) -> float:
    r"""Radius of the rim of the concave region, Eq. (F.1).

    .. math:: r_{peak}/R_o = 1.75[(\delta_{o,max}-\delta_Y-\delta_\Xi)/R_o]^{3/4}

    Parameters
    ----------
    displacement : float
        Largest displacement delta_o,max [m].
    initial_radius : float
        R_o [m].
    yield_overlap : float
        delta_Y [m].

    Returns
    -------
    float
        r_peak [m], zero before onset.

    Examples
    --------
    >>> peak_radius(0.1, 1.0, yield_overlap=0.01)
    0.0
    >>> round(peak_radius(0.3, 1.0, yield_overlap=0.000865), 6)
    0.451273
    """
    beyond = (displacement - yield_overlap) / initial_radius - PEAK_ONSET
    return 1.75 * initial_radius * max(beyond, 0.0) ** 0.75


def peak_fraction(
    displacement: float, initial_radius: float, *, yield_overlap: float
) -> float:
    r"""Radius of the rim over a_max, Eq. (F.2): 1.1 times the cube root.

    Parameters
    ----------
    displacement : float
        Largest displacement delta_o,max [m].
    initial_radius : float
        R_o [m].
    yield_overlap : float
        delta_Y [m].

    Returns
    -------
    float
        r_peak/a_max [-]; just above onset it differs from Eq. (F.1) by up to 2 times.

    Examples
    --------
    >>> round(peak_fraction(0.26, 1.0, yield_overlap=0.0), 6)
    0.55
    """
    beyond = (displacement - yield_overlap) / initial_radius - PEAK_ONSET
    return 1.1 * max(beyond, 0.0) ** (1.0 / 3.0)


def plastic_zone(
    *, modulus: float, work_of_adhesion: float, yield_stress: float
) -> float:
    r"""Size of the plastic zone at the contact edge, Eq. (F.6): :math:`E^*W/(\pi Y^2)`.

    Parameters
    ----------
    modulus, work_of_adhesion : float
        E* [Pa] and work of adhesion W [J/m^2].
    yield_stress : float
        Y [Pa].

    Returns
    -------
    float
        r_Ip [m].

    Examples
    --------
    >>> round(plastic_zone(modulus=1000.0, work_of_adhesion=1.0, yield_stress=72.8), 6)
    0.06006
    """
    return modulus * work_of_adhesion / (pi * yield_stress**2)


def reason(critical_radius: float, peak_radius: float, plastic_zone: float) -> Reason:
    """Why the adhesive contact cannot be trusted, Eq. (F.7).

    Parameters
    ----------
    critical_radius, peak_radius, plastic_zone : float
        a_c, r_peak, r_Ip [m].

    Returns
    -------
    {"ok", "peak", "ssy", "both"}
        "peak": a_c <= r_peak; "ssy": 2 a_c < 15 r_Ip.

    Examples
    --------
    >>> reason(1.0, 0.5, 0.01), reason(1.0, 2.0, 1.0)
    ('ok', 'both')
    """
    inside_peak = peak_radius > 0.0 and critical_radius <= peak_radius
    large_zone = 2.0 * critical_radius < SSY_RATIO * plastic_zone
    if inside_peak:
        return "both" if large_zone else "peak"
    return "ssy" if large_zone else "ok"
