"""Studies: many runs of a case on all the machines there are."""

from pestle.sweep.design import points
from pestle.sweep.jobs import Job, Outcome, compute
from pestle.sweep.study import StudyProgress, StudyResult, finished, planned, run_study

__all__ = [
    "Job",
    "Outcome",
    "StudyProgress",
    "StudyResult",
    "compute",
    "finished",
    "planned",
    "points",
    "run_study",
]
