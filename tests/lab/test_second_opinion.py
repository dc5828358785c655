"""CalculiX: its input file, what is read from it, what it says of the same spheres."""

import json
import subprocess
from pathlib import Path

import numpy as np
import pytest

from lab_setups import SOFT, TINY
from pestle.cli import main
from pestle.errors import InputError, SimulationError
from pestle.lab import calculix
from pestle.lab.calculix import Leg, available, deck, solve
from pestle.lab.confined import Confined
from pestle.lab.material import Material
from pestle.lab.mesh import quarter_disc
from pestle.lab.press import press
from pestle.lab.second_opinion import (
    confined_model,
    of_confined,
    of_sphere,
    sphere_model,
)

needs_calculix = pytest.mark.skipif(not available(), reason="CalculiX is not installed")
LEGS = [Leg.loading(0.1, 0.05), Leg.unloading(0.1, 0.05, 10)]


def test_flats_and_what_they_may_touch():
    model = sphere_model(quarter_disc(TINY))
    (flat,) = model.flats
    assert flat.areas.sum() == pytest.approx(np.pi * 0.95**2, rel=0.1)
    np.testing.assert_allclose(flat.clearances, model.points[flat.nodes, 1])
    die = confined_model(Confined(Material(100.0, 0.3), "die", edges=4, layers=4))
    assert [f.axis for f in die.flats] == [0, 1, 2]
    assert [f.moves for f in die.flats] == [False, False, True]
    for flat in die.flats:
        assert flat.areas.sum() == pytest.approx(0.25 * np.pi, rel=0.15)
    corners = die.points[die.cells]
    edges = corners[:, [1, 3, 4]] - corners[:, :1]
    assert (np.linalg.det(edges) > 0.0).all()  # numbered as CalculiX wants them


def test_input_file_names_every_gap_and_the_path():
    model = sphere_model(quarter_disc(TINY))
    text = deck(model, SOFT, LEGS)
    assert text.count("TYPE=GAPUNI") == len(model.flats[0].nodes)
    assert text.count("*STEP") == len(LEGS)
    assert "*AMPLITUDE, NAME=PATH1\n0,0.1\n1,0.05\n" in text
    yields = text.split("*PLASTIC\n")[1].splitlines()[0]
    assert yields == f"{calculix.MODULUS / 20.0:g},0"


def printed(model, forces, heights):
    """What CalculiX would print of two legs with a step or two."""
    blocks = []
    for time, force in forces:
        share = force * model.share * calculix.MODULUS
        blocks.append(
            f" total force (fx,fy,fz) for set FLAT0 and time {time:15.7E}\n\n"
            f"  0.000000E+00 {share:14.6E}  0.000000E+00\n\n"
        )
    head = " displacements (vx,vy,vz) for set SURFACE and time  0.2000000E+01\n\n"
    rows = [f" {n + 1}  0.0 {u:.6E} 0.0\n" for n, u in heights]
    return "".join(blocks) + head + "".join(rows)


def test_forces_and_heights_are_read(monkeypatch):
    model = sphere_model(quarter_disc(TINY))
    forces = [(0.5, 0.01), (1.0, 0.04), (1.5, 0.01), (2.0, 0.0)]
    heights = [(n, 0.03) for n in model.flats[0].nodes]

    def ends(words, cwd, **_):
        Path(cwd, "sphere.dat").write_text(printed(model, forces, heights))
        return subprocess.CompletedProcess(words, 0, stdout="Job finished")

    monkeypatch.setattr(calculix.shutil, "which", lambda name: name)
    monkeypatch.setattr(calculix.subprocess, "run", ends)
    found = solve(model, SOFT, LEGS)
    assert found.depths[0] == pytest.approx([0.025, 0.1])
    assert found.depths[1] == pytest.approx([0.075, 0.05])
    assert found.forces[0][:, 0] == pytest.approx([0.01, 0.04])
    assert found.heights.min() == pytest.approx(0.03)
    assert found.stopped == ""


def test_a_run_that_finds_nothing_says_why(monkeypatch):
    def fails(words, **_):
        return subprocess.CompletedProcess(words, 201, stdout=" *ERROR: no memory\n")

    monkeypatch.setattr(calculix.shutil, "which", lambda name: name)
    monkeypatch.setattr(calculix.subprocess, "run", fails)
    with pytest.raises(SimulationError, match="no memory"):
        solve(sphere_model(quarter_disc(TINY)), SOFT, LEGS)


def test_without_calculix_the_lab_goes_on(monkeypatch, capfd):
    monkeypatch.setattr(calculix.shutil, "which", lambda name: None)
    with pytest.raises(InputError, match="not installed"):
        solve(sphere_model(quarter_disc(TINY)), SOFT, LEGS)
    words = ["lab", "sphere", "--modulus-ratio", "20", "--to", "0.01", "--quiet"]
    assert main([*words, "--second-opinion", "--json"]) == 0
    told = capfd.readouterr()
    assert "second opinion skipped: CalculiX is not installed" in told.err
    assert "skipped" in json.loads(told.out)["second_opinion"]


@pytest.mark.oracle
@needs_calculix
def test_sphere():
    """Force and work within 1 %, rho within 2 %, alpha within 0.03, E/Y = 20."""
    result = press(SOFT, 0.05, [0.05])
    found = of_sphere(result)
    assert found["stopped"] is None
    row = found["comparison"]["0.05 R"]
    for name in ("force [E R^2]", "work [E R^3]"):
        assert row[name][1] == pytest.approx(row[name][0], rel=0.01)
    assert row["rho"][1] == pytest.approx(row["rho"][0], rel=0.02)
    assert row["alpha"][1] == pytest.approx(row["alpha"][0], abs=0.03)


@pytest.mark.oracle
@needs_calculix
def test_die():
    """Work of the primary flats within 4 % on 256 bricks."""
    case = Confined(Material(100.0, 0.3), "die", edges=4, layers=4)
    found = of_confined(case, case.load(0.15))
    lab, other = found["comparison"]["primary, 0.15 R"]["work [E R^3]"]
    assert other == pytest.approx(lab, rel=0.04)
