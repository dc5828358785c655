"""A dry run: what a case would take, measured by a short probe."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from pestle.simulation.probing import Probe, Sample, probe, sample_of

if TYPE_CHECKING:
    from pestle.config import Case

PRESSED = 0.85
"""Relative density that a powder is taken to be pressed to [-]."""

SETTLING = 0.5
"""Step of a powder coming to rest over that of a first touch [-]."""

ROW = 1.5e-3
"""Wall time of a row of the history, for the estimate [s]."""


@dataclass(frozen=True, slots=True)
class Plan:
    """What a run would take."""

    particles: int
    time_step: float  # [s]
    time_step_reason: str
    steps: int
    memory_bytes: int
    wall_time_s: float  # without compiling [s]
    stages: list[dict[str, Any]] = field(default_factory=list)
    compile_time_s: float = 0.0  # that this plan took and the run will not need [s]


def plan(case: "Case") -> Plan:
    """Estimate steps, memory and wall time of a case.

    The probe times steps of the run's own kernels on a powder in which every particle
    has eight contacts.  The lengths of the steps are rough where a stress or a force
    ends them: the powder is taken to be pressed to a relative density of 0.85.
    """
    from pestle.simulation.build import make_engine
    from pestle.simulation.start import softening
    from pestle.simulation.threads import set_threads

    sample = sample_of(case)
    set_threads(None, sample.count)
    hard = probe(make_engine(case)[0], sample)
    soft = hard
    if case.process[0].step == "fill":
        engine, _ = make_engine(case, filling=True, softening=softening(case))
        soft = probe(engine, sample)
    pressed = pressed_step(case, sample)
    stages, total, wall = [], 0, 0.0
    for name, step in zip(case.stage_names, case.process, strict=True):
        seconds = duration(case, step, sample)
        steps = int(np.ceil(seconds / pressed))
        spent = steps * hard.cost
        if step.step == "fill":
            steps, spent = filling(case, seconds, sample, soft, hard)
        spent += ROW * steps / case.output.history_every
        stages.append(
            {
                "name": name,
                "time [s]": seconds,
                "steps": steps,
                "wall time [s]": spent,
                "inertial number [-]": inertial_number(case, step, sample),
            }
        )
        total, wall = total + steps, wall + spent
    reason = (
        "given in engine.time_step"
        if case.engine.time_step != "auto"
        else f"{case.engine.safety:g} of the critical step of a pressed particle with "
        "eight contacts of half its radius"
    )
    compiling = hard.compiling + (soft.compiling if soft is not hard else 0.0)
    memory = 2 * max(hard.memory, soft.memory)
    return Plan(sample.count, pressed, reason, total, memory, wall, stages, compiling)


def pressed_step(case: "Case", sample: Sample) -> float:
    """Step for the stiffest state expected: eight contacts of radius R/2 [s]."""
    if case.engine.time_step != "auto":
        return float(case.engine.time_step)
    moduli = []
    for name in case.powders:
        m = case.materials[name]
        assert m.youngs_modulus is not None
        assert m.poisson_ratio is not None
        moduli.append(m.youngs_modulus / (1.0 - m.poisson_ratio**2) / 2.0)
    mass = 4.0 / 3.0 * np.pi * sample.radius**3 * sample.density
    modulus = np.array(moduli)[sample.material]
    stiffness = 8.0 * 3.5 * 0.8 * 2.0 * modulus * 0.5 * sample.radius
    return float(case.engine.safety * np.min(2.0 * np.sqrt(mass / (2.0 * stiffness))))


def filling(
    case: "Case", seconds: float, sample: Sample, soft: Probe, hard: Probe
) -> tuple[int, float]:
    """Steps of a fill stage, soft and then hard, and their wall time [s]."""
    gravity = float(np.abs(case.engine.gravity).max())
    relax = 0.05 * (sample.mean / max(gravity, 1e-12)) ** 0.5
    part = SETTLING if case.engine.time_step == "auto" else 1.0
    fall = int(np.ceil(seconds / (part * soft.longest_step)))
    rest = int(np.ceil(relax / hard.longest_step))
    return fall + rest, fall * soft.cost + rest * hard.cost


def powder_heights(case: "Case", sample: Sample) -> tuple[float, float, float]:
    """Heights of the powder as dropped, filled and pressed, in a die [m]."""
    if case.die is None:
        return 0.0, 0.0, 0.0
    solid = sample.count * sample.mean_volume / case.die.area
    room = (1.0 - sample.mean / case.die.radius) ** 2
    return solid / (0.30 * room), solid / (0.60 * room), solid / PRESSED


def duration(case: "Case", step: Any, sample: Sample) -> float:
    """Expected length of a step of the process [s]."""
    given = getattr(step, "duration", None)
    if given is not None:
        return float(given)
    if step.step == "level":
        return 0.0
    dropped, filled, pressed = powder_heights(case, sample)
    if step.step == "fill":
        gravity = float(np.linalg.norm(case.engine.gravity))
        fall = (2.0 * dropped / max(gravity, 1e-12)) ** 0.5
        return float(min(2.0 * fall, step.max_time))
    if getattr(step, "program", None) is not None:
        return float(step.program[-1][0])
    if step.step == "stir":
        return stirring(case, step, sample)
    way = 0.0
    if step.step == "move":
        way = (
            abs(step.to) if step.turn_at is None else 2.0 * step.turn_at - step.back_to
        )
    elif step.step == "press":
        way = step.to_displacement or filled - pressed or sample.mean
    elif step.step == "unload":
        clearance = sample.mean if step.clearance is None else step.clearance
        way = 0.1 * pressed + clearance
    elif step.step == "lift":
        way = filled
    elif case.die is not None and step.step == "eject":
        way = case.die.height
    elif case.die is not None and step.step == "crush":
        way = 0.5 * step.to * 2.0 * case.die.radius  # it breaks about half-way
    return float(way / step.at)


def stirring(case: "Case", step: Any, sample: Sample) -> float:
    """Time from the depth at which the step before ended, or from the clearance [s]."""
    clearance = sample.mean if step.clearance is None else step.clearance
    before = -clearance
    for other in case.process:
        if other is step:
            break
        if other.step == "stir" and other.wall == step.wall:
            before = other.to
    return float(abs(step.to - before) / (step.tip_speed * np.sin(step.helix_angle)))


def inertial_number(case: "Case", step: Any, sample: Sample) -> float | None:
    """I = rate d sqrt(rho/p) at the end of a press: quasi-static below 1e-3 [-]."""
    if step.step != "press" or case.die is None:
        return None
    pressure = step.to_stress or (step.to_force or 0.0) / case.die.area
    if not pressure:
        return None
    rate = step.at / powder_heights(case, sample)[2]
    density = sample.mean_mass / sample.mean_volume
    return float(rate * 2.0 * sample.mean * (density / pressure) ** 0.5)
