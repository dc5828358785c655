"""The examples of powder flow give the numbers of their page: minutes each."""

from pathlib import Path

import pytest

from pestle import simulation
from pestle.config import Case

EXAMPLES = Path(__file__).parent.parent.parent / "examples"


def numbers(name: str, out: Path, *changes: str) -> dict[str, float]:
    """Metrics of an example."""
    case = Case.from_file(EXAMPLES / name, list(changes))
    found = simulation.run(case, out).metrics["metrics"]
    return {key: float(entry["value"]) for key, entry in found.items()}


@pytest.mark.slow
def test_spheres_without_cohesion_shear_as_published(tmp_path: Path) -> None:
    """Friction between that of simple shear at sliding frictions of 0.3 and 1.

    0.357 to 0.405, Chialvo, Sun and Sundaresan (2012); glass beads 0.382, Jop, Forterre
    and Pouliquen (2006).  The locus goes through the origin within two of its errors.
    """
    found = numbers("shear_cell.toml", tmp_path / "cell")
    margin = 2.0 * found["steady_friction_error"]
    assert 0.357 - margin < found["steady_friction"] < 0.405 + margin
    assert found["steady_friction_error"] < 0.015
    assert found["internal_friction_angle"] == pytest.approx(
        20.9, abs=2.0 * found["internal_friction_angle_error"]
    )
    assert abs(found["cohesion"]) < 2.0 * found["cohesion_error"]
    assert "flow_function_coefficient" not in found
    assert found["ledger_residual"] < 0.005


@pytest.mark.slow
def test_the_heap_of_the_example(tmp_path: Path) -> None:
    found = numbers("heap.toml", tmp_path / "heap")
    assert found["angle_of_repose"] == pytest.approx(25.4, abs=2.0)
    assert found["angle_of_repose_error"] < 1.5


@pytest.mark.slow
def test_heap_and_shear_cell_rank_powders_of_rising_cohesion_alike(
    tmp_path: Path,
) -> None:
    angles, cohesions = [], []
    for adhesion in (0.0, 0.16, 0.48):
        change = f"contacts.work_of_adhesion={adhesion}"
        heap = numbers("heap.toml", tmp_path / f"h{adhesion}", "law.name=jkr", change)
        cell = numbers("shear_cell_cohesive.toml", tmp_path / f"c{adhesion}", change)
        angles.append(heap["angle_of_repose"])
        cohesions.append(cell["cohesion"])
    assert angles[0] < angles[1] < angles[2]
    assert cohesions[0] < cohesions[1] < cohesions[2]
