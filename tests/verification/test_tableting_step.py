"""The peak punch force of the tableting scenario is converged in the time step."""

from pathlib import Path

import numpy as np
import pytest

from pestle.config import Case
from pestle.results.history import read_history
from pestle.simulation import run

EXAMPLE = Path(__file__).parents[2] / "examples" / "tableting200.toml"


def peak_force(folder: Path, step: float) -> float:
    """Largest force on the upper punch while it goes down, with a fixed step [N]."""
    case = Case.from_file(EXAMPLE, {"engine.time_step": step})
    down = case.model_copy(update={"process": case.process[:2]})
    run(down, folder)
    return float(
        np.abs(read_history(folder / "history.csv")["upper_punch.force_z [N]"]).max()
    )


@pytest.mark.slow
def test_peak_force_is_converged_within_one_percent(tmp_path: Path) -> None:
    steps = (2e-6, 1e-6, 0.5e-6)
    peaks = [peak_force(tmp_path / f"{step:g}", step) for step in steps]
    print(dict(zip(steps, peaks, strict=True)))
    assert abs(peaks[1] - peaks[2]) < 0.01 * peaks[2]
    assert abs(peaks[0] - peaks[2]) < 0.01 * peaks[2]
