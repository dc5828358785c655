"""How many threads a run uses; its results do not depend on it."""

from typing import Any

FEW = 2000
"""Fewer particles than this run faster on one thread [-].

Best steps per second on two threads over those on one, each particle in 5.4 contacts:
216 particles 0.89 (MDR) and 0.74 (Hertz), 1000: 0.98 and 0.92, 2197: 1.37 and 0.96,
4096: 1.60 and 1.14.
"""


def set_threads(wanted: int | None, particles: int) -> int:
    """Let the engine use so many threads; return their number.

    By default one for few particles, otherwise all cores.
    """
    import numba

    config: Any = numba.config
    cores = int(config.NUMBA_NUM_THREADS)
    if wanted is None:
        wanted = 1 if particles < FEW else cores
    numba.set_num_threads(min(wanted, cores))
    return min(wanted, cores)
