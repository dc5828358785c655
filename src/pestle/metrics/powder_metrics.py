"""Numbers of any powder: sizes and contacts."""

from pestle.metrics.metric import Group, Metric
from pestle.metrics.packing import (
    contact_area_fraction,
    coordination,
    size_distribution,
)
from pestle.metrics.tablet_metrics import key_frames
from pestle.results import Frame
from pestle.results.folder import RunFolder

_POWDER = Group("Powder")
_CONTACTS = Group("Contacts")
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
