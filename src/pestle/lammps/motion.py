"""Prescribed motion: the process as runs of LAMMPS, each with one formula a wall."""

from dataclasses import dataclass, field
from itertools import pairwise
from math import ceil, cos, pi
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pestle.config import Case
    from pestle.config.particle_file import ParticleTable


@dataclass(frozen=True)
class Leg:
    """A run of LAMMPS.

    Parameters
    ----------
    stage : int
        Number of the step of the process.
    first, steps : int
        Steps of the run before it, and in it [-].
    speed, slope : dict
        Velocity at the start [m/s] and its rate [m/s^2] of the walls that move.
    sine : dict
        Way [m] of the walls that move by half a sine of velocity.
    start : dict
        Displacement of every wall at the start [m].
    """

    stage: int
    first: int
    steps: int
    speed: dict[str, float] = field(default_factory=dict)
    slope: dict[str, float] = field(default_factory=dict)
    sine: dict[str, float] = field(default_factory=dict)
    start: dict[str, float] = field(default_factory=dict)

    def at(self, name: str, steps: float, dt: float) -> float:
        """Displacement of a wall after some steps of the run [m]."""
        t = steps * dt
        way = self.speed.get(name, 0.0) * t + 0.5 * self.slope.get(name, 0.0) * t * t
        turned = 0.5 * (1.0 - cos(pi * steps / self.steps))
        return self.start[name] + way + turned * self.sine.get(name, 0.0)

    def formula(self, name: str, dt: float) -> str:
        """Displacement as an equal-style variable of LAMMPS [m]."""
        t = f"((step-{self.first})*{dt!r})"
        text = repr(self.start[name])
        if name in self.speed:
            text += f"+({self.speed[name]!r})*{t}"
        if name in self.slope:
            text += f"+({0.5 * self.slope[name]!r})*{t}*{t}"
        if name in self.sine:
            turn = f"{t}*PI/{self.steps * dt!r}"
            text += f"+({0.5 * self.sine[name]!r})*(1.0-cos({turn}))"
        return text


def legs(case: "Case", table: "ParticleTable", dt: float) -> list[Leg]:
    """All runs of a case, in turn."""
    here = dict.fromkeys(case.all_walls, 0.0)
    found: list[Leg] = []
    for number, step in enumerate(case.process):
        if step.step == "press" and not found and step.wall == "upper_punch":
            here[step.wall] += lowering(case, table)
        for part in _parts(case, step, here):
            first = found[-1].first + found[-1].steps if found else 0
            leg = Leg(number, first, max(ceil(part.pop("time") / dt - 1e-9), 1), **part)
            leg = Leg(**{**vars(leg), "start": dict(here)})
            here = {name: leg.at(name, leg.steps, dt) for name in here}
            found.append(leg)
    return found


def lowering(case: "Case", table: "ParticleTable") -> float:
    """Way of the upper punch to just above the powder [m]."""
    assert case.die is not None
    top = float((table.position[:, 2] + table.radius).max())
    return max(case.die.height - top - 1e-3 * float(table.radius.mean()), 0.0)


def _parts(case: "Case", step: Any, here: dict[str, float]) -> list[dict[str, Any]]:
    """Duration [s] and motion of the parts of a step."""
    if step.step in ("relax", "hold"):
        return [{"time": step.duration}]
    if step.step == "press":
        return [{"time": step.to_displacement / step.at, "speed": {step.wall: step.at}}]
    walls = list(step.walls if step.walls is not None else case.all_walls)
    if step.program is not None:
        return [
            {
                "time": end - begin,
                "speed": dict.fromkeys(walls, u),
                "slope": dict.fromkeys(walls, (v - u) / (end - begin)),
            }
            for (begin, u), (end, v) in pairwise(step.program)
        ]
    if step.profile == "sine":
        ways = {wall: step.to - here[wall] for wall in walls}
        return [{"time": step.duration, "sine": ways}]
    target = step.to if step.turn_at is None else step.turn_at
    stops = [here[walls[0]], target]
    stops += [] if step.turn_at is None else [step.back_to]
    return [
        {
            "time": abs(b - a) / step.at,
            "speed": dict.fromkeys(walls, step.at if b >= a else -step.at),
        }
        for a, b in pairwise(stops)
    ]
