"""The same case on both engines, and what LAMMPS is refused.

Forces of walls over loading, as a share of the largest force of the run.
"""

from pathlib import Path

import numpy as np
import pytest

import pestle
from pestle import lammps
from pestle.config import Case
from pestle.errors import InputError
from pestle.results.history import HistoryTable, read_history

EXAMPLES = Path(__file__).parents[2] / "examples"
TRIAXIAL = EXAMPLES / "triaxial12.toml"
LINE = """
[law]
name = "{law}"
[materials.sphere]
youngs_modulus = "1 GPa"
poisson_ratio = 0.3
yield_stress = "50 MPa"
[materials.flat]
rigid = true
[contacts]
damping_ratio = {damping}
work_of_adhesion = {adhesion}
[particles]
material = "sphere"
file = "line.csv"
[walls.left]
kind = "plane"
point = [0, 0, 0]
normal = [1, 0, 0]
material = "flat"
[walls.right]
kind = "plane"
point = ["3.99997 mm", 0, 0]
normal = [-1, 0, 0]
material = "flat"
[engine]
gravity = [0, 0, 0]
time_step = "0.05 us"
[[process]]
step = "move"
walls = ["left", "right"]
at = "0.2 m/s"
to = "{to}"
[output]
history_every = 50
frames = 2
"""
SPHERES = """id,radius_m,density_kg_m3,x_m,y_m,z_m
1,1e-3,1000,0.99999e-3,0,0
2,1e-3,1000,2.99998e-3,0,0
"""
"""They overlap by 10 nm: at an overlap of zero the engines do not agree on touch."""


@pytest.fixture
def lmp():
    try:
        lammps.command(1)
    except InputError as error:
        pytest.skip(f"LAMMPS cannot be compared with: {error.what}")


def line(folder: Path, **changes: object) -> Case:
    """Two spheres between two flats."""
    values = {"law": "hertz", "damping": 0.2, "adhesion": 0.0, "to": "20 um"} | changes
    (folder / "line.csv").write_text(SPHERES)
    (folder / "case.toml").write_text(LINE.format(**values))
    return Case.from_file(folder / "case.toml")


def both(case: Case, folder: Path) -> tuple[HistoryTable, HistoryTable]:
    """Histories of our engine and of LAMMPS."""
    pestle.run(case, folder / "ours", threads=1)
    lammps.run(case, folder / "theirs")
    return (
        read_history(folder / "ours" / "history.csv"),
        read_history(folder / "theirs" / "history.csv"),
    )


def difference(
    ours: HistoryTable, theirs: HistoryTable, columns: list[str]
) -> np.ndarray:
    """Difference of forces at equal steps over the largest of theirs."""
    common = np.intersect1d(ours["step"], theirs["step"])
    mine, other = (
        np.column_stack([np.interp(common, t["step"], t[c]) for c in columns])
        for t in (ours, theirs)
    )
    return np.abs(mine - other) / np.abs(other).max()


def across(case: Case) -> list[str]:
    """Columns of the forces across flats that are named by their axis."""
    return [f"{wall}.force_{wall[0]} [N]" for wall in case.walls]


@pytest.mark.oracle
@pytest.mark.usefixtures("lmp")
@pytest.mark.parametrize(
    ("law", "changes", "most"),
    [
        ("hertz", {}, 2e-3),
        ("jkr", {"damping": 0.0, "adhesion": 5.0}, 5e-3),
        ("zunker2024", {}, 0.03),
        ("zunker2024", {"to": "0.3 mm"}, 0.03),
    ],
)
def test_two_spheres_between_flats(tmp_path, law, changes, most):
    case = line(tmp_path, law=law, **changes)
    found = difference(*both(case, tmp_path), ["left.force_x [N]", "right.force_x [N]"])
    print(f"{law} {changes}: {found.max():.2g}")
    assert len(found) > 10
    assert found.max() < most


@pytest.mark.oracle
@pytest.mark.usefixtures("lmp")
@pytest.mark.parametrize(
    ("rule", "restitution", "most"),
    [
        ("total", 0.9, 0.03),
        ("total", 0.3, 0.03),
        ("spring", 0.9, 0.03),
        ("spring", 0.3, 0.05),
    ],
)
def test_twelve_spheres_with_friction(tmp_path, rule, restitution, most):
    """Hertz-Mindlin, 6 flats that close in; LAMMPS has the sliding rule "total"."""
    case = Case.from_file(
        TRIAXIAL,
        {
            "law": "hertz",
            "contacts.sliding_friction": 0.3,
            "contacts.restitution": restitution,
            "contacts.sliding_rule": rule,
            "process.move.at": "2 m/s",
            "process.move.to": "0.2 m",
            "engine.time_step": "2 us",
            "output.history_every": 250,
        },
    )
    found = difference(*both(case, tmp_path), across(case))
    print(f"{rule}, e = {restitution}: {found.mean():.2g}, largest {found.max():.2g}")
    assert found.mean() < 0.01
    assert found.max() < most


@pytest.mark.oracle
@pytest.mark.usefixtures("lmp")
@pytest.mark.slow
def test_twelve_spheres_of_mdr(tmp_path):
    """Whole loading of the triaxial case; mean over the flats in every tenth of it."""
    case = Case.from_file(TRIAXIAL, {"engine.time_step": "2 us"})
    ours, theirs = both(case, tmp_path)
    found = difference(ours, theirs, across(case))
    tenths = [part.mean() for part in np.array_split(found, 10)]
    print(f"tenths {np.round(tenths, 4)}, largest {found.max():.3f}")
    assert max(tenths) < 0.03


@pytest.mark.oracle
@pytest.mark.usefixtures("lmp")
def test_two_ranks_give_the_same_as_one(tmp_path):
    try:
        lammps.command(2)
    except InputError as error:
        pytest.skip(f"two ranks cannot be tried: {error.what}")
    changes = {"process.move.to": "10 mm", "output.history_every": 1000}
    case = Case.from_file(TRIAXIAL, changes)
    for ranks in (1, 2):
        lammps.run(case, tmp_path / str(ranks), ranks=ranks)
    one, two = (read_history(tmp_path / str(r) / "history.csv") for r in (1, 2))
    assert np.array_equal(one["step"], two["step"])
    assert difference(one, two, across(case)).max() < 1e-9


@pytest.mark.oracle
@pytest.mark.usefixtures("lmp")
def test_the_folder_is_that_of_a_run(tmp_path):
    from pestle.report import build
    from pestle.results.folder import RunFolder

    case = line(tmp_path, law="zunker2024", to="0.1 mm")
    result = lammps.run(case, tmp_path / "out")
    assert "LAMMPS" in build(tmp_path / "out").read_text()
    with RunFolder(tmp_path / "out") as folder:
        assert folder.provenance["engine"].startswith("LAMMPS")
        assert [stage.name for stage in folder.stages] == ["move"]
        last = folder.results[len(folder.results) - 1]
        assert sorted(last.contacts["second"]) == [-2, -1, 2]
        push = folder.history["left.force_x [N]"][-1]
        forces = last.contacts["force"][:, 0]
        assert np.abs(forces) == pytest.approx(push, rel=0.05)
    assert result.metrics["warnings"][0].startswith("Computed by LAMMPS")


def test_what_lammps_cannot_do_is_named(tmp_path):
    with pytest.raises(InputError) as error:
        lammps.check(Case.from_file(EXAMPLES / "tablet.toml"))
    texts = [e.what for e in (error.value, *error.value.others)]
    for word in ("from a file", "filling", "stress", "unload", "ejection", "crush"):
        assert any(word in text for text in texts), word


def test_walls_that_turn_are_named():
    with pytest.raises(InputError) as error:
        lammps.check(Case.from_file(EXAMPLES / "ft4_small.toml"))
    texts = [e.what for e in (error.value, *error.value.others)]
    for word in ("wall blade is of kind blade", "stir turns", "level with pestle"):
        assert any(word in text for text in texts), word


@pytest.mark.filterwarnings("ignore::pestle.errors.EnergyWarning")  # eq37
@pytest.mark.parametrize(
    ("changes", "word"),
    [
        ({"law": "dmt"}, "law dmt"),
        ({"law": "jkr"}, "JKR"),
        ({"contacts.rolling_friction": 0.1}, "rolling"),
        ({"law.radius_rule": "eq37"}, "eq37"),
    ],
)
def test_a_model_it_lacks_is_named(tmp_path, changes, word):
    with pytest.raises(InputError, match=word):
        lammps.check(Case.from_file(TRIAXIAL, changes))


def test_the_deck_is_exported(tmp_path):
    from pestle.cli import main

    assert main(["export", "lammps", str(TRIAXIAL), "--out", str(tmp_path)]) == 0
    script = (tmp_path / "in.lammps").read_text()
    assert "pair_coeff * * mdr 1000000000.0 0.3 50000000.0 0.0 0.5 0.2" in script
    assert "12 atoms" in (tmp_path / "data.lammps").read_text()


def test_motion_is_that_of_the_case(tmp_path):
    from pestle.lammps.motion import legs

    steps = [
        {"step": "move", "profile": "sine", "to": "1 mm", "duration": "1 ms"},
        {"step": "move", "program": [[0, 0], ["1 ms", "1 m/s"], ["2 ms", 0]]},
        {"step": "move", "at": "1 m/s", "turn_at": "3 mm", "back_to": "1 mm"},
        {"step": "relax", "for": "1 ms"},
    ]
    case = Case.from_file(line(tmp_path).source, {"process": steps})
    dt = 1e-6
    found = legs(case, None, dt)
    ends = [leg.at("left", leg.steps, dt) for leg in found]
    assert ends == pytest.approx([1e-3, 1.5e-3, 2e-3, 3e-3, 1e-3, 1e-3])
    assert [leg.steps for leg in found] == [1000, 1000, 1000, 1000, 2000, 1000]
    assert [leg.stage for leg in found] == [0, 1, 1, 2, 2, 3]
    assert found[0].at("left", 500, dt) == pytest.approx(0.5e-3)
