"""Tables of studies: written, read again, and those that are packaged."""

import numpy as np
import pytest

from pestle.cli import main
from pestle.errors import InputError
from pestle.lab import packaged, tables
from pestle.lab.first_yield import first_yield
from pestle.lab.study import Case, ConfinedCase, run_study
from pestle.particle.edmans2020 import first_yield as equation_5

CASES = [Case(10.0, 0.3, (0.02, 0.1)), ConfinedCase("die", 20.0, 0.3, 0.06, 3)]


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    return run_study(CASES, tmp_path_factory.mktemp("study"), workers=1)


def test_written_and_read_again(results, tmp_path):
    place = tmp_path / "tables"
    written = tables.write("zunker2024", results[:1], place, "by a test")
    assert len(written) == 4
    packaged.use(tmp_path)
    try:
        rows = packaged.table("zunker2024_unloading")
        relaxed = packaged.table("zunker2024_relaxed")
    finally:
        packaged.use(None)
    assert rows.note == "by a test"
    deep = rows.where(modulus_ratio=10.0, dmax_R=0.1)
    assert deep["rho"] == pytest.approx([results[0]["unloading"][1]["rho"]], rel=1e-4)
    assert relaxed.values("dmax_R") == [0.02, 0.1]
    assert relaxed["r_R"].max() <= deep["amax_R"][0]


def test_path_of_an_unloading_returns_its_work(results):
    """Work under the path and the work that the experiment states."""
    row = results[0]["unloading"][1]
    path = np.array(row["path"])
    assert path[0, 3] > path[-1, 3]  # elastic work
    area = float(np.trapezoid(path[::-1, 1], path[::-1, 0]))
    assert area == pytest.approx(row["returned_ER3"], rel=0.01)


def test_confined_case(results):
    rows = list(tables.confined("die")(results))
    assert rows[-1]["d_R"] == pytest.approx(0.06)
    assert rows[-1]["F1_force"] > rows[-1]["F2_force"] >= 0.0
    assert results[1]["stopped"] is None


def test_folder_without_tables(tmp_path, capsys):
    with pytest.raises(InputError, match="no tables"):
        packaged.use(tmp_path)
    assert main(["reproduce", "edmans2020", "8", "--lab", str(tmp_path)]) == 2
    assert "no-lab-tables" in capsys.readouterr().err


def test_first_yield_of_small_contacts():
    """Equation (5) with Chang's constants, to 3 %: Hertz' stresses."""
    found = first_yield(0.3, [200.0, 1000.0])
    assert [one.modulus_ratio for one in found] == [1000.0, 200.0]
    for one in found:
        equation = equation_5(one.modulus_ratio, 0.3)
        assert one.depth == pytest.approx(equation, rel=0.03)
        assert one.height == pytest.approx(0.48, abs=0.06)  # below the surface


def test_packaged_grid_is_whole():
    grid = packaged.table("edmans2020_unloading")
    assert len(grid["rho"]) == 560
    assert "pestle lab study edmans2020" in grid.note
    assert len({*zip(*(grid[k] for k in grid.columns), strict=True)}) == 560
