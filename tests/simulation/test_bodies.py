"""A bed is filled, levelled, stirred by a blade and by a mesh, and resumed."""

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import trimesh

from pestle import simulation
from pestle.config import Case
from pestle.results.history import read_history
from pestle.simulation import StopReason
from simulation.test_resume import digest, interrupt_after

CASE = """
seed = 3
law.name = "hertz"
[materials.powder]
youngs_modulus = "2 MPa"
poisson_ratio = 0.3
density = 1500
[materials.tool]
rigid = true
[contacts]
sliding_friction = 0.5
restitution = 0.3
[particles]
material = "powder"
count = 120
radius = { distribution = "uniform", minimum = "0.4 mm", maximum = "0.6 mm" }
[die]
radius = "4 mm"
height = "30 mm"
material = "tool"
[walls.blade]
kind = "blade"
diameter = "7 mm"
chord = "2 mm"
thickness = "0.5 mm"
tip_angle = "30 deg"
shaft_diameter = "1 mm"
shaft_height = "10 mm"
segments = 6
material = "tool"
[walls.cube]
kind = "mesh"
file = "cube.stl"
unit = "1 mm"
point = ["0 mm", "0 mm", "10 mm"]
absent = true
material = "tool"
[[process]]
step = "fill"
softening = 10
[[process]]
step = "level"
height = "2.6 mm"
[[process]]
step = "stir"
tip_speed = "0.3 m/s"
helix_angle = "20 deg"
to = "1.5 mm"
[[process]]
step = "stir"
tip_speed = "0.3 m/s"
helix_angle = "20 deg"
to = "-1 mm"
turn = "clockwise"
[[process]]  # what the blade has thrown falls back
step = "relax"
for = "0.2 s"
[[process]]
step = "carry"
wall = "cube"
program = [
  ["0 s", 0, 0, 0, 0, 0, 0],
  ["2 ms", 0, 0, "-0.5 m/s", "10 rad/s", 0, "50 rad/s"],
  ["15 ms", 0, 0, "-0.5 m/s", "10 rad/s", 0, "50 rad/s"],
]
[output]
history_every = 50
frames = 3
checkpoint_every = 300
"""


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("bodies")
    trimesh.creation.box((3.0, 2.0, 2.0)).export(folder / "cube.stl")
    (folder / "case.toml").write_text(CASE, encoding="utf-8")
    return folder / "case.toml"


@pytest.fixture(scope="module")
def whole(path: Path) -> Path:
    out = path.parent / "whole"
    assert simulation.run(Case.from_file(path), out).stop_reason == StopReason.FINISHED
    return out


def test_the_blade_goes_along_its_helix(whole: Path) -> None:
    history = read_history(whole / "history.csv")
    stir = np.array(history.stages) == "stir"
    power = history["blade.power [W]"][stir]
    assert power.max() > 0.0
    omega = 0.3 * np.cos(np.deg2rad(20.0)) / 3.5e-3
    fall = -0.3 * np.sin(np.deg2rad(20.0))
    given = (
        omega * history["blade.torque_z [N m]"] + fall * history["blade.force_z [N]"]
    )
    np.testing.assert_allclose(power, given[stir], rtol=1e-9, atol=1e-15)
    went = np.ptp(history["blade.displacement [m]"][stir])
    assert went == pytest.approx(1.5e-3 + 0.5e-3, rel=0.1)  # and a mean radius


def test_the_flow_energy_is_the_integral_of_the_power(whole: Path) -> None:
    from pestle.metrics.flow_metrics import flow_curves
    from pestle.results import RunFolder

    with RunFolder(whole) as folder:
        down, up = flow_curves(folder)
        numbers = simulation_metrics(folder)
    assert down.depth[-1] == pytest.approx(1.5e-3, abs=2e-5)
    assert up.depth[-1] == pytest.approx(-1e-3, abs=2e-5)
    history = read_history(whole / "history.csv")
    rows = np.array(history.stages) == "stir"
    power, time = history["blade.power [W]"][rows], history["time [s]"][rows]
    summed = np.trapezoid(power, time)
    spent = np.ptp(history["blade.work [J]"][rows])
    assert spent == pytest.approx(summed, rel=0.3)  # rows are 50 steps apart
    assert numbers["flow_energy"] == pytest.approx(down.energy[-1])
    assert 600.0 < numbers["bulk_density"] < 1000.0


def simulation_metrics(folder):  # type: ignore[no-untyped-def]
    from pestle.metrics import summarise

    return {metric.key: metric.value for metric in summarise(folder).metrics}


def test_levelling_takes_away_what_stands_higher(whole: Path) -> None:
    from pestle.results import Results

    with Results(whole / "results.vtkhdf") as frames:
        counts = [len(frame.particles["id"]) for frame in frames]
        assert counts[0] == 120
        assert 50 < counts[-1] < 120
        ids = frames[len(frames) - 1].particles["id"]
        assert len(set(ids.tolist())) == len(ids)


def test_frames_show_bodies_where_they_are(whole: Path) -> None:
    from pestle.results import Results

    history = read_history(whole / "history.csv")
    angle = 0.0
    with Results(whole / "results.vtkhdf") as frames:
        assert not len(frames[0].meshes["wall"])  # absent while the powder is poured
        stirred = [frame for frame in frames if frame.stage == "stir"]
        shown = [frame for frame in stirred if len(frame.meshes["wall"])]
        assert len(shown) > 2
        assert {len(np.unique(frame.meshes["wall"])) for frame in shown} == {1}
        last = frames[len(frames) - 1]
        assert len(np.unique(last.meshes["wall"])) == 2  # blade and cube
    for old, new in pairwise(shown):
        row = np.searchsorted(history["step"], [old.step, new.step])
        fell = np.diff(history["blade.displacement [m]"][row])
        one, two = old.meshes["corner"], new.meshes["corner"]
        np.testing.assert_allclose(one[:, 2] - two[:, 2], fell[0], atol=1e-12)
        off_axis = np.hypot(one[:, 0], one[:, 1]) > 1e-4
        turned = np.angle((two @ [1, 1j, 0])[off_axis] / (one @ [1, 1j, 0])[off_axis])
        np.testing.assert_allclose(turned, turned[0], atol=1e-9)
        angle += turned[0]
        assert np.ptp(two @ [1, 0, 0]) < 7.001e-3
    assert abs(angle) > 0.1


def test_the_ledger_closes(whole: Path) -> None:
    history = read_history(whole / "history.csv")
    late = np.array(history.stages) == "carry"
    assert history["cube.work [J]"][late].any()
    gone = sum(
        history[f"energy.{part} [J]"][-1]
        for part in ("contact_dissipation", "friction", "damping")
    )
    assert abs(history["energy.residual [J]"][-1]) < 0.01 * gone


@pytest.mark.parametrize("calls", [40, 90])
def test_resumed_with_moving_bodies_to_the_same_bits(
    path: Path, whole: Path, calls: int
) -> None:
    out = path.parent / f"cut{calls}"
    case = Case.from_file(path)
    stopped = simulation.run(case, out, progress=interrupt_after(calls)).stop_reason
    assert stopped == StopReason.INTERRUPTED
    assert simulation.run(case, out, resume=True).stop_reason == StopReason.FINISHED
    assert digest(out) == digest(whole)
