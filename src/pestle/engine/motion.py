"""The particle pass: forces of all chunks, kick, drift, the law's particle state."""

from typing import Any

import numpy as np

from pestle import _jit
from pestle.engine import scratch as ct
from pestle.engine.vectors import dot, plus
from pestle.laws._base import Nothing, Parts


@_jit.njit
def gather_forces(
    c: int, chunks: Any, last: Any, offset: Any, buf: Any, vel: Any
) -> float:
    """Add the other chunks' buffers to a chunk's own; return max stiffness over mass."""
    lo, hi = chunks[c], chunks[c + 1]
    most = 0.0
    own = offset[c] - lo
    for b in range(c):
        if last[b] > lo:
            base, end = offset[b] - chunks[b], min(hi, last[b])
            mine = buf[own + lo : own + end].reshape(-1)
            theirs = buf[base + lo : base + end].reshape(-1)
            for q in range(mine.shape[0]):
                mine[q] += theirs[q]
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
        given = layout.worked
    else:
        holds = given = 0
        update = load = load_sums = None
        size = fields

    def chunk(
        c: int, chunks: Any, offset: Any, buf: Any, pos: Any, vel: Any, mat: Any, field: Any,
        ref: Any, constants: Any, gravity: Any, box: Any, kick: float, dt_last: float, dt: float, ledger: Any,
    ) -> None:  # fmt: skip
        kinetic = moving = potential = fastest = furthest = 0.0
        held = spent = unpaid = debts = 0.0
        centre = dt_last / kick if kick > 0.0 else 0.0
        lost = 0.0
        own = offset[c] - chunks[c]
        g = gravity[0], gravity[1], gravity[2]
        for i in range(chunks[c], chunks[c + 1]):
            o = own + i
            m, inertia = vel[i, 3], vel[i, 7]
            per = kick / (m * inertia)
            im, ii = inertia * per, m * per
            v, w = (vel[i, 0], vel[i, 1], vel[i, 2]), (vel[i, 4], vel[i, 5], vel[i, 6])
            v_new = plus(plus(v, kick, g), im, (buf[o, 0], buf[o, 1], buf[o, 2]))
            w_new = plus(w, ii, (buf[o, 3], buf[o, 4], buf[o, 5]))
            # product of the velocities before and after, those of a step as long as the
            # last one: closes the ledger exactly
            speed, spin = dot(v, v), dot(w, w)
            moving += 0.5 * m * (speed + centre * (dot(v, v_new) - speed))
            kinetic += 0.5 * inertia * (spin + centre * (dot(w, w_new) - spin))
            potential -= m * dot(g, (pos[i, 0], pos[i, 1], pos[i, 2]))
            vel[i, 0], vel[i, 1], vel[i, 2] = v_new
            vel[i, 4], vel[i, 5], vel[i, 6] = w_new
            x = pos[i, 0] + dt * (v_new[0] + box[2, 0] * (pos[i, 0] - box[3, 0]))
            y = pos[i, 1] + dt * (v_new[1] + box[2, 1] * (pos[i, 1] - box[3, 1]))
            z = pos[i, 2] + dt * (v_new[2] + box[2, 2] * (pos[i, 2] - box[3, 2]))
            pos[i, 0], pos[i, 1], pos[i, 2] = x, y, z
            speed = dot(v_new, v_new)
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
            path = x - ref[i, 0], y - ref[i, 1], z - ref[i, 2]
            far2 = dot(path, path)
            if multi:
                far = np.sqrt(far2) + max(pos[i, 3] - ref[i, 3], 0.0)
                far2 = far * far
            furthest = max(furthest, far2)
            if not speed < 1e300:
                lost = 1.0
        ledger[10] = kinetic + moving
        ledger[15] = moving
        ledger[11] = potential
        ledger[12] = fastest
        ledger[13] = furthest
        ledger[14] = lost
        ledger[ct.HELD], ledger[ct.SPENT] = held, spent
        ledger[ct.UNPAID], ledger[ct.DEBTS] = unpaid, debts

    return _jit.njit(chunk)
