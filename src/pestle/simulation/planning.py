"""A dry run: what a case would take, measured by a short probe."""

from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter
from typing import TYPE_CHECKING, Any

import numpy as np

from pestle.engine import step as st

if TYPE_CHECKING:
    from pestle.config import Case

PROBE = 2.0
"""Wall time of the probe [s]."""


@dataclass(frozen=True, slots=True)
class Plan:
    """What a run would take."""

    particles: int
    time_step: float  # [s]
    time_step_reason: str
    steps: int
    memory_bytes: int
    wall_time_s: float  # [s]
    stages: list[dict[str, Any]] = field(default_factory=list)


def plan(case: "Case") -> Plan:
    """Estimate steps, memory and wall time of a case.

    The probe runs the law on the particles as they start, so a powder that is still
    loose is cheaper than the pressed one: the estimate doubles the measured cost.
    """
    from pestle.simulation.build import make_engine
    from pestle.simulation.runner import Runner
    from pestle.simulation.start import start

    with TemporaryDirectory() as folder:
        run = Runner(case, Path(folder))
        start(run)
    soft = run.engine
    hard, _ = make_engine(case)
    order = np.argsort(soft.ids)
    radius = soft.pos[order, 3]
    density = soft.vel[order, 3] / (4.0 / 3.0 * np.pi * radius**3)
    hard.set_particles(soft.pos[order, :3], radius, soft.mat[order], density)
    hard.start()
    pressed = pressed_step(case, radius, density)
    hard.advance(1)
    begin, first = perf_counter(), hard.steps
    while perf_counter() - begin < PROBE and hard.advance(50) == st.RAN:
        pass
    cost = 2.0 * (perf_counter() - begin) / max(hard.steps - first, 1)
    stages, total, wall = [], 0, 0.0
    for name, step in zip(case.stage_names, case.process, strict=True):
        dt = float(soft.clock[st.DT]) if step.step == "fill" else pressed
        seconds = duration(case, step, run.memory.get("column", 0.0))
        steps = int(np.ceil(seconds / dt))
        stages.append({"name": name, "time [s]": seconds, "steps": steps})
        total += steps
        wall += steps * cost * (0.2 if step.step == "fill" else 1.0)
    size = sum(a.nbytes for a in vars(hard).values() if isinstance(a, np.ndarray))
    reason = (
        "given in engine.time_step"
        if case.engine.time_step != "auto"
        else f"{case.engine.safety:g} of the critical step of a pressed particle with "
        "eight contacts of half its radius"
    )
    return Plan(len(radius), pressed, reason, total, 2 * size, wall, stages)


def pressed_step(case: "Case", radius: Any, density: Any) -> float:
    """Step for the stiffest state expected: eight contacts of radius R/2 [s]."""
    if case.engine.time_step != "auto":
        return float(case.engine.time_step)
    modulus = 0.0
    for name in case.powders:
        m = case.materials[name]
        assert m.youngs_modulus is not None
        assert m.poisson_ratio is not None
        modulus = max(modulus, m.youngs_modulus / (1.0 - m.poisson_ratio**2) / 2.0)
    mass = 4.0 / 3.0 * np.pi * radius**3 * density
    stiffness = 8.0 * 3.5 * 0.8 * 2.0 * modulus * 0.5 * radius
    return float(case.engine.safety * np.min(2.0 * np.sqrt(mass / (2.0 * stiffness))))


def duration(case: "Case", step: Any, column: float) -> float:
    """Expected length of a step of the process [s]."""
    given = getattr(step, "duration", None)
    if given is not None:
        return float(given)
    if step.step == "fill":
        gravity = float(np.linalg.norm(case.engine.gravity))
        return min(1.5 * (2.0 * column / max(gravity, 1e-12)) ** 0.5, step.max_time)
    if step.step == "move":
        if step.program is not None:
            return float(step.program[-1][0])
        way = (
            abs(step.to) if step.turn_at is None else 2.0 * step.turn_at - step.back_to
        )
        return float(way / step.at)
    assert case.die is not None or step.step == "press"
    height = case.die.height if case.die else step.to_displacement
    way = {
        "press": step.to_displacement
        if step.step == "press" and step.to_displacement
        else 0.3 * height,
        "unload": 0.05 * height,
        "eject": height,
        "crush": getattr(step, "to", 0.1)
        * 2.0
        * (case.die.radius if case.die else 0.0)
        * 0.5,
    }.get(step.step, height)
    return float(way / step.at)
