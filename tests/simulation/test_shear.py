"""A small shear cell from filling to yield locus, and a heap; resumed, and refused."""

from pathlib import Path

import numpy as np
import pytest

from pestle import simulation
from pestle.config import Case
from pestle.errors import InputError
from pestle.metrics import summarise
from pestle.metrics.shear_cell import shear_curves
from pestle.results import RunFolder
from pestle.results.history import read_history
from pestle.simulation import StopReason
from simulation.test_resume import digest, interrupt_after

POWDER = """
seed = 5
law.name = "hertz"
[materials.powder]
youngs_modulus = "2 MPa"
poisson_ratio = 0.3
density = 2500
[materials.cell]
rigid = true
[materials.vessel]
rigid = true
[contacts]
sliding_friction = 0.5
rolling_friction = {rolling}
restitution = 0.3
[[contacts.pairs]]
between = ["powder", "vessel"]
sliding_friction = {vessel}
[particles]
material = "powder"
mass = "{mass}"
radius = {{ distribution = "uniform", minimum = "0.4 mm", maximum = "0.6 mm" }}
[die]
radius = "4 mm"
height = "30 mm"
material = "vessel"
"""

HEAD = """
[walls.{name}]
kind = "shear_head"
facing = "{facing}"
diameter = "7.6 mm"
thickness = "0.5 mm"
vanes = 8
vane_depth = "1 mm"
vane_thickness = "0.3 mm"
point = [0, 0, "0.5 mm"]
absent = {absent}
material = "cell"
"""

SHEAR = """
[[process]]
step = "shear"
{role}
stress = "{stress} kPa"
angle = "{angle} deg"
angular_speed = "4 rad/s"
"""

FILL = """
[[process]]
step = "fill"
softening = 10
"""

OUTPUT = """
[output]
history_every = 20
frames = 2
checkpoint_every = 2000
"""

CELL = (
    POWDER.format(rolling=0, vessel=0, mass="0.35 g")
    + HEAD.format(name="base", facing="up", absent="false")
    + HEAD.format(name="head", facing="down", absent="true")
    + FILL
    + SHEAR.format(role='role = "pre-shear"', stress=3, angle=50)
    + SHEAR.format(role="", stress=2, angle=15)
    + SHEAR.format(role="", stress=1, angle=15)
    + OUTPUT
)

WIDE = (
    CELL.replace('radius = "4 mm"', 'radius = "7 mm"')
    .replace('diameter = "7.6 mm"', 'diameter = "13.4 mm"')
    .replace('mass = "0.35 g"', 'mass = "1.3 g"')
    .replace("vanes = 8", "vanes = 12")
    .replace('"4 rad/s"', '"3 rad/s"')
    .replace('angle = "15 deg"', 'angle = "20 deg"')
)
"""Seven diameters from the axis to the wall, for numbers of the powder."""

LIFT = """
[[process]]
step = "lift"
at = "10 cm/s"
"""

HEAP = POWDER.format(rolling=0.2, vessel=0.5, mass="0.35 g") + FILL + LIFT + OUTPUT


@pytest.fixture(scope="module")
def cell(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("shear")
    (folder / "case.toml").write_text(CELL, encoding="utf-8")
    case = Case.from_file(folder / "case.toml")
    out = folder / "whole"
    assert simulation.run(case, out).stop_reason == StopReason.FINISHED
    return out


@pytest.fixture(scope="module")
def wide(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("wide")
    (folder / "case.toml").write_text(WIDE, encoding="utf-8")
    case = Case.from_file(folder / "case.toml")
    ended = simulation.run(case, folder / "run").stop_reason
    assert ended == StopReason.FINISHED
    return folder / "run"


def test_a_head_turns_under_its_stress(wide: Path) -> None:
    with RunFolder(wide) as folder:
        curves = shear_curves(folder)
        assert [stage.step for stage in folder.stages] == ["fill", *3 * ["shear"]]
        above = [stage.info["weight_above"] for stage in folder.stages[1:]]
    # a millimetre of powder between the vanes, where it is level
    fraction = np.array(above) / (2500.0 * 9.81 * 1e-3)
    assert ((fraction > 0.2) & (fraction < 0.65)).all()
    for curve, stress, angle in zip(
        curves, (3e3, 2e3, 1e3), (50.0, 20.0, 20.0), strict=True
    ):
        assert curve.point()[0] == pytest.approx(stress, rel=0.05)
        assert np.degrees(curve.angle[-1]) == pytest.approx(angle, rel=0.01)
        assert curve.shear.min() > -0.05 * stress


def test_the_base_feels_the_torque_of_the_head(cell: Path) -> None:
    """The vessel's wall is smooth: nothing else takes angular momentum."""
    history = read_history(cell / "history.csv")
    late = np.array(history.stages) == "shear"
    late[: len(late) // 3] = False
    head, base = (
        history[f"{name}.torque_z [N m]"][late].mean() for name in ("head", "base")
    )
    assert head > 0.0
    assert base == pytest.approx(-head, rel=0.02)
    assert np.abs(history["die.torque_z [N m]"]).max() < 1e-12 * head


def test_the_work_of_the_head_is_torque_times_angle(cell: Path) -> None:
    history = read_history(cell / "history.csv")
    with RunFolder(cell) as folder:
        begin = folder.stages[1].info["start_of_turning"]
    rows = (np.array(history.stages) == "shear") & (history["time [s]"] > begin)
    torque = history["head.torque_z [N m]"][rows]
    force = history["head.force_z [N]"][rows]
    lowered = history["head.displacement [m]"][rows]
    time = history["time [s]"][rows]
    work = np.ptp(history["head.work [J]"][rows])
    summed = 4.0 * np.trapezoid(torque, time) - np.trapezoid(force, lowered)
    assert work == pytest.approx(summed, rel=0.02)  # rows are 20 steps apart


def test_the_powder_lies_above_the_base(cell: Path) -> None:
    with RunFolder(cell) as folder:
        numbers = {m.key: m.value for m in summarise(folder).metrics}
        last = folder.results[len(folder.results) - 1].particles
    assert (last["position"][:, 2] - last["radius"]).min() > 0.45e-3
    mass = 2500.0 * np.sum(4.0 / 3.0 * np.pi * last["radius_initial"] ** 3)
    assert mass == pytest.approx(0.35e-3, rel=0.01)
    assert numbers["ledger_residual"] < 0.005


def test_the_powder_shears_like_spheres(wide: Path) -> None:
    with RunFolder(wide) as folder:
        numbers = {m.key: m.value for m in summarise(folder).metrics}
    assert 0.3 < numbers["steady_friction"] < 0.5
    assert 15.0 < numbers["internal_friction_angle"] < 29.0
    assert abs(numbers["cohesion"]) < 0.15 * 3e3
    assert numbers["ledger_residual"] < 0.005


@pytest.mark.parametrize("calls", [60, 130])
def test_resumed_while_it_turns_to_the_same_bits(cell: Path, calls: int) -> None:
    out = cell.parent / f"cut{calls}"
    case = Case.from_file(cell.parent / "case.toml")
    stopped = simulation.run(case, out, progress=interrupt_after(calls)).stop_reason
    assert stopped == StopReason.INTERRUPTED
    assert simulation.run(case, out, resume=True).stop_reason == StopReason.FINISHED
    assert digest(out) == digest(cell)


def test_two_threads_give_the_same_bits(cell: Path) -> None:
    out = cell.parent / "two"
    simulation.run(Case.from_file(cell.parent / "case.toml"), out, threads=2)
    assert digest(out) == digest(cell)


def test_a_lifted_die_leaves_a_heap(tmp_path: Path) -> None:
    (tmp_path / "case.toml").write_text(HEAP, encoding="utf-8")
    out = tmp_path / "heap"
    simulation.run(Case.from_file(tmp_path / "case.toml"), out)
    with RunFolder(out) as folder:
        assert folder.stages[-1].end_reason == "the powder is at rest"
        numbers = {m.key: m.value for m in summarise(folder).metrics}
        place = folder.results[len(folder.results) - 1].particles["position"]
    history = read_history(out / "history.csv")
    rows = np.array(history.stages) == "lift"
    assert history["die.displacement [m]"][-1] > 0.002
    drag = history["die.force_z [N]"][rows]
    assert drag.max() > 0.0  # it rubs upwards on the powder ...
    assert drag.min() > -0.1 * drag.max()
    assert np.hypot(place[:, 0], place[:, 1]).max() > 4e-3  # ... which flows out below
    assert 8.0 < numbers["angle_of_repose"] < 40.0
    assert 0.0 < numbers["angle_of_repose_error"] < 5.0


def test_a_body_must_not_come_in_where_powder_is(tmp_path: Path) -> None:
    """Whether its surface meets particles, or encloses them."""
    for point, size in (("2 mm", "1 mm"), ("1 mm", "9 mm")):
        head = HEAD.format(name="head", facing="down", absent="true")
        head = head.replace('"0.5 mm"]', f'"{point}"]')
        head = head.replace('thickness = "0.5 mm"', f'thickness = "{size}"')
        carry = '[[process]]\nstep = "carry"\nwall = "head"\n'
        carry += 'program = [["0 s", 0, 0, 0, 0, 0, 0], ["1 ms", 0, 0, 0, 0, 0, 0]]\n'
        text = POWDER.format(rolling=0, vessel=0, mass="0.1 g") + head + FILL + carry
        (tmp_path / "case.toml").write_text(text, encoding="utf-8")
        with pytest.raises(InputError) as found:
            simulation.run(Case.from_file(tmp_path / "case.toml"), tmp_path / size)
        assert found.value.id == "body-in-powder"
        assert '"head"' in str(found.value)
        assert "process.1" in str(found.value)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (('wall = "head"', 'wall = "base"'), "faces up"),
        (('wall = "head"', 'wall = "die"'), "no wall"),
        (("vanes = 8", "vanes = 50"), "meet at the hub"),
        (("vanes = 8", 'vanes = 8\nhub_diameter = "8 mm"'), "hub_diameter"),
    ],
)
def test_what_cannot_be_is_refused(
    tmp_path: Path, change: tuple[str, str], words: str
) -> None:
    text = CELL.replace('step = "shear"', 'step = "shear"\nwall = "head"')
    (tmp_path / "case.toml").write_text(text.replace(*change), encoding="utf-8")
    with pytest.raises(InputError, match=words):
        Case.from_file(tmp_path / "case.toml")


def test_a_head_is_made_of_closed_meshes(tmp_path: Path) -> None:
    import trimesh

    (tmp_path / "case.toml").write_text(CELL, encoding="utf-8")
    case = Case.from_file(tmp_path / "case.toml")
    for name, side in (("head", -1.0), ("base", 1.0)):
        mesh = trimesh.Trimesh(*case.surface(name))
        assert mesh.is_watertight
        assert mesh.is_winding_consistent
        assert mesh.volume > 0.0
        parts = mesh.split()
        assert len(parts) == 9
        assert np.abs(mesh.vertices[:, 2]).max() == pytest.approx(1e-3)
        deepest = mesh.vertices[np.argmax(np.abs(mesh.vertices[:, 2])), 2]
        assert np.sign(deepest) == side
        far = np.hypot(mesh.vertices[:, 0], mesh.vertices[:, 1]).max()
        assert far == pytest.approx(3.8e-3)


def test_the_plan_knows_how_long_the_steps_take(tmp_path: Path) -> None:
    from pestle.simulation.planning import duration
    from pestle.simulation.probing import sample_of

    (tmp_path / "case.toml").write_text(CELL, encoding="utf-8")
    case = Case.from_file(tmp_path / "case.toml")
    lengths = [duration(case, step, sample_of(case)) for step in case.process[1:]]
    np.testing.assert_allclose(lengths, np.deg2rad([50.0, 15.0, 15.0]) / 4.0)
    (tmp_path / "case.toml").write_text(HEAP, encoding="utf-8")
    case = Case.from_file(tmp_path / "case.toml")
    high = duration(case, case.process[1], sample_of(case)) * 0.1
    solid = 0.35e-3 / 2500.0 / case.die.area  # type: ignore[union-attr]
    assert solid / 0.65 < high < 2.0 * solid / 0.6  # loose at the wall
