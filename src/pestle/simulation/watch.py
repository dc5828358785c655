"""Guards: a run that goes wrong stops with the step, the particles and the remedy."""

from typing import TYPE_CHECKING

import numpy as np

from pestle.engine import scratch as ct
from pestle.engine import step as st
from pestle.engine import walls as wl
from pestle.errors import SimulationError

if TYPE_CHECKING:
    from pestle.simulation.runner import Runner

DRIFT = 0.05
"""Share of the energy put in that the ledger may lack before a run is stopped [-]."""


def failure(run: "Runner", why: int) -> SimulationError:
    """Say what the engine stopped for."""
    e = run.engine
    where = f"step {run.steps}, time {e.time:.6g} s"
    kept = f"what was computed until then is in {run.out}"
    if why == st.STEP_TOO_LARGE:
        return SimulationError(
            "time-step-too-large",
            f"the time step {e.clock[st.DT]:.3g} s exceeds the critical step "
            f"{e.clock[st.CRITICAL]:.3g} s of the stiffest particle",
            where,
            'set engine.time_step = "auto" or a smaller step; ' + kept,
        )
    if why == st.TOO_DEEP:
        chunk = int(np.nanargmax([_deep(row) for row in e.ledger]))
        pairs = _ids(run, chunk)
        return SimulationError(
            "runaway-overlap",
            f"an overlap of {e.sums[st.DEEPEST]:.3g} radii{pairs}",
            where,
            "a wall moves too fast, the step is too large, or the powder is pressed "
            "beyond what the law describes; " + kept,
        )
    bad = np.flatnonzero(
        ~np.isfinite(e.pos).all(axis=1) | ~np.isfinite(e.vel).all(axis=1)
    )
    names = ", ".join(str(int(i)) for i in e.ids[bad[:5]])
    return SimulationError(
        "not-finite",
        f"the motion of particles {names} is no longer finite",
        where,
        "reduce engine.safety or engine.time_step; " + kept,
    )


def _deep(row: "np.ndarray[tuple[int], np.dtype[np.float64]]") -> float:
    value = float(row[ct.DEEPEST])
    return np.inf if np.isnan(value) else value


def _ids(run: "Runner", chunk: int) -> str:
    """Name the particles of the deepest contact, if it is one of the pair list."""
    e = run.engine
    slot = int(e.ledger[chunk, ct.WHERE])
    lo, hi = e.pairs[chunk], e.pairs[chunk + 1]
    if lo <= slot < hi:
        return f" between particles {e.ids[e.pa[slot]]} and {e.ids[e.pb[slot]]}"
    return ""


def check_state(run: "Runner") -> None:
    """Stop a run that has lost a particle or made energy from nothing."""
    e = run.engine
    for w in np.flatnonzero(e.wall[:, wl.ACTIVE] > 0.0):
        if e.wall[w, wl.KIND] != 0.0:
            continue
        depth = (e.pos[:, :3] - e.wall[w, 1:4]) @ e.wall[w, 4:7]
        lost = np.flatnonzero(depth < 0.0)
        if len(lost):
            raise SimulationError(
                "particle-lost",
                f"particle {e.ids[lost[0]]} went through the wall {run.walls[w]!r}"
                + (f", and {len(lost) - 1} more" if len(lost) > 1 else ""),
                f"step {run.steps}, time {e.time:.6g} s",
                "reduce the speed of the wall or engine.safety; "
                f"what was computed until then is in {run.out}",
            )
    parts = energies(run)
    gone = parts["contact_dissipation"] + parts["friction"] + parts["damping"]
    given = abs(parts["wall_work"]) + abs(run.memory["energy"])
    scale = given + gone + parts["kinetic"]
    if abs(parts["residual"]) > DRIFT * scale and e.steps > 100:
        raise SimulationError(
            "energy-from-nothing",
            f"the energy ledger lacks {parts['residual']:.3g} J of {scale:.3g} J",
            f"step {run.steps}, time {e.time:.6g} s",
            "the step is too large for this motion: reduce engine.safety; "
            f"what was computed until then is in {run.out}",
        )


def energies(run: "Runner") -> dict[str, float]:
    """Parts of the energy ledger [J]; the residual is what does not close."""
    s = run.engine.sums
    parts = {
        "kinetic": float(s[st.KINETIC]),
        "stored": float(s[st.STORED]),
        "gravity": float(s[st.GRAVITY]),
        "wall_work": float(s[st.WALL_WORK] + s[st.BOX_WORK]),
        "contact_dissipation": float(s[st.PLASTIC]),
        "friction": float(s[st.SLIDING]),
        "damping": float(s[st.DAMPED]),
    }
    gone = parts["contact_dissipation"] + parts["friction"] + parts["damping"]
    held = parts["kinetic"] + parts["stored"] + parts["gravity"]
    parts["residual"] = parts["wall_work"] + run.memory["energy"] - held - gone
    return parts
