"""Screening of contacts that pass through a third particle (MDR, Part II).

For every triple that overlaps mutually, the pair with the longest distance loses
1/(1 + exp(-50 (alpha/pi - 1/2))) of its weight, alpha the angle at the third particle.
Candidate triples are found when the list is rebuilt; weights are set in every step, from
the distances of the step before.
"""

from math import acos, exp, pi, sqrt
from typing import Any

import numpy as np

from pestle import _jit


@_jit.njit
def _adjacent(n: int, pa: Any, pb: Any) -> tuple[Any, Any, Any]:
    """Return the full neighbour lists with the slots of their pairs, sorted."""
    start = np.zeros(n + 1, np.int64)
    for s in range(pa.shape[0]):
        start[pa[s] + 1] += 1
        start[pb[s] + 1] += 1
    for i in range(n):
        start[i + 1] += start[i]
    place = start[:-1].copy()
    other = np.empty(2 * pa.shape[0], np.int32)
    slot = np.empty(2 * pa.shape[0], np.int32)
    for s in range(pa.shape[0]):
        a, b = pa[s], pb[s]
        other[place[a]], slot[place[a]] = b, s
        other[place[b]], slot[place[b]] = a, s
        place[a] += 1
        place[b] += 1
    return start, other, slot


@_jit.njit
def triples(n: int, pa: Any, pb: Any) -> tuple[Any, Any]:
    """Return `first` and `sides`: the other two pairs of each triple that a pair is in."""
    start, other, slot = _adjacent(n, pa, pb)
    mark = np.full(n, -1, np.int64)
    first = np.zeros(pa.shape[0] + 1, np.int64)
    sides = np.empty((0, 2), np.int32)
    for fill in range(2):
        total = 0
        for s in range(pa.shape[0]):
            first[s] = total
            a, b = pa[s], pb[s]
            for o in range(start[a], start[a + 1]):
                mark[other[o]] = slot[o]
            for o in range(start[b], start[b + 1]):
                third = other[o]
                if third != a and mark[third] >= 0:
                    if fill == 1:
                        sides[total, 0] = mark[third]
                        sides[total, 1] = slot[o]
                    total += 1
            for o in range(start[a], start[a + 1]):
                mark[other[o]] = -1
        first[pa.shape[0]] = total
        if fill == 0:
            sides = np.empty((total, 2), np.int32)
    return first, sides


@_jit.njit
def weigh(first: Any, sides: Any, dist: Any, weight: Any, k0: int, k1: int) -> None:
    """Set the weights of the pairs k0:k1; `dist` is squared distance, -1 if apart."""
    for s in range(k0, k1):
        lost = 0.0
        d = dist[s]
        if d > 0.0:
            for t in range(first[s], first[s + 1]):
                one, two = dist[sides[t, 0]], dist[sides[t, 1]]
                if one > 0.0 and two > 0.0 and d > one and d > two:
                    cosine = (one + two - d) / (2.0 * sqrt(one * two))
                    angle = acos(min(max(cosine, -1.0), 1.0))
                    lost += 1.0 / (1.0 + exp(-50.0 * (angle / pi - 0.5)))
        weight[s] = max(1.0 - lost, 0.0)
