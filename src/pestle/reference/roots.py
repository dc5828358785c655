"""Roots without library calls: plain functions that a compiler turns into SIMD."""


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
