r"""Zunker & Kamrin (2024), MDR: elastic-perfectly plastic adhesive spheres.

Each side of a contact is a particle against a rigid flat, mapped to an elliptic
indenter of height A and width B in a bed of springs (`_mdr`).  The particle's apparent
radius R grows so that plastic flow keeps its volume; a bulk response sets in where the
free surface becomes small.  The flat between two particles is placed so that both sides
carry the same force; its place is state, moved by the ratio of the sides' stiffnesses.

References: W. Zunker, K. Kamrin, J. Mech. Phys. Solids 183 (2024) 105492 (Part I) and
105493 (Part II: bulk response); W. Zunker et al., Powder Technol. (2025) 120972.
The reading notes in the documentation say where we depart from print and why.
"""

from dataclasses import dataclass, field
from math import pi
from typing import ClassVar, NamedTuple

from pestle.errors import InputError
from pestle.laws._base import Geometry, Pair, Response, Solid, register
from pestle.laws._mdr import (
    Particle,
    Side,
    SideConstants,
    Sums,
    hardening,
    release,
    side,
    sums,
    update,
)
from pestle.laws._plot import Drawn


class Constants(NamedTuple):
    """Each side against the flat (suffix i, j); the second side of a wall is unused."""

    modulus_i: float  # E_c [Pa]: composite with an elastic wall
    modulus_j: float
    yield_i: float  # Y [Pa]
    yield_j: float
    poisson_i: float  # nu [-]
    poisson_j: float
    shear_i: float  # G [Pa]
    shear_j: float
    bulk_i: float  # kappa [Pa]
    bulk_j: float
    onset_i: float  # delta_Y / R, the root of (41) [-]
    onset_j: float
    adhesion: float  # work of adhesion of the pair [J/m^2]
    always: float  # radius rule: 0 plastic, 1 eq37


class State(NamedTuple):
    """What a pair remembers; all zero before the first touch."""

    share: float  # part of the approach that moves the flat into side i, loading [-]
    share_back: float  # the same, unloading [-]
    flat_i: float  # displacement of the flat against the initial sphere, delta_o [m]
    flat_j: float
    peak_i: float  # delta_max while below it, -1 while at it [m]
    peak_j: float
    offset_i: float  # c_A of a yielded side, 0 before [m^2]
    offset_j: float
    radius_i: float  # adhered contact radius [m]
    radius_j: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Zunker2024(Drawn):
    """Mechanically derived contact model (MDR) with adhesion, growth and bulk response.

    Parameters
    ----------
    psi_b : float
        Free-surface fraction below which the bulk response acts and R rests [-].
    radius_rule : str
        ``"plastic"`` (growth only while a yielded contact moves inwards at its
        maximum) or ``"eq37"`` (as printed: it can create energy).
    """

    psi_b: float = field(
        default=0.5,
        metadata={"help": "free-surface fraction where the bulk response begins [-]"},
    )
    radius_rule: str = field(
        default="plastic",
        metadata={"help": "growth of R", "choices": ("plastic", "eq37")},
    )

    name: ClassVar[str] = "zunker2024"
    summary: ClassVar[str] = "MDR: elastic-plastic adhesive spheres, large deformation"
    requires: ClassVar[tuple[str, ...]] = ("yield_stress",)
    validity: ClassVar[str] = (
        "E/Y of 6.25 to 200, displacement of a side to half its radius; adhesion with "
        "yielding needs 2 a_c >= 15 r_Ip, (F.7): see pestle.reference.validity"
    )
    citation: ClassVar[str] = (
        "@article{zunker2024, author={Zunker, William and Kamrin, Ken}, "
        "title={A mechanically-derived contact model for adhesive elastic-perfectly "
        "plastic particles. Part I: Utilizing the method of dimensionality reduction}, "
        "journal={Journal of the Mechanics and Physics of Solids}, volume={183}, "
        "pages={105492}, year={2024}, doi={10.1016/j.jmps.2023.105492}}\n"
        "@article{zunker2024b, author={Zunker, William and Kamrin, Ken}, "
        "title={A mechanically-derived contact model for adhesive elastic-perfectly "
        "plastic particles. Part II: Contact under high compaction---modeling a bulk "
        "elastic response}, journal={Journal of the Mechanics and Physics of Solids}, "
        "volume={183}, pages={105493}, year={2024}, doi={10.1016/j.jmps.2023.105493}}"
    )

    def __post_init__(self) -> None:
        """Check the options."""
        if not 0.0 <= self.psi_b < 1.0:
            raise InputError(
                "psi-b-out-of-range",
                f"psi_b {self.psi_b:g} is not a fraction of the particle's surface",
                "law.psi_b",
                "the authors use 0.1 to 0.6",
            )
        if self.radius_rule not in ("plastic", "eq37"):
            raise InputError(
                "unknown-radius-rule",
                f"radius_rule {self.radius_rule!r} is neither 'plastic' nor 'eq37'",
                "law.radius_rule",
            )

    def constants(self, pair: Pair) -> Constants:
        """Reduce two materials to the constants of their two sides."""
        one, two = _side(pair.first, pair), _side(pair.second, pair)
        both = (value for couple in zip(one, two, strict=True) for value in couple)
        always = float(self.radius_rule == "eq37")
        return Constants(*both, pair.work_of_adhesion, always)

    def particle_constants(self, solid: Solid) -> tuple[float, float]:
        """kappa [Pa] and psi_b [-], as `update` reads them."""
        return solid.bulk_modulus, self.psi_b

    def particle(self, radius: float) -> Particle:
        """State of an undeformed particle of a radius [m]."""
        volume = 4 / 3 * pi * radius**3
        return Particle(radius, volume, 1.0, -1.0, *7 * (0.0,))


def _side(solid: Solid, pair: Pair) -> tuple[float, ...]:
    if solid.youngs_modulus == float("inf"):
        return (0.0,) * 6
    flat = pair.second.compliance if pair.wall else 0.0
    modulus = 1.0 / (solid.compliance + flat)
    return (
        modulus,
        solid.yield_stress,
        solid.poisson_ratio,
        solid.shear_modulus,
        solid.bulk_modulus,
        yield_onset(modulus, solid.yield_stress),
    )


def yield_onset(modulus: float, yield_stress: float) -> float:
    """delta_Y / R, the root of (41) [-]; the sphere never yields beyond delta = R."""
    if 4.0 * modulus / (3.0 * pi) < 1.1 * yield_stress:
        return 1e3
    low, high = 0.0, 1.0
    for _ in range(200):  # bisection to the last bit
        x = 0.5 * (low + high)
        pressed = 4.0 * modulus / (3.0 * pi) * x**0.5
        low, high = (low, x) if pressed > yield_stress * hardening(x) else (x, high)
    return high


def _first(k: Constants, part: float) -> SideConstants:
    return SideConstants(
        k.modulus_i,
        k.yield_i,
        k.poisson_i,
        k.shear_i,
        k.bulk_i,
        k.onset_i,
        k.adhesion * part if k.adhesion > 0.0 else 0.0,
        k.always,
    )


def _second(k: Constants, part: float) -> SideConstants:
    return SideConstants(
        k.modulus_j,
        k.yield_j,
        k.poisson_j,
        k.shear_j,
        k.bulk_j,
        k.onset_j,
        k.adhesion * part if k.adhesion > 0.0 else 0.0,
        k.always,
    )


def _untouched(a: Side) -> bool:
    return a.depth == 0.0 and a.offset == 0.0 and a.push == 0.0


def contact(
    k: Constants, g: Geometry, s: State, pi_: Particle, pj: Particle
) -> tuple[Response, State, Sums, Sums]:
    """Both sides of a pair against the flat between them."""
    # each side bears W R*/R_i, so that both let go at the pair's 1.5 pi W R*
    ki = _first(k, g.radius / g.radius_i)
    kj = _second(k, g.radius / g.radius_j)
    grown_i = g.radius_i - pi_.initial_radius
    grown_j = g.radius_j - pj.initial_radius
    fresh = s.share == 0.0
    first_share = k.modulus_j / (k.modulus_i + k.modulus_j)
    old_i = -grown_i if fresh else s.flat_i
    old_j = -grown_j if fresh else s.flat_j
    approach = g.overlap - grown_i - grown_j - old_i - old_j
    loading = approach >= 0.0
    # apart, the flat moves the same way forth and back: where it comes to lie does not
    # depend on how far apart a pair is still looked at
    apart = s.radius_i + s.radius_j + pi_.pressure + pj.pressure == 0.0
    forth = loading or apart
    moved = first_share if fresh else (s.share if forth else s.share_back)
    go_i, go_j = moved * approach, (1.0 - moved) * approach
    flat_i, flat_j = old_i + go_i, old_j + go_j
    a = side(ki, pi_, g.radius_i, flat_i, old_i, s.peak_i, s.offset_i, s.radius_i)
    b = side(kj, pj, g.radius_j, flat_j, old_j, s.peak_j, s.offset_j, s.radius_j)
    # a flat that one side has left cannot be pulled by the other
    open_i = a.radius + a.push == 0.0
    open_j = b.radius + b.push == 0.0
    broken = a.parted + b.parted > 0.0 or open_i or open_j
    force_i = max(a.force, 0.0) if broken else a.force
    force_j = max(b.force, 0.0) if broken else b.force
    near = 1e-12 * (k.modulus_i * g.radius_i + k.modulus_j * g.radius_j)
    up = a.slope + b.slope
    back = a.stiffness + b.stiffness
    held = up > near and back > near
    share = b.slope / up if held else (first_share if fresh else s.share)
    share_back = (
        b.stiffness / back if held else (first_share if fresh else s.share_back)
    )
    # evening out: one side loads while the other unloads, by less than an elastic depth
    inwards = force_j >= force_i
    gives_i = a.slope if inwards else a.stiffness
    gives_j = b.stiffness if inwards else b.slope
    gives = gives_i + gives_j
    way = gives_j / gives if held else 0.5
    force = way * force_i + (1.0 - way) * force_j
    most = abs(approach) + 0.02 * min(a.elastic, b.elastic)
    away = (force_j - force_i) / gives if held else 0.0
    # a side that flows is far softer one way: the whole way at once, else half of it
    relax = 1.0 if loading and a.at_peak + b.at_peak > 0.0 else 0.5
    shift = min(max(relax * away, -most), most)
    # never touched: the flat is placed anew in the next step
    virgin = _untouched(a) and _untouched(b)
    weighed = g.weight * force
    uneven = abs(force_i - force_j)
    sums_i = sums(
        ki, pi_, g, g.radius_i, flat_i + shift, old_i, go_i, weighed, a, uneven
    )
    sums_j = sums(
        kj, pj, g, g.radius_j, flat_j - shift, old_j, go_j, weighed, b, uneven
    )
    stiffness = a.stiffness * b.stiffness / back if held else 0.0
    # energy at the even flat; what a side holds that the other has left is lost
    stored = a.stored + b.stored - 0.5 * away * (force_j - force_i)
    stored = max(stored, 0.0) if force != 0.0 else 0.0
    return (
        Response(
            weighed,
            0.5 * (a.radius + b.radius),
            g.weight * stiffness,
            g.weight * stored,
            1.0,
        ),
        State(
            0.0 if virgin else min(max(share, 1e-9), 1.0 - 1e-9),
            share_back,
            flat_i + shift,
            flat_j - shift,
            a.peak,
            b.peak,
            a.offset,
            b.offset,
            0.0 if open_j or (broken and force_i <= 0.0) else a.radius,
            0.0 if open_i or (broken and force_j <= 0.0) else b.radius,
        ),
        sums_i,
        sums_j,
    )


def wall(
    k: Constants, g: Geometry, s: State, p: Particle
) -> tuple[Response, State, Sums]:
    """One particle against a wall: rigid, or elastic through E_c."""
    ki = _first(k, 1.0)
    grown = g.radius_i - p.initial_radius
    old = -grown if s.share == 0.0 else s.flat_i
    flat = g.overlap - grown
    a = side(ki, p, g.radius_i, flat, old, s.peak_i, s.offset_i, s.radius_i)
    added = sums(ki, p, g, g.radius_i, flat, old, flat - old, a.force, a, 0.0)
    return (
        Response(a.force, a.radius, a.stiffness, a.stored, 1.0),
        State(
            0.0 if _untouched(a) else 1.0,
            1.0,
            flat,
            0.0,
            a.peak,
            0.0,
            a.offset,
            0.0,
            a.radius,
            0.0,
        ),
        added,
    )


def reach(k: Constants, g: Geometry) -> float:
    """Farthest negative overlap at which a pair can still pull [m]."""
    return release(k.modulus_i, k.adhesion, g.radius_i) + (
        release(k.modulus_j, k.adhesion, g.radius_j) if g.radius_j > 0.0 else 0.0
    )


register(
    Zunker2024,
    aliases=("mdr",),
    constants=Constants,
    state=State,
    contact=contact,
    wall=wall,
    reach=reach,
    particle=Particle,
    sums=Sums,
    update=update,
    screened=True,
)
