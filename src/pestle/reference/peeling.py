r"""Adhesion of the elliptical MDR indenter under displacement control.

Springs stick to the indenter and detach once stretched by
:math:`\Delta l(a) = \sqrt{2\pi a W/E^*}`, Eq. (11).  W is the work of adhesion of the
pair [J/m^2] (the paper's Delta gamma).  States, Section 6 with the sign of (46):
w = penetration - g(a) is zero or positive (1), between -Delta l and 0 (2: the contact
radius stays), or would fall below -Delta l (3: the contact peels).

Equation numbers: Zunker and Kamrin, J. Mech. Phys. Solids 183 (2024) 105492.
"""

from enum import IntEnum
from math import pi, sqrt
from typing import Literal, NamedTuple

from pestle.reference import ellipse, roots
from pestle.reference.ellipse import Ellipse

Peeling = tuple[Ellipse, float, float, float]
"""Indenter, penetration [m], E* [Pa] and work of adhesion [J/m^2]."""


class Peel(IntEnum):
    """State of an adhesive contact, Section 6."""

    SEPARATED = 0
    NO_TENSION = 1
    HELD = 2
    PEELING = 3


class Adhered(NamedTuple):
    """Answer of an adhesive contact."""

    force: float  # compression positive [N]
    radius: float  # contact radius, to be remembered [m]
    state: Peel


def detachment_length(
    radius: float, *, modulus: float, work_of_adhesion: float
) -> float:
    r"""Stretch at which the outermost spring detaches, Eq. (11).

    Parameters
    ----------
    radius : float
        Contact radius a [m].
    modulus, work_of_adhesion : float
        E* [Pa] and work of adhesion [J/m^2].

    Returns
    -------
    float
        Delta l [m].

    Examples
    --------
    >>> round(detachment_length(0.5, modulus=1.0, work_of_adhesion=1.0), 6)
    1.772454
    """
    return sqrt(2.0 * pi * radius * (work_of_adhesion / modulus))


def critical_radius(
    shape: Ellipse,
    *,
    modulus: float,
    work_of_adhesion: float,
    control: Literal["force", "displacement"] = "displacement",
) -> float:
    r"""Contact radius below which no peeling equilibrium is stable, Eq. (15).

    Root of the cubic :math:`a^3 + k a^2 = k B^2/4`,
    :math:`k = \xi^2 \pi W B^2/(2E^*A^2)`, by Newton's method from above.

    Parameters
    ----------
    shape : Ellipse
        Indenter.
    modulus, work_of_adhesion : float
        E* [Pa] and work of adhesion [J/m^2].
    control : {"force", "displacement"}
        What is prescribed: xi = 3 or 1.

    Returns
    -------
    float
        a_c [m], below B/2.

    Examples
    --------
    >>> k = {"modulus": 22000.0, "work_of_adhesion": 1.0}
    >>> round(critical_radius(Ellipse(4.0, 2.0), **k), 7)
    0.0261284
    """
    if work_of_adhesion == 0.0:
        return 0.0
    half = 0.5 * shape.width
    xi = 3.0 if control == "force" else 1.0
    aspect = shape.width / shape.height
    k = (
        xi**2 * pi * (work_of_adhesion / modulus) * aspect**2 / (2.0 * half)
    )  # in half-widths
    y = min(1.0, k ** (1.0 / 3.0))
    for _ in range(100):
        step = (y * y * (y + k) - k) / (y * (3.0 * y + 2.0 * k))
        y -= step
        if abs(step) <= 1e-16 * y:
            break
    return half * y


def force(
    shape: Ellipse, penetration: float, radius: float, *, modulus: float
) -> float:
    r"""Force of an adhered contact, Eqs. (46), (47).

    .. math:: F = F_{na}(g(a)) + 2E^*a(\delta_e - g(a))

    Parameters
    ----------
    shape : Ellipse
        Indenter.
    penetration : float
        Depth of the tip in the springs [m].
    radius : float
        Contact radius a [m].
    modulus : float
        E* [Pa].

    Returns
    -------
    float
        Force, tension negative [N].

    Examples
    --------
    >>> round(force(Ellipse(4.0, 2.0), 0.005, 0.0998749217771909, modulus=22000.0), 6)
    7.338841
    """
    gap = ellipse.profile(shape, radius)
    pressed = ellipse.force(shape, gap, modulus=modulus)
    return pressed + 2.0 * modulus * radius * (penetration - gap)


def peel(
    shape: Ellipse,
    penetration: float,
    radius: float,
    *,
    modulus: float,
    work_of_adhesion: float,
) -> float | None:
    r"""Radius to which a contact peels, Eq. (48): the largest root below `radius`.

    Parameters
    ----------
    shape : Ellipse
        Indenter.
    penetration : float
        Depth of the tip in the springs [m].
    radius : float
        Contact radius before [m].
    modulus, work_of_adhesion : float
        E* [Pa] and work of adhesion [J/m^2].

    Returns
    -------
    float or None
        Root of ``penetration + detachment_length(a) = profile(a)`` in [a_c, radius]
        [m]; None if the contact separates.

    Examples
    --------
    >>> k = {"modulus": 22000.0, "work_of_adhesion": 1.0}
    >>> peel(Ellipse(4.0, 2.0), -0.1, 0.1, **k) is None
    True
    """
    given = (shape, penetration, modulus, work_of_adhesion)
    return _peeled(radius, given) or None


def _peeled(radius: float, given: Peeling) -> float:
    """Radius to which a contact peels, 0 if it separates [m]."""
    shape, penetration, modulus, work_of_adhesion = given
    if work_of_adhesion == 0.0:
        return ellipse.contact_radius(shape, penetration)  # 0 without penetration
    lowest = critical_radius(
        shape,
        modulus=modulus,
        work_of_adhesion=work_of_adhesion,
        control="displacement",
    )

    at_lowest = _edge_excess(lowest, given)
    if radius <= lowest or at_lowest > 0.0:
        return 0.0
    root = roots.bracket(lowest, at_lowest, radius, _edge_excess(radius, given))
    for _ in range(200):
        root = roots.narrowed(root, 1e-16 * shape.width, 1e-15)
        if root.done:
            break
        root = roots.measured(root, _edge_excess(root.here, given))
    return root.here


def _edge_excess(a: float, given: Peeling) -> float:
    """Stretch of the outermost spring beyond what holds it, zero in Eq. (48) [m]."""
    shape, penetration, modulus, work_of_adhesion = given
    length = detachment_length(a, modulus=modulus, work_of_adhesion=work_of_adhesion)
    return ellipse.profile(shape, a) - length - penetration


def adhere(
    shape: Ellipse,
    penetration: float,
    radius: float,
    *,
    modulus: float,
    work_of_adhesion: float,
) -> Adhered:
    """Force, contact radius and state of an adhesive contact, Section 6.

    Parameters
    ----------
    shape : Ellipse
        Indenter.
    penetration : float
        Depth of the tip in the springs [m].
    radius : float
        Contact radius remembered from before, 0 if detached [m].
    modulus, work_of_adhesion : float
        E* [Pa] and work of adhesion [J/m^2].

    Returns
    -------
    Adhered
        Force [N], contact radius [m] and state.

    Examples
    --------
    >>> k = {"modulus": 22000.0, "work_of_adhesion": 1.0}
    >>> adhere(Ellipse(4.0, 2.0), 0.0, 0.1, **k).state.name
    'PEELING'
    """
    pressed = ellipse.contact_radius(shape, penetration)
    if penetration > 0.0 and pressed >= radius:
        value = ellipse.force(shape, penetration, modulus=modulus)
        return Adhered(value, pressed, Peel.NO_TENSION)
    held = min(radius, 0.5 * shape.width)
    if held <= 0.0:
        return Adhered(0.0, 0.0, Peel.SEPARATED)
    stretch = ellipse.profile(shape, held) - penetration
    state = Peel.HELD
    if stretch > detachment_length(
        held, modulus=modulus, work_of_adhesion=work_of_adhesion
    ):
        state = Peel.PEELING
        held = _peeled(held, (shape, penetration, modulus, work_of_adhesion))
        if held == 0.0:
            return Adhered(0.0, 0.0, Peel.SEPARATED)
    return Adhered(force(shape, penetration, held, modulus=modulus), held, state)


class PullOff(NamedTuple):
    """Unloading of an adhered contact to separation under displacement control."""

    force: float  # largest tension, negative [N]
    penetration: float  # where it acts [m]
    radius: float  # contact radius there [m]
    force_separation: float  # force at the instability [N]
    penetration_separation: float  # where that happens [m]
    radius_separation: float  # contact radius there [m]


def pull_off(
    shape: Ellipse, radius: float, *, modulus: float, work_of_adhesion: float
) -> PullOff:
    """Pull-off force and separation of a contact, in closed form.

    A contact held at a radius below a critical one never reaches that: it keeps its
    radius until its edge detaches.

    Parameters
    ----------
    shape : Ellipse
        Indenter.
    radius : float
        Adhered contact radius at the start of unloading [m].
    modulus, work_of_adhesion : float
        E* [Pa] and work of adhesion [J/m^2].

    Returns
    -------
    PullOff
        Largest tension and separation.

    Examples
    --------
    >>> result = pull_off(Ellipse(4.0, 2.0), 0.2, modulus=22000.0, work_of_adhesion=1.0)
    >>> round(result.force, 6), round(result.force_separation, 6)
    (-4.708215, -2.617172)
    """
    values: list[float] = []
    for control in ("force", "displacement"):
        critical = critical_radius(
            shape,
            modulus=modulus,
            work_of_adhesion=work_of_adhesion,
            control=control,
        )
        a = min(radius, critical)
        length = detachment_length(
            a, modulus=modulus, work_of_adhesion=work_of_adhesion
        )
        depth = ellipse.profile(shape, a) - length
        values += [force(shape, depth, a, modulus=modulus), depth, a]
    return PullOff(*values)
