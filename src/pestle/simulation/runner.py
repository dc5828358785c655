"""The run itself: stages, events by step count, files, interruption."""

import signal
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pestle.engine import step as st
from pestle.engine import walls as wl
from pestle.errors import InputError
from pestle.simulation import checkpoint
from pestle.simulation.build import make_engine
from pestle.simulation.conditions import fraction, reason, tablet_broke, values
from pestle.simulation.output import Output
from pestle.simulation.progress import Progress, RunResult, StopReason
from pestle.simulation.stages import PHASES
from pestle.simulation.start import softening, start
from pestle.simulation.threads import set_threads
from pestle.simulation.watch import check_state, failure

if TYPE_CHECKING:
    from pestle.config import Case

Report = Callable[[Progress], None]


class Runner:
    """One run of a case."""

    def __init__(self, case: "Case", out: Path) -> None:
        self.case, self.out = case, out
        self.stage = self.phase = 0
        self.before = 0  # steps of engines that have been replaced
        self.memory: dict[str, Any] = {}
        self.stages: list[dict[str, Any]] = []
        self.interrupted = False
        self.speed = 0.0  # steps per second of wall time

    # -------------------------------------------------------------- what stages need

    def wall(self, name: str) -> int:
        """Number of a wall."""
        return self.walls.index(name)

    def remove(self, name: str) -> None:
        """Take a wall away."""
        if name in self.walls:
            w = self.wall(name)
            self.engine.stop_wall(w)
            self.engine.wall[w, wl.ACTIVE] = 0.0

    def lower_to_powder(self, w: int) -> None:
        """Bring the upper punch down to just above the powder, if it is higher."""
        engine = self.engine
        top = float((engine.pos[:, 2] + engine.pos[:, 3]).max())
        drop = float(engine.wall[w, 3]) - top - 1e-3 * float(engine.pos[:, 3].mean())
        if drop > 0.0:
            engine.wall[w, 3] -= drop
            engine.move[w, wl.DISPLACEMENT] += drop

    def in_tablet(self) -> Any:
        """Mask of the particles near the bulk, without loose ones."""
        x = self.engine.pos[:, :3]
        centre = np.median(x, axis=0)
        far = np.abs(x - centre)
        return np.all(
            far <= 3.0 * np.median(far, axis=0) + self.engine.pos[:, 3:4], axis=1
        )

    @property
    def steps(self) -> int:
        """Steps of the whole run so far."""
        return self.before + self.engine.steps

    # -------------------------------------------------------------- the loop

    def go(self, output: Output, report: Report | None) -> StopReason:
        """Advance from wherever the run stands to its end."""
        case = self.case
        while self.stage < len(case.process):
            step = case.process[self.stage]
            phases = PHASES[step.step]
            if self.phase == 0 and "entered" not in self.memory:
                self._enter(step, output)
            while self.phase < len(phases):
                if "conditions" not in self.memory:
                    conditions = phases[self.phase](self, step)
                    self.memory["conditions"] = len(conditions)
                    self.engine.condition = np.array(conditions, float).reshape(-1, 3)
                    self.memory["from"] = values(self)
                if not self._phase(output, report):
                    self.save(output)
                    return StopReason.INTERRUPTED
                del self.memory["conditions"]
                self.phase += 1
            self._leave(step, output)
        self.save(output)
        return StopReason.FINISHED

    def _enter(self, step: Any, output: Output) -> None:
        clock = self.engine.clock
        if clock[st.AUTO] > 0.0 and clock[st.CRITICAL] > 0.0:
            longest = min(clock[st.DT_MAX], clock[st.SAFETY] * clock[st.CRITICAL])
            clock[st.DT] = longest / 1.05
        name = self.case.stage_names[self.stage]
        self.memory["entered"] = True
        self.memory["frames"] = 0
        self.memory["peak"] = 0.0
        self.stages.append(
            {
                "name": name,
                "step": step.step,
                "start_step": self.steps,
                "end_step": self.steps,
                "start_time": self.engine.time,
                "end_time": self.engine.time,
                "end_reason": "",
                "info": {},
            }
        )
        output.frame(self, name)

    def _leave(self, step: Any, output: Output) -> None:
        from pestle.simulation.measure import stage_info

        entry = self.stages[-1]
        entry["end_step"], entry["end_time"] = self.steps, self.engine.time
        entry["end_reason"] = self.memory.get("reason", "")
        entry["info"] = stage_info(self, step)
        for w in range(len(self.walls)):
            self.engine.stop_wall(w)
        self.engine.box[2] = 0.0
        output.row(self, entry["name"])
        output.frame(self, entry["name"])
        output.stages(self.stages)
        self.stage += 1
        self.phase = 0
        for key in ("entered", "frames", "peak", "peak_at", "reason", "from"):
            self.memory.pop(key, None)
        self.save(output)

    def _phase(self, output: Output, report: Report | None) -> bool:
        """Advance to the end of a phase; False if interrupted."""
        settings = self.case.output
        name = self.case.stage_names[self.stage]
        if len(self.engine.condition) == 0:
            return True
        while True:
            if self.interrupted:
                return False
            quiet = settings.history_every - self.steps % settings.history_every
            due = settings.checkpoint_every - self.steps % settings.checkpoint_every
            chunk = min(
                quiet, due, max(int(0.2 * self.speed), 1) if self.speed else quiet
            )
            begin = time.perf_counter()
            first = self.engine.steps
            why = self.engine.advance(chunk)
            done = self.engine.steps - first
            spent = time.perf_counter() - begin
            if done and spent > 0.0:
                self.speed = done / spent
            if why not in (st.RAN, st.CONDITION):
                output.frame(self, name)
                raise failure(self, why)
            at_row = self.steps % settings.history_every == 0
            if at_row:
                output.row(self, name)
                check_state(self)
                if fraction(self) * settings.frames >= self.memory["frames"] + 1:
                    self.memory["frames"] = int(fraction(self) * settings.frames)
                    output.frame(self, name)
                if tablet_broke(self):
                    self.memory["reason"] = "the tablet broke"
                    return True
            if why == st.CONDITION:
                self.memory["reason"] = reason(self, int(self.engine.report[1]))
                return True
            if self.steps % settings.checkpoint_every == 0:
                self.save(output)
            if report is not None:
                report(self.progress(name))

    def progress(self, name: str) -> Progress:
        """Where the run stands."""
        e, share = self.engine, fraction(self)
        begun = self.stages[-1]["start_step"]
        done = self.steps - begun
        eta = None
        if 0.0 < share < 1.0 and self.speed:
            eta = done * (1.0 - share) / share / self.speed
        stress = None
        if self.case.die is not None and "upper_punch" in self.walls:
            w = self.wall("upper_punch")
            stress = abs(float(e.total[w, 2])) / self.case.die.area
        return Progress(
            name,
            self.stage,
            len(self.case.process),
            self.steps,
            e.time,
            share,
            eta,
            stress,
            self.speed * len(e.pos),
        )

    # -------------------------------------------------------------- checkpoints

    def save(self, output: Output) -> None:
        """Write a checkpoint and flush what was written so far."""
        output.flush()
        arrays = self.engine.saved()
        arrays["condition"] = self.engine.condition
        facts = {
            "case": self.case.canonical(),
            "law": self.case.canonical_law(),
            "walls": self.walls,
            "powders": self.case.powders,
            "stage": self.stage,
            "phase": self.phase,
            "before": self.before,
            "memory": self.memory,
            "stages": self.stages,
            "soft": self._is_soft(),
            "steps": self.steps,
        }
        checkpoint.write(self.out, arrays, facts)

    def _is_soft(self) -> bool:
        return self.stage < len(self.case.process) and (
            self.case.process[self.stage].step == "fill" and self.before == 0
        )

    def resume(self) -> int:
        """Take over the checkpoint; return the step up to which files hold."""
        arrays, facts = checkpoint.read(self.out)
        if facts["case"] != self.case.canonical():
            raise InputError(
                "case-changed",
                f"the case differs from the one that was run in {self.out}",
                "--resume",
                "resume with the same case and --set values, or run anew with another "
                "--out",
            )
        self.stage, self.phase = facts["stage"], facts["phase"]
        self.before, self.memory, self.stages = (
            facts["before"],
            facts["memory"],
            facts["stages"],
        )
        self.engine, self.walls = make_engine(
            self.case, filling=facts["soft"], softening=softening(self.case)
        )
        self.engine.restore(arrays)
        self.engine.condition = arrays["condition"]
        return int(facts["steps"])


def run(
    case: "Case",
    out: Path | str,
    threads: int | None = None,
    resume: bool = False,
    progress: Report | None = None,
) -> RunResult:
    """Run a case and write everything into a folder.

    Parameters
    ----------
    case : Case
        What to run.
    out : Path
        Folder of the results.
    threads : int, optional
        Number of threads, by default one for few particles and otherwise all cores;
        the results do not depend on it [-].
    resume : bool
        Continue from the last checkpoint of the same case in `out`.
    progress : callable, optional
        Called with a `Progress` a few times a second.

    Returns
    -------
    RunResult
        How it ended; figures are in the folder.

    Raises
    ------
    InputError
        If the case cannot be run as it stands.
    SimulationError
        If the run went wrong; what was computed stays readable in `out`.
    """
    folder = Path(out)
    folder.mkdir(parents=True, exist_ok=True)
    begin = time.perf_counter()
    runner = Runner(case, folder)
    if resume:
        after = runner.resume()
        set_threads(threads, len(runner.engine.pos))
        output = Output(runner, after=after)
    else:
        start(runner)
        threads = set_threads(threads, len(runner.engine.pos))
        output = Output(runner, threads=threads)
    with _Interrupts(runner), output:
        stopped = runner.go(output, progress)
    spent = time.perf_counter() - begin
    output.finish(runner, spent)
    return RunResult(folder, stopped, runner.steps, spent, output.metrics())


class _Interrupts:
    """Turns Ctrl-C into a stop at the next whole step."""

    def __init__(self, runner: Runner) -> None:
        self.runner = runner

    def __enter__(self) -> None:
        self.main = threading.current_thread() is threading.main_thread()
        if self.main:
            self.old = signal.signal(signal.SIGINT, self._note)

    def _note(self, number: int, frame: Any) -> None:
        self.runner.interrupted = True

    def __exit__(self, *_: object) -> None:
        if self.main:
            signal.signal(signal.SIGINT, self.old)
