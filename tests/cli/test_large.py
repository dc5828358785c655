"""pestle plan --large: what more particles would take on each engine."""

import json

import pytest

from pestle.cli import main
from pestle.errors import InputError
from pestle.lammps import command
from simulation.cases import tiny_case


def planned(path, capsys):
    assert main(["plan", str(path), "--large", "--json"]) == 0
    return json.loads(capsys.readouterr().out)


def test_estimates_grow_with_the_number(tmp_path, capsys):
    found = planned(tiny_case(tmp_path), capsys)
    ours = [row for row in found["large"] if row["engine"] == "pestle"]
    assert [row["particles"] for row in ours] == [10**6, 10**7, 10**8]
    assert ours[2]["wall_time_s"] == pytest.approx(100 * ours[0]["wall_time_s"])
    each = ours[0]["memory_bytes"] / 10**6
    assert 500 < each < 50_000
    theirs = [row for row in found["large"] if row["engine"] == "lammps"]
    if "note" in theirs[0]:
        with pytest.raises(InputError) as error:
            command(1)
        assert theirs == [{"engine": "lammps", "note": error.value.what}]
    else:
        assert theirs[0]["memory_bytes"] > 1e8


def test_a_law_that_lammps_lacks_is_named(tmp_path, capsys):
    found = planned(tiny_case(tmp_path, law="nan2022"), capsys)
    assert found["large"][-1]["note"] == "LAMMPS does not have the law nan2022"
