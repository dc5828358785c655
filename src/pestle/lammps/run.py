"""Run a case on LAMMPS and leave the same folder behind as a run of ours."""

import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pestle.lammps import output
from pestle.lammps.deck import CONTACTS, PARTICLES, Deck, make_deck
from pestle.lammps.model import notes
from pestle.lammps.program import command, execute, version
from pestle.results import provenance
from pestle.results.stages import write_stages
from pestle.simulation.progress import Progress, RunResult, StopReason

if TYPE_CHECKING:
    from pestle.config import Case

Report = Callable[[Progress], None]


def run(
    case: "Case", out: Path | str, ranks: int = 1, progress: Report | None = None
) -> RunResult:
    """Run a case on LAMMPS.

    Parameters
    ----------
    case : Case
        What to run.
    out : Path
        Folder of the results; the deck stays there.
    ranks : int
        Number of MPI ranks [-].
    progress : callable, optional
        Called at every row of the history.

    Raises
    ------
    InputError
        If LAMMPS cannot run the case, or is not installed.
    SimulationError
        If LAMMPS stops with an error.
    """
    folder = Path(out)
    deck = make_deck(case)
    words = command(ranks)
    deck.write(folder)
    begin = time.perf_counter()
    count = len(case.read_particles().radius)
    tell = _teller(case, deck, count, progress)
    execute(words, folder, tell)
    spent = time.perf_counter() - begin
    record = _record(case, deck, ranks, spent, count)
    provenance.write_provenance(folder / "provenance.json", record)
    (folder / "case.toml").write_text(case.to_toml(), encoding="utf-8")
    output.write_history(case, deck, folder)
    output.write_results(case, deck, folder, record)
    write_stages(folder / "stages.json", output.stages(case, deck, notes(case)))
    for name in (PARTICLES, CONTACTS):
        (folder / name).unlink()
    return RunResult(folder, StopReason.FINISHED, _steps(deck), spent, _metrics(folder))


def _steps(deck: Deck) -> int:
    return deck.legs[-1].first + deck.legs[-1].steps


def _metrics(folder: Path) -> dict[str, Any]:
    from pestle.metrics.summary import summarise, write_metrics
    from pestle.results.folder import RunFolder

    with RunFolder(folder) as found:
        summary = summarise(found)
    write_metrics(folder, summary)
    return summary.as_dict()


def _record(
    case: "Case", deck: Deck, ranks: int, spent: float, count: int
) -> dict[str, Any]:
    text = case.source.read_text(encoding="utf-8") if case.source else case.to_toml()
    record = provenance.collect(
        case_text=text, canonical=case.canonical(), seed=case.seed, threads=ranks
    )
    return record | {
        "engine": f"LAMMPS {version()}",
        "ranks": ranks,
        "particle_materials": list(case.powders),
        "wall_time_s": spent,
        "steps": _steps(deck),
        "particles": count,
    }


def _teller(
    case: "Case", deck: Deck, count: int, progress: Report | None
) -> Callable[[int], None]:
    """Turn steps of LAMMPS into progress."""
    begin, total = time.monotonic(), _steps(deck)

    def tell(step: int) -> None:
        if progress is None or step == 0:
            return
        number = output.stage_of(deck, step)
        mine = [leg for leg in deck.legs if leg.stage == number]
        first, last = mine[0].first, mine[-1].first + mine[-1].steps
        speed = step / max(time.monotonic() - begin, 1e-9)
        progress(
            Progress(
                case.stage_names[number],
                number,
                len(case.process),
                step,
                step * deck.time_step,
                min((step - first) / (last - first), 1.0),
                (min(total, last) - step) / speed,
                None,
                speed * count,
            )
        )

    return tell
