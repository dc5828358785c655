"""Pictures of the powder for the page, with the die, a scale and a film."""

import base64
from dataclasses import dataclass

import numpy as np

from pestle.metrics.die_curves import LOWER, DieCurves
from pestle.metrics.spring_back import spring_back
from pestle.metrics.stress import pressure
from pestle.metrics.tablet_metrics import key_frames
from pestle.plots.scene import (
    SCALE,
    Picture,
    View,
    common_view,
    kept_wall_facets,
    picture,
)
from pestle.plots.style import stress_unit
from pestle.report.numbers import with_unit
from pestle.results import Frame
from pestle.results.folder import RunFolder

_TITLES = {
    "filled": ("Loose powder", "at rest, before pressing"),
    "pressed": ("Pressed", "under full load"),
    "ejected": ("Tablet", "ejected and free"),
    "crushed": ("Crushed", "across its diameter"),
    "heap": ("Heap", "at rest, the die lifted off"),
}
_STATES = {"filled": ("Start", "first frame"), "pressed": ("Densest", "most pressed")}
_FILM_FRAMES = 18
_CUT_FROM = 40  # fewer particles are not worth cutting open in the film


@dataclass(frozen=True, slots=True)
class Shot:
    """One moment, seen from outside and cut open."""

    key: str
    title: str
    caption: str
    outside: str
    inside: str
    width: int
    height: int
    die: dict[str, float] | None


@dataclass(frozen=True, slots=True)
class Still:
    """One picture of the film."""

    image: str
    label: str


@dataclass(frozen=True, slots=True)
class Album:
    """All pictures of a run and the scales that belong to them."""

    shots: list[Shot]
    film: list[Still]
    bar_pixels: float
    bar_label: str
    stress_top: str
    colours: tuple[str, ...]


def album(
    folder: RunFolder, curves: DieCurves | None = None, *, pixels: int = 720
) -> Album | None:
    """Take all pictures; None without a results file."""
    numbers = key_frames(folder)
    if folder.results is None or not numbers:
        return None
    numbers = {key: numbers[key] for key in _TITLES if key in numbers}
    frames = {key: folder.results[number] for key, number in numbers.items()}
    frames = {key: frame for key, frame in frames.items() if frame.particles["id"].size}
    if not frames:
        return None
    view = common_view(list(frames.values()), pixels=pixels)
    top = _top(frames)
    shots = [
        _shot(key, frame, view, top=top, frames=frames, folder=folder)
        for key, frame in frames.items()
    ]
    length = _round_length(0.3 * view.across)
    return Album(
        shots,
        _film(folder, view, numbers["pressed"], top=top, curves=curves),
        length / view.pixel,
        with_unit(length, "m"),
        with_unit(top, "Pa", 3) if top > 0.0 else "",
        SCALE,
    )


def _top(frames: dict[str, Frame]) -> float:
    """Stress of the darkest colour: few particles are beyond it."""
    pressed = frames.get("pressed", next(iter(frames.values())))
    if "stress" not in pressed.particles:
        return 0.0
    largest = float(np.quantile(pressure(pressed.particles["stress"]), 0.98))
    return max(largest, 0.0)


def _shot(
    key: str,
    frame: Frame,
    view: View,
    *,
    top: float,
    frames: dict[str, Frame],
    folder: RunFolder,
) -> Shot:
    kept = None
    if key in ("ejected", "crushed") and "pressed" in frames:
        change = spring_back(frames["pressed"], frame)
        kept = kept_wall_facets(frames["pressed"], frame, change.rotation)
    outside = picture(frame, view, kept=kept)
    inside = picture(frame, view, values=_stress(frame), top=top, cut=True, kept=kept)
    is_pressed = any(stage.step in ("press", "hold") for stage in folder.stages)
    in_die = folder.case is not None and folder.case.die is not None
    named = _TITLES if in_die and is_pressed else _TITLES | _STATES
    title, caption = named[key]
    die = _die(folder, view, outside, frame) if key in ("filled", "pressed") else None
    return Shot(
        key,
        title,
        f"{caption}, {with_unit(frame.time, 's', 3)}",
        _data_url(outside),
        _data_url(inside),
        outside.width,
        outside.height,
        die,
    )


def _stress(frame: Frame) -> np.ndarray | None:
    stress = frame.particles.get("stress")
    return None if stress is None else pressure(stress)


def _die(
    folder: RunFolder, view: View, shot: Picture, frame: Frame
) -> dict[str, float] | None:
    """Ellipse of the die's floor in pixels, to draw it like glass."""
    if folder.case is None or folder.case.die is None:
        return None
    across = folder.case.die.radius / view.pixel
    x, y = shot.place(np.array([0.0, 0.0, _floor(folder, frame)]))
    return {
        "x": x,
        "y": y,
        "rx": across,
        "ry": across * float(np.sin(view.camera.elevation)),
    }


def _floor(folder: RunFolder, frame: Frame) -> float:
    """Height of the lower punch [m]."""
    history = folder.history
    if history is None or f"{LOWER}.displacement [m]" not in history:
        return 0.0
    moved = history[f"{LOWER}.displacement [m]"]
    return float(np.interp(frame.step, history["step"], moved))


def _film(
    folder: RunFolder, view: View, last: int, *, top: float, curves: DieCurves | None
) -> list[Still]:
    """Small cut pictures from the first frame of the story to the tablet."""
    results = folder.results
    assert results is not None
    kinds = [folder.kind_of(stage) for stage in results.stages]
    story = [n for n, kind in enumerate(kinds) if kind not in ("fill", "crush")]
    start = [max(story[0] - 1, 0)] if story and story[0] > 0 else []
    numbers = start + story
    if len(numbers) < 4:
        return []
    if len(numbers) > _FILM_FRAMES:
        chosen = np.linspace(0, len(numbers) - 1, _FILM_FRAMES).round().astype(int)
        numbers = [numbers[n] for n in sorted(set(chosen.tolist()))]
    if last not in numbers:
        numbers = sorted({*numbers, last})
    small = View(view.camera, view.across, view.height, max(view.pixels * 5 // 9, 40))
    stills = []
    pressed = results[last]
    for number in numbers:
        frame = results[number]
        kept = None
        if number > last and kinds[number] in ("unload", "eject", "relax"):
            change = spring_back(pressed, frame)
            kept = kept_wall_facets(pressed, frame, change.rotation)
        many = len(frame.particles["id"]) >= _CUT_FROM
        shot = picture(
            frame, small, values=_stress(frame), top=top, cut=many, kept=kept
        )
        stills.append(Still(_data_url(shot), _moment(frame, curves)))
    return stills


def _moment(frame: Frame, curves: DieCurves | None) -> str:
    """Stage, stress and density of a frame in one line."""
    if curves is None:
        return f"{frame.stage}, {with_unit(frame.time, 's', 3)}"
    stress = float(np.interp(frame.time, curves.time, curves.axial))
    unit, name = stress_unit(float(curves.axial[curves.peak]))
    text = f"{frame.stage} · {abs(max(stress, 0.0)) / unit:.0f} {name}"
    density = float(np.interp(frame.time, curves.time, curves.density))
    if frame.time <= curves.time[curves.release] and np.isfinite(density):
        text += f" · D = {density:.3f}"
    return text


def _data_url(shot: Picture) -> str:
    return "data:image/png;base64," + base64.b64encode(shot.png).decode("ascii")


def _round_length(length: float) -> float:
    """Largest 1, 2 or 5 times a power of ten that is not longer [m]."""
    power = 10.0 ** np.floor(np.log10(length))
    return float(max(f * power for f in (1.0, 2.0, 5.0) if f * power <= length))
