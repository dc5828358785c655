"""Where everything lies: scratch rows, histories, the pair table, buffers, ledger.

A block of contacts is evaluated in a flat scratch, one row a quantity, so that the loop
over contacts becomes SIMD; NamedTuples of a law are loaded from and saved to such rows.
"""

from typing import Any

from pestle import _jit
from pestle.laws._base import Parts

BLOCK = 128  # contacts in a block
W = BLOCK + 8  # length of a scratch row; no power of two: rows spread over the cache
# scratch rows
DX, D2, VX, OX, RA, RB, MASS, KIND, WEIGHT, WX = 0, 3, 4, 7, 10, 11, 12, 13, 14, 15
BEFORE = WEIGHT  # of a wall contact, which has no weight: squared distance a step ago
H0 = 18  # history: spring force 3, its stiffness, normal force, energy, damping force
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


def loader(kind: type, base: int) -> Any:
    """Compiled function that reads a NamedTuple of floats from scratch rows."""
    length = len(kind._fields)  # type: ignore[attr-defined]
    if length == 0:
        return _jit.inline(lambda scratch, c: kind())

    def step(count: int) -> Any:
        row = (base + count - 1) * W
        if count == 1:
            return _jit.inline(lambda scratch, c: (scratch[row + c],))
        before = step(count - 1)
        return _jit.inline(lambda scratch, c: (*before(scratch, c), scratch[row + c]))

    fields = step(length)
    return _jit.inline(lambda scratch, c: kind(*fields(scratch, c)))


def saver(kind: type, base: int) -> Any:
    """Compiled function that writes a NamedTuple of floats to scratch rows."""
    length = len(kind._fields)  # type: ignore[attr-defined]

    def step(index: int) -> Any:
        if index == length:
            return _jit.inline(lambda scratch, c, values: None)
        row, after = (base + index) * W, step(index + 1)

        def save(scratch: Any, c: int, values: Any) -> None:
            scratch[row + c] = values[index]
            after(scratch, c, values)

        return _jit.inline(save)

    return step(0)


def table_loader(kind: type, base: int, zeros: tuple[int, ...] = ()) -> Any:
    """Compiled function that reads a NamedTuple from a row of the pair table.

    Fields in `zeros` are compiled in as 0: what a law does only for them falls away.
    """
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

        self.state = size(law.state)
        self.fields = size(law.particle)
        self.sums = size(law.sums)
        self.history = HISTORY + (ROLLING if rolling else 0) + self.state
        self.state_row = H0 + self.history - self.state
        self.field_row = H0 + self.history
        self.out = self.field_row + 2 * self.fields
        self.sum_row = self.out + 12
        self.ledger_row = self.sum_row + 2 * self.sums
        self.rows = self.ledger_row + 5
        self.columns = COLUMNS + self.sums
        # energy that contacts give to their particles
        names = law.sums._fields  # type: ignore[attr-defined]
        self.worked = self.sum_row + names.index("worked") if "worked" in names else 0
        # a law whose particles grow keeps the last growth of the radius in this field
        names = law.particle._fields  # type: ignore[attr-defined]
        self.growth = self.field_row + names.index("growth") if "growth" in names else 0
