"""Runs of a study belong together for Dask, which then keeps them in one queue."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest
from distributed.utils import key_split_group

from pestle.sweep import cluster
from pestle.sweep.jobs import Job
from pestle.sweep.study import finished


def test_runs_are_one_group_of_tasks(monkeypatch: pytest.MonkeyPatch) -> None:
    """Tasks of many groups are dealt out to the workers at once, and stay there."""
    keys: list[Any] = []

    class Recorder:
        loop = None

        def map(self, function: Any, jobs: Any, *, key: Any, pure: bool) -> list[Any]:
            assert len(key) == len(jobs)
            keys.extend(key)
            return []

    @contextmanager
    def connected(*_: Any) -> Iterator[Recorder]:
        yield Recorder()

    monkeypatch.setattr(cluster, "connected", connected)
    monkeypatch.setattr("distributed.as_completed", lambda futures, loop: iter(futures))
    for _ in range(2):
        jobs = [Job(f"{n:016x}", "case.toml", {}, f"runs/{n}") for n in range(5)]
        assert list(finished(jobs, 2)) == []
    assert len(set(keys)) == 10
    assert len({key_split_group(key) for key in keys}) == 2  # one for each study
