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
from pestle.packing import draw_radii, place_in_die
from pestle.simulation import checkpoint
from pestle.simulation.build import make_engine, yield_needed
from pestle.simulation.output import Output
from pestle.simulation.progress import Progress, RunResult, StopReason
from pestle.simulation.stages import PHASES
from pestle.simulation.watch import check_state, failure

if TYPE_CHECKING:
    from pestle.config import Case

SOFTENING = 1000.0
"""Modulus of the particles over that of the filling stage, unless the case says."""

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
        yield_needed(case)

    # -------------------------------------------------------------- set-up

    def start(self) -> None:
        """Place the particles of a fresh run."""
        case = self.case
        filling = case.process[0].step == "fill"
        if case.particles.start_from is not None:
            self._continue_from(case.resolve(case.particles.start_from))
            return
        self.engine, self.walls = make_engine(
            case, filling=filling, softening=self.softening
        )
        if case.particles.file is not None:
            table = case.read_particles()
            place, radius, density = table.position, table.radius, table.density
        elif case.die is not None and filling:
            random = np.random.default_rng(case.seed)
            assert (
                case.particles.radius is not None and case.particles.count is not None
            )
            radius = draw_radii(case.particles.radius, case.particles.count, random)
            place, column = place_in_die(radius, case.die.radius, random)
            self.memory["column"] = column
            density = case.materials[case.particles.material].density
        else:
            raise InputError(
                "no-start",
                "generated particles need a die and a first step 'fill'",
                "process.0.step",
                'add [[process]] step = "fill" as the first step, or read a file',
            )
        self.engine.set_particles(
            place,
            radius,
            np.zeros(len(radius), int),
            density * case.engine.mass_scaling,
        )
        if filling:
            self.memory.setdefault("column", float(place[:, 2].max()))
            self._open_for_filling()
        self.engine.start()
        self._initial_energy()

    @property
    def softening(self) -> float:
        """Modulus over that of the filling stage [-]."""
        for step in self.case.process:
            if step.step == "fill":
                return float(getattr(step, "softening", SOFTENING))
        return 1.0

    def _open_for_filling(self) -> None:
        """Take the upper punch away and let the die reach above the column."""
        engine = self.engine
        for name, w in zip(self.walls, range(len(self.walls)), strict=True):
            if name == "upper_punch":
                engine.wall[w, wl.ACTIVE] = 0.0
            if name == "die":
                engine.wall[w, wl.TOP] = max(
                    engine.wall[w, wl.TOP], 1.2 * self.memory["column"]
                )

    def _continue_from(self, folder: Path) -> None:
        """Start from the last state of an earlier run."""
        arrays, facts = checkpoint.read(folder)
        self.engine, self.walls = make_engine(self.case)
        order = np.argsort(arrays["ids"])
        multi = self.engine.layout.fields and arrays["field"].shape[1] > 1
        radius = arrays["field"][order, 0] if multi else arrays["pos"][order, 3]
        mass = arrays["vel"][order, 3]
        density = mass / (4.0 / 3.0 * np.pi * radius**3)
        self.engine.set_particles(
            arrays["pos"][order, :3], radius, np.zeros(len(order), int), density
        )
        self.engine.vel[:, :3] = arrays["vel"][order][self.engine.ids - 1, :3]
        same_law = facts.get("law") == self.case.canonical_law()
        if same_law and facts.get("walls") == self.walls:
            gravity = self.engine.gravity
            self.engine.restore(arrays)
            self.engine.gravity = gravity
            self.engine.report[0] = 0
            self.engine.clock[st.TIME] = 0.0
        self.engine.start()
        self._initial_energy()

    def harden(self) -> None:
        """Replace the soft engine of the filling stage by that of the case."""
        soft = self.engine
        time_, ids = soft.time, soft.ids
        order = np.argsort(ids)
        self.before += soft.steps
        engine, _ = make_engine(self.case)
        radius = soft.pos[order, 3]
        density = soft.vel[order, 3] / (4.0 / 3.0 * np.pi * radius**3)
        top = float((soft.pos[:, 2] + soft.pos[:, 3]).max())
        if self.case.die is not None and top > self.case.die.height:
            raise InputError(
                "die-too-low",
                f"the filled powder reaches {top:.4g} m, above the die of {self.case.die.height:.4g} m",
                "die.height",
                f"raise die.height above {1.05 * top:.3g} m or use fewer particles",
            )
        engine.wall[:, wl.ACTIVE] = soft.wall[:, wl.ACTIVE]
        engine.clock[st.TIME] = time_
        engine.set_particles(soft.pos[order, :3], radius, soft.mat[order], density)
        engine.ids = np.sort(ids)[engine.ids - 1]
        engine.vel[:, [0, 1, 2, 4, 5, 6]] = soft.vel[order][:, [0, 1, 2, 4, 5, 6]][
            np.searchsorted(np.sort(ids), engine.ids)
        ]
        engine.start()
        self.engine = engine
        self._initial_energy()

    def _initial_energy(self) -> None:
        """Remember the energy that a new engine begins with, for the ledger."""
        s = self.engine.sums
        m, g = self.engine.vel[:, 3], self.engine.gravity
        v, w = self.engine.vel[:, :3], self.engine.vel[:, 4:7]
        kinetic = 0.5 * float(np.sum(m[:, None] * v * v)) + 0.5 * float(
            np.sum(self.engine.vel[:, 7][:, None] * w * w)
        )
        potential = -float(np.sum(m * (self.engine.pos[:, :3] @ g)))
        self.memory["energy"] = kinetic + potential + float(s[st.STORED])

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
        inside = np.hypot(engine.pos[:, 0], engine.pos[:, 1]) < np.inf
        top = float((engine.pos[:, 2] + engine.pos[:, 3])[inside].max())
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
                    self.memory["from"] = self._where()
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
        for key in ("entered", "frames", "peak", "reason", "from"):
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
                if self._fraction() * settings.frames >= self.memory["frames"] + 1:
                    self.memory["frames"] = int(self._fraction() * settings.frames)
                    output.frame(self, name)
                if self._broke():
                    self.memory["reason"] = "the tablet broke"
                    return True
            if why == st.CONDITION:
                self.memory["reason"] = self._reason(int(self.engine.report[1]))
                return True
            if self.steps % settings.checkpoint_every == 0:
                self.save(output)
            if report is not None:
                report(self.progress(name))

    def _where(self) -> list[float]:
        """Value of each condition's quantity now."""
        e, values = self.engine, []
        for kind, w, _ in e.condition:
            w = int(w)
            if kind in (st.FORCE_ABOVE, st.FORCE_BELOW):
                values.append(float(e.total[w, :3] @ e.move[w, :3]))
            elif kind in (st.MOVED, st.BACK):
                values.append(float(e.move[w, wl.DISPLACEMENT]))
            elif kind == st.UNTIL:
                values.append(e.time)
            else:
                values.append(float(e.sums[st.KINETIC]))
        return values

    def _fraction(self) -> float:
        """How far the phase has come, 0 to 1: the farthest of its conditions."""
        most = 0.0
        for (kind, _, goal), begun, now in zip(
            self.engine.condition, self.memory["from"], self._where(), strict=True
        ):
            if kind != st.AT_REST and goal != begun:
                most = max(most, (now - begun) / (goal - begun))
        phases = len(PHASES[self.case.process[self.stage].step])
        return float(min((self.phase + min(most, 1.0)) / phases, 1.0))

    def _broke(self) -> bool:
        """Whether the tablet between the platens carries half of its peak or less."""
        if self.case.process[self.stage].step != "crush":
            return False
        e, w = self.engine, self.wall("platen_left")
        force = float(e.total[w, :3] @ e.move[w, :3])
        self.memory["peak"] = max(self.memory["peak"], force)
        moved = float(e.move[w, wl.DISPLACEMENT])
        settled = moved > 0.005 * self.memory["crush_diameter"]
        return settled and force < 0.5 * self.memory["peak"]

    def _reason(self, index: int) -> str:
        kind, w, value = self.engine.condition[index]
        name = self.walls[int(w)] if w >= 0 else ""
        return {
            st.FORCE_ABOVE: f"{name} reached {value:.6g} N",
            st.FORCE_BELOW: f"{name} carries no load",
            st.MOVED: f"{name} reached a displacement of {value:.6g} m",
            st.BACK: f"{name} is back at a displacement of {value:.6g} m",
            st.UNTIL: f"time {value:.6g} s",
            st.AT_REST: "the powder is at rest",
        }[int(kind)]

    def progress(self, name: str) -> Progress:
        """Where the run stands."""
        e, fraction = self.engine, self._fraction()
        begun = self.stages[-1]["start_step"]
        done = self.steps - begun
        eta = None
        if 0.0 < fraction < 1.0 and self.speed:
            eta = done * (1.0 - fraction) / fraction / self.speed
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
            fraction,
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
                "resume with the same case and --set values, or run anew with another --out",
            )
        self.stage, self.phase = facts["stage"], facts["phase"]
        self.before, self.memory, self.stages = (
            facts["before"],
            facts["memory"],
            facts["stages"],
        )
        self.engine, self.walls = make_engine(
            self.case, filling=facts["soft"], softening=self.softening
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
        Number of threads; the results do not depend on it [-].
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
    import numba

    if threads is not None:
        numba.set_num_threads(min(threads, numba.config.NUMBA_NUM_THREADS))
    folder = Path(out)
    folder.mkdir(parents=True, exist_ok=True)
    begin = time.perf_counter()
    runner = Runner(case, folder)
    if resume:
        output = Output(runner, after=runner.resume())
    else:
        runner.start()
        output = Output(runner, threads=numba.get_num_threads())
    with _Interrupts(runner), output:
        reason = runner.go(output, progress)
    spent = time.perf_counter() - begin
    output.finish(runner, spent)
    return RunResult(folder, reason, runner.steps, spent, output.metrics())


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
