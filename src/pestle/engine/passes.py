"""The contact pass of a chunk: detect, gather, contact loop, scatter.

Per block: detect without branches, gather into the flat scratch, one loop over the
contacts (`contacts.make_batch`), scatter into the chunk's private force buffer.
"""

from typing import Any

import numpy as np

from pestle import _jit
from pestle.engine.contacts import make_batch
from pestle.engine.lanes import make_prefetch, make_sum
from pestle.engine.scratch import (
    BLOCK,
    BOX_NEXT,
    BOX_NOW,
    D2,
    DAMPED,
    DEEPEST,
    H0,
    LANES,
    NEGATIVE,
    NEGATIVES,
    PLASTIC,
    RA,
    RB,
    SLIDING,
    STORED,
    TOUCHING,
    WEIGHT,
    WHERE,
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
from pestle.engine.vectors import dot
from pestle.laws._base import Nothing, Parts

sum_block = make_sum(BLOCK)


@_jit.njit
def total(S: Any, row: int, m: int) -> float:
    """Sum of a row of the scratch over the first m contacts of a block."""
    for c in range(m, BLOCK):
        S[at(row, c)] = 0.0
    result: float = sum_block(S, at(row, 0))
    return result


def make_tally() -> Any:
    """Build the sum of a block's ledger rows into its chunk's ledger."""

    def tally(
        S: Any, m: int, row: int, deep_row: int, ledger: Any, listed: Any
    ) -> None:
        deepest = ledger[DEEPEST]
        touching = above = below = 0
        for c in range(m):
            deep = S[at(deep_row, c)]
            touching += deep > 0.0
            above += not deep <= deepest  # also catches NaN
            below += S[at(row + 4, c)] < 0.0
        ledger[NEGATIVES] += np.float64(below)
        ledger[STORED] += total(S, row, m)
        ledger[PLASTIC] += total(S, row + 1, m)
        ledger[SLIDING] += total(S, row + 2, m)
        ledger[DAMPED] += total(S, row + 3, m)
        ledger[NEGATIVE] += total(S, row + 4, m)
        ledger[TOUCHING] += np.float64(touching)
        if above > 0:
            for c in range(m):
                deep = S[at(deep_row, c)]
                if not deep <= ledger[DEEPEST]:
                    ledger[DEEPEST], ledger[WHERE] = deep, np.float64(listed[c])

    return _jit.njit(tally)


def make_pair_chunk(
    law: Parts,
    layout: Layout,
    *,
    uniform: bool,
    rolling: bool,
    stretched: bool,
    periodic: bool,
    zeros: tuple[int, ...],
) -> Any:
    """Build the contact pass over one chunk of the pair list."""
    batch = make_batch(
        law,
        layout,
        is_wall=False,
        uniform=uniform,
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
    field_a, field_b, table_row = layout.field_a, layout.field_b, layout.table_row
    out_a, out_b = layout.out_a, layout.out_b
    deep_row, ledger_row = layout.deep_row, layout.ledger_row
    prefetch = make_prefetch(history)
    kept = 2 if law.particle is not Nothing else 0  # of the flag of a contact that ends
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
        spare: int,
        dt: float,
        cut: float,
        box: Any,
        ledger: Any,
    ) -> None:
        U = np.uint64
        slots, one, two, kinds = listed[0], listed[1], listed[2], listed[3]
        own = shift * columns  # where the chunk's own rows of the buffer begin
        k = k0
        while k < k1:
            m = fresh = 0
            n = k
            while n < k1 and m < BLOCK:
                s = U(n)
                a, b = U(pa[s]), U(pb[s])
                prefetch(hist, n)
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
                d2 = dot((dx, dy, dz), (dx, dy, dz))
                near = d2 < (rs + cut) * (rs + cut)
                if screened:
                    dist[s] = d2 if d2 < rs * rs else -1.0
                slots[m] = n
                S[at(0, m)], S[at(1, m)], S[at(2, m)] = dx, dy, dz
                S[at(D2, m)], S[at(RA, m)], S[at(RB, m)] = d2, pos[a, 3], pos[b, 3]
                was = flag[s]
                one[fresh] = n
                fresh += near & (was == 0)
                m += near | ((was & 1) != 0)
                flag[s] = 3 if near else (was & kept)
                n += 1
            for c in range(fresh):  # what an earlier contact left is over
                hist[U(one[c])] = 0.0
            k = n
            full = fill_lanes(S, slots, m)
            for c in range(full):
                s = U(slots[c])
                one[c], two[c] = pa[s], pb[s]
                if not uniform:
                    kinds[c] = mat[U(one[c])] * materials + mat[U(two[c])]
                S[at(WEIGHT, c)] = weight[s] if screened else 1.0
            for c in range(0, full, LANES):
                read_lanes(vel, 0, one, c, S, at(A, c))
                read_lanes(vel, 0, two, c, S, at(B, c))
                for g in range(history_turns):
                    q = min(g * LANES, last_q)
                    read_lanes(hist, q, slots, c, S, at(H0 + q, c))
                for g in range(field_turns):
                    q = min(g * LANES, last_f)
                    read_lanes(field, q, one, c, S, at(field_a + q, c))
                    read_lanes(field, q, two, c, S, at(field_b + q, c))
                if not uniform:
                    for g in range(table_turns):
                        q = min(g * LANES, last_t)
                        read_lanes(table, q, kinds, c, S, at(table_row + q, c))
            if periodic:
                # the box carries a pair from where it was before the step
                for c in range(full):
                    for v in range(3):
                        apart = S[at(A + v, c)] - S[at(B + v, c)]
                        apart += box[2, v] * S[at(v, c)]
                        S[at(A + v, c)] = apart / (1.0 + box[2, v] * dt)
                        S[at(B + v, c)] = 0.0
            batch(S, full, table, dt)
            one[m:full] = two[m:full] = spare
            for c in range(0, full, LANES):
                for g in range(history_turns):
                    q = min(g * LANES, last_q)
                    write_lanes(hist, q, slots, c, S, at(H0 + q, c))
                for q in range(0, columns, LANES):
                    add_lanes(buf, own + q, one, c, S, at(out_a + q, c))
                    add_lanes(buf, own + q, two, c, S, at(out_b + q, c))
            if periodic:  # the deforming box, against the contact
                worked = pushed = 0.0
                for c in range(m):
                    for v in range(3):
                        f = S[at(out_a + v, c)]
                        power = -f * box[2, v] * S[at(v, c)]
                        moved = -f * box[2, v] * S[at(A + v, c)] * dt
                        pushed += power
                        worked += power - moved  # from where the pair was before
                ledger[BOX_NOW] += worked
                ledger[BOX_NEXT] += pushed
            tally(S, m, ledger_row, deep_row, ledger, slots)

    return _jit.njit(chunk)
