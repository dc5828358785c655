"""Steps that move bodies of triangles, and the levelling of a bed."""

from math import cos, sin
from typing import TYPE_CHECKING, Any

import numpy as np

from pestle.config.geometry import BladeWall
from pestle.engine import step as st
from pestle.engine import walls as wl
from pestle.errors import InputError
from pestle.simulation.entering import come_in
from pestle.simulation.start import begin_ledger

if TYPE_CHECKING:
    from pestle.simulation.runner import Runner

Conditions = list[tuple[int, int, float]]


def carry_go(run: "Runner", step: Any) -> Conditions:
    """Move and turn a body by its program."""
    w = run.wall(step.wall)
    come_in(run, w)
    rows = np.array(step.program, float)
    run.engine.set_motion(w, rows[:, 0], rows[:, 1:4], rows[:, 4:7])
    return [(st.UNTIL, -1, run.engine.time + float(rows[-1, 0]))]


def surface(run: "Runner") -> float:
    """Height of the powder: as levelled, else the top of the highest particle [m]."""
    if "surface" not in run.memory:
        tops = run.engine.pos[:, 2] + run.engine.pos[:, 3]
        run.memory["surface"] = float(tops.max())
    return float(run.memory["surface"])


def depth(run: "Runner", name: str) -> float:
    """Depth of a body's lowest point below the surface [m]; it turns about z alone."""
    vertices, _ = run.case.surface(name)
    w = run.wall(name)
    lowest = float(run.engine.wall[w, wl.POINT + 2] + vertices[:, 2].min())
    return surface(run) - lowest


def lift_over(run: "Runner", name: str, clearance: float) -> None:
    """Put a body that faces down so high above the surface [m]."""
    w, lift = run.wall(name), depth(run, name) + clearance
    run.engine.wall[w, wl.POINT + 2] += lift
    run.engine.move[w, wl.DISPLACEMENT] -= lift


def stir_go(run: "Runner", step: Any) -> Conditions:
    """Send the blade down or up its helix, from above the surface if it was absent."""
    engine, w = run.engine, run.wall(step.wall)
    if engine.wall[w, wl.ACTIVE] == 0.0:
        mean = float(engine.pos[:, 3].mean())
        lift_over(run, step.wall, step.clearance or mean)
        come_in(run, w)
    way = step.to - depth(run, step.wall)
    down = 1.0 if way >= 0.0 else -1.0
    turn = 1.0 if step.turn == "anticlockwise" else -1.0
    rate = turn * step.tip_speed * cos(step.helix_angle)
    blade = run.case.walls[step.wall]
    assert isinstance(blade, BladeWall)
    rate /= 0.5 * blade.diameter
    fall = -down * step.tip_speed * sin(step.helix_angle)
    engine.set_motion(
        w,
        np.array([0.0, 1e30]),
        np.array([[0.0, 0.0, fall]] * 2),
        np.array([[0.0, 0.0, rate]] * 2),
    )
    here = float(engine.move[w, wl.DISPLACEMENT])
    run.memory["stir"] = {
        "wall": step.wall,
        "depth_at_start": depth(run, step.wall),
        "displacement_at_start": here,
        "surface": surface(run),
        "role": step.role,
        "tip_speed": step.tip_speed,
        "mass": float(np.sum(np.sort(engine.vel[:, 3]))),
        "angular_velocity": rate,
        "velocity": fall,
    }
    if run.case.die is not None:
        bottom = float(engine.wall[run.wall("lower_punch"), wl.POINT + 2])
        volume = run.case.die.area * (surface(run) - bottom)
        run.memory["stir"]["bulk_density"] = run.memory["stir"]["mass"] / volume
    return [(st.MOVED if way >= 0.0 else st.BACK, w, here + way)]


def level_go(run: "Runner", step: Any) -> Conditions:
    """Take away what reaches above the height."""
    engine = run.engine
    keep = engine.pos[:, 2] + engine.pos[:, 3] <= step.height
    if not keep.any():
        lowest = float((engine.pos[:, 2] + engine.pos[:, 3]).min())
        raise InputError(
            "nothing-left",
            f"no particle lies below {step.height:g} m, the lowest reaches {lowest:g}",
            f"process.{step.place(run.stage)}.height",
            "the height is a coordinate along z",
        )
    run.memory["surface"] = step.height
    run.memory["levelled"] = int(np.count_nonzero(~keep))
    if keep.all():
        return []
    engine.keep(keep)
    begin_ledger(run)
    return []
