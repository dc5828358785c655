"""What is rebuilt now and then: order of the particles, lists, chunks and buffers."""

from typing import TYPE_CHECKING, Any

import numba
import numpy as np
import numpy.typing as npt

from pestle.engine import mesh_pass as mp
from pestle.engine import neighbours as nb
from pestle.engine import scratch as ct
from pestle.engine import wall_lists as ls
from pestle.engine import walls as wl
from pestle.engine.lanes import LANES, aligned, lined
from pestle.engine.screening import triples

if TYPE_CHECKING:
    from pestle.engine.engine import Engine

Array = npt.NDArray[Any]


def rebuild(e: "Engine", wanted: Array | None = None) -> None:
    """Sort the particles, list all pairs within reach and skin, carry histories.

    Particles that are not wanted are left out.
    """
    if e.rebuilds:
        if e.since_rebuild > 400:
            e.skin *= 0.85
        elif e.since_rebuild < 40:
            e.skin *= 1.3
        mean = float(np.mean(e.pos[:, 3]))
        e.skin = min(max(e.skin, 0.02 * mean), 0.8 * mean)
    images = e.box[1] > 0.0
    lengths, origin = e.box[0], e.box[3]
    for c in np.flatnonzero(images):
        x = e.pos[:, c] - origin[c]
        e.pos[:, c] = origin[c] + x - lengths[c] * np.floor(x / lengths[c])
    e.beyond = e.cut()
    reach = e.skin + e.beyond
    old = e.first, e.pa, e.pb, e.hist, e.flag, e.weight
    left = np.arange(len(e.pos)) if wanted is None else np.flatnonzero(wanted)
    e.pos = e.pos[left] if wanted is not None else e.pos
    cell, low, count = _grid(e, reach, images)
    order, start = nb.cell_order(e.pos, low, cell, count)
    e.pos, order = np.ascontiguousarray(e.pos[order]), left[order]
    for name in ("vel", "mat", "ids", "field"):
        setattr(e, name, np.ascontiguousarray(getattr(e, name)[order]))
    for name in ("pos", "vel", "field"):
        setattr(e, name, lined(getattr(e, name)))
    wrap = images & (count >= 3)
    e.first, e.pa, e.pb = nb.pair_list(
        e.pos, e.ids, low, cell, count, start, wrap, images, lengths, reach,
        int(1.1 * len(e.pa)) or 8 * len(e.pos),
    )  # fmt: skip
    pairs = len(e.pa)
    e.hist = aligned(pairs, e.layout.history)
    e.flag = np.zeros(pairs, np.uint8)
    e.weight, e.dist = np.ones(pairs), np.full(pairs, -1.0)
    lost = nb.carry_pairs(order, *old, e.first, e.pa, e.pb, e.hist, e.flag, e.weight)
    e.lost_contacts += lost if wanted is None else 0
    list_walls(e, order, reach)
    e.ref = e.pos.copy()
    meshes = e.wall[:, wl.KIND] == wl.MESH
    e.wref = np.where(meshes, e.body[:, wl.PATH], e.move[:, wl.DISPLACEMENT])
    e.rebuilds += 1
    e.since_rebuild = 0
    divide(e)


def list_walls(e: "Engine", order: Array, reach: float) -> None:
    """List the particles near walls, and near which triangles; carry their histories."""
    old = e.wfirst, e.ww, e.whist, e.wflag, e.gap
    e.wfirst = np.empty(len(e.pos) + 1, np.int64)
    mark = np.empty(len(e.mesh.face), np.int64)
    given = e.pos, e.wall, e.body, e.mesh, reach, mark
    few, many = np.empty(0, np.int32), np.empty(0, np.int64)
    total, pairs, triangles = ls.wall_list(
        *given, few, few, e.wfirst, many, many, many, False
    )
    e.wp, e.ww = np.empty(total, np.int32), np.empty(total, np.int32)
    e.slot, e.mlisted = np.empty(pairs, np.int64), np.empty(triangles, np.int64)
    e.mfirst = np.empty(pairs + 1, np.int64)
    ls.wall_list(*given, e.wp, e.ww, e.wfirst, e.slot, e.mfirst, e.mlisted, True)
    e.whist = aligned(total, e.layout.history)
    e.wflag = np.zeros(total, np.uint8)
    e.gap = np.zeros((total if pairs else 0, ls.GAP))
    e.gap[:, [ls.SQUARE, ls.BEFORE]] = 1e300
    ls.carry_walls(order, *old, e.wfirst, e.ww, e.whist, e.wflag, e.gap)


def _grid(e: "Engine", reach: float, images: Array) -> tuple[Array, Array, Array]:
    low, high, largest = nb.extent(e.pos)
    size, span = 2.0 * largest + reach, high - low
    low = np.where(images, e.box[3], low)
    span = np.where(images, e.box[0], span + 1e-12 * size)
    count = np.maximum(np.floor(span / size), 1).astype(np.int64)
    while np.prod(count.astype(float)) > 4.0 * len(e.pos) + 1000.0:
        size *= 1.26
        count = np.maximum(np.floor(span / size), 1).astype(np.int64)
    count[images & (count < 3)] = 1
    return span / count, low, count


def divide(e: "Engine") -> None:
    """Set chunks, buffers and candidate triples from the lists: no state of its own."""
    n = len(e.pos)
    number = 8 if n <= 20_000 else 16
    e.chunks = np.array([n * c // number for c in range(number + 1)], np.int64)
    e.pairs = e.first[e.chunks]
    e.wpairs = e.wfirst[e.chunks]
    e.mpairs = np.searchsorted(e.slot, e.wpairs)
    e.last = e.chunks[1:].copy()
    for c in range(number):
        lo, hi = e.pairs[c], e.pairs[c + 1]
        if hi > lo:
            top = max(int(e.pa[lo:hi].max()), int(e.pb[lo:hi].max())) + 1
            e.last[c] = max(e.last[c], top)
    sizes = e.last - e.chunks[:-1] + 1  # and a spare row
    e.offset = np.concatenate([[0], np.cumsum(sizes)[:-1]]).astype(np.int64)
    e.buf = aligned(int(sizes.sum()), e.layout.columns)
    if not hasattr(e, "ledger") or len(e.ledger) != number:
        e.ledger = np.zeros((number, ct.LEDGER))
    if not hasattr(e, "scratch"):  # of a thread
        threads = numba.config.NUMBA_NUM_THREADS
        e.scratch = aligned(threads, e.layout.rows * ct.W + LANES)
        e.listed = np.zeros((threads, 4, ct.W), np.int64)
        e.cand = np.zeros((threads, mp.CANDIDATES, mp.COLUMNS))
        e.chosen = np.zeros((threads, ls.SLOTS + 8), np.int64)
    e.wtotal = np.zeros((number, len(e.wall), wl.TOTALS))
    if e.parts.screened:
        e.tri, e.sides = triples(e.first, e.pa, e.pb, e.chunks)
    else:
        e.tri, e.sides = np.zeros(1, np.int64), np.zeros((0, 3), np.int32)
