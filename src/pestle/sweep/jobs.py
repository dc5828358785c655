"""One run of a study: its folder, its lock, and what is known of how it ended.

The folder is named by the hash of the case, so that the same case is never computed
twice, whichever point of whichever design asks for it.  ``outcome.json`` is written in
one piece after everything else: a run counts as finished when that file says so.
"""

import hashlib
import json
import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pestle.errors import PestleError

if TYPE_CHECKING:
    from pestle.config import Case

OUTCOME = "outcome.json"
LOCK = "lock"


@dataclass(frozen=True)
class Job:
    """A run that a study asks for.

    Parameters
    ----------
    id : str
        Name of its folder.
    case_file : str
        Case file.
    changes : dict
        Values that differ from the file.
    folder : str
        Where it is computed.
    """

    id: str
    case_file: str
    changes: dict[str, Any]
    folder: str

    def case(self) -> "Case":
        """Read and check the case."""
        from pestle.config import Case

        return Case.from_file(self.case_file, self.changes)


@dataclass(frozen=True)
class Outcome:
    """How a run ended.

    Parameters
    ----------
    status : {"done", "failed", "stopped"}
        `failed`: for a reason in the case, which another attempt would meet again;
        `stopped`: for one outside, such as a full disk.
    reason : str
        What went wrong, in words.
    steps : int
        Steps of the run [-].
    wall_time : float
        How long it took [s].
    metrics : dict
        Value, unit, label and definition by key.
    """

    status: str
    reason: str = ""
    steps: int = 0
    wall_time: float = 0.0
    metrics: dict[str, Any] = field(default_factory=dict)


def identity(case: "Case") -> str:
    """Name of a run: equal names mean equal results."""
    return hashlib.sha256(case.canonical().encode()).hexdigest()[:16]


def compute(job: Job) -> Outcome:
    """Compute a run, or what is left of it, unless that has been done.

    A second process that is given the same run waits for the first and takes over its
    outcome: a worker that was thought lost may still be at work.
    """
    folder = Path(job.folder)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with _locked(folder):
            known = stored(folder)
            return known if known is not None else _computed(job, folder)
    except (OSError, MemoryError) as error:
        return Outcome("stopped", reason=f"{type(error).__name__}: {error}")


def _computed(job: Job, folder: Path) -> Outcome:
    from pestle import simulation
    from pestle.errors import InputError
    from pestle.simulation import checkpoint

    begin = time.perf_counter()
    try:
        case = job.case()
        if identity(case) != job.id:
            what = f"{job.case_file} has changed since the study began"
            hint = "begin the study again: runs of unchanged cases are kept"
            raise InputError("case-changed", what, hint=hint)
        resume = (folder / checkpoint.NAME).exists()
        result = simulation.run(case, folder, threads=1, resume=resume)
    except PestleError as error:
        if isinstance(error.__cause__, OSError):  # not the fault of the case
            raise error.__cause__ from None
        spent = time.perf_counter() - begin
        outcome = Outcome("failed", f"{error.id}: {error.what}", wall_time=spent)
    else:
        metrics = result.metrics["metrics"]
        spent = time.perf_counter() - begin
        outcome = Outcome("done", "", result.steps, spent, metrics)
    write(folder, outcome)
    return outcome


def write(folder: Path, outcome: Outcome) -> None:
    """Write the outcome of a run, in one piece and to the disk itself."""
    draft = folder / f"{OUTCOME}.{os.getpid()}"
    with draft.open("w", encoding="utf-8") as file:
        json.dump(asdict(outcome), file, indent=1, allow_nan=False)
        file.flush()
        os.fsync(file.fileno())
    draft.replace(folder / OUTCOME)


def stored(folder: Path) -> Outcome | None:
    """Outcome of a run, None as long as it has none."""
    try:
        data = json.loads((folder / OUTCOME).read_text(encoding="utf-8"))
        return Outcome(**data)
    except (FileNotFoundError, ValueError, TypeError):
        return None


def forget_failure(folder: Path) -> None:
    """Let a failed run be tried again, from its beginning."""
    known = stored(folder)
    if known is not None and known.status == "failed":
        (folder / OUTCOME).unlink()
        (folder / "checkpoint.npz").unlink(missing_ok=True)


@contextmanager
def _locked(folder: Path) -> Iterator[None]:
    """Hold the run against other processes; a lock ends with its process."""
    import fcntl

    with (folder / LOCK).open("w") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        yield
