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
from numba import prange

from pestle import _jit
from pestle.engine import scratch as ct
from pestle.engine.passes import make_pair_chunk, make_wall_chunk
from pestle.engine.screening import weigh
from pestle.engine.walls import drive_walls
from pestle.laws._base import Nothing, Parts

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
) = range(15)
SUMS = 16
# condition columns: kind, wall, value
NEVER, FORCE_ABOVE, FORCE_BELOW, MOVED, UNTIL, AT_REST, BACK = range(7)


@cache
def compiled(
    law: Parts,
    uniform: bool,
    rolling: bool,
    periodic: bool,
    zeros: tuple[tuple[int, ...], tuple[int, ...]] = ((), ()),
) -> Callable[..., Any]:
    """Return `advance`, compiled for a law; kept on disk between processes.

    Parameters
    ----------
    law : Parts
        Parts of the law.
    uniform, rolling, periodic : bool
        All particles of one material; rolling friction; periodic box.
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
        periodic=periodic,
        zeros=zeros[0],
    )
    wall_chunk = make_wall_chunk(law, layout, rolling=rolling, zeros=zeros[1])
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
        wref: Any, skin: float, cut: float,
    ) -> tuple[int, int]:  # fmt: skip
        number = chunks.shape[0] - 1
        walls = wall.shape[0]
        for n in range(steps):
            dt = clock[DT]
            for c in prange(number):
                lo = chunks[c]
                shift = offset[c] - lo
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
                    scratch[c],
                    listed[c],
                    pairs[c],
                    pairs[c + 1],
                    shift,
                    clock[DT_LAST],
                    cut,
                    box,
                    ledger[c],
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
                    scratch[c],
                    listed[c],
                    wpairs[c],
                    wpairs[c + 1],
                    shift,
                    clock[DT_LAST],
                    cut,
                    ledger[c],
                )
            # wall forces and ledger, summed in the order of chunks
            for w in range(walls):
                along = 0.0
                for v in range(3):
                    along += total[w, v] * move[w, v]
                for v in range(5):
                    total[w, v] = 0.0
                for c in range(number):
                    for v in range(5):
                        total[w, v] += wtotal[c, w, v]
                now = 0.0
                for v in range(3):
                    now += total[w, v] * move[w, v]
                sums[WALL_WORK] += 0.5 * (along + now) * move[w, 5] * clock[DT_LAST]
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
                        scratch[c],
                        listed[c],
                    )
            for v in range(3):
                box[0, v] *= 1.0 + box[2, v] * dt
                if box[1, v] > 0.0:
                    box[1, v] = 1.0 / box[0, v]
            drive_walls(wall, move, total, program, lengths, clock[TIME], dt)
            sums[KINETIC] = 0.0
            sums[GRAVITY] = 0.0
            fastest = 0.0
            moved = 0.0
            finite = True
            for c in range(number):
                sums[KINETIC] += ledger[c, 10]
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
            wall_moved = 0.0
            for w in range(walls):
                if wall[w, 10] > 0.0:
                    wall_moved = max(wall_moved, abs(move[w, 4] - wref[w]))
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

    kernel = _jit.njit(advance, parallel=True)
    key = "-".join(
        [
            _jit.package_fingerprint(),
            *(
                _jit.fingerprint(f)
                for f in (law.contact, law.wall, law.update, law.reach)
            ),
            str(law.constants._fields),  # type: ignore[attr-defined]
            str(law.state._fields),  # type: ignore[attr-defined]
            f"{uniform}{rolling}{periodic}{zeros}",
        ]
    )
    return _jit.cached(kernel, key)


@_jit.njit
def gather_forces(
    c: int, chunks: Any, last: Any, offset: Any, buf: Any, vel: Any
) -> float:
    """Add the other chunks' buffers to a chunk's own; return max stiffness over mass."""
    lo, hi = chunks[c], chunks[c + 1]
    most = 0.0
    columns = buf.shape[1]
    for b in range(c):
        if last[b] > lo:
            base = offset[b] - chunks[b]
            own = offset[c] - lo
            for i in range(lo, min(hi, last[b])):
                for v in range(columns):
                    buf[own + i, v] += buf[base + i, v]
    own = offset[c] - lo
    for i in range(lo, hi):
        most = max(most, buf[own + i, 6] / vel[i, 3])
    return most


def make_move_chunk(law: Parts, layout: ct.Layout) -> Any:
    """Build the particle pass over one chunk: kick, drift, the law's particle state."""
    fields = layout.fields
    multi = law.particle is not Nothing
    if multi:
        update = _jit.inline(law.update)
        load = ct.table_loader(law.particle, 0)
        load_sums = ct.table_loader(law.sums, ct.COLUMNS)
        size = len(law.particle._fields)  # type: ignore[attr-defined]
        holds = layout.worked and law.particle._fields.index("energy")  # type: ignore[attr-defined]
        given = ct.COLUMNS + layout.worked - layout.sum_row
    else:
        holds = given = 0
        update = load = load_sums = None
        size = fields

    def chunk(
        c: int, chunks: Any, offset: Any, buf: Any, pos: Any, vel: Any, mat: Any, field: Any,
        ref: Any, constants: Any, gravity: Any, box: Any, kick: float, dt_last: float, dt: float, ledger: Any,
    ) -> None:  # fmt: skip
        kinetic = potential = fastest = furthest = 0.0
        held = spent = unpaid = debts = 0.0
        centre = dt_last / kick if kick > 0.0 else 0.0
        lost = 0.0
        own = offset[c] - chunks[c]
        gx, gy, gz = gravity[0], gravity[1], gravity[2]
        for i in range(chunks[c], chunks[c + 1]):
            o = own + i
            m = vel[i, 3]
            im, ii = kick / m, kick / vel[i, 7]
            v0, v1, v2 = vel[i, 0], vel[i, 1], vel[i, 2]
            w0, w1, w2 = vel[i, 4], vel[i, 5], vel[i, 6]
            a0 = v0 + im * buf[o, 0] + kick * gx
            a1 = v1 + im * buf[o, 1] + kick * gy
            a2 = v2 + im * buf[o, 2] + kick * gz
            b0, b1, b2 = w0 + ii * buf[o, 3], w1 + ii * buf[o, 4], w2 + ii * buf[o, 5]
            # product of the velocities before and after, those of a step as long as the
            # last one: closes the ledger exactly
            speed = v0 * v0 + v1 * v1 + v2 * v2
            spin = w0 * w0 + w1 * w1 + w2 * w2
            gain = v0 * a0 + v1 * a1 + v2 * a2 - speed
            turn = w0 * b0 + w1 * b1 + w2 * b2 - spin
            kinetic += 0.5 * m * (speed + centre * gain)
            kinetic += 0.5 * vel[i, 7] * (spin + centre * turn)
            potential -= m * (gx * pos[i, 0] + gy * pos[i, 1] + gz * pos[i, 2])
            vel[i, 0], vel[i, 1], vel[i, 2] = a0, a1, a2
            vel[i, 4], vel[i, 5], vel[i, 6] = b0, b1, b2
            x = pos[i, 0] + dt * (a0 + box[2, 0] * (pos[i, 0] - box[3, 0]))
            y = pos[i, 1] + dt * (a1 + box[2, 1] * (pos[i, 1] - box[3, 1]))
            z = pos[i, 2] + dt * (a2 + box[2, 2] * (pos[i, 2] - box[3, 2]))
            pos[i, 0], pos[i, 1], pos[i, 2] = x, y, z
            speed = a0 * a0 + a1 * a1 + a2 * a2
            fastest = max(fastest, speed)
            if multi:
                radius, state = update(
                    (constants[mat[i], 0], constants[mat[i], 1]),
                    pos[i, 3],
                    load(field, i),
                    load_sums(buf, o),
                )
                pos[i, 3] = radius
                if holds:  # energy of the particle, given by its contacts
                    gone = field[i, holds] + buf[o, given] - state[holds]
                    spent += gone
                    if gone < -1e-9 * (abs(field[i, holds]) + abs(buf[o, given])):
                        unpaid += gone
                        debts += 1.0
                    held += state[holds]
                for q in range(size):
                    field[i, q] = state[q]
            dx, dy, dz = x - ref[i, 0], y - ref[i, 1], z - ref[i, 2]
            grown = pos[i, 3] - ref[i, 3]
            far2 = dx * dx + dy * dy + dz * dz
            if grown > 0.0:
                far = np.sqrt(far2) + grown
                far2 = far * far
            furthest = max(furthest, far2)
            if not speed < 1e300:
                lost = 1.0
        ledger[10] = kinetic
        ledger[11] = potential
        ledger[12] = fastest
        ledger[13] = furthest
        ledger[14] = lost
        ledger[ct.HELD], ledger[ct.SPENT] = held, spent
        ledger[ct.UNPAID], ledger[ct.DEBTS] = unpaid, debts

    return _jit.njit(chunk)
