"""A run cut anywhere goes on to bitwise the same result as an unbroken one."""

import hashlib
import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

CASE = """
schema_version = 1
seed = 3
[law]
name = "{law}"
[materials.powder]
youngs_modulus = "5 MPa"
poisson_ratio = 0.3
yield_stress = "0.1 MPa"
density = 1500
[materials.tool]
rigid = true
[contacts]
sliding_friction = 0.5
restitution = 0.3
work_of_adhesion = {adhesion}
[particles]
material = "powder"
count = {count}
radius = {{ distribution = "uniform", minimum = "0.4 mm", maximum = "0.6 mm" }}
[die]
radius = "2 mm"
height = "12 mm"
material = "tool"
[[process]]
step = "fill"
[[process]]
step = "press"
to = "{to}"
at = "{at}"
[[process]]
step = "hold"
for = "2 ms"
stress = "{to}"
[[process]]
step = "unload"
at = "0.2 m/s"
[output]
history_every = 100
frames = 3
checkpoint_every = {every}
"""


def write_case(folder: Path, **changes: object) -> Path:
    values: dict[str, object] = {
        "law": "zunker2024",
        "adhesion": 0.1,
        "count": 40,
        "to": "20 kPa",
        "at": "0.2 m/s",
        "every": 500,
    }
    path = folder / "case.toml"
    path.write_text(CASE.format(**(values | changes)))
    return path


def command(case: Path, out: Path, *more: str) -> list[str]:
    program = "from pestle.cli import main; raise SystemExit(main())"
    return [
        sys.executable,
        "-c",
        program,
        "run",
        str(case),
        "--out",
        str(out),
        "--quiet",
        *more,
    ]


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


def kill_and_resume(case: Path, out: Path, seconds: list[float], how: int) -> int:
    """Run with a kill after each of the times; return how many hit a running process."""
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
    case = write_case(tmp_path)
    whole = run(case, tmp_path / "whole")
    broken = tmp_path / "broken"
    process = subprocess.Popen(command(case, broken))
    while not (broken / "checkpoint.npz").exists():
        time.sleep(0.05)
    process.send_signal(signal.SIGTERM)
    assert process.wait(timeout=60) == 130
    assert run(case, broken, "--resume") == whole


def test_threads_do_not_change_a_bit(tmp_path: Path) -> None:
    case = write_case(tmp_path)
    one = run(case, tmp_path / "one", "--threads", "1")
    assert run(case, tmp_path / "two", "--threads", "2") == one


def test_resume_of_another_case_is_refused(tmp_path: Path) -> None:
    case = write_case(tmp_path, to="5 kPa")
    run(case, tmp_path / "out")
    changed = write_case(tmp_path, to="6 kPa")
    done = subprocess.run(
        command(changed, tmp_path / "out", "--resume"), capture_output=True, text=True
    )
    assert done.returncode == 2
    assert "error[case-changed]" in done.stderr


@pytest.mark.slow
@pytest.mark.parametrize("law", ["hertz", "zunker2024"])
def test_five_kills_in_a_long_run(tmp_path: Path, law: str) -> None:
    """At least 1e5 steps with rebuilds; SIGKILL at random; one and two threads."""
    case = write_case(
        tmp_path, law=law, count=200, to="60 kPa", at="20 mm/s", every=3000
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
