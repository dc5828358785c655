"""Laws beside the lab: errors, unloadings, figure."""

import csv
import json

import numpy as np
import pytest

from lab_setups import HARD, TINY
from pestle.cli import main
from pestle.errors import InputError
from pestle.lab import fits
from pestle.lab.compare import compare, rows
from pestle.lab.figure import draw
from pestle.lab.mesh import scaled
from pestle.lab.press import press


@pytest.fixture(scope="module")
def pressed():
    return press(HARD, 0.2, [0.1, 0.2], mesh=scaled("coarse", 1.5))


def test_errors_are_those_of_the_law(pressed):
    from pestle.particle import Shahin2021

    found = compare("shahin2021+edmans2020", pressed)
    law = Shahin2021(youngs_modulus=1.0, poisson_ratio=0.3, yield_stress=0.005)
    curve = law.curve(found.depths, radius=1.0)
    np.testing.assert_allclose(found.force, curve.force)
    by_depth = {p.depth: p for p in pressed.loading}
    lab = np.array([by_depth[d].force for d in found.depths])
    np.testing.assert_allclose(found.errors["force"], curve.force / lab - 1.0)
    assert found.depths.min() >= 0.01
    deep = found.errors["force"][found.depths > 0.05]
    assert abs(deep.mean()) < 0.05


def test_unloading_of_a_power_law_is_found_again(pressed):
    from pestle.particle import edmans2020

    found = compare("shahin2021+edmans2020", pressed)
    for branch, depth in zip(found.branches, (0.1, 0.2), strict=True):
        rho = edmans2020.secant_stiffness(depth, 200.0, 0.3)
        alpha = edmans2020.exponent(depth, 200.0, 0.3)
        assert branch.numbers.rho == pytest.approx(float(rho), rel=3e-3)
        assert branch.numbers.alpha == pytest.approx(float(alpha), abs=5e-3)


def test_parameter_set_as_a_law(pressed, tmp_path):
    """With the published constants it is the published law; other sets are refused."""
    path = tmp_path / "mine.toml"
    gammas = fits.PAPER["edmans2020"]
    names = tuple(f"gamma_{i}" for i in range(1, 6))
    zero = (0.0,) * 4
    five = (0.0,) * 5
    found = fits.Fit("edmans2020", "Eq. 3", names, gammas, None, zero, None, 560, five)
    fits.save(found, "mine", path)
    own = compare(f"shahin2021+{path}", pressed)
    law = compare("shahin2021+edmans2020", pressed)
    for a, b in zip(own.branches, law.branches, strict=True):
        np.testing.assert_allclose(a.forces, b.forces, rtol=1e-12)
    with pytest.raises(InputError, match="unloads by itself"):
        compare(f"zunker2024+{path}", pressed)
    path.write_text(path.read_text().replace('study = "edm', 'study = "zunk'))
    with pytest.raises(InputError, match="not of a law"):
        compare(f"shahin2021+{path}", pressed)


def test_mdr_unloads_by_itself(pressed):
    found = compare("zunker2024", pressed)
    assert all(branch.numbers.rho > 100.0 for branch in found.branches)
    table = rows([found], pressed)
    assert [row["quantity"] for row in table] == [
        "force",
        "area",
        "pressure",
        "rho",
        "alpha",
    ]


def test_a_law_without_unloading(pressed):
    found = compare("shahin2021", pressed)
    assert found.branches == (None, None)
    assert {row["quantity"] for row in rows([found], pressed)} == {
        "force",
        "area",
        "pressure",
    }


def test_figure_has_all_curves(pressed):
    laws = [compare(n, pressed) for n in ("zunker2024", "shahin2021")]
    figure = draw(laws, pressed)
    counts = [len(axes.lines) for axes in figure.axes]
    assert counts == [3, 3, 3, 4]


def test_command(tmp_path, capfd):
    words = ["zunker2024", "--to", "0.05", "--unload", "0.05", "--out", str(tmp_path)]
    assert main(["lab", "compare", *words, "--mesh", "coarse*2", "--json"]) == 0
    found = json.loads(capfd.readouterr().out)
    assert len(found["errors_of_laws"]) == 5
    assert (tmp_path / "compare.svg").stat().st_size > 10_000
    with (tmp_path / "compare.csv").open() as file:
        assert len(list(csv.DictReader(file))) == 5


@pytest.mark.parametrize(
    ("id", "words"),
    [
        ("unknown-particle-law", ["zunker"]),
        ("setting-without-number", ["zunker2024", "--set", "work_of_adhesion=x"]),
        ("unknown-law-parameter", ["shahin2021", "--set", "colour=1", "--to", "0.05"]),
    ],
)
def test_bad_input(id, words, capsys):
    quick = ["--mesh", "coarse*3", "--unload", "0.05", "--quiet"]
    assert main(["lab", "compare", *words, *quick]) == 2
    assert f"error[{id}]" in capsys.readouterr().err


def test_tiny_mesh_still_works():
    assert press(HARD, 0.1, mesh=TINY).stopped is None
