"""Checks of walls against each other, the die and the sizes of the particles."""

from collections.abc import Iterator
from itertools import combinations
from math import sqrt
from typing import TYPE_CHECKING

from pestle.config.base import problem
from pestle.config.geometry import AnyWall, CylinderWall, PlaneWall, Vector

if TYPE_CHECKING:
    from pestle.config.case import Case

RESERVED = ("die", "lower_punch", "upper_punch", "platen_left", "platen_right")
"""Names of walls that a die makes."""

_PARALLEL = 1e-9


def check_geometry(case: "Case") -> None:
    """Refuse walls that clash, leave no room or face away from the powder."""
    for name in case.walls:
        if name in RESERVED:
            raise problem(
                "contradiction",
                f'the wall name "{name}" belongs to the die',
                "choose another name",
                ("walls", name),
            )
    _check_die_size(case)
    room = 2.0 * _smallest_radius(case)
    for (one, first), (two, second) in combinations(case.all_walls.items(), 2):
        named = two if two in case.walls else one
        for what, hint in _clashes(one, first, two, second, room):
            key = ("walls", named) if case.walls else ("die", "height")
            raise problem("walls-overlap", what, hint, key)
    _check_box(case)


def _smallest_radius(case: "Case") -> float:
    return min((g.radius.minimum for g in case.particles if g.radius), default=0.0)


def _largest_radius(case: "Case") -> float:
    return max((g.radius.maximum for g in case.particles if g.radius), default=0.0)


def _check_die_size(case: "Case") -> None:
    largest = _largest_radius(case)
    if case.die is None:
        return
    for key, size in (("radius", case.die.radius), ("height", case.die.height / 2)):
        if size < largest:
            raise problem(
                "die-too-small",
                f"die {key} {getattr(case.die, key):g} m: a particle of radius "
                f"{largest:g} m does not fit in",
                "check the units of die and particles",
                ("die", key),
            )


def _check_box(case: "Case") -> None:
    largest = _largest_radius(case)
    if case.box is None:
        return
    for number, length in enumerate(case.box.lengths):
        if length < 4.0 * largest:
            raise problem(
                "box-too-small",
                f"box edge {length:g} m is below two diameters of the largest "
                f"particle ({4 * largest:g} m)",
                "a particle would touch its own image",
                ("box", "lengths", number),
            )


def _clashes(
    one: str,
    first: AnyWall,
    two: str,
    second: AnyWall,
    room: float,
) -> Iterator[tuple[str, str]]:
    """Describe what is wrong with two walls, if anything."""
    if isinstance(first, PlaneWall) and isinstance(second, PlaneWall):
        yield from _planes(one, first, two, second, room)
    elif isinstance(first, CylinderWall) and isinstance(second, CylinderWall):
        if first == second:
            yield f'the walls "{one}" and "{two}" are the same', "remove one"
    elif isinstance(first, PlaneWall) and isinstance(second, CylinderWall):
        yield from _plane_and_cylinder(one, first, two, second, room)
    elif isinstance(first, CylinderWall) and isinstance(second, PlaneWall):
        yield from _plane_and_cylinder(two, second, one, first, room)


def _planes(
    one: str, first: PlaneWall, two: str, second: PlaneWall, room: float
) -> Iterator[tuple[str, str]]:
    cosine = _dot(first.normal, second.normal)
    gap = _dot(first.normal, _minus(second.point, first.point))
    if cosine > 1.0 - _PARALLEL and abs(gap) <= _PARALLEL * (1.0 + abs(gap)):
        yield f'the walls "{one}" and "{two}" are the same plane', "remove one"
    if cosine < -1.0 + _PARALLEL and gap <= room:
        yield (
            f'the walls "{one}" and "{two}" overlap or face away from each other: '
            f"the room between them is {gap:g} m",
            "a normal points into the powder",
        )


def _plane_and_cylinder(
    one: str, plane: PlaneWall, two: str, cylinder: CylinderWall, room: float
) -> Iterator[tuple[str, str]]:
    """Room left in a cylinder by a plane: its farthest point in front of the plane."""
    along = _dot(plane.normal, cylinder.axis)
    start = _dot(plane.normal, _minus(cylinder.point, plane.point))
    ends = max(start + along * cylinder.bottom, start + along * cylinder.top)
    depth = ends + cylinder.radius * sqrt(max(0.0, 1.0 - along**2))
    if depth <= room:
        yield (
            f'the wall "{one}" leaves no room in the cylinder "{two}"',
            "a normal points into the powder",
        )


def _dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _minus(a: Vector, b: Vector) -> Vector:
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]
