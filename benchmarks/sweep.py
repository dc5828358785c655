"""How busy a study keeps the cores of this machine.

python benchmarks/sweep.py [--runs 40] [--workers 2] [--particles 1600] [--out DIR]

Runs `pestle sweep` on a study of small tablets, each some tens of seconds long, and
reads the processor time of every core between the first run's start and the moment when
the last run has left the queue.  Other programs must be still.
"""

import argparse
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import psutil

CASE = Path(__file__).parent.parent / "examples" / "small_tablet.toml"
STUDY = """case = "{case}"
set = {{ particles.count = {particles}, die.height = "{height} mm" }}
replicates = {replicates}

[vary]
materials.powder.yield_stress = ["80 MPa", "100 MPa", "120 MPa", "140 MPa"]
contacts.pairs.0.sliding_friction = [0.1, 0.3]
"""


def main() -> None:
    """Run the study; print the busy share of every core and the time of a run."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, default=40, help="a multiple of 8")
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--particles", type=int, default=1600)
    parser.add_argument("--out", type=Path)
    options = parser.parse_args()
    out = options.out or Path(tempfile.mkdtemp(prefix="pestle-sweep-"))
    out.mkdir(parents=True, exist_ok=True)
    replicates = options.runs // 8
    (out / "study.toml").write_text(
        STUDY.format(
            case=CASE,
            particles=options.particles,
            height=options.particles / 50,
            replicates=replicates,
        )
    )
    command = [sys.executable, "-m", "pestle", "sweep", str(out / "study.toml")]
    command += ["--out", str(out / "study"), "--workers", str(options.workers)]
    study = subprocess.Popen(command)
    begun = wait_for(1, out, study)
    queue_empty = wait_for(8 * replicates, out, study)
    if study.wait():
        sys.exit(study.returncode)
    wall = queue_empty[0] - begun[0]
    print(f"{wall:.0f} s between the first start and the last queue")
    for core, (old, new) in enumerate(zip(begun[1], queue_empty[1], strict=True)):
        idle = new.idle + new.iowait - old.idle - old.iowait
        print(f"core {core}: {100.0 * (1.0 - idle / wall):.1f} % busy")


def wait_for(runs: int, out: Path, study: "subprocess.Popen[bytes]") -> tuple:
    """Time and processor times when so many runs have begun."""
    while len(list(out.glob("study/runs/*/lock"))) < runs and study.poll() is None:
        time.sleep(0.05)
    return time.perf_counter(), psutil.cpu_times(percpu=True)


if __name__ == "__main__":
    main()
