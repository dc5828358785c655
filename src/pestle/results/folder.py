"""The output folder of a run: every part of it, or a clear word that it is missing."""

from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pestle.errors import InputError
from pestle.results.history import HistoryTable, read_history
from pestle.results.provenance import read_provenance
from pestle.results.read import Results
from pestle.results.stages import Stage, read_stages

if TYPE_CHECKING:
    from pestle.config import Case

CASE = "case.toml"
PROVENANCE = "provenance.json"
HISTORY = "history.csv"
RESULTS = "results.vtkhdf"
STAGES = "stages.json"
METRICS = "metrics.json"
REPORT = "report.html"


@dataclass(frozen=True)
class RunFolder:
    """An output folder; parts are read when they are first asked for.

    A part that is missing is None or empty. A part that is damaged raises
    InputError, except the case file: the numbers can be read without it, so what is
    wrong with it becomes one of the ``problems``.

    Parameters
    ----------
    path : Path
        The folder.
    """

    path: Path
    problems: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        if not self.path.is_dir():
            raise InputError(
                "folder-missing",
                f"there is no folder {self.path.name or self.path}",
                str(self.path),
                "give the output folder of pestle run",
            )
        if not any((self.path / name).exists() for name in (HISTORY, RESULTS)):
            raise InputError(
                "folder-without-results",
                f"{self.path.name or self.path} holds neither {HISTORY} nor {RESULTS}",
                str(self.path),
                "give the output folder of pestle run",
            )

    @cached_property
    def case(self) -> "Case | None":
        """The case, checked."""
        if not (self.path / CASE).exists():
            return None
        from pestle.config import Case

        try:
            return Case.from_file(self.path / CASE)
        except InputError as error:
            self.problems.append(f"{CASE} cannot be used: {error.what}")
            return None

    @cached_property
    def case_text(self) -> str:
        """The case as the user wrote it, else its canonical copy."""
        written = self.provenance.get("case_text")
        if isinstance(written, str) and written:
            return written
        if not (self.path / CASE).exists():
            return ""
        return (self.path / CASE).read_text(encoding="utf-8", errors="replace")

    @cached_property
    def provenance(self) -> dict[str, Any]:
        """Where the results come from."""
        path = self.path / PROVENANCE
        if path.exists():
            return read_provenance(path)
        if self.results is not None:
            return self.results.provenance
        return {}

    @cached_property
    def history(self) -> HistoryTable | None:
        """The history."""
        path = self.path / HISTORY
        return read_history(path) if path.exists() else None

    @cached_property
    def stages(self) -> list[Stage]:
        """Stages that have begun."""
        path = self.path / STAGES
        return read_stages(path) if path.exists() else []

    @cached_property
    def results(self) -> Results | None:
        """The results file, open."""
        path = self.path / RESULTS
        return Results(path) if path.exists() else None

    def kind_of(self, stage: str) -> str:
        """Kind of step ("press") of the stage of this name."""
        for known in self.stages:
            if known.name == stage:
                return known.step
        return stage.split(" ")[0]

    def close(self) -> None:
        """Close the results file."""
        if "results" in self.__dict__ and self.results is not None:
            self.results.close()

    def __enter__(self) -> "RunFolder":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
