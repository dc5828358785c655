"""Straight legs of a path: steps, events and the return mapping of the radius.

Plain functions of numbers and arrays, which `_compile.compiled` makes fast.  A point of
the path is an array with a row for each group of flats and the columns below; the
growth R - R_o stands in all rows.
"""

from math import ceil, inf, pi
from typing import Any, NamedTuple

import numpy as np

from pestle.particle.contact import (
    Contact,
    Memory,
    beyond_equator,
    has_reached_yield,
    respond,
    yielded,
)
from pestle.reference import roots, volume
from pestle.reference.mdr import Constants

(
    OVERLAP,
    PENETRATION,
    FORCE,
    RADIUS,
    STATE,
    LARGEST,
    YIELDED,
    YIELD_OVERLAP,
    AREA_OFFSET,
    DISPLACEMENT,
    GROWTH,
) = range(11)
COLUMNS = 11

RULES = ("plastic", "loading", "eq37", "frozen")
PLASTIC, LOADING, EQ37, FROZEN = range(4)

FINE, SINGULAR, EQUATOR, CRUSHED = range(4)
"""How a path ends."""

_SHORTEST = 1e-12  # shortest step, as a part of the leg [-]
_ROUND_OFF = 4e-16  # width of a bisected event, as a part of the leg [-]
_SLOPE_STEP = 1e-6  # step of one-sided derivatives, in radii [-]
_DEEPEST = 80  # bisections that can wait for each other [-]


class Resolution(NamedTuple):
    """How finely a path is resolved, all in initial radii; 0 for round-off."""

    step: float = 0.004  # largest displacement between two checks for events [-]
    event: float = 0.0  # width to which yield, touch and separation are bisected [-]
    maximum: float = 0.0  # the same for the return to the running maximum [-]


class Setting(NamedTuple):
    """What a particle is: numbers only."""

    constants: Constants
    work_of_adhesion: float  # W [J/m^2]
    initial_radius: float  # R_o [m]
    rule: int  # place in RULES
    resolution: Resolution


def follow_path(
    p: Setting, counts: Any, start: Any, targets: Any, out: Any, trouble: Any
) -> int:
    """Follow legs to rows of displacements; how many legs were done.

    Parameters
    ----------
    p : Setting
        The particle.
    counts : array
        Number of flats in every group.
    start : array
        Point where the path begins; (groups, columns).
    targets : array
        Displacements at the end of every leg; (legs, groups) [m].
    out : array
        Takes the points at the ends of the legs; (legs, groups, columns).
    trouble : array
        Takes how the path ended, and the number that explains it.
    """
    point = start.copy()
    for n in range(targets.shape[0]):
        leg = np.empty((point.shape[0], 2))
        for i in range(point.shape[0]):
            leg[i, 0], leg[i, 1] = point[i, DISPLACEMENT], targets[n, i]
        point = run(p, counts, leg, point, trouble)
        out[n] = point
        if trouble[0] == FINE:
            note_crush(p, counts, point, trouble)
        if trouble[0] != FINE:
            return n
    return targets.shape[0]


def run(p: Setting, counts: Any, leg: Any, point: Any, trouble: Any) -> Any:
    """Follow one leg from a point at its start; the point at its end."""
    parts = 0.0  # length of the leg in radii
    for i in range(leg.shape[0]):
        parts = max(parts, abs(leg[i, 1] - leg[i, 0]) / p.initial_radius)
    if parts == 0.0:
        return point
    grid = max(1, ceil(parts / p.resolution.step - 1e-9))
    goals = np.empty(grid + _DEEPEST)
    for i in range(grid):
        goals[i] = 1.0 - i / grid  # the next one last
    waiting, s = grid, 0.0
    while waiting > 0:
        point = yield_where_due(p, point)
        far = goals[waiting - 1]
        found, end = trial(p, counts, leg, point, far, trouble)
        if not found and far - s < _SHORTEST:
            trouble[0] = SINGULAR
        if trouble[0] != FINE:
            return point
        middle = 0.5 * (s + far)
        narrow = 0.0
        if found:
            narrow = width(p, counts, leg, point, end, s, far, parts, trouble)
        if trouble[0] != FINE:
            return point
        narrow = max(narrow / parts, _ROUND_OFF)
        if not found or (far - s > narrow and s < middle < far):
            goals[waiting] = middle
            waiting += 1
        else:
            s, point = far, end
            waiting -= 1
    return yield_where_due(p, point)


def width(
    p: Setting,
    counts: Any,
    leg: Any,
    point: Any,
    end: Any,
    s: float,
    far: float,
    parts: float,
    trouble: Any,
) -> float:
    """Width to which a step must be bisected because of events in it [radii]."""
    before, growing = flags(p, counts, leg, point, s, parts, trouble)
    after, still = flags(p, counts, leg, end, far, parts, trouble)
    event = growing + still == 1 and growing >= 0 and still >= 0
    for i in range(point.shape[0]):
        event = event or before[i, 0] != after[i, 0] or after[i, 1]
        event = event or (before[i, 2] and not after[i, 2])
    if event:
        return p.resolution.event
    for i in range(point.shape[0]):
        largest = point[i, LARGEST]
        inwards = leg[i, 1] > leg[i, 0]
        if inwards and point[i, OVERLAP] < largest < end[i, OVERLAP]:
            return p.resolution.maximum
    return inf


def flags(
    p: Setting, counts: Any, leg: Any, point: Any, s: float, parts: float, trouble: Any
) -> Any:
    """What stays the same between two events, seen in the direction of the leg.

    For every group: whether its cap counts; whether it is intact, but beyond its yield
    pressure; whether it moves outwards, kept at its maximum by a growing R.  And
    whether R grows: 1, 0, or -1 while the radius rule does not act.
    """
    radius = p.initial_radius + point[0, GROWTH]
    ahead = at(p, leg, point, s + _SLOPE_STEP / parts, point[0, GROWTH], trouble)
    counting = active(point)
    growing = -1
    if acts(p, leg, point, ahead):
        next_to = potential(p, counts, ahead, counting, trouble)
        here = potential(p, counts, point, counting, trouble)
        growing = 1 if next_to < here else 0
    found = np.zeros((point.shape[0], 3), np.bool_)
    for i in range(point.shape[0]):
        outwards = leg[i, 1] < leg[i, 0]
        found[i, 0] = counting[i]
        found[i, 1] = has_reached_yield(
            p.constants, radius, point[i, OVERLAP], memory_of(point, i)
        )
        at_maximum = point[i, OVERLAP] >= point[i, LARGEST]
        found[i, 2] = growing == 1 and outwards and at_maximum
    return found, growing


def trial(
    p: Setting, counts: Any, leg: Any, point: Any, s: float, trouble: Any
) -> tuple[bool, Any]:
    """Point at `s` by return mapping, and whether it was found: a step may be long."""
    end = at(p, leg, point, s, point[0, GROWTH], trouble)
    counting = active(point) | active(end)
    if not acts(p, leg, point, end):
        return True, end
    reference = potential(p, counts, point, counting, trouble)
    fall = potential(p, counts, end, counting, trouble) - reference
    if fall >= 0.0:
        return True, end
    given = (p, counts, leg, point, s, counting, reference, trouble)
    first, small = point[0, GROWTH], 1e-7 * p.initial_radius
    most = 2.0 * p.resolution.step * p.initial_radius
    slope = (rise(first + small, given) - fall) / small
    guess = -1.25 * fall / slope if slope > 0.0 else inf
    while guess <= most:
        above = rise(first + guess, given)
        if above >= 0.0:
            root = roots.bracket(first, fall, first + guess, above)
            for _ in range(100):
                root = roots.narrowed(root, 1e-17 * p.initial_radius, 1e-15)
                if root.done:
                    break
                root = roots.measured(root, rise(root.here, given))
            return True, at(p, leg, point, s, root.here, trouble)
        guess *= 2.0
    return False, end


def rise(growth: float, given: Any) -> float:
    """Potential at a growth of the radius over that before the step [m^3]."""
    p, counts, leg, point, s, counting, reference, trouble = given
    end = at(p, leg, point, s, growth, trouble)
    return potential(p, counts, end, counting, trouble) - reference


def at(p: Setting, leg: Any, point: Any, s: float, growth: float, trouble: Any) -> Any:
    """Point at `s` with a given growth, coming from another point."""
    radius = p.initial_radius + growth
    end = np.empty_like(point)
    for i in range(point.shape[0]):
        d = leg[i, 1] if s == 1.0 else leg[i, 0] + s * (leg[i, 1] - leg[i, 0])
        before = memory_of(point, i)
        contact = respond(p.constants, p.work_of_adhesion, radius, d + growth, before)
        if beyond_equator(radius, contact) and trouble[0] == FINE:
            trouble[0], trouble[1], trouble[2] = EQUATOR, contact.overlap, radius
        put(end, i, contact)
        end[i, DISPLACEMENT], end[i, GROWTH] = d, growth
    return end


def potential(
    p: Setting, counts: Any, point: Any, counting: Any, trouble: Any
) -> float:
    """Geometric plus elastically lost volume, less the initial one [m^3]."""
    r_o, u = p.initial_radius, point[0, GROWTH]
    radius = r_o + u
    shell = 4.0 / 3.0 * pi * u * (radius * radius + radius * r_o + r_o * r_o)
    caps = 0.0
    for i in range(point.shape[0]):
        if counting[i]:
            caps += counts[i] * volume.cap_volume(point[i, OVERLAP], radius)
    note_crush(p, counts, point, trouble)
    work = virial(p, counts, point)
    lost = volume.lost_volume_within(work, r_o, bulk=p.constants.bulk)
    return shell - caps + lost


def virial(p: Setting, counts: Any, point: Any) -> float:
    """Forces times branch lengths R_o - delta_o [J]."""
    total = 0.0
    for i in range(point.shape[0]):
        branch = p.initial_radius - point[i, DISPLACEMENT]
        total += counts[i] * point[i, FORCE] * branch
    return total


def note_crush(p: Setting, counts: Any, point: Any, trouble: Any) -> None:
    """Note forces that the particle's volume cannot balance."""
    work = virial(p, counts, point)
    ratio = volume.virial_ratio(work, p.initial_radius, bulk=p.constants.bulk)
    if ratio > 1.0 and trouble[0] == FINE:
        trouble[0], trouble[1] = CRUSHED, work


def active(point: Any) -> Any:
    """Tell the caps of which contacts count: touches, adheres or is outside R."""
    found = np.empty(point.shape[0], np.bool_)
    for i in range(point.shape[0]):
        touches = point[i, PENETRATION] > 0.0 or point[i, RADIUS] > 0.0
        found[i] = touches or point[i, OVERLAP] <= 0.0
    return found


def acts(p: Setting, leg: Any, point: Any, end: Any) -> bool:
    """Tell whether the radius rule acts between two points."""
    if p.rule in (EQ37, FROZEN):
        return p.rule == EQ37
    for i in range(point.shape[0]):
        inwards = leg[i, 1] > leg[i, 0]
        plastic = point[i, YIELDED] > 0.0 or p.rule == LOADING
        if inwards and plastic and end[i, OVERLAP] > point[i, LARGEST]:
            return True
    return False


def yield_where_due(p: Setting, point: Any) -> Any:
    """Make the contacts yield that have reached their yield pressure."""
    radius = p.initial_radius + point[0, GROWTH]
    for i in range(point.shape[0]):
        overlap, memory = point[i, OVERLAP], memory_of(point, i)
        if has_reached_yield(p.constants, radius, overlap, memory):
            memory = yielded(p.constants, radius, memory)
            point = point.copy()
            new = respond(p.constants, p.work_of_adhesion, radius, overlap, memory)
            put(point, i, new)
    return point


def memory_of(point: Any, i: int) -> Memory:
    """What the contact of a group of flats remembers."""
    return Memory(
        point[i, LARGEST],
        point[i, RADIUS],
        point[i, YIELDED] > 0.0,
        point[i, YIELD_OVERLAP],
        point[i, AREA_OFFSET],
    )


def put(point: Any, i: int, contact: Contact) -> None:
    """Write a contact into the row of its group."""
    memory = contact.memory
    point[i, OVERLAP], point[i, PENETRATION] = contact.overlap, contact.penetration
    point[i, FORCE], point[i, RADIUS] = contact.force, contact.radius
    point[i, STATE], point[i, LARGEST] = contact.state.value, memory.largest
    point[i, YIELDED] = 1.0 if memory.yielded else 0.0
    point[i, YIELD_OVERLAP] = memory.yield_overlap
    point[i, AREA_OFFSET] = memory.area_offset
