"""Run a case: build, advance stage by stage, write, checkpoint, resume."""

from pestle.simulation.planning import Plan, plan
from pestle.simulation.progress import Progress, RunResult, StopReason
from pestle.simulation.runner import run

__all__ = ["Plan", "Progress", "RunResult", "StopReason", "plan", "run"]
