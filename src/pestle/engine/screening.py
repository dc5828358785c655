"""Screening of contacts that pass through a third particle (MDR, Part II).

For every triple that overlaps mutually, the pair with the longest distance loses
1/(1 + exp(-50 (alpha/pi - 1/2))) of its weight, alpha the angle at the third particle.
Candidate triples are found when the list is rebuilt; weights are set in every step, from
the distances of the step before.
"""

from math import pi, sqrt
from typing import Any

import numpy as np

from pestle import _jit

ROW = 64  # screened pairs worked off together


@_jit.njit
def triples(first: Any, pa: Any, pb: Any, chunks: Any) -> tuple[Any, Any]:
    """Return `start` and `sides`: three pairs that form a triangle, by chunk.

    Pairs of the lower index i are first[i]:first[i + 1].  The triples of chunk c are
    start[c]:start[c + 1]; a chunk lists all that have a pair of its own.
    """
    n, number = first.shape[0] - 1, chunks.shape[0] - 1
    home = np.empty(n, np.int64)
    for c in range(number):
        home[chunks[c] : chunks[c + 1]] = c
    mark = np.full(n, -1, np.int64)
    start = np.zeros(number + 1, np.int64)
    place = np.zeros(number, np.int64)
    sides = np.empty((0, 3), np.int32)
    for fill in range(2):
        for i in range(n):
            for s in range(first[i], first[i + 1]):
                mark[max(pa[s], pb[s])] = s
            for s in range(first[i], first[i + 1]):
                j = max(pa[s], pb[s])
                for t in range(first[j], first[j + 1]):
                    third = mark[max(pa[t], pb[t])]
                    if third < 0:
                        continue
                    for c in (home[i], home[j]):
                        if fill == 1:
                            sides[place[c], 0], sides[place[c], 1] = s, t
                            sides[place[c], 2] = third
                        place[c] += 1
                        if home[i] == home[j]:
                            break
            for s in range(first[i], first[i + 1]):
                mark[max(pa[s], pb[s])] = -1
        if fill == 0:
            for c in range(number):
                start[c + 1] = start[c] + place[c]
            place[:] = start[:-1]
            sides = np.empty((start[number], 3), np.int32)
    return start, sides


@_jit.inline
def arcsine(x: float) -> float:
    """asin(x) to round-off, in a form that the compiler turns into SIMD [rad]."""
    size = abs(x)
    small = size < 0.5
    z = x * x if small else 0.5 * (1.0 - size)
    s = size if small else sqrt(z)
    p = 3.47933107596021167570e-05
    p = p * z + 7.91534994289814532176e-04
    p = p * z - 4.00555345006794114027e-02
    p = p * z + 2.01212532134862925881e-01
    p = p * z - 3.25565818622400915405e-01
    p = p * z + 1.66666666666666657415e-01
    q = 7.70381505559019352791e-02
    q = q * z - 6.88283971605453293030e-01
    q = q * z + 2.02094576023350569471e00
    q = q * z - 2.40339491173441421878e00
    q = q * z + 1.0
    value = s + s * (z * p / q)
    value = value if small else 0.5 * pi - 2.0 * value
    return value if x >= 0.0 else -value


@_jit.inline
def exponential(x: float) -> float:
    """exp(x) for -25 <= x <= 10 to 4e-15, by squaring a Taylor polynomial [-]."""
    y = x * 0.03125
    p = 1.0 / 1307674368000.0
    p = p * y + 1.0 / 87178291200.0
    p = p * y + 1.0 / 6227020800.0
    p = p * y + 1.0 / 479001600.0
    p = p * y + 1.0 / 39916800.0
    p = p * y + 1.0 / 3628800.0
    p = p * y + 1.0 / 362880.0
    p = p * y + 1.0 / 40320.0
    p = p * y + 1.0 / 5040.0
    p = p * y + 1.0 / 720.0
    p = p * y + 1.0 / 120.0
    p = p * y + 1.0 / 24.0
    p = p * y + 1.0 / 6.0
    p = p * y + 0.5
    p = p * y + 1.0
    p = p * y + 1.0
    p = p * p
    p = p * p
    p = p * p
    p = p * p
    return p * p


@_jit.njit
def _lose(weight: Any, work: Any, slot: Any, m: int) -> None:
    """Add what `m` screened pairs lose; `work` holds cosines, as difference and product."""
    for c in range(m):
        cosine = work[c] / (2.0 * sqrt(work[ROW + c]))
        tilt = arcsine(min(max(cosine, -1.0), 1.0))  # pi/2 - alpha
        work[2 * ROW + c] = 1.0 / (1.0 + exponential(50.0 / pi * tilt))
    for c in range(m):
        weight[slot[c]] += work[2 * ROW + c]


@_jit.njit
def weigh(
    sides: Any,
    dist: Any,
    weight: Any,
    t0: int,
    t1: int,
    k0: int,
    k1: int,
    work: Any,
    slot: Any,
) -> None:
    """Set the weights of a chunk's pairs k0:k1 from its triples t0:t1.

    `dist` is the squared distance of a pair, -1 if apart.  The few screened pairs among the triples are collected in `work` and `slot`, then
    worked off together.
    """
    U = np.uint64
    for s in range(k0, k1):
        weight[s] = 0.0
    m = 0
    for t in range(t0, t1):
        a, b, c = sides[t, 0], sides[t, 1], sides[t, 2]
        da, db, dc = dist[U(a)], dist[U(b)], dist[U(c)]
        longest_a = (da > db) & (da > dc)
        longest_b = (db > da) & (db > dc)
        slot[m] = a if longest_a else (b if longest_b else c)
        longest = da if longest_a else (db if longest_b else dc)
        one, two = db if longest_a else da, dc if longest_a | longest_b else db
        work[m] = one + two - longest
        work[ROW + m] = one * two
        mutual = (one > 0.0) & (two > 0.0) & (longest > one) & (longest > two)
        m += mutual & (slot[m] >= k0) & (slot[m] < k1)
        if m == ROW:
            _lose(weight, work, slot, m)
            m = 0
    _lose(weight, work, slot, m)
    for s in range(k0, k1):
        weight[s] = max(1.0 - weight[s], 0.0)
