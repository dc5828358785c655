"""Progress of a run: a live bar on a terminal, plain lines elsewhere, or nothing."""

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from pestle.cli.printing import duration, quantity

if TYPE_CHECKING:
    from pestle.simulation import Progress

Report = Callable[["Progress"], None]

SECONDS_BETWEEN_LINES = 10.0
"""Time between two plain lines of one stage [s]."""


@contextmanager
def progress(*, quiet: bool) -> Iterator[Report | None]:
    """Give the function that a run calls with its progress."""
    if quiet:
        yield None
    elif sys.stderr.isatty():
        with _bar() as report:
            yield report
    else:
        yield Lines()


class Lines:
    """One line at the start of each stage and every few seconds."""

    def __init__(self) -> None:
        self._stage: int | None = None
        self._last = 0.0

    def __call__(self, now: "Progress") -> None:
        """Print a line if it is time for one."""
        clock = time.monotonic()
        is_new = now.stage_index != self._stage
        if not is_new and clock - self._last < SECONDS_BETWEEN_LINES:
            return
        self._stage, self._last = now.stage_index, clock
        print(
            f"{_title(now)}: {100 * now.fraction:.0f} %, {_state(now)}", file=sys.stderr
        )
        sys.stderr.flush()


@contextmanager
def _bar() -> Iterator[Report]:
    from rich import progress as widgets
    from rich.console import Console

    columns = (
        widgets.TextColumn("{task.description}"),
        widgets.BarColumn(bar_width=24),
        widgets.TaskProgressColumn(),
        widgets.TextColumn("{task.fields[state]}"),
    )
    with widgets.Progress(*columns, console=Console(stderr=True)) as bars:
        tasks: dict[int, Any] = {}

        def report(now: "Progress") -> None:
            if now.stage_index not in tasks:
                for task in tasks.values():
                    bars.update(task, completed=1.0, state="")
                new = bars.add_task(_title(now), total=1.0, state="")
                tasks[now.stage_index] = new
            bars.update(
                tasks[now.stage_index], completed=now.fraction, state=_state(now)
            )

        yield report


def _title(now: "Progress") -> str:
    return f"[{now.stage_index + 1}/{now.stages}] {now.stage}"


def _state(now: "Progress") -> str:
    parts = [f"step {now.step}", f"t = {quantity(now.time, 's')}"]
    if now.stress is not None:
        parts.append(f"punch {now.stress / 1e6:.1f} MPa")
    if now.eta_s is not None:
        parts.append(f"{duration(now.eta_s)} left")
    if now.particle_steps_per_s:
        parts.append(f"{now.particle_steps_per_s / 1e6:.2f} M particle-steps/s")
    return ", ".join(parts)
