"""Checks of the process: what each step needs and what must come before it."""

from typing import TYPE_CHECKING

from pestle.config.base import problem
from pestle.config.geometry import CylinderWall, ShearHead
from pestle.config.process import (
    Crush,
    Deform,
    Eject,
    Fill,
    Hold,
    Move,
    Press,
    Servo,
    Unload,
)
from pestle.config.process_bodies import Carry, Lift, Shear, Stir
from pestle.errors import did_you_mean

if TYPE_CHECKING:
    from pestle.config.case import Case

_Driven = Press | Hold | Unload | Servo


def check_process(case: "Case") -> None:
    """Refuse steps that cannot be carried out in this case."""
    _check_names(case)
    _check_fill(case)
    ejected = any(group.start_from is not None for group in case.particles)
    for number, stage in enumerate(case.process):
        key = ("process", stage.place(number))
        if isinstance(stage, Fill | Eject | Crush | Lift) and case.die is None:
            raise problem(
                "needs-die",
                f'the step "{stage.step}" needs a [die]',
                "add [die] with radius, height and material",
                (*key, "step"),
            )
        if isinstance(stage, _Driven):
            _check_wall(case, stage, key)
        if isinstance(stage, Move):
            _check_move(case, stage, key)
        if isinstance(stage, Carry | Stir | Shear):
            _check_body(case, stage, key)
        if isinstance(stage, Deform) and case.box is None:
            what = 'the step "deform" needs a periodic [box]'
            raise problem("needs-box", what, "add [box]", (*key, "step"))
        if isinstance(stage, Crush) and not ejected:
            raise problem(
                "wrong-order",
                'the step "crush" needs an ejected tablet',
                'put a step "eject" before it',
                (*key, "step"),
            )
        ejected = ejected or isinstance(stage, Eject)


def _check_names(case: "Case") -> None:
    names = [stage.name for stage in case.process if stage.name is not None]
    for number, stage in enumerate(case.process):
        if stage.name is not None and names.count(stage.name) > 1:
            what = f'two steps have the name "{stage.name}"'
            key = "process", stage.place(number), "name"
            raise problem("contradiction", what, None, key)


def _check_fill(case: "Case") -> None:
    fills = [n for n, stage in enumerate(case.process) if isinstance(stage, Fill)]
    if any(number > 0 for number in fills):
        raise problem(
            "wrong-order",
            'the step "fill" comes first or not at all',
            "an earlier run can be continued with start_from",
            ("process", case.process[fills[-1]].place(fills[-1]), "step"),
        )
    generated = case.is_generated
    if generated and case.die is not None and case.box is None and not fills:
        raise problem(
            "missing-key",
            "nothing places the particles: the process has no step fill",
            'begin with [[process]] step = "fill"',
            ("process",),
        )
    if fills and not generated:
        raise problem(
            "contradiction",
            'the step "fill" needs particles to generate, but they are read',
            "remove the step, or give count and radius",
            ("process", 0, "step"),
        )


def _check_wall(case: "Case", stage: _Driven, key: tuple[str | int, ...]) -> None:
    walls = case.all_walls
    if stage.wall not in walls:
        what = f'there is no wall "{stage.wall}" for the step "{stage.step}"'
        hint = did_you_mean(stage.wall, walls) if walls else "add a [die] or [walls.*]"
        raise problem("unknown-wall", what, hint, (*key, "wall"))
    if isinstance(walls[stage.wall], CylinderWall):
        what = f'the wall "{stage.wall}" is a cylinder; only planes are driven'
        raise problem("wrong-wall", what, None, (*key, "wall"))
    stress = getattr(stage, "to_stress", None) or getattr(stage, "stress", None)
    if stress is not None and (case.die is None or stage.wall in case.walls):
        raise problem(
            "needs-die",
            f'a stress needs the area of a die, which "{stage.wall}" does not have',
            "give a force instead",
            (*key, "to" if isinstance(stage, Press) else "stress"),
        )


_KINDS = {
    "carry": ("mesh", "blade", "shear_head"),
    "stir": ("blade",),
    "shear": ("shear_head",),
}


def _check_body(
    case: "Case", stage: Carry | Stir | Shear, key: tuple[str | int, ...]
) -> None:
    kinds = _KINDS[stage.step]
    wall = case.walls.get(stage.wall)
    if wall is None:
        what = f'there is no wall "{stage.wall}" for the step "{stage.step}"'
        hint = did_you_mean(stage.wall, case.walls) if case.walls else "add [walls.*]"
        raise problem("unknown-wall", what, hint, (*key, "wall"))
    if wall.kind not in kinds:
        what = f'the wall "{stage.wall}" is a {wall.kind}; "{stage.step}" moves a '
        raise problem("wrong-wall", what + " or a ".join(kinds), None, (*key, "wall"))
    if stage.step == "shear" and isinstance(wall, ShearHead) and wall.facing == "up":
        what = f'the wall "{stage.wall}" faces up; "shear" turns one that faces down'
        raise problem("wrong-wall", what, None, (*key, "wall"))


def _check_move(case: "Case", stage: Move, key: tuple[str | int, ...]) -> None:
    walls = case.all_walls
    if not walls:
        what = 'the step "move" needs walls'
        raise problem("unknown-wall", what, "add [walls.*]", (*key, "walls"))
    for place, name in enumerate(stage.walls or ()):
        if name not in walls:
            what = f'there is no wall "{name}" to move'
            hint = did_you_mean(name, walls)
            raise problem("unknown-wall", what, hint, (*key, "walls", place))
