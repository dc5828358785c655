"""Wall forces of twelve spheres against LAMMPS' MDR (release 22Jul2025, update 4).

The reference is the force of each flat every 500 steps, in tests/data/triaxial12.  Ours
solves the yield point, takes no running mean of the growth, has no wall magnifier and
shares the energy of an interface between its two sides: differences are expected, and
their size is asserted here.
"""

from pathlib import Path

import numpy as np
import pytest

from pestle.config import Case
from pestle.results.history import read_history
from pestle.simulation import run

ROOT = Path(__file__).parents[2]
REFERENCE = ROOT / "tests" / "data" / "triaxial12"
WALLS = [f"{axis}_{side}" for axis in "xyz" for side in ("plus", "minus")]


def forces(folder: Path, **settings: object) -> tuple[np.ndarray, np.ndarray]:
    """Displacement [m] and the six wall forces [N] of a run of the example."""
    case = Case.from_file(
        ROOT / "examples" / "triaxial12.toml", [f"{k}={v}" for k, v in settings.items()]
    )
    run(case, folder)
    table = read_history(folder / "history.csv")
    found = [np.abs(table[f"{wall}.force_{wall[0]} [N]"]) for wall in WALLS]
    return table["x_plus.displacement [m]"], np.column_stack(found)


def reference(name: str) -> tuple[np.ndarray, np.ndarray]:
    """Displacement [m] and the six wall forces [N] of LAMMPS."""
    data = np.loadtxt(REFERENCE / name, delimiter=",", skiprows=1)
    return data[:, 0], np.abs(data[:, 1:7])


def difference(
    mine: tuple[np.ndarray, np.ndarray],
    theirs: tuple[np.ndarray, np.ndarray],
    window: tuple[float, float],
) -> float:
    """Mean absolute difference in a window of displacement over the largest force."""
    place, force = theirs
    use = (place >= window[0]) & (place <= window[1])
    ours = np.column_stack(
        [np.interp(place[use], mine[0], mine[1][:, w]) for w in range(6)]
    )
    return float(np.abs(ours - force[use]).mean() / force[use].max())


@pytest.mark.slow
def test_loading_without_adhesion(tmp_path: Path) -> None:
    mine = forces(tmp_path)
    theirs = reference("gamma0_psib0.5_load.csv")
    plastic = difference(mine, theirs, (0.25, 0.35))
    bulk = difference(mine, theirs, (0.35, 0.40))
    print(f"0.25-0.35 m: {plastic:.4f}, 0.35-0.40 m: {bulk:.4f}")
    assert plastic < 0.03
    assert bulk < 0.06


@pytest.mark.slow
def test_adhesive_loading_and_turning_back(tmp_path: Path) -> None:
    """Reported: free spheres that stick and bounce are chaotic until pressed."""
    place, force = forces(tmp_path, work_of_adhesion=2e5, turn_at=0.35)
    theirs = reference("gamma2e5_psib0.5_turn0.35.csv")
    top = int(np.argmax(place))
    loading = difference(
        (place[: top + 1], force[: top + 1]),
        tuple(column[: int(np.argmax(theirs[0])) + 1] for column in theirs),  # type: ignore[arg-type]
        (0.25, 0.35),
    )
    print(f"adhesive, 0.25-0.35 m: {loading:.4f}")
    assert place[-1] < 0.0 + 1e-3
    assert loading < 0.10
