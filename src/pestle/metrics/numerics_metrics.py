"""Numbers that tell how far a run can be trusted: energy, inertia, imbalance."""

import numpy as np
from numpy.typing import NDArray

from pestle.metrics.die_curves import DieCurves
from pestle.metrics.metric import Group, Metric
from pestle.results import HistoryTable

_ENERGY = Group("Energy")
_NUMERICS = Group("Quality of the run")
_KEPT_OR_GONE = (
    "kinetic",
    "stored",
    "contact_dissipation",
    "friction",
    "damping",
    "residual",
)
_PRESSED = 0.1  # part of the peak stress from which the inertial number is looked at


def energy_metrics(history: HistoryTable) -> list[Metric]:
    """Work put in and how well the ledger closes."""
    if "energy.wall_work [J]" not in history or not len(history):
        return []
    work = work_put_in(history)
    residual = history["energy.residual [J]"]
    found = [
        _ENERGY.metric(
            "work_put_in",
            "Work put in",
            work,
            unit="J",
            definition="Largest energy that walls and gravity have put in.",
        )
    ]
    if work > 0.0:
        found.append(
            _ENERGY.metric(
                "ledger_residual",
                "Ledger residual",
                float(np.max(np.abs(residual))) / work,
                unit="-",
                definition="Largest energy that the ledger cannot account for, over "
                "the work put in.",
            )
        )
    return found


def put_in(history: HistoryTable) -> NDArray[np.float64]:
    """Work of walls and gravity since the start, plus what was there then [J].

    ``energy.gravity`` is the potential energy, so that gravity's work is what it has
    lost. The ledger holds this against all that is kept and all that is gone.
    """
    given = history["energy.wall_work [J]"] - history["energy.gravity [J]"]
    if not len(history):
        return given
    found = sum(float(history[f"energy.{name} [J]"][0]) for name in _KEPT_OR_GONE)
    return np.asarray(given - given[0] + found)


def work_put_in(history: HistoryTable) -> float:
    """Largest energy that walls and gravity have put in so far [J]."""
    return float(np.max(put_in(history), initial=0.0))


def numerics_metrics(history: HistoryTable, curves: DieCurves | None) -> list[Metric]:
    """Inertial number, imbalance of contacts, energy made from nothing."""
    make, found = _NUMERICS.metric, []
    if curves is not None:
        rows = curves.loading
        rows = rows[curves.axial[rows] >= _PRESSED * curves.axial[curves.peak]]
        for key, label, column, definition in (
            (
                "inertial_number",
                "Inertial number",
                "inertial_number [-]",
                "Largest strain rate · diameter · √(density/stress) while pressing, "
                "above a tenth of the peak stress: below 0.001 is quasi-static.",
            ),
            (
                "contact_imbalance",
                "Imbalance of contacts",
                "imbalance [-]",
                "Largest difference of the forces of a contact's two sides over its "
                "force while pressing, in the mean over contacts.",
            ),
        ):
            if column in history and len(rows):
                values = history[column][rows]
                if np.isfinite(values).any():
                    value = float(np.nanmax(values))
                    found.append(
                        make(key, label, value, unit="-", definition=definition)
                    )
    column = "energy.negative_increments [J]"
    work = _work(history)
    if column in history and len(history) and work > 0.0:
        share = abs(float(history[column][-1])) / work
        definition = (
            "Sum of all negative dissipation increments over the work put in: energy "
            "that contacts have given back beyond what they had stored."
        )
        found.append(
            make(
                "negative_dissipation",
                "Negative dissipation",
                share,
                unit="-",
                definition=definition,
            )
        )
    return found


def _work(history: HistoryTable) -> float:
    return work_put_in(history) if "energy.wall_work [J]" in history else 0.0
