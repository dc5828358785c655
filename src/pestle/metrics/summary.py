"""All numbers of a run, and ``metrics.json``."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pestle.metrics.die_curves import DieCurves, die_curves
from pestle.metrics.die_metrics import fit_metrics, pressing_metrics, release_metrics
from pestle.metrics.flow_metrics import flow_metrics
from pestle.metrics.heap import heap_metrics
from pestle.metrics.metric import Metric
from pestle.metrics.numerics_metrics import energy_metrics, numerics_metrics
from pestle.metrics.powder_metrics import powder_metrics
from pestle.metrics.shear_metrics import shear_metrics
from pestle.metrics.tablet_metrics import tablet_metrics
from pestle.results.folder import METRICS, RunFolder

LEDGER_LIMIT = 0.005
"""Largest ledger residual over the work put in that passes without a warning [-]."""

INERTIA_LIMIT = 0.01
"""Largest inertial number while pressing that passes without a warning [-]."""

IMBALANCE_LIMIT = 0.001
"""Largest imbalance of contacts that passes without a warning [-]."""

NEGATIVE_LIMIT = 0.01
"""Largest sum of negative dissipation that passes without a warning [-]."""


@dataclass(frozen=True, slots=True)
class Summary:
    """What a run says.

    Parameters
    ----------
    metrics : tuple of Metric
        Numbers with units and definitions.
    warnings : tuple of str
        What the reader should know before using them.
    curves : DieCurves or None
        Stresses and density over time, for a die.
    """

    metrics: tuple[Metric, ...]
    warnings: tuple[str, ...]
    curves: DieCurves | None

    def value(self, key: str) -> float | None:
        """SI value of a metric, None if the run does not have it."""
        for metric in self.metrics:
            if metric.key == key:
                return metric.value
        return None

    def as_dict(self) -> dict[str, Any]:
        """Everything as plain values for JSON."""
        return {
            "schema_version": 1,
            "metrics": {
                metric.key: {
                    "value": metric.value,
                    "unit": metric.unit,
                    "label": metric.label,
                    "definition": metric.definition,
                }
                for metric in self.metrics
            },
            "warnings": list(self.warnings),
        }


def summarise(folder: RunFolder) -> Summary:
    """Work out every number that the run allows."""
    metrics: list[Metric] = []
    curves = die_curves(folder)
    if curves is not None:
        metrics += pressing_metrics(curves) + fit_metrics(curves)
        metrics += release_metrics(curves, folder) + tablet_metrics(curves, folder)
    metrics += flow_metrics(folder) + shear_metrics(folder) + heap_metrics(folder)
    metrics += powder_metrics(folder)
    if folder.history is not None:
        metrics += energy_metrics(folder.history)
        metrics += numerics_metrics(folder.history, curves)
    known = tuple(metric for metric in metrics if metric.is_known)
    return Summary(known, tuple(_warnings(folder, known)), curves)


def _warnings(folder: RunFolder, metrics: tuple[Metric, ...]) -> list[str]:
    found = list(folder.problems)
    value = {metric.key: metric.value for metric in metrics}
    residual = value.get("ledger_residual", 0.0)
    if residual > LEDGER_LIMIT:
        found.append(
            f"The energy ledger misses {100 * residual:.2g} % of the work put in "
            f"(more than {100 * LEDGER_LIMIT:g} %): use a smaller time step."
        )
    if value.get("inertial_number", 0.0) > INERTIA_LIMIT:
        found.append(
            f"The inertial number reaches {value['inertial_number']:.2g} while "
            f"pressing (more than {INERTIA_LIMIT:g}): inertia carries a part of the "
            "stress; use a slower punch or less mass scaling."
        )
    if value.get("contact_imbalance", 0.0) > IMBALANCE_LIMIT:
        found.append(
            "The two sides of a contact disagree by "
            f"{100 * value['contact_imbalance']:.2g} % of its force on average (more "
            f"than {100 * IMBALANCE_LIMIT:g} %): use a smaller time step."
        )
    if value.get("negative_dissipation", 0.0) > NEGATIVE_LIMIT:
        found.append(
            "Contacts have given back more energy than they had stored: the negative "
            "dissipation increments add up to "
            f"{100 * value['negative_dissipation']:.3g} % of the work put in."
        )
    if value.get("peak_relative_density", 0.0) >= 1.0:
        found.append(
            "The relative density in the die reaches 1 or more: the powder is "
            "compressed elastically beyond its solid volume, and Heckel points there "
            "are left out."
        )
    if value.get("tablet_share", 1.0) < 0.95:
        found.append(
            f"Only {100 * value['tablet_share']:.3g} % of the particles hang together "
            "after ejection: the tablet has crumbled or capped."
        )
    for stage in folder.stages:
        told = stage.info.get("warnings")
        found += [str(text) for text in told] if isinstance(told, list) else []
    return found


def write_metrics(path: Path, summary: Summary) -> None:
    """Write ``metrics.json`` into the output folder `path`."""
    text = json.dumps(summary.as_dict(), indent=2, ensure_ascii=False, allow_nan=False)
    draft = path / (METRICS + ".new")
    draft.write_text(text + "\n", encoding="utf-8")
    draft.replace(path / METRICS)
