"""What LAMMPS cannot do of a case, each in a sentence that names it."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from pestle.errors import InputError

if TYPE_CHECKING:
    from pestle.config import Case
    from pestle.config.contacts import PairProperties
    from pestle.config.geometry import CylinderWall, PlaneWall

LAWS = ("hertz", "jkr", "zunker2024")
"""Laws of ours that LAMMPS has."""

REASONS = {
    "fill": "LAMMPS has no filling with softened particles: fill with pestle first, "
    "write the particles to a file and read that",
    "unload": "LAMMPS' walls here follow a prescribed motion, and an unload ends at a "
    "force: give the way back as a move",
    "eject": "an ejection takes walls away, which LAMMPS' walls here cannot",
    "crush": "a crush takes walls away, which LAMMPS' walls here cannot",
    "servo": "LAMMPS' walls here follow a prescribed motion and hold no force",
    "deform": "LAMMPS' walls here move, its box does not",
    "carry": "carry moves a wall as a body, which LAMMPS' walls here do not",
    "stir": "stir turns a wall as a body, which LAMMPS' walls here do not",
    "shear": "shear turns a wall under a force, which LAMMPS' walls here do not",
    "lift": "a lift takes the die away, which LAMMPS' walls here cannot",
    "level": "LAMMPS takes no particles away here: level with pestle first",
}


def check(case: "Case") -> None:
    """Refuse a case that LAMMPS cannot run.

    Raises
    ------
    InputError
        One for each reason, the others attached to the first.
    """
    found = [
        InputError("lammps-cannot", what, where, "leave out --engine lammps")
        for what, where in reasons(case)
    ]
    if found:
        found[0].others = tuple(found[1:])
        raise found[0]


def reasons(case: "Case") -> Iterator[tuple[str, str]]:
    """Reasons, and the keys that they are about."""
    if case.law.name not in LAWS:
        known = ", ".join(LAWS)
        yield f"LAMMPS does not have the law {case.law.name} (it has {known})", "law"
    if case.particles[0].file is None:
        what = "LAMMPS reads particles from a file; it places none by our rules"
        yield what + " and cannot go on from a run of ours", "particles"
    if case.box is not None:
        yield "our periodic box is not translated for LAMMPS", "box"
    yield from _walls(case)
    yield from _pairs(case)
    if case.law.name == "zunker2024":
        yield from _mdr(case)
    for number, step in enumerate(case.process):
        where = f"process.{step.place(number)}"
        if step.step in REASONS:
            yield REASONS[step.step], where
        elif step.step == "press":
            if step.to_displacement is None:
                what = "LAMMPS' walls here follow a prescribed motion, and this press"
                yield f"{what} ends at a stress or force: give a displacement", where
            if number and case.process[number - 1].step not in ("press", "hold"):
                what = "LAMMPS cannot lower the punch to where the powder ends"
                yield f"{what} after another step: press first", where
        elif step.step == "hold" and (step.stress or step.force):
            yield REASONS["servo"], where


def walls_of(case: "Case") -> "dict[str, PlaneWall | CylinderWall]":
    """Walls of a case that LAMMPS can run, by name."""
    from pestle.config.geometry import CylinderWall, PlaneWall

    return {
        name: wall
        for name, wall in case.all_walls.items()
        if isinstance(wall, PlaneWall | CylinderWall)
    }


def _walls(case: "Case") -> Iterator[tuple[str, str]]:
    for name, wall in case.all_walls.items():
        if wall.kind not in ("plane", "cylinder"):
            what = f"LAMMPS' walls here are planes and cylinders, the wall {name} is of"
            yield f"{what} kind {wall.kind}", f"walls.{name}.kind"
        along = [abs(c) > 1.0 - 1e-12 for c in getattr(wall, "axis", ())]
        if wall.kind == "cylinder" and not any(along):
            what = f"LAMMPS' cylinders lie along x, y or z, the wall {name} does not"
            yield what, f"walls.{name}.axis"


def quarter_at_walls(inside: "PairProperties", outside: "PairProperties") -> bool:
    """Whether a wall has the damping that LAMMPS' MDR gives it by that of the pairs."""
    if inside.damping_ratio is None or outside.damping_ratio is None:
        return False
    return outside.damping_ratio == 0.25 * inside.damping_ratio


def _pairs(case: "Case") -> Iterator[tuple[str, str]]:
    others = [*case.powders, *sorted({w.material for w in case.all_walls.values()})]
    for powder in case.powders:
        for other in others:
            pair = case.pair(powder, other)
            where = f"contacts, {powder} - {other}"
            if pair.rolling_friction > 0.0:
                what = "LAMMPS' rolling spring does not follow the contact radius"
                yield f"{what} as ours does: rolling friction", where
            if case.law.name == "jkr" and (pair.restitution or 0.0) < 1.0:
                if pair.damping_ratio == 0.0:
                    continue
                what = "LAMMPS has no damping by the stiffness of a JKR contact"
                yield f"{what}: set damping_ratio = 0", where
            if case.law.name == "hertz" and (pair.damping_ratio or 0.0) >= 0.91:
                what = "LAMMPS states damping by a restitution, and none is as low"
                yield f"{what} as damping_ratio {pair.damping_ratio:g}", where


def _mdr(case: "Case") -> Iterator[tuple[str, str]]:
    if case.law.options.get("radius_rule", "plastic") != "plastic":
        yield "LAMMPS' MDR has one rule of growth, not eq37", "law.radius_rule"
    if len(case.powders) > 1:
        yield "LAMMPS' MDR has one material for all particles", "particles"
    for name in sorted({w.material for w in case.all_walls.values()}):
        if not case.materials[name].rigid:
            yield f"LAMMPS' MDR has rigid walls, {name} is elastic", f"materials.{name}"
    powder = case.powders[0]
    if case.materials[powder].poisson_ratio == 0.5:
        yield "LAMMPS' MDR needs a Poisson ratio below 0.5", f"materials.{powder}"
    inside = case.pair(powder, powder)
    for name in sorted({w.material for w in case.all_walls.values()}):
        outside = case.pair(powder, name)
        damping = ("restitution", "damping_ratio")
        same = all(getattr(inside, k) == getattr(outside, k) for k in damping)
        if not same and not quarter_at_walls(inside, outside):
            what = (
                "LAMMPS' MDR has one damping, at walls a quarter of it in our terms; "
                f"{name} has another than the particles"
            )
            yield what, f"contacts, {powder} - {name}"
