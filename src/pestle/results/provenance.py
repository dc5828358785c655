"""Where a result comes from: version, case, seed, machine, threads."""

import hashlib
import json
import platform
from collections.abc import Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from pestle.errors import InputError

_LIBRARIES = ("numpy", "numba", "scipy", "h5py")


def collect(
    *,
    case_text: str,
    canonical: str | None = None,
    seed: int | None = None,
    threads: int | None = None,
) -> dict[str, Any]:
    """Describe this run.

    Parameters
    ----------
    case_text : str
        The case file as it was read.
    canonical : str, optional
        Text whose hash identifies the case; `case_text` if not given.
    seed : int, optional
        Seed of the random numbers [-].
    threads : int, optional
        Number of threads [-].

    Returns
    -------
    dict
        Plain values that JSON can hold.

    Examples
    --------
    >>> record = collect(case_text="seed = 1", seed=1)
    >>> record["case_sha256"][:8], record["seed"]
    ('1d932908', 1)
    """
    import pestle

    identity = case_text if canonical is None else canonical
    return {
        "pestle_version": pestle.__version__,
        "case_sha256": hashlib.sha256(identity.encode()).hexdigest(),
        "case_text": case_text,
        "seed": seed,
        "threads": threads,
        "started": datetime.now(UTC).isoformat(timespec="seconds"),
        "machine": machine(),
        "libraries": _library_versions(),
    }


def machine() -> dict[str, Any]:
    """Describe the computer: processor, cores [-], memory [bytes], system."""
    import os

    return {
        "processor": _processor(),
        "cores": os.cpu_count(),
        "memory_bytes": _memory(),
        "system": f"{platform.system()} {platform.release()} {platform.machine()}",
        "python": platform.python_version(),
    }


def _processor() -> str:
    cpuinfo = Path("/proc/cpuinfo")
    if cpuinfo.exists():
        for line in cpuinfo.read_text(errors="replace").splitlines():
            if line.lower().startswith("model name"):
                return line.partition(":")[2].strip()
    return platform.processor() or platform.machine()


def _memory() -> int | None:
    import os

    try:
        return os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (ValueError, OSError, AttributeError):
        return None


def _library_versions() -> dict[str, str]:
    from importlib.metadata import PackageNotFoundError, version

    found = {}
    for name in _LIBRARIES:
        try:
            found[name] = version(name)
        except PackageNotFoundError:
            continue
    return found


def to_json(record: Mapping[str, Any]) -> str:
    """Return the record as JSON text."""
    return json.dumps(record, indent=2, ensure_ascii=False, allow_nan=False)


def write_provenance(path: Path, record: Mapping[str, Any]) -> None:
    """Write the record beside the results, in one piece."""
    draft = path.with_name(path.name + ".new")
    draft.write_text(to_json(record) + "\n", encoding="utf-8")
    draft.replace(path)


def read_provenance(path: Path) -> dict[str, Any]:
    """Read what ``write_provenance`` wrote."""
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise InputError(
            "provenance-damaged",
            f"{path.name} cannot be read: {error}",
            str(path),
            "continue the run with --resume, or delete the file",
        ) from error
    if not isinstance(found, dict):
        raise InputError(
            "provenance-damaged",
            f"{path.name} does not hold a JSON object",
            str(path),
            "delete the file: the results file keeps the same record",
        )
    return found
