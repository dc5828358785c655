"""What a run says about itself while it goes and when it ends."""

from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import Any


class StopReason(StrEnum):
    """Why a run came to its end without an error."""

    FINISHED = "finished"
    INTERRUPTED = "interrupted"


@dataclass(frozen=True, slots=True)
class Progress:
    """Where a run stands."""

    stage: str
    stage_index: int
    stages: int
    step: int
    time: float  # [s]
    fraction: float  # of the stage [-]
    eta_s: float | None  # of the stage [s]
    stress: float | None  # axial stress on the driven punch [Pa]
    particle_steps_per_s: float


@dataclass(frozen=True, slots=True)
class RunResult:
    """What a run leaves behind."""

    out: Path
    stop_reason: StopReason
    steps: int
    wall_time: float  # [s]
    metrics: dict[str, Any] = field(default_factory=dict)
