"""Between rows of arrays and the flat scratch: eight contacts at a time, transposed.

An array of the engine keeps what belongs together in a row of `LANES` numbers, or a
multiple; the scratch keeps one row a quantity, so that a loop over contacts is SIMD.
Eight rows of eight numbers are turned in registers, by 24 shuffles instead of 64 moves.
Without a compiler (NUMBA_DISABLE_JIT=1) the same functions are plain Python.
"""

from typing import Any

import numba
import numpy as np
from llvmlite import ir
from numba.core import cgutils, types
from numba.extending import intrinsic

LANES = 8  # numbers in a row and contacts in a turn

_ROW = ir.VectorType(ir.DoubleType(), LANES)
# three stages of a transposition: which two rows meet, and what each takes of both
_STAGES = (
    (1, (0, 8, 2, 10, 4, 12, 6, 14), (1, 9, 3, 11, 5, 13, 7, 15)),
    (2, (0, 1, 8, 9, 4, 5, 12, 13), (2, 3, 10, 11, 6, 7, 14, 15)),
    (4, (0, 1, 2, 3, 8, 9, 10, 11), (4, 5, 6, 7, 12, 13, 14, 15)),
)


def _transposed(builder: Any, rows: list[Any]) -> list[Any]:
    """Turn eight vectors of eight."""
    for apart, low, high in _STAGES:
        turned = list(rows)
        for i in range(LANES):
            if not i & apart:
                one, two = rows[i], rows[i + apart]
                for place, take in ((i, low), (i + apart, high)):
                    mask = ir.Constant(ir.VectorType(ir.IntType(32), LANES), list(take))
                    turned[place] = builder.shuffle_vector(one, two, mask)
        rows = turned
    return rows


def _pointer(builder: Any, data: Any, place: Any) -> Any:
    return builder.bitcast(builder.gep(data, [place]), _ROW.as_pointer())


def _read(builder: Any, data: Any, place: Any) -> Any:
    value = builder.load(_pointer(builder, data, place))
    value.align = 8
    return value


def _write(builder: Any, value: Any, data: Any, place: Any) -> None:
    builder.store(value, _pointer(builder, data, place)).align = 8


def _places(builder: Any, rows: Any, index: Any, first: Any, column: Any) -> list[Any]:
    """Where the eight rows named by index[first:first + 8] begin, from a column on."""
    width = cgutils.unpack_tuple(builder, rows.shape, 2)[1]
    places = []
    for lane in range(LANES):
        at = builder.add(first, ir.Constant(first.type, lane))
        row = builder.load(builder.gep(index.data, [at]))
        places.append(builder.add(builder.mul(row, width), column))
    return places


def _lanes(builder: Any, place: Any, stride: int) -> list[Any]:
    return [
        builder.add(place, ir.Constant(place.type, q * stride)) for q in range(LANES)
    ]


def _arrays(context: Any, builder: Any, signature: Any, arguments: Any) -> list[Any]:
    return [
        context.make_array(kind)(context, builder, value)
        if isinstance(kind, types.Array)
        else value
        for kind, value in zip(signature.args, arguments, strict=True)
    ]


def make_prefetch(width: int) -> Any:
    """Build what asks for a row of an array, so that it is near by the time of its use.

    `width` is the length of a row [-]; arrays come from `aligned`.
    """
    lines = range(0, width + (width % LANES > 0) * (LANES - 1), LANES)

    def typed(context: Any, rows: Any, row: Any) -> Any:
        def generated(
            context: Any, builder: Any, signature: Any, arguments: Any
        ) -> Any:
            rows, row = _arrays(context, builder, signature, arguments)
            start = builder.mul(row, ir.Constant(row.type, width))
            word, byte = ir.IntType(32), ir.IntType(8).as_pointer()
            kind = ir.FunctionType(ir.VoidType(), [byte, word, word, word])
            ask = cgutils.get_or_insert_function(
                builder.module, kind, "llvm.prefetch.p0"
            )
            how = [ir.Constant(word, n) for n in (1, 3, 1)]  # to write, keep, data
            for line in lines:
                place = builder.add(start, ir.Constant(row.type, line))
                at = builder.bitcast(builder.gep(rows.data, [place]), byte)
                builder.call(ask, [at, *how])
            return context.get_dummy_value()

        return types.void(rows, types.int64), generated

    if numba.config.DISABLE_JIT:
        return lambda rows, row: None
    return intrinsic(typed)


def aligned(length: int, width: int) -> Any:
    """Zeros (length, width) whose rows begin where cache lines do."""
    line = 8 * LANES
    flat = np.zeros(length * width + LANES)
    start = -flat.ctypes.data % line // 8
    return flat[start : start + length * width].reshape(length, width)


def lined(rows: Any) -> Any:
    """Copy of an array whose rows begin where cache lines do."""
    copy = aligned(*rows.shape)
    copy[:] = rows
    return copy


def make_lanes(stride: int) -> tuple[Any, Any, Any]:
    """Build the moves for a scratch whose rows are so far apart.

    Returns
    -------
    read(rows, column, index, c, scratch, place)
        Read rows index[c:c + 8], columns column:column + 8, into scratch rows: the first
        of them from `place` on.
    write(rows, column, index, c, scratch, place)
        Write scratch rows back, in the order of the contacts.
    add(rows, column, index, c, scratch, place)
        Add them, in that order; several contacts may name the same row, and the column
        may lie in another one, so many rows on or back.
    """
    if numba.config.DISABLE_JIT:
        return _plain(stride)

    def declared(name: str, body: Any) -> Any:
        def typed(
            context: Any,
            rows: Any,
            column: Any,
            index: Any,
            c: Any,
            scratch: Any,
            place: Any,
        ) -> Any:
            signature = types.void(
                rows, types.int64, index, types.int64, scratch, types.int64
            )

            def generated(
                context: Any, builder: Any, signature: Any, arguments: Any
            ) -> Any:
                rows, column, index, c, scratch, place = _arrays(
                    context, builder, signature, arguments
                )
                places = _places(builder, rows, index, c, column)
                lanes = _lanes(builder, place, stride)
                body(builder, rows.data, places, scratch.data, lanes)
                return context.get_dummy_value()

            return signature, generated

        typed.__name__ = name
        return intrinsic(typed)

    def read(b: Any, rows: Any, places: Any, scratch: Any, lanes: Any) -> None:
        turned = _transposed(b, [_read(b, rows, p) for p in places])
        for value, lane in zip(turned, lanes, strict=True):
            _write(b, value, scratch, lane)

    def write(b: Any, rows: Any, places: Any, scratch: Any, lanes: Any) -> None:
        turned = _transposed(b, [_read(b, scratch, lane) for lane in lanes])
        for value, place in zip(turned, places, strict=True):
            _write(b, value, rows, place)

    def add(b: Any, rows: Any, places: Any, scratch: Any, lanes: Any) -> None:
        turned = _transposed(b, [_read(b, scratch, lane) for lane in lanes])
        for value, place in zip(turned, places, strict=True):
            _write(b, b.fadd(_read(b, rows, place), value), rows, place)

    return declared("read", read), declared("write", write), declared("add", add)


def make_sum(length: int) -> Any:
    """Build the sum of so many numbers of a scratch, whole eights, from a place on.

    Eight sums side by side, then halves of them onto each other: SIMD in a fixed order.
    """

    def typed(context: Any, scratch: Any, place: Any) -> Any:
        def generated(
            context: Any, builder: Any, signature: Any, arguments: Any
        ) -> Any:
            scratch, place = _arrays(context, builder, signature, arguments)
            sums = _read(builder, scratch.data, place)
            for first in range(LANES, length, LANES):
                at = builder.add(place, ir.Constant(place.type, first))
                sums = builder.fadd(sums, _read(builder, scratch.data, at))
            for half in (4, 2, 1):
                order = [*range(half, LANES), *range(half)]
                mask = ir.Constant(ir.VectorType(ir.IntType(32), LANES), order)
                sums = builder.fadd(sums, builder.shuffle_vector(sums, sums, mask))
            return builder.extract_element(sums, ir.Constant(ir.IntType(32), 0))

        return types.float64(scratch, types.int64), generated

    def plain(scratch: Any, place: Any) -> float:
        sums = np.zeros(LANES)
        for row in scratch[int(place) : int(place) + length].reshape(-1, LANES):
            sums = sums + row
        for half in (4, 2, 1):
            sums = sums + np.roll(sums, -half)
        return float(sums[0])

    return plain if numba.config.DISABLE_JIT else intrinsic(typed)


def _plain(stride: int) -> tuple[Any, Any, Any]:
    def lanes(scratch: Any, place: Any) -> Any:
        start = int(place) + stride * np.arange(LANES)[:, None] + np.arange(LANES)
        return start

    def read(
        rows: Any, column: int, index: Any, c: int, scratch: Any, place: Any
    ) -> None:
        block = rows[index[c : c + LANES], column : column + LANES]
        scratch[lanes(scratch, place)] = block.T

    def write(
        rows: Any, column: int, index: Any, c: int, scratch: Any, place: Any
    ) -> None:
        block = scratch[lanes(scratch, place)].T
        rows[index[c : c + LANES], column : column + LANES] = block

    def add(
        rows: Any, column: int, index: Any, c: int, scratch: Any, place: Any
    ) -> None:
        block = scratch[lanes(scratch, place)].T
        flat, width = rows.reshape(-1), rows.shape[1]
        for row, value in zip(index[c : c + LANES], block, strict=True):
            start = row * width + column
            flat[start : start + LANES] += value

    return read, write, add
