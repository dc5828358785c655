"""How far the conditions that end a phase have come, and which one ended it."""

from typing import TYPE_CHECKING

from pestle.engine import step as st
from pestle.engine import walls as wl
from pestle.simulation.stages import PHASES

if TYPE_CHECKING:
    from pestle.simulation.runner import Runner


def values(run: "Runner") -> list[float]:
    """Value of each condition's quantity now."""
    e, found = run.engine, []
    for kind, wall, _ in e.condition:
        w = int(wall)
        if kind in (st.FORCE_ABOVE, st.FORCE_BELOW):
            found.append(float(e.total[w, :3] @ e.move[w, :3]))
        elif kind in (st.MOVED, st.BACK):
            found.append(float(e.move[w, wl.DISPLACEMENT]))
        elif kind == st.UNTIL:
            found.append(e.time)
        elif kind == st.STILL:
            found.append(float(e.sums[st.MOVING]))
        else:
            found.append(float(e.sums[st.KINETIC]))
    return found


def fraction(run: "Runner") -> float:
    """How far the stage has come, 0 to 1: the farthest of its phase's conditions."""
    most = 0.0
    for (kind, _, goal), begun, now in zip(
        run.engine.condition, run.memory["from"], values(run), strict=True
    ):
        if kind not in (st.AT_REST, st.STILL) and goal != begun:
            most = max(most, (now - begun) / (goal - begun))
    phases = len(PHASES[run.case.process[run.stage].step])
    return float(min((run.phase + min(most, 1.0)) / phases, 1.0))


def reason(run: "Runner", index: int) -> str:
    """Say which condition was met."""
    kind, w, value = run.engine.condition[index]
    name = run.walls[int(w)] if w >= 0 else ""
    return {
        st.FORCE_ABOVE: f"{name} reached {value:.6g} N",
        st.FORCE_BELOW: f"{name} carries no load",
        st.MOVED: f"{name} reached a displacement of {value:.6g} m",
        st.BACK: f"{name} is back at a displacement of {value:.6g} m",
        st.UNTIL: f"time {value:.6g} s",
        st.AT_REST: "the powder is at rest",
        st.STILL: "the powder is at rest",
    }[int(kind)]


def tablet_broke(run: "Runner") -> bool:
    """Whether the tablet between the platens has broken.

    It carries half of its peak or less, and did not recover while each platen moved on
    by half a particle's radius: a particle that gives way on the rim is no break.
    """
    if run.case.process[run.stage].step != "crush":
        return False
    e, w = run.engine, run.wall("platen_left")
    force = float(e.total[w, :3] @ e.move[w, :3])
    moved = float(e.move[w, wl.DISPLACEMENT])
    if force >= run.memory["peak"]:
        run.memory["peak"], run.memory["peak_at"] = force, moved
    further = moved - run.memory.get("peak_at", moved)
    weak = force < 0.5 * run.memory["peak"]
    return bool(weak and further > 0.5 * float(e.pos[:, 3].mean()))
