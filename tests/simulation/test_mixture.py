"""Two powders in one die: each particle keeps its material, the ledger closes."""

import csv
import json
from pathlib import Path

import numpy as np
import pytest

from pestle import simulation
from pestle.config import Case
from pestle.results.read import Results
from pestle.simulation import checkpoint

EXAMPLE = Path(__file__).parents[2] / "examples" / "mixture.toml"
TINY = [
    "particles.hard.count=10",
    "particles.soft.count=20",
    "die.radius=0.6 mm",
    "press.to=60 MPa",
    "press.at=5 m/s",
    "unload.at=5 m/s",
    "hold.for=2 us",
]


@pytest.fixture(scope="module")
def pressed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of the example, run with fewer particles."""
    out = tmp_path_factory.mktemp("mixture")
    result = simulation.run(Case.from_file(EXAMPLE, TINY), out)
    assert str(result.stop_reason) == "finished"
    return out


def test_the_ledger_closes(pressed: Path) -> None:
    with (pressed / "history.csv").open() as file:
        rows = list(csv.DictReader(file))
    work = float(rows[-1]["energy.wall_work [J]"])
    worst = max(abs(float(row["energy.residual [J]"])) for row in rows)
    assert work > 0.0
    assert worst < 1e-3 * work


def test_results_number_the_powders(pressed: Path) -> None:
    record = json.loads((pressed / "provenance.json").read_text())
    assert record["particle_materials"] == ["hard", "soft"]
    with Results(pressed / "results.vtkhdf") as results:
        last = results[-1]
    assert last.particles["material"].tolist() == [0] * 10 + [1] * 20


def test_the_soft_powder_deforms_more(pressed: Path) -> None:
    with Results(pressed / "results.vtkhdf") as results:
        last = results[-1]
    growth = last.particles["radius"] / last.particles["radius_initial"] - 1.0
    soft = last.particles["material"] == 1
    assert growth[soft].mean() > 3.0 * growth[~soft].mean() >= 0.0


def test_masses_are_those_of_each_powder(pressed: Path) -> None:
    arrays, _ = checkpoint.read(pressed)
    volume = 4.0 / 3.0 * np.pi * arrays["field"][:, 0] ** 3
    density = np.where(arrays["mat"] == 0, 2300.0, 1300.0)
    np.testing.assert_allclose(arrays["vel"][:, 3], density * volume, rtol=1e-12)


def continued(pressed: Path, folder: Path, *changes: tuple[str, str]) -> Path:
    """Run a case that goes on from the pressed mixture; return its folder."""
    head, _, rest = EXAMPLE.read_text().partition("[[particles]]")
    die = rest.partition("[die]")[2].partition("[[process]]")[0]
    case = (
        f'{head}[particles]\nstart_from = "{pressed}"\n[die]{die}'
        '[[process]]\nstep = "relax"\nfor = "1 us"\n'
    ).replace('radius = "1 mm"', 'radius = "0.6 mm"')
    for old, new in changes:
        assert old in case
        case = case.replace(old, new)
    (folder / "case.toml").write_text(case)
    simulation.run(Case.from_file(folder / "case.toml"), folder / "out")
    return folder / "out"


def test_a_mixture_goes_on_with_its_contacts(pressed: Path, tmp_path: Path) -> None:
    before, _ = checkpoint.read(pressed)
    after, _ = checkpoint.read(continued(pressed, tmp_path))
    assert set(after["mat"]) == {0, 1}
    assert np.count_nonzero(after["hist"]) > 0.5 * np.count_nonzero(before["hist"])


def test_a_mixture_goes_on_with_another_law(pressed: Path, tmp_path: Path) -> None:
    change = ('name = "zunker2024"\npsi_b = 0.5', 'name = "hertz"')
    before, _ = checkpoint.read(pressed)
    after, _ = checkpoint.read(continued(pressed, tmp_path, change))
    order, then = np.argsort(after["ids"]), np.argsort(before["ids"])
    assert after["mat"][order].tolist() == before["mat"][then].tolist()
    np.testing.assert_allclose(after["vel"][order, 3], before["vel"][then, 3])
