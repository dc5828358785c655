"""pestle lab sphere: what it prints, what it writes, what it refuses."""

import csv
import json

import pytest

from pestle.cli import main
from pestle.lab.sphere import Sphere

FIVE = {"dmax_R", "d0_R", "rho", "alpha", "Fmax_ER2"}
QUICK = ["--modulus-ratio", "20", "--mesh", "coarse*2", "--quiet"]


def test_json_ends_with_one_line(capfd):
    words = ["--modulus-ratio", "20", "--poisson", "0.3", "--to", "0.05"]
    assert main(["lab", "sphere", *words, "--unload", "0.02,0.05", "--json"]) == 0
    found = json.loads(capfd.readouterr().out.strip().splitlines()[-1])
    assert [row["dmax_R"] for row in found["unloading"]] == [0.02, 0.05]
    for row in found["unloading"]:
        assert set(row) >= FIVE
        assert row["rho"] == pytest.approx(1.0 / (row["dmax_R"] - row["d0_R"]))
    assert found["reached_R"] == 0.05
    assert found["stopped"] is None
    last = found["loading"][-1]
    assert last["F_ER2"] == pytest.approx(found["unloading"][-1]["Fmax_ER2"])
    assert last["r_in"] <= last["A_piR2"] ** 0.5 <= last["r_out"]


def test_files_of_an_experiment(tmp_path, capsys):
    import meshio

    words = [*QUICK, "--to", "0.06", "--unload", "0.03", "--out", str(tmp_path)]
    adhesion = ["--work-of-adhesion", "1e-5"]
    assert main(["lab", "sphere", *words, "--frames", *adhesion]) == 0
    text = capsys.readouterr().out
    assert "pull_off_ER2" in text
    assert "{" not in text
    with (tmp_path / "unloading.csv").open() as file:
        (unloading,) = csv.DictReader(file)
    assert float(unloading["pull_off_ER2"]) < -1.5 * 3.14 * 1e-5
    with (tmp_path / "loading.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert {row["branch"] for row in rows} == {"load", "unload"}
    with (tmp_path / "profile.csv").open() as file:
        heights = [float(row["z_R"]) for row in csv.DictReader(file)]
    assert min(heights) == 0.0
    with (tmp_path / "pressure.csv").open() as file:
        depths = {float(row["d_R"]) for row in csv.DictReader(file)}
    assert depths == {0.03, 0.06}
    loads = sum(row["branch"] == "load" for row in rows)
    assert len(list((tmp_path / "frames").glob("step_*.vtu"))) == loads
    frame = meshio.read(tmp_path / "frames" / "top_001.vtu")
    force = frame.point_data["contact_force"].sum()
    assert force == pytest.approx(float(rows[loads - 1]["F_ER2"]))
    assert main(["lab", "sphere", *words]) == 2
    assert "folder-in-use" in capsys.readouterr().err
    assert main(["lab", "sphere", *words, "--overwrite"]) == 0
    assert not list((tmp_path / "frames").glob("step_*.vtu"))


BAD = {
    "modulus-ratio-out-of-range": ["--modulus-ratio", "-200"],
    "poisson-ratio-out-of-range": ["--poisson", "0.5"],
    "depth-out-of-range": ["--to", "0.61"],
    "unloading-beyond-loading": ["--to", "0.1", "--unload", "0.2"],
    "mesh-too-coarse": ["--to", "1e-5"],
    "mesh-factor-out-of-range": ["--mesh", "fine*0.01"],
    "unknown-mesh": ["--mesh", "corse"],
    "not-a-list-of-numbers": ["--unload", "0.1;0.2"],
    "depth-twice": ["--unload", "0.1,0.1"],
    "not-a-list-of-pairs": ["--hardening-table", "0:1,0.2"],
    "two-hardening-laws": ["--hardening-table", "0:1", "--hardening-exponent", "0.1"],
    "no-adhesion": ["--to", "0.05", "--unload", "0.05", "--work-of-adhesion", "-1"],
    "frames-without-folder": ["--frames"],
}


@pytest.mark.parametrize("id", BAD)
def test_bad_input(id, capsys):
    assert main(["lab", "sphere", "--modulus-ratio", "20", *BAD[id]]) == 2
    text = capsys.readouterr().err
    assert f"error[{id}]" in text
    assert "hint" in text


def test_a_run_that_cannot_go_on_says_what_it_reached(monkeypatch, capfd):
    from pestle.lab import equilibrium

    real = equilibrium.Contact.equilibrium

    def fails(self, depth, **rest):
        if depth > 0.04:
            raise equilibrium.NotConverged("made to fail")
        return real(self, depth, **rest)

    monkeypatch.setattr(equilibrium.Contact, "equilibrium", fails)
    words = [*QUICK, "--to", "0.1", "--unload", "0.03,0.1", "--json"]
    assert main(["lab", "sphere", *words]) == 1
    found = capfd.readouterr()
    assert "lab-not-converged" in found.err
    numbers = json.loads(found.out.splitlines()[0])
    assert [row["dmax_R"] for row in numbers["unloading"]] == [0.03]
    assert 0.03 < numbers["reached_R"] <= 0.04
    assert "made to fail" in numbers["stopped"]


def test_ctrl_c(monkeypatch, capsys):
    def interrupt(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(Sphere, "load", interrupt)
    assert main(["lab", "sphere", *QUICK]) == 130
