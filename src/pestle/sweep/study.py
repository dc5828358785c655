"""Run a study: what is missing of it, on a cluster, and the table of all of it."""

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any
from uuid import uuid4

from pestle.errors import InputError, PestleError
from pestle.sweep import cluster, table
from pestle.sweep.design import points
from pestle.sweep.jobs import Job, Outcome, compute, forget_failure, identity, stored

if TYPE_CHECKING:
    from pestle.config.study import StudySettings

RUNS = "runs"
WAITING = Outcome("waiting")
BYTES = 4000
"""Memory of a particle with its contacts, generous [bytes]."""
BASE = 400_000_000
"""Memory of a process without particles [bytes]."""


@dataclass(frozen=True)
class Row:
    """A run of a study.

    Parameters
    ----------
    number, point : int
        Numbers of the run and of its point, from 0 [-].
    seed : int
        Seed of its case [-].
    values : dict
        Varied values by key.
    job : Job or None
        How to compute it; None where its case is refused.
    outcome : Outcome
        What is known of it.
    particles : int
        Particles that its case generates [-].
    """

    number: int
    point: int
    seed: int
    values: dict[str, Any]
    job: Job | None
    outcome: Outcome = WAITING
    particles: int = 0

    @property
    def link(self) -> str:
        """Folder of the run, relative to that of the study."""
        return f"{RUNS}/{self.job.id}" if self.job else ""


@dataclass(frozen=True)
class StudyProgress:
    """How far a study is; times in s."""

    done: int
    failed: int
    total: int
    workers: int
    left: float | None


@dataclass(frozen=True)
class StudyResult:
    """What a study left behind."""

    folder: Path
    table: Path
    rows: list[Row] = field(repr=False)

    def count(self, status: str) -> int:
        """Number of runs that ended so."""
        return sum(row.outcome.status == status for row in self.rows)


Report = Callable[[StudyProgress], None]


def planned(study: "StudySettings", folder: Path) -> list[Row]:
    """All runs of a study, with what is known of them.

    Parameters
    ----------
    study : StudySettings
        The study.
    folder : Path
        Its folder.
    """
    from pestle.config import Case

    first = Case.from_file(study.case_file, study.set).seed
    rows: list[Row] = []
    for number, point in enumerate(points(study)):
        for replicate in range(study.replicates):
            seed = int(point.get("seed", first + replicate))
            changes = {**study.set, **point, "seed": seed}
            rows.append(_row(study, folder, number, changes, point, len(rows)))
    if rows and all(row.job is None for row in rows):
        raise InputError(
            "no-valid-run",
            f"every run of the study is refused: {rows[0].outcome.reason}",
            str(study.source),
        )
    return rows


def _row(
    study: "StudySettings",
    folder: Path,
    point: int,
    changes: dict[str, Any],
    values: dict[str, Any],
    number: int,
) -> Row:
    path = str(study.case_file.resolve())
    draft = Job("", path, changes, "")
    try:
        case = draft.case()
    except InputError as error:
        if error.id in ("unknown-key", "ambiguous-key", "no-such-file", "not-toml"):
            raise  # wrong in every run
        outcome = Outcome("failed", f"{error.id}: {error.what}")
        return Row(number, point, changes["seed"], values, None, outcome)
    name = identity(case)
    place = folder.resolve() / RUNS / name
    job = Job(name, path, changes, str(place))
    outcome = stored(place) or WAITING
    particles = sum(case.generated)
    return Row(number, point, changes["seed"], values, job, outcome, particles)


def run_study(
    study: "StudySettings",
    folder: Path,
    *,
    workers: int | None = None,
    scheduler: str | None = None,
    retry_failed: bool = False,
    progress: Report | None = None,
) -> StudyResult:
    """Compute what is missing of a study and write its table.

    Parameters
    ----------
    study : StudySettings
        The study.
    folder : Path
        Where its runs and its table are, or will be.
    workers : int, optional
        Processes on this machine, by default as many as cores and memory allow [-].
    scheduler : str, optional
        Address of a Dask scheduler whose workers see the same folders.
    retry_failed : bool
        Try runs again that failed for a reason of their own.
    progress : callable, optional
        Called after every run.
    """
    cluster.require()
    folder.mkdir(parents=True, exist_ok=True)
    rows = planned(study, folder)
    if retry_failed:
        for row in rows:
            if row.job is not None and row.outcome.status == "failed":
                forget_failure(Path(row.job.folder))
        rows = planned(study, folder)
    jobs = {row.job.id: row.job for row in rows if row.outcome is WAITING and row.job}
    known = {row.job.id: row.outcome for row in rows if row.job}
    memory = BASE + BYTES * max((row.particles for row in rows), default=0)
    count = workers or cluster.worker_count(memory, len(jobs))
    clock = _Clock(count, len(jobs))
    try:
        for name, outcome in finished(list(jobs.values()), count, scheduler):
            known[name] = outcome
            if progress:
                progress(_progress(rows, known, clock.after_one()))
    finally:
        rows = [_with(row, known) for row in rows]
        path = folder / table.TABLE
        table.write(path, rows)
    return StudyResult(folder, path, rows)


def _with(row: Row, known: dict[str, Outcome]) -> Row:
    if row.job is None:
        return row
    outcome = known.get(row.job.id, WAITING)
    return Row(
        row.number, row.point, row.seed, row.values, row.job, outcome, row.particles
    )


class _Clock:
    """Time left, from the runs that have ended."""

    def __init__(self, workers: int, total: int) -> None:
        self.begin, self.ended = time.monotonic(), 0
        self.workers, self.total = workers, total

    def after_one(self) -> tuple[int, float]:
        """Note that a run has ended; workers and the time left [s]."""
        self.ended += 1
        spent = time.monotonic() - self.begin
        return self.workers, spent * (self.total - self.ended) / self.ended


def _progress(
    rows: Sequence[Row], known: dict[str, Outcome], clock: tuple[int, float]
) -> StudyProgress:
    states = [_with(row, known).outcome.status for row in rows]
    failed = states.count("failed") + states.count("stopped")
    return StudyProgress(states.count("done"), failed, len(rows), *clock)


def finished(
    jobs: list[Job], workers: int, scheduler: str | None = None
) -> Iterator[tuple[str, Outcome]]:
    """Compute runs on a cluster; yields the name and outcome of each as it ends.

    Raises
    ------
    SimulationError
        If the scheduler goes away; what has ended is kept.
    """
    if not jobs:
        return
    from distributed import as_completed

    with cluster.connected(scheduler, workers) as client:
        # one name before the numbers: Dask keeps a queue for tasks that belong
        # together, and only runs in no worker's list yet can go to an idle one
        study = f"study-{uuid4().hex}"
        names = {(study, number): job.id for number, job in enumerate(jobs)}
        futures = client.map(compute, jobs, key=list(names), pure=False)
        try:
            for future in as_completed(futures, loop=client.loop):
                yield names[future.key], _outcome(future)
        except (OSError, TimeoutError) as error:
            raise cluster.lost(error) from error


def _outcome(future: Any) -> Outcome:
    """Outcome of a run; workers that died at it are named."""
    from distributed import KilledWorker

    if future.status == "finished":
        outcome: Outcome = future.result()
        return outcome
    if future.status == "cancelled":
        raise cluster.lost(ConnectionError("its runs were cancelled"))
    error = future.exception()
    if isinstance(error, KilledWorker):
        count = cluster.ATTEMPTS
        return Outcome("stopped", f"{count} workers died at it, one after the other")
    if isinstance(error, PestleError):
        return Outcome("failed", f"{error.id}: {error.what}")
    return Outcome("stopped", f"{type(error).__name__}: {error}")
