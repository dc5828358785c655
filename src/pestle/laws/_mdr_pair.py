r"""Two MDR sides against the flat between them, or one against a wall.

The flat is placed so that both sides carry the same force; its place is state, moved by
the ratio of the sides' stiffnesses.  [Dn] are decisions of the reading notes.
"""

from pestle.laws._base import Geometry, Response
from pestle.laws._mdr_particle import Particle, Sums, sums
from pestle.laws._mdr_quantities import (
    Constants,
    Side,
    State,
    first_side,
    second_side,
)
from pestle.laws._mdr_side import side


def _untouched(a: Side) -> bool:
    return a.depth == 0.0 and a.offset == 0.0 and a.push == 0.0


def contact(
    k: Constants, g: Geometry, s: State, pi_: Particle, pj: Particle
) -> tuple[Response, State, Sums, Sums]:
    """Both sides of a pair against the flat between them."""
    # each side bears W R*/R_i, so that both let go at the pair's 1.5 pi W R*; where all
    # pairs have a W of 0 the compiler leaves out what it would do
    sticks = k.adhesion > 0.0
    ki = first_side(k, k.adhesion * g.radius / g.radius_i if sticks else 0.0)
    kj = second_side(k, k.adhesion * g.radius / g.radius_j if sticks else 0.0)
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
    ki = first_side(k, max(k.adhesion, 0.0))
    grown = g.radius_i - p.initial_radius
    old = -grown if s.share == 0.0 else s.flat_i
    flat = g.overlap - grown
    a = side(ki, p, g.radius_i, flat, old, s.peak_i, s.offset_i, s.radius_i)
    added = sums(ki, p, g, g.radius_i, flat, old, flat - old, a.force, a, 0.0)
    new = 0.0 if _untouched(a) else 1.0
    return (
        Response(a.force, a.radius, a.stiffness, a.stored, 1.0),
        State(new, 1.0, flat, 0.0, a.peak, 0.0, a.offset, 0.0, a.radius, 0.0),
        added,
    )
