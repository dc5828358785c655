"""``stages.json``: when each step of the process began and how it ended."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from pestle.errors import InputError


@dataclass(frozen=True, slots=True)
class Stage:
    """One step of the process.

    Parameters
    ----------
    name : str
        Name in the history and in the results file.
    step : str
        Kind of step: "fill", "press", "unload" ...
    start_step, end_step : int
        Steps of the run [-].
    start_time, end_time : float
        Simulated time [s].
    end_reason : str
        Why it ended, in words.
    info : dict
        What else is known about it.
    """

    name: str
    step: str
    start_step: int
    end_step: int
    start_time: float
    end_time: float
    end_reason: str = ""
    info: dict[str, Any] = field(default_factory=dict)


def write_stages(path: Path, stages: Sequence[Stage | Mapping[str, Any]]) -> None:
    """Write the stages in one piece."""
    rows = [_as_dict(stage) for stage in stages]
    draft = path.with_name(path.name + ".new")
    draft.write_text(json.dumps(rows, indent=2, ensure_ascii=False) + "\n", "utf-8")
    draft.replace(path)


def _as_dict(stage: Stage | Mapping[str, Any]) -> dict[str, Any]:
    if isinstance(stage, Stage):
        return {name: getattr(stage, name) for name in Stage.__slots__}
    return dict(stage)


def read_stages(path: Path) -> list[Stage]:
    """Read the stages, in the order of the process."""
    try:
        rows = json.loads(path.read_text(encoding="utf-8"))
        return [
            Stage(
                name=str(row["name"]),
                step=str(row["step"]),
                start_step=int(row["start_step"]),
                end_step=int(row["end_step"]),
                start_time=float(row["start_time"]),
                end_time=float(row["end_time"]),
                end_reason=str(row.get("end_reason", "")),
                info=dict(row.get("info") or {}),
            )
            for row in rows
        ]
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise InputError(
            "stages-damaged",
            f"{path.name} cannot be read: {error}",
            str(path),
            "continue the run with --resume",
        ) from error
