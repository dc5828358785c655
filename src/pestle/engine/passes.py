"""The contact pass of a chunk: detect, gather, contact loop, scatter.

Per block: detect without branches, gather into the flat scratch, one loop over the
contacts (`contacts.make_batch`), scatter into the chunk's private force buffer.
"""

from typing import Any

import numpy as np

from pestle import _jit
from pestle.engine.contacts import make_batch
from pestle.engine.scratch import (
    BLOCK,
    BOX_NEXT,
    BOX_NOW,
    COLUMNS,
    D2,
    DAMPED,
    DEEPEST,
    H0,
    KIND,
    MASS,
    NEGATIVE,
    NEGATIVES,
    OX,
    PLASTIC,
    RA,
    RB,
    SLIDING,
    STIFF,
    STORED,
    TOUCHING,
    VX,
    WEIGHT,
    WHERE,
    WX,
    Layout,
    W,
)
from pestle.laws._base import Nothing, Parts


def make_tally() -> Any:
    """Build the sum of a block's ledger rows into its chunk's ledger."""

    def tally(
        S: Any, m: int, row: int, deep_row: int, ledger: Any, listed: Any
    ) -> None:
        stored = spent = slid = damped = negative = negatives = touching = 0.0
        deepest, where = ledger[DEEPEST], ledger[WHERE]
        for c in range(m):
            e = row * W + c
            plastic = S[e + W]
            stored += S[e]
            spent += plastic
            slid += S[e + 2 * W]
            damped += S[e + 3 * W]
            negatives += 1.0 if S[e + 4 * W] < 0.0 else 0.0
            negative += S[e + 4 * W]
            deep = S[deep_row * W + c]
            touching += 1.0 if deep > 0.0 else 0.0
            if not deep <= deepest:  # also catches NaN
                deepest = deep
                where = np.float64(listed[c])
        ledger[STORED] += stored
        ledger[PLASTIC] += spent
        ledger[SLIDING] += slid
        ledger[DAMPED] += damped
        ledger[NEGATIVES] += negatives
        ledger[NEGATIVE] += negative
        ledger[TOUCHING] += touching
        ledger[DEEPEST], ledger[WHERE] = deepest, where

    return _jit.njit(tally)


def make_pair_chunk(
    law: Parts,
    layout: Layout,
    *,
    uniform: bool,
    rolling: bool,
    periodic: bool,
    zeros: tuple[int, ...],
) -> Any:
    """Build the contact pass over one chunk of the pair list."""
    batch = make_batch(
        law, layout, is_wall=False, uniform=uniform, rolling=rolling, zeros=zeros
    )
    tally = make_tally()
    history, fields, sums = layout.history, layout.fields, layout.sums
    field_row, sum_row, out = layout.field_row, layout.sum_row, layout.out
    ledger_row = layout.ledger_row
    keeps = law.particle is not Nothing
    screened = law.screened

    def chunk(
        pos: Any,
        vel: Any,
        mat: Any,
        field: Any,
        pa: Any,
        pb: Any,
        hist: Any,
        flag: Any,
        weight: Any,
        dist: Any,
        table: Any,
        materials: int,
        buf: Any,
        S: Any,
        listed: Any,
        k0: int,
        k1: int,
        shift: int,
        dt: float,
        cut: float,
        box: Any,
        ledger: Any,
    ) -> None:
        U = np.uint64
        k = k0
        while k < k1:
            m = 0
            stop = min(k1, k + BLOCK)
            for n in range(k, stop):
                s = U(n)
                a, b = U(pa[s]), U(pb[s])
                dx, dy, dz = (
                    pos[a, 0] - pos[b, 0],
                    pos[a, 1] - pos[b, 1],
                    pos[a, 2] - pos[b, 2],
                )
                if periodic:
                    dx -= box[0, 0] * np.floor(dx * box[1, 0] + 0.5)
                    dy -= box[0, 1] * np.floor(dy * box[1, 1] + 0.5)
                    dz -= box[0, 2] * np.floor(dz * box[1, 2] + 0.5)
                rs = pos[a, 3] + pos[b, 3]
                d2 = dx * dx + dy * dy + dz * dz
                near = d2 < (rs + cut) * (rs + cut)
                if screened:
                    dist[s] = d2 if d2 < rs * rs else -1.0
                listed[m] = n
                S[m], S[W + m], S[2 * W + m], S[D2 * W + m] = dx, dy, dz, d2
                m += near | ((flag[s] & 1) != 0)
            k = stop
            for c in range(m):
                s = U(listed[c])
                a, b = U(pa[s]), U(pb[s])
                ra, rb, ma, mb = pos[a, 3], pos[b, 3], vel[a, 3], vel[b, 3]
                S[RA * W + c], S[RB * W + c], S[MASS * W + c] = (
                    ra,
                    rb,
                    ma * mb / (ma + mb),
                )
                for v in range(3):
                    S[(VX + v) * W + c] = vel[a, v] - vel[b, v]
                    S[(OX + v) * W + c] = ra * vel[a, 4 + v] + rb * vel[b, 4 + v]
                    if rolling:
                        S[(WX + v) * W + c] = vel[a, 4 + v] - vel[b, 4 + v]
                    if periodic:
                        # the box carries a pair from where it was before the step
                        S[(VX + v) * W + c] += box[2, v] * S[v * W + c]
                        S[(VX + v) * W + c] /= 1.0 + box[2, v] * dt
                if not uniform:
                    S[KIND * W + c] = np.float64(mat[a] * materials + mat[b])
                S[WEIGHT * W + c] = weight[s] if screened else 1.0
                if flag[s] != 0:
                    for q in range(history):
                        S[(H0 + q) * W + c] = hist[s, q]
                else:
                    for q in range(history):
                        S[(H0 + q) * W + c] = 0.0
                for q in range(fields):
                    S[(field_row + q) * W + c] = field[a, q]
                    S[(field_row + fields + q) * W + c] = field[b, q]
            batch(S, m, table, dt)
            worked = pushed = 0.0
            for c in range(m):
                s = U(listed[c])
                rs = S[RA * W + c] + S[RB * W + c]
                near = S[D2 * W + c] < (rs + cut) * (rs + cut)
                flag[s] = 3 if near else (2 if keeps else 0)
                for q in range(history):
                    hist[s, q] = S[(H0 + q) * W + c]
                a, b = U(np.int64(pa[s]) + shift), U(np.int64(pb[s]) + shift)
                arm = S[(out + 9) * W + c]
                la, lb = S[RA * W + c] * arm, S[RB * W + c] * arm
                for v in range(3):
                    f, t = S[(out + v) * W + c], S[(out + 3 + v) * W + c]
                    r = S[(out + 6 + v) * W + c]
                    buf[a, v] += f
                    buf[b, v] -= f
                    if periodic:  # the deforming box, against the contact
                        power = -f * box[2, v] * S[v * W + c]
                        moved = -f * box[2, v] * S[(VX + v) * W + c] * dt
                        pushed += power
                        worked += power - moved  # from where the pair was before
                    buf[a, 3 + v] += r - la * t
                    buf[b, 3 + v] -= r + lb * t
                stiff = S[(out + 10) * W + c]
                buf[a, STIFF] += stiff
                buf[b, STIFF] += stiff
                for v in range(sums):
                    buf[a, COLUMNS + v] += S[(sum_row + v) * W + c]
                    buf[b, COLUMNS + v] += S[(sum_row + sums + v) * W + c]
            ledger[BOX_NOW] += worked
            ledger[BOX_NEXT] += pushed
            tally(S, m, ledger_row, out + 11, ledger, listed)

    return _jit.njit(chunk)
