"""Tables come back as they were written."""

from pathlib import Path

import numpy as np
import pytest
from scipy.io import netcdf_file

from pestle.bench import write_table
from pestle.errors import InputError

COLUMNS = {
    "law": np.array(["a", "a", "b"]),
    "leg": np.array([0, 1, 1]),
    "force [N]": np.array([0.1, -1.0 / 3.0, np.nan]),
}


def test_csv(tmp_path):
    write_table(tmp_path / "t.csv", COLUMNS)
    head, *rows = (tmp_path / "t.csv").read_text().splitlines()
    assert head == "law,leg,force [N]"
    assert rows == ["a,0,0.1", "a,1,-0.3333333333333333", "b,1,nan"]


def test_netcdf(tmp_path):
    write_table(tmp_path / "t.nc", COLUMNS)
    with netcdf_file(tmp_path / "t.nc", mmap=False) as file:
        np.testing.assert_array_equal(file.variables["force"][:], COLUMNS["force [N]"])
        assert file.variables["force"].units == b"N"
        assert file.law_names == b"a, b"
        assert file.variables["law"][:].tolist() == [0, 0, 1]


def test_parquet(tmp_path):
    parquet = pytest.importorskip("pyarrow.parquet")
    write_table(tmp_path / "t.parquet", COLUMNS)
    table = parquet.read_table(tmp_path / "t.parquet")
    assert table.column_names == list(COLUMNS)
    assert table["law"].to_pylist() == ["a", "a", "b"]


def test_unknown_suffix():
    with pytest.raises(InputError, match="no suffix of a table"):
        write_table(Path("t.xls"), COLUMNS)


def test_folder_that_does_not_exist(tmp_path):
    with pytest.raises(InputError, match="No such file"):
        write_table(tmp_path / "no" / "t.csv", COLUMNS)
