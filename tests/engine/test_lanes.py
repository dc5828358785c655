"""Rows turned into lanes in registers are those that plain Python moves."""

import numpy as np
import pytest

from pestle import _jit
from pestle.engine import lanes
from pestle.engine.scratch import W

MOVES = ("read", "write", "add")


@pytest.mark.parametrize("number", range(3), ids=MOVES)
@pytest.mark.parametrize("width", [8, 11, 24])
def test_compiled_moves_are_the_plain_ones(number: int, width: int) -> None:
    move, plain = lanes.make_lanes(W)[number], lanes._plain(W)[number]
    compiled = _jit.njit(
        lambda rows, column, index, scratch, place: move(
            rows, column, index, 16, scratch, place
        )
    )
    random = np.random.default_rng(number)
    rows = random.random((50, width))
    scratch = random.random(12 * W)
    index = random.integers(0, 5, 32)  # rows are named more than once
    column, place = width - 8, 3 * W + 16
    if MOVES[number] == "write":  # as it is used: no row twice with other values
        index = random.permutation(50)[:32]
    mine, theirs = (rows.copy(), scratch.copy()), (rows.copy(), scratch.copy())
    compiled(mine[0], column, index, mine[1], place)
    plain(theirs[0], column, index, 16, theirs[1], place)
    for one, two in zip(mine, theirs, strict=True):
        assert np.array_equal(one, two)
    assert not np.array_equal(mine[0], rows) or not np.array_equal(mine[1], scratch)


@pytest.mark.parametrize("width", [1, 8, 17])
def test_rows_begin_at_cache_lines(width: int) -> None:
    table = lanes.aligned(5, width)
    assert table.shape == (5, width)
    assert table.ctypes.data % 64 == 0
    assert table.flags.c_contiguous
    assert not table.any()
    assert np.array_equal(lanes.lined(table + 1.0), table + 1.0)
