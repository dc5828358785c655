"""pestle bench and pestle fit, from the words to the files."""

import json

import numpy as np
import pytest

from pestle.cli import main
from pestle.particle import build, law


@pytest.fixture(autouse=True)
def _first_warnings(monkeypatch):
    monkeypatch.setattr(law, "_WARNED", set())


def run(capsys, *words):
    code = main(list(words))
    out, err = capsys.readouterr()
    return code, out, err


class TestHelp:
    def test_lists_laws(self, capsys):
        code, out, _ = run(capsys, "bench")
        assert code == 0
        for name in ("hertz", "shahin2021", "zunker2024", "edmans2020"):
            assert name in out

    @pytest.mark.parametrize(
        ("name", "words"),
        [
            ("hertz", "Young's modulus of the particles"),
            ("shahin2021+edmans2020", "exponent alpha of unloading"),
            ("luding2008", "k_1, plastic loading"),
            ("mdr", "work of adhesion W"),
        ],
    )
    def test_explains_the_parameters_of_a_law(self, capsys, name, words):
        code, out, _ = run(capsys, "bench", name, "--help")
        assert code == 0
        assert words in out
        assert "Usage" in out


class TestBench:
    def test_prints_and_writes(self, capsys, tmp_path):
        table, figure = tmp_path / "t.csv", tmp_path / "f.svg"
        code, out, err = run(
            capsys,
            *("bench", "--compare", "shahin2021+edmans2020", "hertz"),
            *("--set", "yield_stress=30 MPa", "--path", "0.1, 0", "--points", "50"),
            *("--out", str(table), "--figure", str(figure)),
        )
        assert code == 0
        assert "shahin2021+edmans2020" in out
        assert err == ""
        lines = table.read_text().splitlines()
        assert lines[0].startswith("law,leg,displacement [m],force [N]")
        assert len(lines) == 1 + 2 * 101
        assert "<svg" in figure.read_text()

    def test_warns_in_words(self, capsys):
        _, _, err = run(capsys, "bench", "shahin2021", "--path", "0.1")
        assert err.startswith("warning: shahin2021: lambda = 64.1 is outside")

    def test_impact(self, capsys, tmp_path):
        code, out, _ = run(
            capsys, "bench", "hertz", "--impact", "0.1 m/s, 1 m/s", "--angle", "30"
        )
        assert code == 0
        assert "never" in out
        assert "1.0000" in out

    @pytest.mark.parametrize(
        ("words", "id"),
        [
            (("hertz", "jkr"), "several-laws"),
            (("hertzz",), "unknown-law"),
            (("hertz+edmans2020",), "unknown-law"),
            (("hertz", "--set", "yield=3"), "unknown-law-parameter"),
            (("hertz", "--set", "jkr:yield_stress=3"), "unknown-law"),
            (("hertz", "--set", "yield_stress=3 mm"), "wrong-unit"),
            (("hertz", "--material", "none"), "missing-law-parameter"),
            (("hertz", "--path", "3 s"), "wrong-unit"),
            (("hertz", "--path", "0.1", "--out", "t.xls"), "unknown-table-format"),
            (("hertz", "--path", "0.1", "--figure", "t.x"), "unknown-figure-format"),
            (("hertz", "--impact", "1 m/s"), "bad-range"),
            (("hertz", "--against", "wal"), "unknown-choice"),
            (("biwa1995", "--set", "strength"), "bad-setting"),
            (("zunker2024", "--impact", "1 m/s, 2 m/s", "--angle", "9"), "no-tang"),
        ],
    )
    def test_errors(self, capsys, words, id):
        code, _, err = run(capsys, "bench", *words)
        assert code == 2
        assert f"error[{id}" in err


class TestFit:
    @pytest.fixture
    def data(self, tmp_path):
        radius = 75e-6
        values = {"strength": 6.0272e6, "hardening_exponent": 0.6585}
        d = np.linspace(0.01, 0.45, 80) * radius
        force = build("shahin2021_hardening", values).follow(d, radius=radius).force
        rows = [f"{2e6 * a!r}, {1e3 * f!r}" for a, f in zip(d, force, strict=True)]
        path = tmp_path / "mcc.csv"
        text = "displacement [um], force [mN]\n" + "\n".join(rows) + "\n\n"
        path.write_text(text.replace("np.float64(", "").replace(")", ""))
        return path

    def words(self, data, *more):
        law = ("shahin2021_hardening", "--diameter", "150 um")
        return "fit", str(data), *law, "--vary", "strength,hardening_exponent", *more

    def test_finds_the_parameters_and_saves(self, capsys, data, tmp_path):
        out = tmp_path / "out"
        code, text, err = run(capsys, *self.words(data, "--out", str(out)))
        assert code == 0, err
        assert "6.0272 MPa" in text
        assert "correlation: strength with hardening_exponent" in text
        assert (out / "material.toml").exists()

    def test_json(self, capsys, data):
        code, text, _ = run(capsys, *self.words(data, "--json"))
        assert code == 0
        values = json.loads(text)["values"]
        assert values["hardening_exponent"] == pytest.approx(0.6585, rel=1e-5)

    def test_bounds_and_start(self, capsys, data):
        more = ("--bounds", "strength=1 MPa:5 MPa", "--start", "strength=2 MPa")
        code, text, _ = run(capsys, *self.words(data, *more))
        assert code == 0
        assert "warning: strength lies at its bound" in text

    @pytest.mark.parametrize(
        ("text", "id"),
        [
            ("", "missing-column"),
            ("displacement,force\n1,2\n", "missing-column"),
            ("displacement [um],force [mN]\n1,a\n", "not-a-number"),
            ("displacement [um],force [mN]\n1\n", "not-a-number"),
            ("displacement [s],force [mN]\n1,2\n", "wrong-unit"),
            ("displacement [um],force [mN]\n1,2\n", "no-curve"),
            ("displacement [mm],force [mN]\n1,2\n2,3\n3,4\n", "diameter-out-of-range"),
        ],
    )
    def test_broken_files(self, capsys, tmp_path, text, id):
        path = tmp_path / "x.csv"
        path.write_text(text)
        code, _, err = run(capsys, *self.words(path))
        assert code == 2
        assert f"error[{id}]" in err

    def test_missing_file(self, capsys, tmp_path):
        code, _, err = run(capsys, *self.words(tmp_path / "no.csv"))
        assert code == 2
        assert "error[unreadable-curve]" in err
