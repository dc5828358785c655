"""A short timed probe of LAMMPS: what a step of a pressed powder costs there.

The powder is the lattice of our own probe: every particle touches eight others and
stands still; the contact model is that of the case's first powder.
"""

import re
import subprocess
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from pestle.errors import SimulationError
from pestle.lammps.deck import DATA, SCRIPT, SKIN
from pestle.lammps.model import pair_model
from pestle.lammps.program import command
from pestle.simulation.probing import _lattice

if TYPE_CHECKING:
    from pestle.config import Case
    from pestle.simulation.probing import Sample

STEPS = 50
"""Steps that are timed [-]."""


def probe(case: "Case", sample: "Sample") -> tuple[float, float]:
    """Time of a step [s] and memory [bytes] of a particle on one rank.

    Raises
    ------
    InputError
        If LAMMPS is not installed.
    SimulationError
        If it stops.
    """
    words = command(1)
    place, edges = _lattice(len(sample.radius), sample.mean)
    dt = 1e-9 * float(np.sqrt(sample.mean_mass / (1e9 * sample.mean)))
    powder = case.powders[0]
    lines = [
        "units si",
        "atom_style sphere 1",
        "newton off",
        "comm_modify vel yes",
        "boundary m m m",
        f"read_data {DATA}",
        f"neighbor {SKIN * sample.mean!r} bin",
        "pair_style granular",
        f"pair_coeff * * {pair_model(case, powder, powder)}",
        "fix integrate all nve/sphere",
        f"timestep {dt!r}",
        "thermo 1000000",
        "run 5",
        f"run {STEPS}",
    ]
    rows = ["particles", "", f"{len(place)} atoms", "1 atom types", ""]
    rows += [
        f"0 {e!r} {axis}lo {axis}hi"
        for e, axis in zip(map(float, edges), "xyz", strict=True)
    ]
    rows += ["", "Atoms # sphere", ""]
    density = float(np.mean(sample.density))
    for k, (x, y, z) in enumerate(place.tolist(), 1):
        rows.append(f"{k} 1 {2.0 * sample.mean!r} {density!r} {x!r} {y!r} {z!r}")
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, SCRIPT).write_text("\n".join(lines) + "\n")
        Path(folder, DATA).write_text("\n".join(rows) + "\n")
        done = subprocess.run(
            [*words, "-in", SCRIPT, "-log", "none"],
            cwd=folder,
            capture_output=True,
            text=True,
        )
    times = re.findall(r"Loop time of (\S+) on", done.stdout)
    sizes = re.findall(r"memory allocation \(min/avg/max\) = (\S+)", done.stdout)
    if len(times) < 2 or not sizes:
        errors = re.findall(r"ERROR.*", done.stdout + done.stderr)
        said = errors[0] if errors else "it ended before its time"
        raise SimulationError("lammps-stopped", f"LAMMPS stopped: {said}")
    count = len(place)
    return float(times[-1]) / STEPS / count, float(sizes[-1]) * 1e6 / count
