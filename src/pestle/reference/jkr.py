r"""Johnson, Kendall and Roberts (1971): elastic spheres with adhesion.

The state is given by the contact radius a, which determines force and overlap.
`work_of_adhesion` is the work of adhesion W of the pair [J/m^2] (the papers' Gamma and
Delta gamma, "effective surface energy"), not the surface energy of one side.

Reference: K. L. Johnson, K. Kendall, A. D. Roberts, Proc. R. Soc. A 324 (1971) 301.
"""

from math import pi, sqrt
from typing import Literal

from pestle.reference.peeling import detachment_length

Control = Literal["force", "displacement"]


def force(
    contact_radius: float, radius: float, *, modulus: float, work_of_adhesion: float
) -> float:
    r"""Normal force at a contact radius, tension negative.

    .. math:: F = \frac{4E^*a^3}{3R} - \sqrt{8\pi W E^* a^3}

    Parameters
    ----------
    contact_radius, radius : float
        a [m] and radius R* [m].
    modulus, work_of_adhesion : float
        E* [Pa] and work of adhesion [J/m^2].

    Returns
    -------
    float
        Force [N].

    Examples
    --------
    >>> round(force(0.1, 1.0, modulus=750.0, work_of_adhesion=0.0), 12)
    1.0
    """
    a = contact_radius
    hertz = 4.0 / 3.0 * modulus * a * a * (a / radius)
    return hertz - 2.0 * modulus * a * detachment_length(
        a, modulus=modulus, work_of_adhesion=work_of_adhesion
    )


def overlap(
    contact_radius: float, radius: float, *, modulus: float, work_of_adhesion: float
) -> float:
    r"""Overlap at a contact radius: :math:`\delta = a^2/R - \sqrt{2\pi W a/E^*}`.

    Parameters
    ----------
    contact_radius, radius : float
        a [m] and radius R* [m].
    modulus, work_of_adhesion : float
        E* [Pa] and work of adhesion [J/m^2].

    Returns
    -------
    float
        Overlap [m], negative where a neck has formed.

    Examples
    --------
    >>> round(overlap(0.1, 1.0, modulus=1.0, work_of_adhesion=0.0), 12)
    0.01
    """
    a = contact_radius
    length = detachment_length(a, modulus=modulus, work_of_adhesion=work_of_adhesion)
    return a * (a / radius) - length


def critical_radius(
    radius: float, *, modulus: float, work_of_adhesion: float, control: Control
) -> float:
    r"""Contact radius at which the contact breaks, Eq. (15) for a parabola.

    .. math:: a_c^3 = \xi^2 \pi W R^2 / (8 E^*), \quad \xi = 3 \text{ or } 1

    Parameters
    ----------
    radius : float
        R* [m].
    modulus, work_of_adhesion : float
        E* [Pa] and work of adhesion [J/m^2].
    control : {"force", "displacement"}
        What is prescribed: xi = 3 or 1.

    Returns
    -------
    float
        a_c [m].

    Examples
    --------
    >>> k = {"modulus": 5.0, "work_of_adhesion": 0.1}
    >>> a = critical_radius(2.0, **k, control="force")
    >>> round(force(a, 2.0, **k) / pull_off(2.0, work_of_adhesion=0.1), 9)
    1.0
    """
    xi = 3.0 if control == "force" else 1.0
    return (xi**2 * pi * work_of_adhesion * radius**2 / (8.0 * modulus)) ** (1.0 / 3.0)


def pull_off(
    radius: float, *, work_of_adhesion: float, control: Control = "force"
) -> float:
    r"""Force at which the contact breaks.

    :math:`-\frac32 \pi W R` under force control (the largest tension),
    :math:`-\frac56 \pi W R` under displacement control.

    Parameters
    ----------
    radius : float
        R* [m].
    work_of_adhesion : float
        Work of adhesion [J/m^2].
    control : {"force", "displacement"}
        What is prescribed.

    Returns
    -------
    float
        Force [N], negative.

    Examples
    --------
    >>> round(pull_off(1.0, work_of_adhesion=1.0), 5)
    -4.71239
    """
    factor = 1.5 if control == "force" else 5.0 / 6.0
    return -factor * pi * work_of_adhesion * radius


def self_contact_radius(
    radius: float, *, modulus: float, work_of_adhesion: float
) -> float:
    r"""Contact radius without external force, :math:`a^3 = 9\pi W R^2/(2E^*)`.

    Parameters
    ----------
    radius : float
        R* [m].
    modulus, work_of_adhesion : float
        E* [Pa] and work of adhesion [J/m^2].

    Returns
    -------
    float
        a [m].

    Examples
    --------
    >>> a = self_contact_radius(1.0, modulus=5.0, work_of_adhesion=0.1)
    >>> abs(force(a, 1.0, modulus=5.0, work_of_adhesion=0.1)) < 1e-15
    True
    """
    return (9.0 * pi * work_of_adhesion * radius**2 / (2.0 * modulus)) ** (1.0 / 3.0)


def tabor_number(
    radius: float, *, modulus: float, work_of_adhesion: float, range_of_force: float
) -> float:
    r"""Tabor's number :math:`(R W^2/(E^{*2} z_0^3))^{1/3}`; JKR holds well above 1.

    Parameters
    ----------
    radius : float
        R* [m].
    modulus, work_of_adhesion : float
        E* [Pa] and work of adhesion [J/m^2].
    range_of_force : float
        Range z_0 of the surface force, about 0.3e-9 m [m].

    Returns
    -------
    float
        Number [-].

    Examples
    --------
    >>> tabor_number(1.0, modulus=1.0, work_of_adhesion=1.0, range_of_force=1.0)
    1.0
    """
    return (
        sqrt(radius)
        * work_of_adhesion
        / (modulus * range_of_force * sqrt(range_of_force))
    ) ** (2.0 / 3.0)
