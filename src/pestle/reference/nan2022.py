r"""Nan, Goh and Rahman (2022): parameters and force law of one contact.

Equation numbers are those of the paper; tags such as [N-02] are our reading notes of
what is printed otherwise (docs/papers/nan2022).  `Contact` holds what is fixed for a
contact, `unloading` what follows from its largest overlap, `respond` is the state
machine (20).  The law of the engine calls the same functions.

Reference: W. Nan, W. P. Goh, M. T. Rahman, Powder Technol. 406 (2022) 117634.
"""

from math import pi, sqrt
from typing import NamedTuple

from pestle.reference.roots import cube_root

WORK_PRINTED = 7.09  # coefficient of (37) as printed [-]
WORK_EXACT = 7.092195971863962  # of the exact JKR work from touch to separation [-]
NAN59, PASHA61, TN64, ENERGY67 = 0.0, 1.0, 2.0, 3.0  # rules of the pull-off force
RULES = ("nan59", "pasha61", "tn64", "energy67")
FREE, ELASTIC, PLASTIC, ADHESIVE = 0.0, 1.0, 2.0, 3.0  # branches of (20)


class Contact(NamedTuple):
    """A contact of given materials and radii. SI units."""

    modulus: float  # E* [Pa]
    radius: float  # R* [m]
    adhesion: float  # Gamma, work of adhesion [J/m^2]
    pressure: float  # p_y, limiting pressure [Pa]
    elastic: float  # k_el, stiffness before yield [N/m]
    plastic: float  # k_p [N/m]
    ratio: float  # k_el/k_cl = k_e/k_c [-]
    pull_off: float  # f_ce, largest tension before yield, (5) [N]
    yield_force: float  # f_y, (28) [N]
    rest: float  # alpha_0, overlap without force before yield, (6) [m]
    yield_overlap: float  # alpha_y, (7) [m]
    flattening: float  # A of (56) [-]
    rule: float  # of the pull-off force, an index of RULES


class Unloading(NamedTuple):
    """What follows from the largest overlap of a contact."""

    overlap: float  # alpha_max, not below alpha_y, (10) [m]
    elastic: float  # k_e, (46) [N/m]
    adhesive: float  # k_c [N/m]
    force: float  # f_max at alpha_max [N]
    rest: float  # alpha_p, overlap without force, (16) [m]
    pull_off: float  # f_cp [N]
    touch: float  # alpha_c0, where a detached contact attaches, (12) [m]
    turn: float  # alpha_cp, overlap of the largest tension, (13) [m]
    leave: float  # alpha_jp, where the contact detaches, (14) [m]
    parting: float  # W5 + W6, work from alpha_p to detachment, (78) [J]


class Answer(NamedTuple):
    """Force of a contact and its new state."""

    force: float  # [N]
    stiffness: float  # k_n of the branch, 0 without contact [N/m]
    stored: float  # what unloading until detachment gives back [J]
    peak: float  # alpha_max, 0 if never yielded or forgotten [m]
    attached: float  # cs: 1 in contact, else 0
    branch: float  # FREE, ELASTIC, PLASTIC or ADHESIVE


def jkr_work(
    modulus: float, radius: float, adhesion: float, coefficient: float = WORK_PRINTED
) -> float:
    r"""Work to part a JKR contact, (37): :math:`7.09(\Gamma^5R^4/E^2)^{1/3}` [J].

    Parameters
    ----------
    modulus, radius, adhesion : float
        E* [Pa], R* [m], Gamma [J/m^2].
    coefficient : float
        7.09 as printed, or `WORK_EXACT` [-].

    Returns
    -------
    float
        Work [J].

    Examples
    --------
    >>> round(jkr_work(1.0, 1.0, 1.0), 9)
    7.09
    """
    number = adhesion / (modulus * radius)
    return coefficient * adhesion * radius**2 * cube_root(number) ** 2


def yield_work(modulus: float, radius: float, pressure: float) -> float:
    """Work up to yield, right side of (27) [J]."""
    return (pi * radius * pressure) ** 5 / (60.0 * modulus**4 * radius**2)


def yield_force_hertz(modulus: float, radius: float, pressure: float) -> float:
    """Yield force f_y0 of Thornton and Ning, (30) [N]."""
    return pi**3 * radius**2 * pressure**3 / (6.0 * modulus**2)


def yield_overlap_hertz(modulus: float, radius: float, pressure: float) -> float:
    """Overlap alpha_y0 at their yield point, (31) [m]."""
    return pi**2 * radius * pressure**2 / (4.0 * modulus**2)


def yield_force(
    modulus: float, radius: float, pressure: float, elastic: float
) -> float:
    """Yield force f_y, (28): the work (27) on a line of stiffness k_el [N]."""
    plain = yield_force_hertz(modulus, radius, pressure)
    return plain * sqrt(1.2 * elastic / (pi * radius * pressure))


def stiffness_ratio(
    modulus: float, radius: float, adhesion: float, elastic: float
) -> float:
    """k_el/k_cl from (36), read as its derivation demands [N-02]; 1 without adhesion.

    Negative where the model has no answer (cohesion-yield number below 0.00115).
    """
    if adhesion <= 0.0:
        return 1.0
    tension = 1.5 * pi * adhesion * radius
    work = jkr_work(modulus, radius, adhesion)
    return (162.0 * work * elastic / (tension * tension) - 17.0) / 56.0


def contact(
    modulus: float,
    radius: float,
    adhesion: float,
    pressure: float,
    elastic: float,
    plastic: float,
    ratio: float,
    rule: float = NAN59,
) -> Contact:
    """Complete a contact from its stiffnesses: (4)-(7), (28), (29), (56).

    Parameters
    ----------
    modulus, radius, adhesion, pressure : float
        E* [Pa], R* [m], Gamma [J/m^2], p_y [Pa].
    elastic, plastic : float
        k_el and k_p [N/m].
    ratio : float
        k_el/k_cl [-], see `stiffness_ratio`.
    rule : float
        Index of `RULES`.

    Returns
    -------
    Contact
        The contact.
    """
    tension = 1.5 * pi * adhesion * radius
    force = yield_force(modulus, radius, pressure, elastic)
    rest = 8.0 / 9.0 * tension / elastic
    return Contact(
        modulus,
        radius,
        adhesion,
        pressure,
        elastic,
        plastic,
        ratio,
        tension,
        force,
        rest,
        rest + force / elastic,
        96.0 / (56.0 * ratio + 17.0),  # [N-05]
        rule,
    )


def pull_off(
    c: Contact, overlap: float, elastic: float, plastic: float, rest: float
) -> float:
    """Largest tension f_cp after an overlap alpha_max, by the rule of the contact [N].

    (59), (61), (64) or (67), each multiplied by f_ce so that it holds without adhesion.
    """
    stiffer = elastic / c.elastic
    if c.rule == NAN59:
        a = c.flattening * c.pull_off
        wide = c.pull_off * (1.125 * c.flattening * c.elastic * rest + c.pull_off)
        return 0.5 * (sqrt(a * a + 4.0 * stiffer * wide) - a)
    if c.rule == PASHA61:
        left = max(rest - c.yield_overlap, 0.0)  # [N-07]
        wide = 1.125 * elastic * c.pull_off * left * max(2.0 - left / c.radius, 0.0)
        new = sqrt(96.0 / 137.0 * wide)
        return new if overlap > c.yield_overlap else c.pull_off
    if c.rule == TN64:
        more = overlap - c.yield_overlap
        above = c.yield_force + elastic * more
        return c.pull_off * above / (c.yield_force + plastic * more)
    return c.pull_off * stiffer * sqrt(stiffer)


def unloading(c: Contact, peak: float) -> Unloading:
    """All that follows from the largest overlap: (10)-(16), (46), Table 4.

    Parameters
    ----------
    c : Contact
        The contact.
    peak : float
        Largest overlap; below alpha_y it counts as alpha_y [m].

    Returns
    -------
    Unloading
        Stiffnesses, forces and overlaps of the unloading lines.
    """
    top = max(peak, c.yield_overlap)
    elastic = c.elastic * sqrt(top / c.yield_overlap)  # (46)
    plastic = min(c.plastic, elastic)
    force = c.yield_force + plastic * (top - c.yield_overlap)
    rest = top - force / elastic if top > c.yield_overlap else c.rest
    tension = pull_off(c, top, elastic, plastic, rest)
    adhesive = elastic / c.ratio
    touch = rest - 8.0 / 9.0 * tension / elastic if top > c.yield_overlap else 0.0
    turn = rest - tension / elastic
    leave = turn - 4.0 / 9.0 * tension / adhesive
    parting = 0.5 * tension * tension / elastic * (1.0 + 56.0 / 81.0 * c.ratio)
    return Unloading(
        top, elastic, adhesive, force, rest, tension, touch, turn, leave, parting
    )


def respond(
    c: Contact, overlap: float, peak: float, attached: float, forget: float
) -> Answer:
    """Force and new state at an overlap: (17)-(20) with detachment and re-attachment.

    Parameters
    ----------
    c : Contact
        The contact.
    overlap : float
        alpha [m].
    peak, attached : float
        State: alpha_max (0: not yielded) [m] and cs.
    forget : float
        A detached contact below this overlap is as new [m]; minus infinity: never.

    Returns
    -------
    Answer
        Force, stiffness, stored energy, new state, branch.
    """
    before = max(peak, c.yield_overlap)
    yields = overlap > before  # [N-11]: not the printed comparison of forces
    u = unloading(c, max(before, overlap))
    on = overlap >= (u.leave if attached > 0.0 else u.touch)
    pulls = overlap <= u.turn
    tension = u.pull_off + u.adhesive * (overlap - u.turn)  # minus (19)
    force = -tension if pulls else u.elastic * (overlap - u.rest)
    given = -0.5 * (overlap - u.leave) * (tension + 5.0 / 9.0 * u.pull_off)
    stored = given if pulls else 0.5 * force * force / u.elastic - u.parting
    stiffness = u.adhesive if pulls else u.elastic
    stiffness = min(c.plastic, u.elastic) if yields else stiffness
    branch = PLASTIC if yields else (ADHESIVE if pulls else ELASTIC)
    kept = overlap if yields else peak
    return Answer(
        force if on else 0.0,
        stiffness if on else 0.0,
        stored if on else 0.0,
        kept if on or overlap >= forget else 0.0,
        1.0 if on else 0.0,
        branch if on else FREE,
    )


def stiffness_ratio_rounded(
    modulus: float, radius: float, adhesion: float, elastic: float
) -> tuple[float, float]:
    """k_el/k_cl with the rounded numbers of (38) and of (39) with (40) [-]."""
    scale = radius * modulus * cube_root(adhesion / (modulus * radius))
    return 0.92 * elastic / scale - 0.3, 1.13 * elastic / (1.23 * scale) - 0.3


def tangential(
    stiffness: float,
    spring: list[float],
    velocity: list[float],
    force: float,
    *,
    friction: float,
    damping: float,
    mass: float,
    cap: str = "abs",
    pull_off: float = 0.0,
) -> tuple[list[float], list[float], bool]:
    """Tangential force, (21), (23), (25), opposing spring and velocity.

    Parameters
    ----------
    stiffness : float
        k_t [N/m], see (22).
    spring, velocity : list of float
        delta_t [m] and V_t [m/s].
    force : float
        Normal force f [N].
    friction, damping : float
        mu [-], gamma of (26) [-].
    mass : float
        m* [kg].
    cap : str
        Limit of friction: ``"abs"`` mu |f|, ``"positive"`` mu max(f, 0), ``"pull_off"``
        mu max(f + f_cp, 0); as printed, (23) pushes along where f < 0 [N-18].
    pull_off : float
        f_cp [N].

    Returns
    -------
    tuple
        Force [N], spring after sliding [m], whether it slides.
    """
    holds = {"abs": abs(force), "positive": force, "pull_off": force + pull_off}
    limit = friction * max(holds[cap], 0.0)
    size = sqrt(sum(x * x for x in spring))
    slides = stiffness * size > limit
    if slides:
        cut = limit / (stiffness * size)
        return [-stiffness * cut * x for x in spring], [cut * x for x in spring], True
    loss = 2.0 * damping * sqrt(mass * stiffness)
    pairs = zip(spring, velocity, strict=True)
    return [-stiffness * x - loss * v for x, v in pairs], list(spring), False
