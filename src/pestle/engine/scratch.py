"""Where everything lies: scratch rows, histories, the pair table, buffers, ledger.

A block of contacts is evaluated in a flat scratch, one row a quantity, so that the loop
over contacts becomes SIMD; NamedTuples of a law are loaded from and saved to such rows.
"""

from typing import Any

import numpy as np

from pestle import _jit
from pestle.engine.lanes import LANES, make_lanes
from pestle.laws._base import Parts

BLOCK = 128  # contacts in a block
# length of a scratch row; no power of two: rows spread over the cache
W = BLOCK + LANES
# scratch rows; A and B are velocity 3, mass, angular velocity 3, moment of inertia
DX, D2, RA, RB, WEIGHT, A, B = 0, 3, 4, 5, 6, 8, 16
MASS, SPIN = 3, 4  # within A and B
BEFORE = WEIGHT  # of a wall contact, which has no weight: squared distance a step ago
H0 = 24  # history: spring force 3, compliance, normal force, energy, damping force
HISTORY = 7
ROLLING = 3  # further history of the rolling spring
# pair table, columns before the law's constants
FRICTION, ROLL, DAMPING, SHEAR, PAIR = 0, 1, 2, 3, 4
# columns of a force buffer before the law's sums
FORCE, TORQUE, STIFF, COLUMNS = 0, 3, 6, 7
# ledger of a chunk
STORED, PLASTIC, SLIDING, DAMPED, NEGATIVE, NEGATIVES, TOUCHING, DEEPEST, WHERE = range(
    9
)
# and of its particles: energy that the law holds in them, and what it lets go of
HELD, SPENT, UNPAID, DEBTS = 16, 17, 18, 19
# power of a deforming box, by the lengths before and after the step [W]
BOX_NOW, BOX_NEXT = 20, 21
LEDGER = 24


@_jit.inline
def at(row: int, c: Any) -> Any:
    """Place of contact c in a row of the scratch; unsigned, so it is never wrapped."""
    return np.uint64(row * W) + np.uint64(c)


def padded(length: int) -> int:
    """Length of a row that is added in turns of `LANES` numbers."""
    return (length + LANES - 1) // LANES * LANES


def turns(length: int) -> int:
    """Turns that move a row of `length` numbers; the last one may overlap the others."""
    return padded(length) // LANES


read_lanes, write_lanes, add_lanes = make_lanes(W)


@_jit.njit
def fill_lanes(S: Any, listed: Any, m: int) -> int:
    """Repeat the last of m contacts up to a whole number of lanes; return their number.

    The loop over contacts then has no rest that is not SIMD.
    """
    full = (m + LANES - 1) // LANES * LANES
    for c in range(m, full):
        listed[c] = listed[m - 1]
        for row in range(WEIGHT):
            S[at(row, c)] = S[at(row, m - 1)]
    return full


def loader(kind: type, base: int, zeros: tuple[int, ...] = ()) -> Any:
    """Compiled function that reads a NamedTuple of floats from scratch rows.

    Fields in `zeros` are compiled in as 0: what a law does only for them falls away.
    """
    length = len(kind._fields)  # type: ignore[attr-defined]
    if length == 0:
        return _jit.inline(lambda scratch, c: kind())

    def step(count: int) -> Any:
        row = base + count - 1
        if count == 0:
            return _jit.inline(lambda scratch, c: ())
        before = step(count - 1)
        if count - 1 in zeros:
            return _jit.inline(lambda scratch, c: (*before(scratch, c), 0.0))
        return _jit.inline(
            lambda scratch, c: (*before(scratch, c), scratch[at(row, c)])
        )

    fields = step(length)
    return _jit.inline(lambda scratch, c: kind(*fields(scratch, c)))


def saver(kind: type, base: int) -> Any:
    """Compiled function that writes a NamedTuple of floats to scratch rows."""
    length = len(kind._fields)  # type: ignore[attr-defined]

    def step(index: int) -> Any:
        if index == length:
            return _jit.inline(lambda scratch, c, values: None)
        row, after = base + index, step(index + 1)

        def save(scratch: Any, c: int, values: Any) -> None:
            scratch[at(row, c)] = values[index]
            after(scratch, c, values)

        return _jit.inline(save)

    return step(0)


def table_loader(kind: type, base: int, zeros: tuple[int, ...] = ()) -> Any:
    """Compiled function that reads a NamedTuple from a row of a table; see `loader`."""
    length = len(kind._fields)  # type: ignore[attr-defined]

    def step(count: int) -> Any:
        column = base + count - 1
        if count == 0:
            return _jit.inline(lambda table, row: ())
        before = step(count - 1)
        if count - 1 in zeros:
            return _jit.inline(lambda table, row: (*before(table, row), 0.0))
        return _jit.inline(lambda table, row: (*before(table, row), table[row, column]))

    if length == 0:
        return _jit.inline(lambda table, row: kind())
    fields = step(length)
    return _jit.inline(lambda table, row: kind(*fields(table, row)))


class Layout:
    """Where the parts of a law lie in scratch, history and buffers."""

    def __init__(self, law: Parts, rolling: bool) -> None:
        def size(kind):
            return len(kind._fields)

        self.used = PAIR + size(law.constants)  # columns of the pair table
        self.constants = max(self.used, LANES)  # and how many it has
        self.fields = max(size(law.particle), LANES) if size(law.particle) else 0
        self.sums = size(law.sums)
        self.state_row = H0 + HISTORY + (ROLLING if rolling else 0)
        self.history = max(self.state_row - H0 + size(law.state), LANES)
        self.columns = padded(COLUMNS + self.sums)  # of a force buffer
        self.field_a = H0 + self.history
        self.field_b = self.field_a + self.fields
        self.table_row = self.field_b + self.fields
        self.out_a = self.table_row + self.constants
        self.out_b = self.out_a + self.columns
        self.deep_row = self.out_b + self.columns
        self.ledger_row = self.deep_row + 1
        self.rows = self.ledger_row + 5
        # energy that contacts give to their particles
        names = law.sums._fields  # type: ignore[attr-defined]
        self.worked = COLUMNS + names.index("worked") if "worked" in names else 0
        # a law whose particles grow keeps the last growth of the radius in this field
        names = law.particle._fields  # type: ignore[attr-defined]
        self.growth = names.index("growth") if "growth" in names else -1
