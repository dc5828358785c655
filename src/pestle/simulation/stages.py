"""Process steps as phases: what each sets in motion and the condition that ends it.

A phase sets walls and returns conditions (kind, wall, value); the engine checks them in
every step.  The stage ends after its last phase.
"""

from collections.abc import Callable
from math import pi
from typing import TYPE_CHECKING, Any

import numpy as np

from pestle.config.geometry import ShearHead
from pestle.engine import step as st
from pestle.engine import walls as wl
from pestle.errors import InputError
from pestle.simulation.bodies import carry_go, level_go, lift_over, stir_go
from pestle.simulation.entering import come_in
from pestle.simulation.start import harden

if TYPE_CHECKING:
    from pestle.simulation.runner import Runner

Conditions = list[tuple[int, int, float]]
Phase = Callable[["Runner", Any], Conditions]
FOREVER = 1e30


def until(run: "Runner", duration: float) -> tuple[int, int, float]:
    """End after a time [s]."""
    return (st.UNTIL, -1, run.engine.time + duration)


def go(run: "Runner", wall: int, speed: float) -> None:
    """Move a wall at a constant speed along its drive axis [m/s]."""
    run.engine.set_program(wall, np.array([0.0, FOREVER]), np.array([speed, speed]))


def displacement(run: "Runner", wall: int) -> float:
    """Displacement of a wall so far [m]."""
    return float(run.engine.move[wall, wl.DISPLACEMENT])


def appear(run: "Runner", walls: list[int]) -> None:
    """Bring in walls that may be absent so far."""
    run.engine.wall[walls, wl.ACTIVE] = 1.0
    run.engine.rebuild()


def target_force(
    run: "Runner", step: Any, stress: float | None, force: float | None
) -> float | None:
    """Punch force of a target stress or force [N]."""
    if stress is not None:
        if run.case.die is None:
            raise InputError(
                "needs-die",
                f"the step {step.step!r} names a stress, which needs the area of a die",
                hint="give a force, or add [die]",
            )
        return float(stress * run.case.die.area)
    return force


# ------------------------------------------------------------------ fill and rest


def fill_fall(run: "Runner", step: Any) -> Conditions:
    """Let the placed particles fall for as long as the highest needs."""
    gravity = float(np.linalg.norm(run.engine.gravity))
    fall = (2.0 * run.memory["column"] / max(gravity, 1e-12)) ** 0.5
    return [until(run, min(fall, step.max_time))]


def fill_settle(run: "Runner", step: Any) -> Conditions:
    """Wait until the kinetic energy is a share of a fall through one radius."""
    return [(st.AT_REST, -1, little_energy(run)), until(run, step.max_time)]


def little_energy(run: "Runner") -> float:
    """Ten-thousandth of what all particles gain in a fall through one radius [J]."""
    engine = run.engine
    weight = float(engine.vel[:, 3].sum() * np.linalg.norm(engine.gravity))
    return 1e-4 * weight * float(engine.pos[:, 3].mean())


def fill_harden(run: "Runner", step: Any) -> Conditions:
    """Go over to the case's own law and stiffness, and let the overlaps relax."""
    harden(run)
    mean = float(run.engine.pos[:, 3].mean())
    speed = float(np.abs(run.engine.gravity).max() * mean) ** 0.5
    return [until(run, min(0.05 * mean / max(speed, 1e-9), step.max_time))]


# ------------------------------------------------------------------ punches


def press_go(run: "Runner", step: Any) -> Conditions:
    """Lower the punch to the powder, then press."""
    w = run.wall(step.wall)
    if step.wall == "upper_punch":
        run.lower_to_powder(w)
    appear(run, [w])
    go(run, w, step.at)
    force = target_force(run, step, step.to_stress, step.to_force)
    if force is not None:
        return [(st.FORCE_ABOVE, w, force)]
    return [(st.MOVED, w, displacement(run, w) + step.to_displacement)]


def hold_go(run: "Runner", step: Any) -> Conditions:
    """Stand still, or hold a force."""
    w = run.wall(step.wall)
    force = target_force(run, step, step.stress, step.force)
    if force is None:
        run.engine.stop_wall(w)
    else:
        servo(run, w, force)
    return [until(run, step.duration)]


def servo(
    run: "Runner", wall: int, force: float, relax: float = 50.0, fastest: float = 0.0
) -> None:
    """Control a wall: it may move a hundredth of a mean radius in fifty steps.

    It seeks the force within `relax` steps; `fastest` is a speed [m/s] that it may have
    at any rate.
    """
    engine = run.engine
    dt = float(engine.clock[st.DT])
    mean = float(engine.pos[:, 3].mean())
    top = max(2e-4 * mean / dt, fastest)
    engine.hold_force(wall, force, top, relax * dt)


def unload_go(run: "Runner", step: Any) -> Conditions:
    """Draw the punch back until it carries nothing."""
    w = run.wall(step.wall)
    go(run, w, -step.at)
    peak = abs(float(run.engine.total[w, 0:3] @ run.engine.move[w, 0:3]))
    return [(st.FORCE_BELOW, w, 1e-6 * peak)]


def unload_lift(run: "Runner", step: Any) -> Conditions:
    """Lift the punch clear."""
    w = run.wall(step.wall)
    mean = float(run.engine.pos[:, 3].mean())
    lift = mean if step.clearance is None else step.clearance
    return [(st.BACK, w, displacement(run, w) - lift)]


def eject_go(run: "Runner", step: Any) -> Conditions:
    """Take the upper punch away and push with the lower one up to the rim."""
    run.remove("upper_punch")
    w = run.wall("lower_punch")
    go(run, w, step.at)
    rim = run.case.die.height - float(run.engine.wall[w, 3])  # type: ignore[union-attr]
    margin = 0.1 * float(run.engine.pos[:, 3].mean())
    return [(st.MOVED, w, displacement(run, w) + rim + margin)]


def relax_go(run: "Runner", step: Any) -> Conditions:
    """Let everything move with the walls at rest."""
    return [until(run, step.duration)]


def crush_go(run: "Runner", step: Any) -> Conditions:
    """Free the tablet and bring the platens to its sides, each at half the speed."""
    engine = run.engine
    run.remove("upper_punch")
    run.remove("lower_punch")
    run.remove("die")
    engine.gravity = np.zeros(3)
    x, r = engine.pos[:, 0], engine.pos[:, 3]
    core = run.in_tablet()
    ends = float((x - r)[core].min()), float((x + r)[core].max())
    run.memory["crush_diameter"] = ends[1] - ends[0]
    for name, end in zip(("platen_left", "platen_right"), ends, strict=True):
        w = run.wall(name)
        engine.wall[w, 1], engine.wall[w, wl.ACTIVE] = end, 1.0
        go(run, w, 0.5 * step.at)
    engine.rebuild()
    w = run.wall("platen_left")
    approach = 0.5 * step.to * run.memory["crush_diameter"]
    return [(st.MOVED, w, displacement(run, w) + approach)]


# ------------------------------------------------------------------ walls and boxes


def moving_walls(run: "Runner", step: Any) -> list[int]:
    """Numbers of the walls that a `move` step moves."""
    names = step.walls if step.walls is not None else list(run.case.all_walls)
    return [run.wall(name) for name in names]


def move_go(run: "Runner", step: Any) -> Conditions:
    """Set the walls of a `move` step in motion."""
    walls = moving_walls(run, step)
    first = walls[0]
    here = displacement(run, first)
    if step.program is not None:
        times, speeds = (np.array(c, float) for c in zip(*step.program, strict=True))
        for w in walls:
            run.engine.set_program(w, times, speeds)
        return [until(run, float(times[-1]))]
    if step.profile == "sine":
        t = np.linspace(0.0, step.duration, 257)
        shape = np.sin(pi * t / step.duration)
        travel = float(np.sum(0.5 * (shape[1:] + shape[:-1]) * np.diff(t)))
        for w in walls:
            way = step.to - displacement(run, w)
            run.engine.set_program(w, t, way / travel * shape)
        return [until(run, step.duration)]
    target = step.to if step.turn_at is None else step.turn_at
    forward = target >= here
    for w in walls:
        go(run, w, step.at if forward else -step.at)
    return [(st.MOVED if forward else st.BACK, first, target)]


def move_back(run: "Runner", step: Any) -> Conditions:
    """Turn the walls back."""
    walls = moving_walls(run, step)
    if step.turn_at is None or step.program is not None:
        return []
    for w in walls:
        go(run, w, -step.at)
    return [(st.BACK, walls[0], step.back_to)]


def servo_go(run: "Runner", step: Any) -> Conditions:
    """Hold a force for a time."""
    w = run.wall(step.wall)
    if run.engine.wall[w, wl.ACTIVE] == 0.0:
        appear(run, [w])
    force = target_force(run, step, step.stress, step.force)
    assert force is not None
    servo(run, w, force)
    return [until(run, step.duration)]


def deform_go(run: "Runner", step: Any) -> Conditions:
    """Strain the periodic box."""
    run.engine.box[2] = step.strain_rate
    return [until(run, step.duration)]


# ------------------------------------------------------------------ shear cell, heap


def push(run: "Runner", wall: int) -> float:
    """Force of a wall on the particles along its drive axis [N]."""
    return float(run.engine.total[wall, :3] @ run.engine.move[wall, :3])


def shear_head(run: "Runner", step: Any) -> ShearHead:
    """Head that a step turns."""
    head = run.case.walls[step.wall]
    assert isinstance(head, ShearHead)
    return head


def shear_approach(run: "Runner", step: Any) -> Conditions:
    """Bring an absent head down until it carries half of its load."""
    w = run.wall(step.wall)
    if run.engine.wall[w, wl.ACTIVE] > 0.0:
        return []
    lift_over(run, step.wall, 1e-3 * float(run.engine.pos[:, 3].mean()))
    come_in(run, w)
    head = shear_head(run, step)
    go(run, w, step.at or step.angular_speed * head.radius)
    return [(st.FORCE_ABOVE, w, 0.5 * step.stress * head.area)]


def shear_load(run: "Runner", step: Any) -> Conditions:
    """Seek the normal stress with the head at rest, to 2 %."""
    w, head = run.wall(step.wall), shear_head(run, step)
    force, rim = step.stress * head.area, step.angular_speed * head.radius
    servo(run, w, force, relax=3.0, fastest=rim)  # sheared beds shrink and swell
    if push(run, w) < force:
        return [(st.FORCE_ABOVE, w, 0.98 * force)]
    return [(st.FORCE_BELOW, w, 1.02 * force)]


def shear_turn(run: "Runner", step: Any) -> Conditions:
    """Turn the head under the stress."""
    w = run.wall(step.wall)
    run.engine.set_motion(
        w,
        np.array([0.0, FOREVER]),
        np.zeros((2, 3)),
        np.array([[0.0, 0.0, step.angular_speed]] * 2),
    )
    run.memory["shear"] = {
        "wall": step.wall,
        "role": step.role,
        "stress": step.stress,
        "radius": shear_head(run, step).radius,
        "angular_speed": step.angular_speed,
        "start_of_turning": run.engine.time,
    }
    return [until(run, step.duration)]


def lift_go(run: "Runner", step: Any) -> Conditions:
    """Lift the die until its rim is above all particles."""
    engine, w = run.engine, run.wall("die")
    go(run, w, step.at)
    top = float((engine.pos[:, 2] + engine.pos[:, 3]).max())
    rim = float(engine.wall[w, wl.POINT + 2] + engine.wall[w, wl.BOTTOM])
    return [(st.MOVED, w, displacement(run, w) + top - rim)]


def lift_settle(run: "Runner", step: Any) -> Conditions:
    """Take the die away and wait until the heap is at rest.

    Spin does not count: single spheres go on turning about a vertical axis, which no
    friction of a contact point brakes.
    """
    run.remove("die")
    return [(st.STILL, -1, little_energy(run)), until(run, step.max_time)]


PHASES: dict[str, tuple[Phase, ...]] = {
    "fill": (fill_fall, fill_settle, fill_harden),
    "press": (press_go,),
    "hold": (hold_go,),
    "unload": (unload_go, unload_lift),
    "eject": (eject_go,),
    "relax": (relax_go,),
    "crush": (crush_go,),
    "move": (move_go, move_back),
    "servo": (servo_go,),
    "deform": (deform_go,),
    "carry": (carry_go,),
    "stir": (stir_go,),
    "level": (level_go,),
    "shear": (shear_approach, shear_load, shear_turn),
    "lift": (lift_go, lift_settle),
}
