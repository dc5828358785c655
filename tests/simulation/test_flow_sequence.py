"""The standard program of a powder rheometer, on a bed of few particles."""

from pathlib import Path

import numpy as np
import pytest

from pestle import simulation
from pestle.config import Case
from pestle.errors import InputError
from pestle.metrics.flow_metrics import flow_curves
from pestle.results import RunFolder
from simulation.test_bodies import CASE

SEQUENCE = """
[[process]]
step = "flow_sequence"
tip_speed = "0.3 m/s"
helix_angle = "20 deg"
to = "1.5 mm"
clearance = "0.5 mm"
tests = 2
speeds = ["0.3 m/s", "0.2 m/s"]
conditioning_speed = "0.4 m/s"
[output]
history_every = 50
"""


def written(folder: Path, sequence: str = SEQUENCE) -> Path:
    """Case file: filled, levelled, then the sequence."""
    bed, _, _ = CASE.partition('[[process]]\nstep = "stir"')
    bed, _, rest = bed.partition("[walls.cube]")
    path = folder / "case.toml"
    path.write_text(bed + rest[rest.index("[[process]]") :] + sequence)
    return path


def test_a_sequence_stands_for_its_steps(tmp_path: Path) -> None:
    case = Case.from_file(written(tmp_path))
    names = case.stage_names[2:]
    assert len(names) == 16
    assert names[:4] == (
        "conditioning 1 down",
        "conditioning 1 up",
        "test 1 down",
        "test 1 up",
    )
    strokes = case.process[2:]
    turns = [stroke.turn for stroke in strokes if stroke.turn == "anticlockwise"]
    assert len(turns) == 4  # the tests alone, downwards
    downs = [stroke for stroke in strokes if stroke.to > 0.0]
    tests = [stroke for stroke in downs if stroke.role != "conditioning"]
    assert [stroke.tip_speed for stroke in tests] == [0.3, 0.3, 0.3, 0.2]
    assert [stroke.role for stroke in tests] == ["stability"] * 2 + ["flow-rate"] * 2
    assert {s.tip_speed for s in strokes if s.role == "conditioning"} == {0.4}
    again = tmp_path / "again.toml"
    again.write_text(case.to_toml())
    assert Case.from_file(again).canonical() == case.canonical()


def test_without_conditioning(tmp_path: Path) -> None:
    case = Case.from_file(written(tmp_path), ["conditioning=false", "tests=3"])
    assert [stroke.role for stroke in case.process[2:]] == (
        ["stability"] * 6 + ["flow-rate"] * 4
    )


def test_two_sequences_are_told_apart_by_their_names(tmp_path: Path) -> None:
    sequence, _, rest = SEQUENCE.partition("[output]")
    named = sequence + 'name = "again"\n'
    case = Case.from_file(written(tmp_path, sequence + named + "[output]" + rest))
    assert len(case.process) == 2 + 16 + 16
    assert case.stage_names[18] == "again conditioning 1 down"
    assert case.stage_names[20] == "again test 1 down"


def test_an_error_behind_a_sequence_names_its_place_in_the_file(tmp_path: Path) -> None:
    sequence, _, rest = SEQUENCE.partition("[output]")
    stir = sequence.replace("flow_sequence", "stir").partition("tests")[0]
    stir = stir.replace("tip_speed", 'wall = "spoon"\ntip_speed')
    path = written(tmp_path, sequence + stir + "[output]" + rest)
    with pytest.raises(InputError) as caught:
        Case.from_file(path)
    line = path.read_text().splitlines().index('wall = "spoon"') + 1
    assert str(caught.value.where).endswith(f":{line}  process.3.wall")


@pytest.mark.parametrize("change", ["tests=0", "tests=1000", 'clearance="-1 mm"'])
def test_what_is_no_sequence_is_refused(tmp_path: Path, change: str) -> None:
    with pytest.raises(InputError) as caught:
        Case.from_file(written(tmp_path), [change])
    assert caught.value.where is not None
    assert "process" in caught.value.where


def test_indices_are_ratios_of_the_energies_of_the_strokes(tmp_path: Path) -> None:
    result = simulation.run(Case.from_file(written(tmp_path)), tmp_path / "out")
    found = {key: m["value"] for key, m in result.metrics["metrics"].items()}
    with RunFolder(tmp_path / "out") as folder:
        curves = {curve.stage: curve for curve in flow_curves(folder)}
        history = folder.history
        assert history is not None
        energy = {}
        for name, curve in curves.items():
            rows = np.array(history.stages) == name
            work = history["blade.work [J]"][rows]
            start = np.interp(0.0, curve.depth, work) if curve.goes_down else work[0]
            energy[name] = work[-1] - start
        mass = next(iter(curves.values())).mass
    assert len(curves) == 16
    down = [energy[f"test {n} down"] for n in (1, 2, 3, 4)]
    assert min(down) > 0.0
    assert found["basic_flowability_energy"] == pytest.approx(down[1])
    assert found["stability_index"] == pytest.approx(down[1] / down[0])
    assert found["flow_rate_index"] == pytest.approx(down[3] / down[2])
    up = 0.5 * (energy["test 1 up"] + energy["test 2 up"])
    assert found["specific_energy"] == pytest.approx(up / mass)
    assert "flow_energy" not in found
