"""From measured data to parameters with what is known of them."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

from pestle.calibrate import bulk, output, single
from pestle.calibrate.posterior import Posterior, require
from pestle.calibrate.runs import Say

if TYPE_CHECKING:
    from pestle.config.calibration import CalibrationSettings

__all__ = ["Posterior", "calibrate", "require"]


def calibrate(
    settings: "CalibrationSettings",
    folder: Path,
    *,
    workers: int | None = None,
    scheduler: str | None = None,
    say: Say = lambda text: None,
) -> dict[str, Any]:
    """Calibrate and write everything into a folder; return the numbers.

    Parameters
    ----------
    settings : CalibrationSettings
        Data and parameters.
    folder : Path
        Where results, and runs if any, are or will be.
    workers : int, optional
        Processes for the runs, by default one for each core [-].
    scheduler : str, optional
        Address of a Dask scheduler.
    say : callable
        Told what happens, in sentences.
    """
    from pestle.calibrate import figures

    require()
    if settings.particle is not None:
        from pestle.fit import draw_fit

        best, found = single.calibrate(settings)
        extra = output.of_fit(best)
        drawn, fixed = {"fit": draw_fit(best)}, best.fixed
    else:
        from pestle.sweep import cluster

        cluster.require()
        count = workers or cluster.worker_count(10**9, 10**6)
        result = bulk.calibrate(
            settings, folder, workers=count, scheduler=scheduler, say=say
        )
        found, fixed = result.posterior, {}
        extra = output.of_bulk(result)
        drawn = {
            "targets": figures.draw_targets(result),
            "sensitivity": figures.draw_sensitivity(result),
        }
    numbers = output.summary(settings, found, extra)
    output.save(settings, folder, found, numbers=numbers, drawn=drawn, fixed=fixed)
    return numbers
