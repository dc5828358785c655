"""Kill a worker, the scheduler, the sweep: nothing finished is lost or done twice."""

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from pestle.errors import InputError
from pestle.sweep import cluster, run_study
from sweep.studies import SLOW, alone, finished, write

DEADLINE = 60.0
"""Longest time to wait for anything [s]."""


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """Table of the slow study that nothing has disturbed."""
    folder = tmp_path_factory.mktemp("whole")
    return alone(write(folder, **SLOW), folder)


def wait_for(condition):
    """Wait until something is the case."""
    end = time.monotonic() + DEADLINE
    while not condition():
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.02)


def sweep(folder: Path, *options: str) -> subprocess.Popen[str]:
    """Start the command in a process of its own."""
    words = ["sweep", str(folder / "study.toml"), "--out", str(folder), "--json", "-q"]
    return subprocess.Popen(
        [sys.executable, "-m", "pestle", *words, *options],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def test_a_worker_killed_mid_run(tmp_path, whole):
    """The other one, or its successor, goes on from the checkpoint."""
    study = write(tmp_path, **SLOW)
    killed = []

    def kill_once(progress):
        if killed:
            return
        wait_for(lambda: len(unfinished(tmp_path)) > 0)
        killed.extend(unfinished(tmp_path))
        for pid in worker_pids():
            os.kill(pid, signal.SIGKILL)

    result = run_study(study, tmp_path, workers=2, progress=kill_once)
    assert killed
    assert result.count("done") == 6
    assert result.table.read_bytes() == whole


def unfinished(folder: Path) -> list[Path]:
    """Runs at work that have a checkpoint behind them."""
    runs = folder.glob("runs/*/checkpoint.npz")
    return [p.parent for p in runs if not (p.parent / "outcome.json").exists()]


def worker_pids() -> list[int]:
    """Processes of the workers that this process has started."""
    import psutil

    children = psutil.Process().children(recursive=True)
    return [c.pid for c in children if "spawn_main" in " ".join(c.cmdline())]


def test_the_sweep_killed(tmp_path, whole):
    write(tmp_path, **SLOW)
    process = sweep(tmp_path, "--workers", "2")
    wait_for(lambda: len(finished(tmp_path)) >= 2)
    process.kill()
    process.communicate()
    times = finished(tmp_path)
    again = sweep(tmp_path, "--workers", "1")
    out, err = again.communicate(timeout=DEADLINE)
    assert again.returncode == 0, err
    assert json.loads(out)["done"] == 6
    assert times.items() <= finished(tmp_path).items()
    assert (tmp_path / "table.parquet").read_bytes() == whole


def test_the_scheduler_killed(tmp_path, whole):
    write(tmp_path, **SLOW)
    with servers(tmp_path) as (address, scheduler):
        process = sweep(tmp_path, "--scheduler", address)
        wait_for(lambda: len(finished(tmp_path)) >= 2)
        scheduler.kill()
        _, err = process.communicate(timeout=DEADLINE)
        assert process.returncode == 1, err
        assert "scheduler-lost" in err
    times = finished(tmp_path)
    assert 2 <= len(times) < 6
    with servers(tmp_path) as (address, _):
        again = sweep(tmp_path, "--scheduler", address)
        _, err = again.communicate(timeout=DEADLINE)
        assert again.returncode == 0, err
    assert times.items() <= finished(tmp_path).items()
    assert (tmp_path / "table.parquet").read_bytes() == whole


def test_no_scheduler_is_an_error_of_the_input(tmp_path, monkeypatch):
    monkeypatch.setattr(cluster, "CONNECT", 0.3)
    with pytest.raises(InputError, match="no-scheduler"):
        run_study(write(tmp_path), tmp_path, scheduler="tcp://127.0.0.1:1")


@contextmanager
def servers(folder: Path) -> Iterator[tuple[str, subprocess.Popen[bytes]]]:
    """Start a scheduler and a worker as a cluster does; address and scheduler."""
    file = folder / f"scheduler-{time.monotonic_ns()}.json"
    common = ["--scheduler-file", str(file), "--no-dashboard"]
    processes = [
        start("scheduler", "--port", "0", *common),
        start("worker", *common, "--nthreads", "1", "--no-nanny"),
    ]
    try:
        wait_for(file.exists)
        wait_for(lambda: file.read_text().endswith("}"))
        yield json.loads(file.read_text())["address"], processes[0]
    finally:
        for process in processes:
            process.kill()
            process.wait()


def start(name: str, *options: str) -> subprocess.Popen[bytes]:
    """Start a part of Dask."""
    command = [sys.executable, "-m", f"distributed.cli.dask_{name}", *options]
    return subprocess.Popen(
        command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
