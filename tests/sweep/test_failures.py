"""Disk full, failing cases, missing libraries: without a cluster."""

import errno
from importlib import util
from pathlib import Path

import pytest
from pyarrow import parquet

from pestle.errors import InputError, PestleError
from pestle.sweep import cluster, compute, planned, run_study
from pestle.sweep.jobs import forget_failure, stored
from sweep.studies import alone, finished, write


def full(*_, **__):
    """Fail like a write to a full disk."""
    raise OSError(errno.ENOSPC, "No space left on device")


def test_a_full_disk_stops_a_run_and_it_goes_on_later(tmp_path, monkeypatch):
    whole = alone(write(tmp_path / "a"), tmp_path / "a")
    study = write(tmp_path / "b")
    first, *_ = planned(study, tmp_path / "b")
    with monkeypatch.context() as patch:
        patch.setattr("pestle.results.write.ResultFile.append", full)
        outcome = compute(first.job)
    assert outcome.status == "stopped"
    assert "No space left" in outcome.reason
    assert not finished(tmp_path / "b")
    assert alone(study, tmp_path / "b") == whole


def test_a_disk_that_fills_up_at_the_outcome(tmp_path, monkeypatch):
    first, *_ = planned(write(tmp_path), tmp_path)
    with monkeypatch.context() as patch:
        patch.setattr("pestle.sweep.jobs.json.dump", full)
        assert compute(first.job).status == "stopped"
    assert stored(Path(first.job.folder)) is None
    assert compute(first.job).status == "done"


def test_a_table_that_cannot_be_written_leaves_no_half_of_it(tmp_path, monkeypatch):
    study = write(tmp_path)
    alone(study, tmp_path)
    before = (tmp_path / "table.parquet").read_bytes()
    monkeypatch.setattr(parquet, "write_table", full)
    with pytest.raises(PestleError) as error:
        run_study(study, tmp_path)
    assert error.value.id == "table-not-written"
    assert (tmp_path / "table.parquet").read_bytes() == before


def test_a_run_that_fails_is_kept_with_its_reason(tmp_path):
    text = 'case = "case.toml"\nvary.engine.time_step = ["auto", "1 ms"]'
    study = write(tmp_path, text)
    good, bad = (compute(row.job) for row in planned(study, tmp_path))
    assert good.status == "done"
    assert bad.status == "failed"
    assert bad.reason.partition(":")[0].count("-") >= 1  # an id of ours
    times = finished(tmp_path)
    assert len(times) == 2
    result = run_study(study, tmp_path)  # nothing is left to do: no cluster
    assert (result.count("done"), result.count("failed")) == (1, 1)
    assert finished(tmp_path) == times
    (row,) = [row for row in result.rows if row.outcome.status == "failed"]
    forget_failure(Path(row.job.folder))
    assert len(finished(tmp_path)) == 1


def test_a_case_that_changes_under_a_study_is_not_mistaken(tmp_path):
    first, *_ = planned(write(tmp_path), tmp_path)
    write(tmp_path, at="2 m/s")
    outcome = compute(first.job)
    assert outcome.status == "failed"
    assert outcome.reason.startswith("case-changed")


def test_a_missing_extra_is_named(tmp_path, monkeypatch):
    monkeypatch.setattr(util, "find_spec", lambda name: None)
    with pytest.raises(InputError, match=r"pestle\[sweep\]"):
        run_study(write(tmp_path), tmp_path)


def test_workers_fit_cores_and_memory():
    from dask.system import CPU_COUNT

    assert cluster.worker_count(memory=1, runs=10**6) == CPU_COUNT
    assert cluster.worker_count(memory=10**15, runs=10**6) == 1
    assert cluster.worker_count(memory=1, runs=1) == 1
