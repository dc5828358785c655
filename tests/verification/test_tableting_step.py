"""The peak punch force of the tableting scenario is converged in the time step.

A packing of frictional particles that flow is chaotic: starts that differ by 10 nm
differ in their peak force by about 1 %, at any step.  So the mean over starts is what
can converge, and its scatter is shown beside it.
"""

from pathlib import Path

import numpy as np
import pytest

from pestle.config import Case
from pestle.results.history import read_history
from pestle.simulation import run
from pestle.simulation.checkpoint import NAME, read, write

EXAMPLE = Path(__file__).parents[2] / "examples" / "tableting200.toml"
STARTS = 8
STEPS = (2e-6, 1e-6, 0.5e-6)  # [s]


def settled(folder: Path) -> Path:
    """Run of the first process step alone."""
    case = Case.from_file(EXAMPLE)
    run(case.model_copy(update={"process": case.process[:1]}), folder)
    return folder


def moved(folder: Path, start: Path, number: int) -> Path:
    """The same powder with every particle moved by about 10 nm."""
    arrays, facts = read(start)
    random = np.random.default_rng(number)
    arrays["pos"][:, :3] += 1e-8 * random.standard_normal(arrays["pos"][:, :3].shape)
    folder.mkdir()
    (folder / NAME).unlink(missing_ok=True)
    write(folder, arrays, facts)
    return folder


def peak_force(folder: Path, start: Path, step: float) -> float:
    """Largest force on the upper punch while it goes down, with a fixed step [N]."""
    case = Case.from_file(EXAMPLE, {"engine.time_step": step})
    powder = case.particles[0].model_copy(
        update={"file": None, "start_from": str(start)}
    )
    down = case.model_copy(
        update={"process": case.process[1:2], "particles": (powder,)}
    )
    run(down, folder)
    force = read_history(folder / "history.csv")["upper_punch.force_z [N]"]
    return float(np.abs(force).max())


@pytest.mark.slow
def test_peak_force_is_converged_within_one_percent(tmp_path: Path) -> None:
    start = settled(tmp_path / "settled")
    starts = [moved(tmp_path / f"start{n}", start, n) for n in range(STARTS)]
    means = []
    for step in STEPS:
        peaks = [
            peak_force(tmp_path / f"run{n}-{step:g}", place, step)
            for n, place in enumerate(starts)
        ]
        means.append(np.mean(peaks))
        error = np.std(peaks, ddof=1) / np.sqrt(STARTS)
        print(f"{step:g} s: {means[-1]:.3f} +- {error:.3f} N", np.round(peaks, 2))
    assert abs(means[1] - means[2]) < 0.01 * means[2]
    assert abs(means[0] - means[2]) < 0.01 * means[2]
