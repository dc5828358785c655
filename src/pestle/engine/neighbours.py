"""Pair list: particles sorted by cell, half list of all pairs within reach and skin.

The order of particles and pairs depends on the particles alone, never on the number of
threads.  Histories move to the new list by matching pairs.
"""

from typing import Any

import numpy as np

from pestle import _jit


@_jit.njit
def extent(pos: Any) -> tuple[Any, Any, float]:
    """Lowest and highest centre on each axis, and the largest radius."""
    low, high, largest = np.full(3, np.inf), np.full(3, -np.inf), 0.0
    for i in range(pos.shape[0]):
        for c in range(3):
            low[c] = min(low[c], pos[i, c])
            high[c] = max(high[c], pos[i, c])
        largest = max(largest, pos[i, 3])
    return low, high, largest


@_jit.njit
def cell_order(pos: Any, low: Any, cell: Any, count: Any) -> Any:
    """Return the order of particles sorted by cell, and the start of each cell."""
    n = pos.shape[0]
    cells = count[0] * count[1] * count[2]
    start = np.zeros(cells + 1, np.int64)
    index = np.empty(n, np.int64)
    for i in range(n):
        a = 0
        for c in range(3):
            k = int((pos[i, c] - low[c]) / cell[c])
            a = a * count[c] + min(max(k, 0), count[c] - 1)
        index[i] = a
        start[a + 1] += 1
    for a in range(cells):
        start[a + 1] += start[a]
    place = start[:-1].copy()
    order = np.empty(n, np.int64)
    for i in range(n):
        order[place[index[i]]] = i
        place[index[i]] += 1
    return order, start


@_jit.njit
def _scan(
    pos: Any,
    ids: Any,
    low: Any,
    cell: Any,
    count: Any,
    start: Any,
    wrap: Any,
    images: Any,
    box: Any,
    skin: float,
    first: Any,
    pa: Any,
    pb: Any,
) -> int:
    """Fill the half list, as far as it has room; return how many pairs there are.

    Pairs first[i]:first[i + 1] are those of i.  All pairs looked at are written, one over
    the other until one is near: no branch to be guessed.
    """
    n = pos.shape[0]
    last = pa.shape[0] - 1
    total = 0
    nx, ny, nz = count[0], count[1], count[2]
    any_image = images[0] or images[1] or images[2]
    inverse = np.zeros(3)
    for c in range(3):
        if images[c]:
            inverse[c] = 1.0 / box[c]
    U = np.uint64
    for i in range(n):
        first[i] = total
        x, y, z, reach = pos[i, 0], pos[i, 1], pos[i, 2], pos[i, 3] + skin
        at_x = min(max(int((x - low[0]) / cell[0]), 0), nx - 1)
        at_y = min(max(int((y - low[1]) / cell[1]), 0), ny - 1)
        at_z = min(max(int((z - low[2]) / cell[2]), 0), nz - 1)
        # cells along z lie one after the other: one row, and a second across the border
        bottom, top = max(at_z - 1, 0), min(at_z + 1, nz - 1)
        other = -1
        if wrap[2] and at_z == 0:
            other = nz - 1
        elif wrap[2] and at_z == nz - 1:
            other = 0
        for a in range(at_x - 1, at_x + 2):
            if wrap[0]:
                a = a % nx
            if a < 0 or a >= nx:
                continue
            for b in range(at_y - 1, at_y + 2):
                if wrap[1]:
                    b = b % ny
                if b < 0 or b >= ny:
                    continue
                row = (a * ny + b) * nz
                for part in range(1 if other < 0 else 2):
                    lower = row + (bottom if part == 0 else other)
                    upper = row + (top if part == 0 else other)
                    for j in range(max(start[lower], i + 1), start[upper + 1]):
                        s = U(j)
                        dx, dy, dz = x - pos[s, 0], y - pos[s, 1], z - pos[s, 2]
                        if any_image:
                            dx -= box[0] * np.floor(dx * inverse[0] + 0.5)
                            dy -= box[1] * np.floor(dy * inverse[1] + 0.5)
                            dz -= box[2] * np.floor(dz * inverse[2] + 0.5)
                        r = reach + pos[s, 3]
                        k = U(min(total, last))
                        pa[k] = i if ids[i] < ids[s] else j
                        pb[k] = j if ids[i] < ids[s] else i
                        total += dx * dx + dy * dy + dz * dz < r * r
    first[n] = total
    return total


def pair_list(
    pos: Any,
    ids: Any,
    low: Any,
    cell: Any,
    count: Any,
    start: Any,
    wrap: Any,
    images: Any,
    box: Any,
    skin: float,
    room: int,
) -> tuple[Any, Any, Any]:
    """Return `first`, `pa`, `pb`: pairs of the lower index i are first[i]:first[i+1].

    There will be about `room` pairs: were there more, they are looked for again.
    """
    first = np.empty(pos.shape[0] + 1, np.int64)
    arguments = (pos, ids, low, cell, count, start, wrap, images, box, skin, first)
    total = room
    while True:
        room = total + 1  # the last place takes what is not near
        pa, pb = np.empty(room, np.int32), np.empty(room, np.int32)
        total = _scan(*arguments, pa, pb)
        if total < room:
            return first, pa[:total].copy(), pb[:total].copy()


@_jit.njit
def carry_pairs(
    order: Any,
    old_first: Any,
    old_a: Any,
    old_b: Any,
    old_hist: Any,
    old_flag: Any,
    old_weight: Any,
    first: Any,
    pa: Any,
    pb: Any,
    hist: Any,
    flag: Any,
    weight: Any,
) -> int:
    """Copy histories to the new list; return how many pairs in contact found no place."""
    kept = 0
    for i in range(first.shape[0] - 1):
        for s in range(first[i], first[i + 1]):
            a, b = order[pa[s]], order[pb[s]]
            for o in range(old_first[min(a, b)], old_first[min(a, b) + 1]):
                if old_a[o] == a and old_b[o] == b:
                    flag[s] = old_flag[o]
                    weight[s] = old_weight[o]
                    if old_flag[o] != 0:
                        kept += old_flag[o] & 1
                        for q in range(hist.shape[1]):
                            hist[s, q] = old_hist[o, q]
                    break
    held = 0
    for o in range(old_flag.shape[0]):
        held += old_flag[o] & 1
    return held - kept
