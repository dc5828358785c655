"""The compiled time loop: forces, ledger, checks, kick and drift, walls.

Order of step n: forces at the places of step n with the velocities of n - 1/2, their
work over the last displacement into the ledger, checks, v(n + 1/2), x(n + 1), walls,
particle states of the law.  A step is a function of the arrays alone, so a run may be
cut anywhere into calls of `advance` without changing a bit.
"""

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
from numba import get_thread_id, prange

from pestle import _jit
from pestle.engine import scratch as ct
from pestle.engine.mesh_pass import gather_contacts
from pestle.engine.motion import gather_forces, make_move_chunk
from pestle.engine.passes import make_pair_chunk
from pestle.engine.screening import weigh
from pestle.engine.wall_pass import make_wall_chunk
from pestle.engine.walls import TOTALS, WORK, drive_walls, wall_path, wall_power
from pestle.laws._base import Parts

# why `advance` came back
RAN, REBUILD, CONDITION, BROKEN, TOO_DEEP, STEP_TOO_LARGE = range(6)
# clock: what changes in a run besides arrays of particles
TIME, DT, DT_LAST, SAFETY, AUTO, DT_MAX, CRITICAL, SCALE = range(8)
CLOCK = 8
# running sums of the ledger [J]
(
    KINETIC,
    STORED,
    GRAVITY,
    WALL_WORK,
    PLASTIC,
    SLIDING,
    DAMPED,
    NEGATIVE,
    NEGATIVES,
    TOUCHING,
    DEEPEST,
    BOX_WORK,
    HIGHEST_SPEED,
    MOST_STIFF,
    BOX_POWER,
    MOVING,
) = range(16)
SUMS = 16
# condition columns: kind, wall, value
NEVER, FORCE_ABOVE, FORCE_BELOW, MOVED, UNTIL, AT_REST, BACK, STILL = range(8)


@cache
def compiled(
    law: Parts,
    uniform: bool,
    rolling: bool,
    stretched: bool,
    periodic: bool,
    meshed: bool,
    zeros: tuple[tuple[int, ...], tuple[int, ...]] = ((), ()),
) -> Callable[..., Any]:
    """Return `advance`, compiled for a law; kept on disk between processes.

    Parameters
    ----------
    law : Parts
        Parts of the law.
    uniform, rolling, stretched, periodic, meshed : bool
        All particles of one material; rolling friction; Coulomb's limit for spring and
        dashpot together; periodic box; walls of mesh.
    zeros : tuple
        Which of the law's constants are 0 for all pairs of particles, and of
        particles with walls: no code is made for them.
    """
    layout = ct.Layout(law, rolling)
    pair_chunk = make_pair_chunk(
        law,
        layout,
        uniform=uniform,
        rolling=rolling,
        stretched=stretched,
        periodic=periodic,
        zeros=zeros[0],
    )
    wall_chunk = make_wall_chunk(
        law,
        layout,
        rolling=rolling,
        stretched=stretched,
        meshed=meshed,
        zeros=zeros[1],
    )
    move_chunk = make_move_chunk(law, layout)
    screened = law.screened

    def advance(
        steps: int, clock: Any, sums: Any, gravity: Any, condition: Any,
        pos: Any, vel: Any, mat: Any, field: Any, ref: Any, constants: Any,
        pa: Any, pb: Any, hist: Any, flag: Any, weight: Any, dist: Any, tri: Any, sides: Any,
        wp: Any, ww: Any, whist: Any, wflag: Any,
        table: Any, materials: int, wall: Any, move: Any, total: Any, program: Any, lengths: Any,
        box: Any, chunks: Any, pairs: Any, wpairs: Any, last: Any, offset: Any, buf: Any,
        scratch: Any, listed: Any, ledger: Any, wtotal: Any, report: Any,
        wref: Any, skin: float, cut: float, body: Any, motion: Any, turns: Any, mesh: Any,
        gap: Any, slot: Any, mfirst: Any, mlisted: Any, mpairs: Any, cand: Any, chosen: Any,
    ) -> tuple[int, int]:  # fmt: skip
        number = chunks.shape[0] - 1
        walls = wall.shape[0]
        for n in range(steps):
            dt = clock[DT]
            for c in prange(number):
                lo = chunks[c]
                me = get_thread_id()
                shift = offset[c] - lo
                spare = last[c]  # a row that nobody reads, for idle lanes
                buf[offset[c] : offset[c] + last[c] - lo].reshape(-1)[:] = 0.0
                ledger[c, :] = 0.0
                ledger[c, ct.DEEPEST] = -1e300
                pair_chunk(
                    pos,
                    vel,
                    mat,
                    field,
                    pa,
                    pb,
                    hist,
                    flag,
                    weight,
                    dist,
                    table,
                    materials,
                    buf,
                    scratch[me],
                    listed[me],
                    pairs[c],
                    pairs[c + 1],
                    shift,
                    spare,
                    clock[DT_LAST],
                    cut,
                    box,
                    ledger[c],
                )
                if meshed:
                    gather_contacts(
                        pos,
                        vel,
                        wall,
                        body,
                        mesh,
                        wp,
                        ww,
                        wflag,
                        gap,
                        slot,
                        mfirst,
                        mlisted,
                        mpairs[c],
                        mpairs[c + 1],
                        clock[DT_LAST],
                        cut,
                        cand[me],
                        chosen[me],
                    )
                wall_chunk(
                    pos,
                    vel,
                    mat,
                    field,
                    wp,
                    ww,
                    whist,
                    wflag,
                    table,
                    materials,
                    wall,
                    move,
                    wtotal[c],
                    buf,
                    scratch[me],
                    listed[me],
                    wpairs[c],
                    wpairs[c + 1],
                    shift,
                    spare,
                    clock[DT_LAST],
                    cut,
                    ledger[c],
                    body,
                    gap,
                )
            # wall forces and ledger, summed in the order of chunks
            for w in range(walls):
                power = wall_power(wall, move, body, total, w)
                for v in range(TOTALS):
                    total[w, v] = 0.0
                for c in range(number):
                    for v in range(TOTALS):
                        total[w, v] += wtotal[c, w, v]
                power += wall_power(wall, move, body, total, w)
                sums[WALL_WORK] += 0.5 * power * clock[DT_LAST]
                total[w, WORK] += 0.5 * power * clock[DT_LAST]
            pushed, pushes = sums[BOX_POWER], 0.0
            sums[STORED] = 0.0
            sums[TOUCHING] = 0.0
            sums[DEEPEST] = -1e300
            for c in range(number):
                sums[STORED] += ledger[c, ct.STORED]
                sums[PLASTIC] += ledger[c, ct.PLASTIC]
                sums[SLIDING] += ledger[c, ct.SLIDING]
                sums[DAMPED] += ledger[c, ct.DAMPED]
                sums[NEGATIVE] += ledger[c, ct.NEGATIVE]
                sums[NEGATIVES] += ledger[c, ct.NEGATIVES]
                pushed += ledger[c, ct.BOX_NOW]
                pushes += ledger[c, ct.BOX_NEXT]
                sums[TOUCHING] += ledger[c, ct.TOUCHING]
                if not ledger[c, ct.DEEPEST] <= sums[DEEPEST]:
                    sums[DEEPEST] = ledger[c, ct.DEEPEST]
            sums[BOX_WORK] += 0.5 * pushed * clock[DT_LAST]
            sums[BOX_POWER] = pushes
            # what each particle feels, and the step that it can bear
            for c in prange(number):
                ledger[c, 9] = gather_forces(c, chunks, last, offset, buf, vel)
            stiff = 0.0
            for c in range(number):
                stiff = max(stiff, ledger[c, 9])
            sums[MOST_STIFF] = stiff
            critical = 2.0 / np.sqrt(2.0 * stiff + 1e-300)
            clock[CRITICAL] = critical
            if not sums[DEEPEST] < clock[SCALE]:
                return n, TOO_DEEP
            if clock[AUTO] > 0.0:
                best = min(clock[SAFETY] * critical, clock[DT_MAX])
                if dt > best:
                    dt = best / 1.05
                    clock[DT] = dt
            elif dt > critical:
                return n, STEP_TOO_LARGE
            kick = 0.5 * (clock[DT_LAST] + dt)
            for c in prange(number):
                move_chunk(
                    c,
                    chunks,
                    offset,
                    buf,
                    pos,
                    vel,
                    mat,
                    field,
                    ref,
                    constants,
                    gravity,
                    box,
                    kick,
                    clock[DT_LAST],
                    dt,
                    ledger[c],
                )
                if screened:
                    weigh(
                        sides,
                        dist,
                        weight,
                        tri[c],
                        tri[c + 1],
                        pairs[c],
                        pairs[c + 1],
                        scratch[get_thread_id()],
                        listed[get_thread_id(), 0],
                    )
            for v in range(3):
                box[0, v] *= 1.0 + box[2, v] * dt
                if box[1, v] > 0.0:
                    box[1, v] = 1.0 / box[0, v]
            drive_walls(
                wall,
                move,
                total,
                program,
                lengths,
                body,
                motion,
                turns,
                clock[TIME],
                dt,
            )
            sums[KINETIC] = 0.0
            sums[MOVING] = 0.0
            sums[GRAVITY] = 0.0
            fastest = 0.0
            moved = 0.0
            finite = True
            for c in range(number):
                sums[KINETIC] += ledger[c, 10]
                sums[MOVING] += ledger[c, 15]
                sums[GRAVITY] += ledger[c, 11]
                fastest = max(fastest, ledger[c, 12])
                moved = max(moved, ledger[c, 13])
                finite = finite and ledger[c, 14] == 0.0
                sums[STORED] += ledger[c, ct.HELD]
                sums[PLASTIC] += ledger[c, ct.SPENT]
                sums[NEGATIVE] += ledger[c, ct.UNPAID]
                sums[NEGATIVES] += ledger[c, ct.DEBTS]
            sums[HIGHEST_SPEED] = np.sqrt(fastest)
            clock[TIME] += dt
            clock[DT_LAST] = dt
            report[0] += 1
            if not finite:
                return n + 1, BROKEN
            slack = np.sqrt(moved)
            wall_moved = wall_path(wall, move, body, wref)
            met = False
            for q in range(condition.shape[0]):
                kind = condition[q, 0]
                w = int(condition[q, 1])
                value = condition[q, 2]
                along = 0.0
                if w >= 0:
                    for v in range(3):
                        along += total[w, v] * move[w, v]
                hit = (
                    (kind == FORCE_ABOVE and along >= value)
                    or (kind == FORCE_BELOW and along <= value)
                    or (kind == MOVED and move[w, 4] >= value)
                    or (kind == BACK and move[w, 4] <= value)
                    or (kind == UNTIL and clock[TIME] >= value)
                    or (kind == AT_REST and sums[KINETIC] <= value)
                    or (kind == STILL and sums[MOVING] <= value)
                )
                if hit and not met:
                    met = True
                    report[1] = q
            over = max(2.0 * slack, slack + wall_moved) >= skin
            if met:
                return n + 1, (CONDITION + 16 if over else CONDITION)
            if over:
                return n + 1, REBUILD
        return steps, RAN

    # without Python's lock: other threads, such as Dask's, answer while it runs
    kernel = _jit.njit(advance, parallel=True, nogil=True)
    key = "-".join(
        [
            _jit.package_fingerprint(),
            *(
                _jit.fingerprint(f)
                for f in (law.contact, law.wall, law.update, law.reach)
            ),
            str(law.constants._fields),  # type: ignore[attr-defined]
            str(law.state._fields),  # type: ignore[attr-defined]
            f"{uniform}{rolling}{stretched}{periodic}{meshed}{zeros}",
        ]
    )
    return _jit.cached(kernel, key)
