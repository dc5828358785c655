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
    COLUMNS,
    D2,
    H0,
    HISTORY,
    KIND,
    MASS,
    OX,
    RA,
    RB,
    STIFF,
    VX,
    WX,
    Layout,
    W,
)
from pestle.engine.wall_lists import BEFORE as LAST
from pestle.engine.wall_lists import SQUARE, USED
from pestle.engine.walls import surface_velocity, towards_wall
from pestle.laws._base import Nothing, Parts


def make_wall_chunk(
    law: Parts, layout: Layout, *, rolling: bool, meshed: bool, zeros: tuple[int, ...]
) -> Any:
    """Build the contact pass of one chunk's particles against the walls."""
    batch = make_batch(
        law, layout, is_wall=True, uniform=False, rolling=rolling, zeros=zeros
    )
    tally = make_tally()
    history, fields, sums = layout.history, layout.fields, layout.sums
    field_row, sum_row, out = layout.field_row, layout.sum_row, layout.out
    ledger_row = layout.ledger_row
    keeps = law.particle is not Nothing
    springs = 2 if rolling else 1

    def ride(
        pos: Any, vel: Any, wall: Any, body: Any, gap: Any, S: Any, c: int, a: int, w: int, s: int, dt: float
    ) -> None:  # fmt: skip
        """See a contact from a mesh that moves: velocities, distance before, springs."""
        ux, uy, uz = surface_velocity(
            pos[a, 0] - gap[s, 0], pos[a, 1] - gap[s, 1], pos[a, 2] - gap[s, 2], wall, body, w
        )  # fmt: skip
        S[VX * W + c] = vel[a, 0] - ux
        S[(VX + 1) * W + c] = vel[a, 1] - uy
        S[(VX + 2) * W + c] = vel[a, 2] - uz
        S[BEFORE * W + c] = gap[s, LAST]
        wx, wy, wz = body[w, wl.SPIN], body[w, wl.SPIN + 1], body[w, wl.SPIN + 2]
        for v in range(3):
            S[(WX + v) * W + c] -= body[w, wl.SPIN + v]
        for q in range(springs):  # they turn with the mesh
            h = (H0 + q * HISTORY) * W + c
            x, y, z = S[h], S[h + W], S[h + 2 * W]
            S[h] += dt * (wy * z - wz * y)
            S[h + W] += dt * (wz * x - wx * z)
            S[h + 2 * W] += dt * (wx * y - wy * x)

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
        dt: float,
        cut: float,
        ledger: Any,
        body: Any,
        gap: Any,
    ) -> None:
        U = np.uint64
        total[:, :] = 0.0
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
                listed[m] = n
                S[m], S[W + m], S[2 * W + m], S[D2 * W + m] = dx, dy, dz, d2
                m += near | ((flag[s] & 1) != 0)
            k = stop
            for c in range(m):
                s = U(listed[c])
                a, w = U(wp[s]), U(ww[s])
                ra = pos[a, 3]
                S[RA * W + c], S[RB * W + c], S[MASS * W + c] = ra, 0.0, vel[a, 3]
                for v in range(3):
                    S[(VX + v) * W + c] = vel[a, v] - move[w, v] * move[w, 5]
                    S[(OX + v) * W + c] = ra * vel[a, 4 + v]
                    S[(WX + v) * W + c] = vel[a, 4 + v]
                S[KIND * W + c] = np.float64(mat[a] * materials) + wall[w, 11]
                if flag[s] != 0:
                    for q in range(history):
                        S[(H0 + q) * W + c] = hist[s, q]
                else:
                    for q in range(history):
                        S[(H0 + q) * W + c] = 0.0
                for q in range(fields):
                    S[(field_row + q) * W + c] = field[a, q]
                    S[(field_row + fields + q) * W + c] = field[a, q]
                if meshed and wall[w, wl.KIND] == wl.MESH:
                    ride(pos, vel, wall, body, gap, S, c, a, w, s, dt)
                    if gap[s, USED] == 0.0:  # no contact any more: it ends here
                        S[D2 * W + c] = 4.0 * (ra + cut) * (ra + cut) + 1e-300
                        S[BEFORE * W + c] = S[D2 * W + c]
                    continue
                dx, dy, dz = towards_wall(  # a step ago, as seen from the wall
                    pos[a, 0] - dt * S[VX * W + c],
                    pos[a, 1] - dt * S[(VX + 1) * W + c],
                    pos[a, 2] - dt * S[(VX + 2) * W + c],
                    wall,
                    w,
                )
                S[BEFORE * W + c] = dx * dx + dy * dy + dz * dz
                if wall[w, 10] == 0.0:  # taken away: the contact ends here
                    S[D2 * W + c] = 4.0 * (ra + cut) * (ra + cut) + 1e-300
                    S[BEFORE * W + c] = S[D2 * W + c]  # no work is done on it
            batch(S, m, table, dt)
            for c in range(m):
                s = U(listed[c])
                w = U(ww[s])
                r = S[RA * W + c] + cut
                near = S[D2 * W + c] < r * r
                gone = meshed and wall[w, wl.KIND] == wl.MESH and gap[s, USED] == 0.0
                flag[s] = 3 if near else (2 if keeps and not gone else 0)
                for q in range(history):
                    hist[s, q] = S[(H0 + q) * W + c]
                a = U(np.int64(wp[s]) + shift)
                arm = S[RA * W + c] * S[(out + 9) * W + c]
                fx, fy, fz = S[out * W + c], S[(out + 1) * W + c], S[(out + 2) * W + c]
                i = U(wp[s])  # the point where the wall acts, from the wall's own
                rx = pos[i, 0] - S[c] - wall[w, 1]
                ry = pos[i, 1] - S[W + c] - wall[w, 2]
                rz = pos[i, 2] - S[2 * W + c] - wall[w, 3]
                total[w, 5] += ry * fz - rz * fy + S[(out + 6) * W + c]
                total[w, 6] += rz * fx - rx * fz + S[(out + 7) * W + c]
                total[w, 7] += rx * fy - ry * fx + S[(out + 8) * W + c]
                for v in range(3):
                    f = S[(out + v) * W + c]
                    buf[a, v] += f
                    buf[a, 3 + v] += (
                        S[(out + 6 + v) * W + c] - arm * S[(out + 3 + v) * W + c]
                    )
                    total[w, v] += f
                total[w, 3] += S[(H0 + 4) * W + c]
                total[w, 4] += S[(out + 10) * W + c]
                buf[a, STIFF] += S[(out + 10) * W + c]
                for v in range(sums):
                    buf[a, COLUMNS + v] += S[(sum_row + v) * W + c]
            tally(S, m, ledger_row, out + 11, ledger, listed)

    return _jit.njit(chunk)
