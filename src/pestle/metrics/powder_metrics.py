"""Numbers of any run: sizes, contacts, energy."""

import numpy as np

from pestle.metrics.metric import Group, Metric
from pestle.metrics.packing import (
    contact_area_fraction,
    coordination,
    size_distribution,
)
from pestle.metrics.tablet_metrics import key_frames
from pestle.results import Frame, HistoryTable
from pestle.results.folder import RunFolder

_POWDER = Group("Powder")
_CONTACTS = Group("Contacts")
_ENERGY = Group("Energy")
_MOMENT = {"pressed": "under full load", "ejected": "in the free tablet"}


def powder_metrics(folder: RunFolder) -> list[Metric]:
    """Sizes, and contacts at the moments that matter."""
    frames = key_frames(folder)
    if folder.results is None or not frames:
        return []
    first = folder.results[frames["filled"]]
    found = _sizes(first)
    for moment, words in _MOMENT.items():
        if moment in frames:
            found += _contacts(folder.results[frames[moment]], moment, words)
    return found


def _sizes(frame: Frame) -> list[Metric]:
    radius = frame.particles.get("radius_initial", frame.particles["radius"])
    sizes = size_distribution(radius)
    found = [
        _POWDER.metric(
            "particles",
            "Particles",
            len(radius),
            unit="-",
            definition="Number of particles.",
        )
    ]
    for percent in (10, 50, 90):
        found.append(
            _POWDER.metric(
                f"d{percent}",
                f"d{percent} by volume",
                sizes.percentile(percent),
                unit="m",
                definition=f"Diameter below which {percent} % of the volume lies.",
            )
        )
    return found


def _contacts(frame: Frame, moment: str, words: str) -> list[Metric]:
    make = _CONTACTS.metric
    return [
        make(
            f"coordination_{moment}",
            f"Coordination, {words}",
            coordination(frame),
            unit="-",
            definition="Mean number of contacts of a particle, walls included.",
        ),
        make(
            f"contact_area_fraction_{moment}",
            f"Contact area fraction, {words}",
            contact_area_fraction(frame),
            unit="-",
            definition="Part of the surface of the truncated spheres that lies in "
            "contacts.",
        ),
    ]


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
            definition="Largest sum of the work of walls and gravity on the powder.",
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


def work_put_in(history: HistoryTable) -> float:
    """Largest sum of the work of walls and gravity that the run has seen [J]."""
    total = history["energy.wall_work [J]"] + history["energy.gravity [J]"]
    return float(np.max(total))
