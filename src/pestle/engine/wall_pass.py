"""The contact pass of a chunk's particles against the walls, as that of pairs."""

from typing import Any

import numpy as np

from pestle import _jit
from pestle.engine import walls as wl
from pestle.engine.contacts import make_batch
from pestle.engine.passes import make_tally
from pestle.engine.scratch import (
    BEFORE,
    BLOCK,
    D2,
    H0,
    HISTORY,
    LANES,
    RA,
    RB,
    SPIN,
    STIFF,
    TORQUE,
    A,
    B,
    Layout,
    add_lanes,
    at,
    fill_lanes,
    read_lanes,
    turns,
    write_lanes,
)
from pestle.engine.wall_lists import BEFORE as LAST
from pestle.engine.wall_lists import SQUARE, USED
from pestle.engine.walls import surface_velocity, towards_wall
from pestle.laws._base import Nothing, Parts


def make_wall_chunk(
    law: Parts,
    layout: Layout,
    *,
    rolling: bool,
    stretched: bool,
    meshed: bool,
    zeros: tuple[int, ...],
) -> Any:
    """Build the contact pass of one chunk's particles against the walls."""
    batch = make_batch(
        law,
        layout,
        is_wall=True,
        uniform=False,
        rolling=rolling,
        stretched=stretched,
        zeros=zeros,
    )
    tally = make_tally()
    history, columns, constants = layout.history, layout.columns, layout.constants
    fields = layout.fields
    history_turns, field_turns = turns(history), turns(fields)
    table_turns = turns(constants)
    last_q, last_f, last_t = history - LANES, fields - LANES, constants - LANES
    field_a, table_row = layout.field_a, layout.table_row
    out_a, out_b = layout.out_a, layout.out_b
    deep_row, ledger_row = layout.deep_row, layout.ledger_row
    keeps = law.particle is not Nothing
    springs = 2 if rolling else 1

    def ride(
        pos: Any, wall: Any, body: Any, gap: Any, S: Any, c: int, a: int, w: int, s: int, dt: float
    ) -> None:  # fmt: skip
        """See a contact from a mesh that moves: velocities, distance before, springs."""
        ux, uy, uz = surface_velocity(
            pos[a, 0] - gap[s, 0], pos[a, 1] - gap[s, 1], pos[a, 2] - gap[s, 2], wall, body, w
        )  # fmt: skip
        S[at(B, c)], S[at(B + 1, c)], S[at(B + 2, c)] = ux, uy, uz
        S[at(BEFORE, c)] = gap[s, LAST]
        wx, wy, wz = body[w, wl.SPIN], body[w, wl.SPIN + 1], body[w, wl.SPIN + 2]
        for v in range(3):
            S[at(B + SPIN + v, c)] = body[w, wl.SPIN + v]
        for q in range(springs):  # they turn with the mesh
            h = H0 + q * HISTORY
            x, y, z = S[at(h, c)], S[at(h + 1, c)], S[at(h + 2, c)]
            S[at(h, c)] += dt * (wy * z - wz * y)
            S[at(h + 1, c)] += dt * (wz * x - wx * z)
            S[at(h + 2, c)] += dt * (wx * y - wy * x)

    ride = _jit.njit(ride)

    def chunk(
        pos: Any,
        vel: Any,
        mat: Any,
        field: Any,
        wp: Any,
        ww: Any,
        hist: Any,
        flag: Any,
        table: Any,
        materials: int,
        wall: Any,
        move: Any,
        total: Any,
        buf: Any,
        S: Any,
        listed: Any,
        k0: int,
        k1: int,
        shift: int,
        spare: int,
        dt: float,
        cut: float,
        ledger: Any,
        body: Any,
        gap: Any,
    ) -> None:
        U = np.uint64
        slots, one, kinds = listed[0], listed[1], listed[3]
        total[:, :] = 0.0
        own = shift * columns  # where the chunk's own rows of the buffer begin
        k = k0
        while k < k1:
            m = 0
            stop = min(k1, k + BLOCK)
            for n in range(k, stop):
                s = U(n)
                a, w = U(wp[s]), U(ww[s])
                if meshed and wall[w, wl.KIND] == wl.MESH:
                    dx, dy, dz, d2 = gap[s, 0], gap[s, 1], gap[s, 2], gap[s, SQUARE]
                else:
                    dx, dy, dz = towards_wall(pos[a, 0], pos[a, 1], pos[a, 2], wall, w)
                    d2 = dx * dx + dy * dy + dz * dz
                r = pos[a, 3] + cut
                near = (d2 < r * r) & (wall[w, 10] > 0.0)
                slots[m] = n
                S[at(0, m)], S[at(1, m)], S[at(2, m)] = dx, dy, dz
                S[at(D2, m)], S[at(RA, m)], S[at(RB, m)] = d2, pos[a, 3], 0.0
                m += near | ((flag[s] & 1) != 0)
            k = stop
            full = fill_lanes(S, slots, m)
            for c in range(full):
                s = U(slots[c])
                one[c] = wp[s]
                kinds[c] = mat[U(one[c])] * materials + np.int64(wall[U(ww[s]), 11])
            for c in range(0, full, LANES):
                read_lanes(vel, 0, one, c, S, at(A, c))
                for g in range(history_turns):
                    q = min(g * LANES, last_q)
                    read_lanes(hist, q, slots, c, S, at(H0 + q, c))
                for g in range(field_turns):
                    q = min(g * LANES, last_f)
                    read_lanes(field, q, one, c, S, at(field_a + q, c))
                for g in range(table_turns):
                    q = min(g * LANES, last_t)
                    read_lanes(table, q, kinds, c, S, at(table_row + q, c))
            for c in range(full):
                s = U(slots[c])
                a, w = U(wp[s]), U(ww[s])
                ra = pos[a, 3]
                for v in range(3):
                    S[at(B + v, c)] = move[w, v] * move[w, 5]
                    S[at(B + SPIN + v, c)] = 0.0
                if flag[s] == 0:  # what an earlier contact left is over
                    for q in range(history):
                        S[at(H0 + q, c)] = 0.0
                if meshed and wall[w, wl.KIND] == wl.MESH:
                    ride(pos, wall, body, gap, S, c, a, w, s, dt)
                    if gap[s, USED] == 0.0:  # no contact any more: it ends here
                        S[at(D2, c)] = 4.0 * (ra + cut) * (ra + cut) + 1e-300
                        S[at(BEFORE, c)] = S[at(D2, c)]
                    continue
                dx, dy, dz = towards_wall(  # a step ago, as seen from the wall
                    pos[a, 0] - dt * (vel[a, 0] - move[w, 0] * move[w, 5]),
                    pos[a, 1] - dt * (vel[a, 1] - move[w, 1] * move[w, 5]),
                    pos[a, 2] - dt * (vel[a, 2] - move[w, 2] * move[w, 5]),
                    wall,
                    w,
                )
                S[at(BEFORE, c)] = dx * dx + dy * dy + dz * dz
                if wall[w, 10] == 0.0:  # taken away: the contact ends here
                    S[at(D2, c)] = 4.0 * (ra + cut) * (ra + cut) + 1e-300
                    S[at(BEFORE, c)] = S[at(D2, c)]  # no work is done on it
            batch(S, full, table, dt)
            one[m:full] = spare
            for c in range(0, full, LANES):
                for g in range(history_turns):
                    q = min(g * LANES, last_q)
                    write_lanes(hist, q, slots, c, S, at(H0 + q, c))
                for q in range(0, columns, LANES):
                    add_lanes(buf, own + q, one, c, S, at(out_a + q, c))
            for c in range(m):
                s = U(slots[c])
                i, w = U(wp[s]), U(ww[s])
                r = S[at(RA, c)] + cut
                near = S[at(D2, c)] < r * r
                gone = meshed and wall[w, wl.KIND] == wl.MESH and gap[s, USED] == 0.0
                flag[s] = 3 if near else (2 if keeps and not gone else 0)
                # the point where the wall acts, from the wall's own
                rx = pos[i, 0] - S[at(0, c)] - wall[w, 1]
                ry = pos[i, 1] - S[at(1, c)] - wall[w, 2]
                rz = pos[i, 2] - S[at(2, c)] - wall[w, 3]
                fx, fy, fz = S[at(out_a, c)], S[at(out_a + 1, c)], S[at(out_a + 2, c)]
                # a wall has no radius: what turns it is what resists the rolling
                total[w, 5] += ry * fz - rz * fy - S[at(out_b + TORQUE, c)]
                total[w, 6] += rz * fx - rx * fz - S[at(out_b + TORQUE + 1, c)]
                total[w, 7] += rx * fy - ry * fx - S[at(out_b + TORQUE + 2, c)]
                for v in range(3):
                    total[w, v] += S[at(out_a + v, c)]
                total[w, 3] += S[at(H0 + 4, c)]
                total[w, 4] += S[at(out_a + STIFF, c)]
            tally(S, m, ledger_row, deep_row, ledger, slots)

    return _jit.njit(chunk)
