"""Numbers of the tablet: spring-back, size, strength."""

import numpy as np

from pestle.metrics.die_curves import HEIGHT, DieCurves
from pestle.metrics.metric import Group, Metric
from pestle.metrics.packing import solid_volume
from pestle.metrics.spring_back import spring_back
from pestle.metrics.strength import diametral_tensile_strength
from pestle.results import Frame
from pestle.results.folder import RunFolder

_TABLET = Group("Tablet")
PLATENS = ("platen_left", "platen_right")


def key_frames(folder: RunFolder) -> dict[str, int]:
    """Frames that tell the story: filled, pressed, released, ejected, crushed, heap.

    Returns
    -------
    dict of str to int
        Number of the frame by moment; moments that the run has not reached are left
        out.
    """
    results = folder.results
    if results is None or not len(results):
        return {}
    kinds = [folder.kind_of(stage) for stage in results.stages]
    found = {}
    pressing = [n for n, kind in enumerate(kinds) if kind in ("press", "hold")]
    if pressing:
        found["filled"] = max(pressing[0] - 1, 0)
        found["pressed"] = pressing[-1]
    else:
        densest = _densest(folder)
        before = [
            n for n in range(densest) if results.stages[n] != results.stages[densest]
        ]
        found |= {"filled": before[-1] if before else 0, "pressed": densest}
    ejecting = [n for n, kind in enumerate(kinds) if kind == "eject"]
    ends = {"released": ("unload",), "crushed": ("crush",), "heap": ("lift",)}
    for moment, names in ends.items():
        rows = [n for n, kind in enumerate(kinds) if kind in names]
        if rows:
            found[moment] = rows[-1]
    if ejecting:
        free = [
            n
            for n, kind in enumerate(kinds)
            if kind in ("eject", "relax") and n >= ejecting[-1]
        ]
        found["ejected"] = free[-1]
    return found


def _densest(folder: RunFolder) -> int:
    """Frame with the most overlap, for a run without a press step."""
    assert folder.results is not None
    if folder.history is None or "relative_density [-]" not in folder.history:
        return len(folder.results) - 1
    density = folder.history["relative_density [-]"]
    step = folder.history["step"]
    at = np.interp(folder.results.steps, step, np.nan_to_num(density))
    return int(np.argmax(at)) if at.any() else len(folder.results) - 1


def tablet_metrics(curves: DieCurves, folder: RunFolder) -> list[Metric]:
    """Spring-back, thickness, density out of the die and tensile strength."""
    frames = key_frames(folder)
    if folder.results is None or not {"pressed", "ejected"} <= frames.keys():
        return []
    pressed = folder.results[frames["pressed"]]
    ejected = folder.results[frames["ejected"]]
    change = spring_back(pressed, ejected)
    if change.particles < 5:
        return []
    h_in = _height_at(folder, pressed)
    diameter = 2.0 * curves.die_radius * (1.0 + change.radial)
    thickness = h_in * (1.0 + change.axial)
    bulk = 0.25 * np.pi * diameter**2 * thickness
    share = change.particles / len(pressed.particles["id"])
    make = _TABLET.metric
    found = [
        make(
            "axial_spring_back",
            "Axial spring-back",
            change.axial,
            unit="-",
            definition="(h_out − h_in)/h_in from the end of pressing to the free "
            "tablet, as the stretch of the best affine map of all particle centres.",
        ),
        make(
            "radial_spring_back",
            "Radial spring-back",
            change.radial,
            unit="-",
            definition="The same across the die, for the diameter.",
        ),
        make(
            "tablet_thickness",
            "Tablet thickness",
            thickness,
            unit="m",
            definition="Distance of the punches at the end of pressing times one plus "
            "the axial spring-back.",
        ),
        make(
            "tablet_diameter",
            "Tablet diameter",
            diameter,
            unit="m",
            definition="Diameter of the die times one plus the radial spring-back.",
        ),
        make(
            "tablet_relative_density",
            "Relative density of the tablet",
            share * solid_volume(pressed) / bulk,
            unit="-",
            definition="Undeformed volume of the particles (mass over true density) "
            "over that of the free tablet: out-of-die.",
        ),
        make(
            "tablet_share",
            "Powder in the tablet",
            share,
            unit="-",
            definition="Particles that hang together after ejection over all.",
        ),
    ]
    return found + _strength(folder, diameter, thickness)


def _height_at(folder: RunFolder, frame: Frame) -> float:
    history = folder.history
    assert history is not None
    if HEIGHT in history:
        return float(np.interp(frame.step, history["step"], history[HEIGHT]))
    assert folder.case is not None
    assert folder.case.die is not None
    down = history["upper_punch.displacement [m]"]
    return folder.case.die.height - float(np.interp(frame.step, history["step"], down))


def _strength(folder: RunFolder, diameter: float, thickness: float) -> list[Metric]:
    history = folder.history
    if history is None:
        return []
    crushing = np.array([folder.kind_of(s) == "crush" for s in history.stages])
    forces = [
        np.linalg.norm([history[f"{wall}.force_{axis} [N]"] for axis in "xyz"], axis=0)
        for wall in PLATENS
        if wall in history.walls
    ]
    if not crushing.any() or not forces:
        return []
    force = float(np.max(np.mean(forces, axis=0)[crushing]))
    return [
        _TABLET.metric(
            "tensile_strength",
            "Tensile strength",
            diametral_tensile_strength(force, diameter, thickness),
            unit="Pa",
            definition="2 F/(π D t) with the largest platen force "
            f"F = {force:.4g} N in diametral compression.",
        )
    ]
