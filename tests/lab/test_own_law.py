"""Laws with constants of one's own: made up, found again, taken by the library."""

from types import SimpleNamespace

import numpy as np
import pytest

from pestle.cli import main
from pestle.errors import InputError
from pestle.lab import fits
from pestle.lab.compare import make_law
from pestle.lab.material import Material
from pestle.lab.own_law import fit_shahin
from pestle.particle import Shahin2021, Zunker2024

SOLID = Material(150.0, 0.3)
X = np.linspace(0.012, 0.5, 80)


def loading():
    """A loading on which the thesis' law holds exactly."""
    law = Shahin2021(youngs_modulus=1.0, poisson_ratio=0.3, yield_stress=1.0 / 150.0)
    rows = zip(X, *law.curve(X, radius=1.0), strict=True)
    points = [SimpleNamespace(depth=d, force=f, radius=a) for d, f, a in rows]
    return SimpleNamespace(sphere=SimpleNamespace(material=SOLID), loading=points)


def test_constants_of_the_thesis_are_found_again(tmp_path):
    found = fit_shahin(loading())
    assert found.constants == pytest.approx(found.published, rel=1e-4)
    assert found.errors[-1] < 1e-6
    path = tmp_path / "own.toml"
    fits.save(found, "own", path)
    own = make_law(str(path), SOLID, {}).follow(X, radius=1.0)
    law = make_law("shahin2021", SOLID, {}).follow(X, radius=1.0)
    np.testing.assert_allclose(own.force, law.force, rtol=1e-4)
    np.testing.assert_allclose(own.contact_radius, law.contact_radius, rtol=1e-4)


def test_too_short_a_loading():
    short = loading()
    short.loading = short.loading[:10]
    with pytest.raises(InputError, match="too few"):
        fit_shahin(short)


def hardening_set(path, a, b):
    four, two, names = (0.0,) * 4, (0.0,) * 2, ("a", "b")
    found = fits.Fit("zunker2024", "(16)", names, (a, b), None, four, None, 9, two)
    fits.save(found, "own", path)
    return str(path)


def test_hardening_curve_of_ones_own(tmp_path):
    """While a yielded contact is loaded its pressure is that of the curve."""
    law = make_law(hardening_set(tmp_path / "own.toml", 1.5, 4.0), SOLID, {})
    assert isinstance(law, Zunker2024)
    x = np.linspace(0.0, 0.02, 50)  # the radius has not grown yet
    curve = law.follow(x, radius=1.0)
    pressure = curve.force[20:] / (np.pi * curve.contact_radius[20:] ** 2)
    expected = (1.5 * np.exp(-4.0 * x[20:]) + 1.0) / 150.0
    np.testing.assert_allclose(pressure, expected, rtol=2e-3)
    published = make_law(hardening_set(tmp_path / "paper.toml", 1.75, 4.4), SOLID, {})
    plain = make_law("zunker2024", SOLID, {})
    np.testing.assert_array_equal(
        published.follow(x, radius=1.0).force, plain.follow(x, radius=1.0).force
    )


def test_sets_in_the_wrong_place(tmp_path):
    path = hardening_set(tmp_path / "own.toml", 1.5, 4.0)
    with pytest.raises(InputError, match="unloads by itself"):
        make_law(f"{path}+edmans2020", SOLID, {})
    found = fit_shahin(loading())
    fits.save(found, "own", tmp_path / "s.toml")
    law = make_law(f"{tmp_path / 's.toml'}+edmans2020", SOLID, {})
    assert law.unloading.name == "edmans2020"
    text = (tmp_path / "s.toml").read_text().replace('"shahin2021"', '"edmans2020"')
    (tmp_path / "s.toml").write_text(text)
    with pytest.raises(InputError, match="not those of a law of loading"):
        make_law(str(tmp_path / "s.toml"), SOLID, {})


def test_command(tmp_path, capsys):
    words = ["lab", "law", "--modulus-ratio", "150", "--mesh", "coarse*2"]
    assert main([*words, "--out", str(tmp_path), "--quiet"]) == 0
    assert "hardness_max" in capsys.readouterr().out
    assert {p.name for p in tmp_path.iterdir()} == {
        "own-zunker2024.toml",
        "own-shahin2021.toml",
    }
