"""Few particles are faster on one thread."""

from collections.abc import Iterator

import numba
import pytest

from pestle.simulation.threads import FEW, set_threads


@pytest.fixture(autouse=True)
def _as_before() -> Iterator[None]:
    before = numba.get_num_threads()
    yield
    numba.set_num_threads(before)


@pytest.mark.parametrize(
    ("wanted", "particles", "used"),
    [
        (None, FEW - 1, 1),
        (None, FEW, numba.config.NUMBA_NUM_THREADS),
        (1, 10 * FEW, 1),
        (10**6, 10, numba.config.NUMBA_NUM_THREADS),
    ],
)
def test_threads_by_the_number_of_particles(
    wanted: int | None, particles: int, used: int
) -> None:
    assert set_threads(wanted, particles) == used
    assert numba.get_num_threads() == used
