"""Dask: a cluster of our own on this machine, or one that runs already."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from pestle.errors import InputError, SimulationError

if TYPE_CHECKING:
    from distributed import Client

ATTEMPTS = 3
"""Workers that may die at one run before it is given up."""

CONNECT = 10.0
"""Longest time to wait for a scheduler to answer [s]."""

_ONE_THREAD = {
    name: "1"
    for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS")
}


def require() -> None:
    """Refuse to begin without the libraries of a sweep."""
    from importlib.util import find_spec

    for name in ("distributed", "pyarrow"):
        if find_spec(name) is None:
            raise InputError(
                "missing-extra",
                f"a sweep needs {name}, which is not installed",
                hint='install it with: pip install "pestle[sweep]"',
            )


def worker_count(memory: int, runs: int) -> int:
    """Number of processes: a core and the memory of a run for each.

    Parameters
    ----------
    memory : int
        Memory of one run [bytes].
    runs : int
        Runs to compute [-].
    """
    from dask.system import CPU_COUNT
    from distributed.system import MEMORY_LIMIT

    fitting = int(0.9 * MEMORY_LIMIT / max(memory, 1))
    return max(1, min(CPU_COUNT, fitting, runs))


@contextmanager
def connected(scheduler: str | None, workers: int) -> "Iterator[Client]":
    """Client of a running cluster, or of one that lives as long as the study.

    Parameters
    ----------
    scheduler : str, optional
        Address of a running one, ``tcp://host:8786``.
    workers : int
        Processes of a cluster of our own [-].
    """
    import dask
    from distributed import Client, LocalCluster

    quiet: dict[str, Any] = {
        "distributed.scheduler.allowed-failures": ATTEMPTS - 1,
        "distributed.nanny.pre-spawn-environ": _ONE_THREAD,
        # one run at a time: a run that waits on a worker cannot move to an idle one
        "distributed.scheduler.worker-saturation": 1.0,
    }
    with dask.config.set(quiet):
        if scheduler is not None:
            try:
                client = Client(scheduler, timeout=CONNECT, set_as_default=False)
            except (OSError, TimeoutError, ValueError) as error:
                raise InputError(
                    "no-scheduler",
                    f"no Dask scheduler answers at {scheduler}: {error}",
                    "--scheduler",
                    "start one with `dask scheduler`, or leave the option out",
                ) from None
            with client:
                yield client
            return
        with (
            LocalCluster(
                n_workers=workers,
                threads_per_worker=1,
                processes=True,
                dashboard_address=":0",
                silence_logs=50,
            ) as cluster,
            Client(cluster, set_as_default=False) as client,
        ):
            yield client


def lost(error: BaseException) -> SimulationError:
    """Error for a scheduler that has gone away."""
    return SimulationError(
        "scheduler-lost",
        f"the Dask scheduler has gone away: {type(error).__name__}: {error}",
        hint="finished runs are kept: the same command goes on with the rest",
    )
