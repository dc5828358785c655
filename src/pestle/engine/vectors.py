"""Vectors of three numbers, as the loops over contacts write them."""

from pestle import _jit
from pestle._jit import multiply_add

Vector = tuple[float, float, float]


@_jit.inline
def dot(a: Vector, b: Vector) -> float:
    """Return a . b."""
    return multiply_add(a[2], b[2], multiply_add(a[1], b[1], a[0] * b[0]))


@_jit.inline
def cross(a: Vector, b: Vector) -> Vector:
    """Return a x b; exactly 0 for a vector with itself, which one rounding is not."""
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


@_jit.inline
def times(s: float, a: Vector) -> Vector:
    """Return s a."""
    return s * a[0], s * a[1], s * a[2]


@_jit.inline
def minus(a: Vector, b: Vector) -> Vector:
    """Return a - b."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


@_jit.inline
def plus(a: Vector, s: float, b: Vector) -> Vector:
    """Return a + s b."""
    return (
        multiply_add(s, b[0], a[0]),
        multiply_add(s, b[1], a[1]),
        multiply_add(s, b[2], a[2]),
    )
