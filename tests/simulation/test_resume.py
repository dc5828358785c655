"""A run cut anywhere goes on to bitwise the same result as an unbroken one."""

import hashlib
import os
import random
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from pestle import simulation
from pestle.config import Case
from pestle.errors import InputError
from pestle.simulation import Progress, StopReason, checkpoint
from simulation.cases import tiny_case


def command(case: Path, out: Path, *more: str) -> list[str]:
    program = "from pestle.cli import main; raise SystemExit(main())"
    words = [sys.executable, "-c", program, "run", str(case), "--out", str(out)]
    return [*words, "--quiet", *more]


def digest(out: Path) -> str:
    """Hash of all positions, velocities, contact histories and of the history file."""
    found = hashlib.sha256((out / "history.csv").read_bytes())
    with np.load(out / "checkpoint.npz") as file:
        for name in ("ids", "pos", "vel", "field", "hist", "whist", "wall", "sums"):
            found.update(np.ascontiguousarray(file[name]).tobytes())
    return found.hexdigest()


def run(case: Path, out: Path, *more: str) -> str:
    subprocess.run(command(case, out, *more), check=True, timeout=900)
    return digest(out)


def interrupt_after(calls: int) -> Callable[[Progress], None]:
    """Progress report that presses Ctrl-C once."""
    seen = 0

    def report(progress: Progress) -> None:
        nonlocal seen
        seen += 1
        if seen == calls:
            signal.raise_signal(signal.SIGINT)

    return report


def kill_and_resume(case: Path, out: Path, seconds: list[float], how: int) -> int:
    """Run with a kill after each of the times; return how many hit a running one."""
    hit = 0
    for wait in seconds:
        started = (out / "checkpoint.npz").exists()
        more = ("--resume",) if started else ("--overwrite",)
        process = subprocess.Popen(command(case, out, *more), env=dict(os.environ))
        time.sleep(wait)
        if process.poll() is None:
            process.send_signal(how)
            hit += 1
        process.wait(timeout=60)
    return hit


def test_interrupted_run_goes_on_to_the_same_bits(tmp_path: Path) -> None:
    case = Case.from_file(tiny_case(tmp_path))
    whole, broken = tmp_path / "whole", tmp_path / "broken"
    steps = simulation.run(case, whole).steps
    reached = []
    for calls in (2, 4, 3):  # as early as a fast machine reaches
        report = interrupt_after(calls)
        result = simulation.run(case, broken, resume=bool(reached), progress=report)
        assert result.stop_reason == StopReason.INTERRUPTED
        reached.append(result.steps)
    assert 0 < reached[0] < reached[1] < reached[2] < steps
    assert simulation.run(case, broken, resume=True).steps == steps
    assert digest(broken) == digest(whole)


def test_threads_do_not_change_a_bit(tmp_path: Path) -> None:
    case = Case.from_file(tiny_case(tmp_path))
    for threads in (1, 2):
        simulation.run(case, tmp_path / str(threads), threads=threads)
    assert digest(tmp_path / "1") == digest(tmp_path / "2")


def test_resume_of_another_case_is_refused(tmp_path: Path) -> None:
    path, out = tiny_case(tmp_path), tmp_path / "out"
    path.write_text(path.read_text().partition('[[process]]\nstep = "press"')[0])
    simulation.run(Case.from_file(path), out)
    with pytest.raises(InputError) as caught:
        simulation.run(Case.from_file(path, ["seed=4"]), out, resume=True)
    assert caught.value.id == "case-changed"


def test_sigterm_leaves_a_checkpoint(tmp_path: Path) -> None:
    case, out = tiny_case(tmp_path, hold="100 s"), tmp_path / "out"
    process = subprocess.Popen(command(case, out))
    while not (out / "checkpoint.npz").exists():
        assert process.poll() is None
        time.sleep(0.05)
    process.send_signal(signal.SIGTERM)
    assert process.wait(timeout=60) == 130
    _, facts = checkpoint.read(out)
    assert facts["steps"] > 0


@pytest.mark.slow
@pytest.mark.parametrize(
    ("law", "at"), [("hertz", "2 mm/s"), ("zunker2024", "4.5 mm/s")]
)
def test_five_kills_in_a_long_run(tmp_path: Path, law: str, at: str) -> None:
    """At least 1e5 steps with rebuilds; SIGKILL at random; one and two threads."""
    case = tiny_case(
        tmp_path,
        law=law,
        count=200,
        height="24 mm",
        to="60 kPa",
        at=at,
        hold="2 ms",
        every=3000,
    )
    begin = time.monotonic()
    whole = run(case, tmp_path / "whole", "--threads", "1")
    length = time.monotonic() - begin
    assert run(case, tmp_path / "two", "--threads", "2") == whole
    with np.load(tmp_path / "whole" / "checkpoint.npz") as file:
        assert int(file["counters"][0]) > 10  # rebuilds
    history = (tmp_path / "whole" / "history.csv").read_text().splitlines()
    step = history[0].split(",").index("step")
    assert int(float(history[-1].split(",")[step])) >= 100_000
    draw = random.Random(5)
    times = [draw.uniform(0.15, 0.3) * length for _ in range(5)]
    broken = tmp_path / "broken"
    assert kill_and_resume(case, broken, times, signal.SIGKILL) >= 4
    assert run(case, broken, "--resume") == whole
