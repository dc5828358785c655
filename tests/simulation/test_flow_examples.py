"""The examples of powder flow give the numbers of their page: minutes each."""

from pathlib import Path

import pytest

from pestle import simulation
from pestle.config import Case
from pestle.simulation import StopReason
from simulation.test_resume import digest, interrupt_after

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
def test_the_flow_energy_of_yield(tmp_path: Path) -> None:
    """Within three deviations of three packings, and of their ratios."""
    laws = {
        "jkr": 'law={name="jkr"}',
        "elastic": "law.yields=false",
        "plastic": "law.yields=true",
    }
    found = {
        key: numbers("ft4_small.toml", tmp_path / key, law) for key, law in laws.items()
    }
    energy = {key: each["flow_energy"] for key, each in found.items()}
    assert energy["plastic"] == pytest.approx(6.71e-3, abs=0.42e-3)
    assert energy["elastic"] / energy["jkr"] == pytest.approx(0.93, abs=0.05)
    assert energy["plastic"] / energy["jkr"] == pytest.approx(1.18, abs=0.09)
    for each in found.values():
        assert each["bulk_density"] == pytest.approx(1421.0, abs=10.0)
        assert each["ledger_residual"] < 0.01


@pytest.mark.slow
def test_the_rheometer_keeps_its_bits(tmp_path: Path) -> None:
    """On one and two threads, and when it is cut while the blade goes down."""
    coarse = ["particles.count=1200", "particles.radius.minimum=0.8 mm"]
    coarse.append("particles.radius.maximum=1.2 mm")
    case = Case.from_file(EXAMPLES / "ft4_small.toml", coarse)
    for threads in (1, 2):
        simulation.run(case, tmp_path / f"{threads}", threads=threads)
    cut = tmp_path / "cut"
    result = simulation.run(case, cut, progress=interrupt_after(60), threads=2)
    assert result.stop_reason == StopReason.INTERRUPTED
    assert simulation.run(case, cut, resume=True).stop_reason == StopReason.FINISHED
    assert digest(tmp_path / "1") == digest(tmp_path / "2") == digest(cut)


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
