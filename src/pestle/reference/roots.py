"""Roots without library calls: plain functions that a compiler turns into SIMD."""

from typing import NamedTuple


def cube_root(x: float) -> float:
    """Cube root of a positive number between 1e-28 and 1e28, to the last bits.

    The number is brought to 1/8 ... 8 by powers of 8, then four steps of Halley.

    Parameters
    ----------
    x : float
        Number [-].

    Returns
    -------
    float
        Its cube root [-]; 0 for 0.

    Examples
    --------
    >>> cube_root(27.0), cube_root(1e-12)
    (3.0, 0.0001)
    """
    root = 1.0
    big, root = (x * 2.0**-48, root * 2.0**16) if x > 2.0**48 else (x, root)
    big, root = (big * 2.0**-24, root * 2.0**8) if big > 2.0**24 else (big, root)
    big, root = (big * 2.0**-12, root * 2.0**4) if big > 2.0**12 else (big, root)
    big, root = (big * 2.0**-6, root * 2.0**2) if big > 2.0**6 else (big, root)
    big, root = (big * 2.0**-3, root * 2.0) if big > 2.0**3 else (big, root)
    big, root = (big * 2.0**48, root * 2.0**-16) if big < 2.0**-48 else (big, root)
    big, root = (big * 2.0**24, root * 2.0**-8) if big < 2.0**-24 else (big, root)
    big, root = (big * 2.0**12, root * 2.0**-4) if big < 2.0**-12 else (big, root)
    big, root = (big * 2.0**6, root * 2.0**-2) if big < 2.0**-6 else (big, root)
    big, root = (big * 2.0**3, root * 0.5) if big < 2.0**-3 else (big, root)
    y = 1.0
    for _ in range(4):
        cube = y * y * y
        y = y * (cube + 2.0 * big) / (2.0 * cube + big)
    return root * y if x > 0.0 else 0.0


class Bracket(NamedTuple):
    """A root between two points of opposite sign, on the way of Brent's method.

    The function is the caller's affair, so that a compiler can take everything:
    `bracket` begins, then `narrowed` proposes the next point `here` until `done`, and
    `measured` takes the function's value there.
    """

    before: float
    here: float
    kept: float
    f_before: float
    f_here: float
    f_kept: float
    step: float
    last: float
    done: bool


def bracket(low: float, f_low: float, high: float, f_high: float) -> Bracket:
    """Begin between two points at which a function has opposite signs or is zero.

    Parameters
    ----------
    low, f_low, high, f_high : float
        Ends and the function there, in the units of root and function.

    Returns
    -------
    Bracket
        To be narrowed.

    Examples
    --------
    >>> b = bracket(0.0, -2.0, 2.0, 2.0)
    >>> for _ in range(50):
    ...     b = narrowed(b, 1e-15, 1e-15)
    ...     if b.done:
    ...         break
    ...     b = measured(b, b.here * b.here - 2.0)
    >>> round(b.here, 12)
    1.414213562373
    """
    if f_low == 0.0:
        return Bracket(low, low, low, f_low, f_low, f_low, 0.0, 0.0, True)
    wide = high - low
    return Bracket(low, high, low, f_low, f_high, f_low, wide, wide, f_high == 0.0)


def narrowed(b: Bracket, width: float, relative: float) -> Bracket:
    """Next point: inverse interpolation where it converges, bisection where not.

    Parameters
    ----------
    b : Bracket
        What is known.
    width, relative : float
        Absolute and relative width of the answer, root's units and [-].

    Returns
    -------
    Bracket
        With `here` to be measured, or `done` with `here` the root.

    Examples
    --------
    >>> narrowed(bracket(0.0, -1.0, 2.0, 1.0), 0.0, 1e-15).here
    1.0
    """
    before, here, kept, f_before, f_here, f_kept, step, last, done = b
    if done:
        return b
    if f_here == 0.0:
        return Bracket(before, here, kept, f_before, f_here, f_kept, step, last, True)
    if (f_before < 0.0) != (f_here < 0.0):
        kept, f_kept = before, f_before
        step = last = here - before
    if abs(f_kept) < abs(f_here):
        before, here, kept = here, kept, here
        f_before, f_here, f_kept = f_here, f_kept, f_here
    tolerance = 0.5 * (width + relative * abs(here))
    half = 0.5 * (kept - here)
    if abs(half) < tolerance:
        return Bracket(before, here, kept, f_before, f_here, f_kept, step, last, True)
    guess = half
    if abs(last) > tolerance and abs(f_here) < abs(f_before):
        if before == kept:
            guess = -f_here * (here - before) / (f_here - f_before)
        else:
            a = (f_before - f_here) / (before - here)
            c = (f_kept - f_here) / (kept - here)
            guess = -f_here * (f_kept * c - f_before * a)
            guess /= c * a * (f_kept - f_before)
        if 2.0 * abs(guess) < min(abs(last), 3.0 * abs(half) - tolerance):
            last = step
        else:
            guess = last = half
    else:
        last = half
    step, before, f_before = guess, here, f_here
    least = tolerance if half > 0.0 else -tolerance
    here += step if abs(step) > tolerance else least
    return Bracket(before, here, kept, f_before, f_here, f_kept, step, last, False)


def measured(b: Bracket, value: float) -> Bracket:
    """Take the function's value at `here`.

    Parameters
    ----------
    b : Bracket
        Just narrowed.
    value : float
        The function at `here`, in its units.

    Returns
    -------
    Bracket
        To be narrowed again.

    Examples
    --------
    >>> measured(bracket(0.0, -1.0, 2.0, 1.0), 0.5).f_here
    0.5
    """
    return Bracket(
        b.before, b.here, b.kept, b.f_before, value, b.f_kept, b.step, b.last, False
    )
