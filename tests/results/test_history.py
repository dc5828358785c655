"""history.csv: exact numbers, half rows, foreign files."""

import math

import numpy as np
import pytest

from pestle.errors import InputError
from pestle.results import History, Stage, read_history, read_stages, write_stages
from pestle.results.provenance import collect, read_provenance, write_provenance

COLUMNS = ["time [s]", "step", "stage", "die.displacement [m]", "energy.kinetic [J]"]


@pytest.fixture
def path(tmp_path):
    with History(tmp_path / "history.csv", COLUMNS) as history:
        for k in range(5):
            stage = "fill" if k < 2 else 'press, "hard"'
            history.row([k / 3, 10 * k, stage, np.float64(0.1) * k, math.pi * 10**-k])
    return tmp_path / "history.csv"


def test_numbers_read_back_exactly(path):
    table = read_history(path)
    assert len(table) == 5
    assert table["time [s]"].tolist() == [k / 3 for k in range(5)]
    assert table["energy.kinetic [J]"].tolist() == [math.pi * 10**-k for k in range(5)]
    assert table.walls == ("die",)
    assert table.in_stage('press, "hard"').tolist() == [False] * 2 + [True] * 3
    assert path.read_text().splitlines()[1] == "0.0,0,fill,0.0,3.141592653589793"


def test_continued_history_has_the_same_bytes(path, tmp_path):
    whole = path.read_bytes()
    path.write_bytes(whole[:-7])  # killed in the middle of a row
    assert len(read_history(path)) == 4
    with History(path, COLUMNS, "a") as history:
        history.truncate_after(25)
        for k in (3, 4):
            stage = 'press, "hard"'
            history.row([k / 3, 10 * k, stage, np.float64(0.1) * k, math.pi * 10**-k])
    assert path.read_bytes() == whole


def test_wrong_use_is_refused(path, tmp_path):
    with pytest.raises(InputError, match="history-columns"):
        History(path, COLUMNS[:-1], "a")
    with pytest.raises(ValueError, match="step"):
        History(tmp_path / "x.csv", ["time [s]"])
    with (
        History(tmp_path / "x.csv", COLUMNS) as history,
        pytest.raises(ValueError, match="2 values"),
    ):
        history.row([1.0, 2])


def test_missing_column_names_the_nearest(path):
    with pytest.raises(InputError, match=r"energy\.kinetic"):
        read_history(path)["energy.kinetik [J]"]


@pytest.mark.parametrize(
    ("content", "error"),
    [
        (b"", "history-foreign"),
        (b"a,b\n1,2\n", "history-foreign"),
        (b"\xff\xfe\x00\x01", "history-unreadable"),
        (b"step,x\n1,2\n1\n2,3\n", "history-damaged"),
        (b"step,x\n1,2\n1,two\n", "history-damaged"),
    ],
)
def test_foreign_and_damaged_files(tmp_path, content, error):
    path = tmp_path / "history.csv"
    path.write_bytes(content)
    with pytest.raises(InputError) as caught:
        read_history(path)
    assert caught.value.id == error


def test_damage_names_the_line(tmp_path):
    path = tmp_path / "history.csv"
    path.write_text("step,x\n1,2\n1,two\n")
    with pytest.raises(InputError, match=r"history\.csv:3"):
        read_history(path)


def test_missing_history(tmp_path):
    with pytest.raises(InputError, match="history-unreadable"):
        read_history(tmp_path / "history.csv")


def test_stages_round_trip(tmp_path):
    stage = Stage("press", "press", 0, 10, 0.0, 0.1, "reached 150 MPa", {"to": 1.5e8})
    write_stages(tmp_path / "stages.json", [stage])
    assert read_stages(tmp_path / "stages.json") == [stage]
    (tmp_path / "stages.json").write_text('[{"name": 1}]')
    with pytest.raises(InputError, match="stages-damaged"):
        read_stages(tmp_path / "stages.json")


def test_provenance_round_trip(tmp_path):
    record = collect(case_text="seed = 1\n", seed=1, threads=2)
    write_provenance(tmp_path / "provenance.json", record)
    assert read_provenance(tmp_path / "provenance.json") == record
    assert record["machine"]["cores"] >= 1
    assert record["libraries"]["numpy"] == np.__version__
    (tmp_path / "provenance.json").write_text("[]")
    with pytest.raises(InputError, match="provenance-damaged"):
        read_provenance(tmp_path / "provenance.json")
