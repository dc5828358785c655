"""How many threads a run uses; its results do not depend on it."""

from typing import Any


def set_threads(wanted: int | None) -> int:
    """Let the engine use so many threads, all cores by default; return their number."""
    import numba

    config: Any = numba.config
    if wanted is not None:
        numba.set_num_threads(min(wanted, config.NUMBA_NUM_THREADS))
    return int(numba.get_num_threads())
