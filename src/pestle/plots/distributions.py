"""Distributions of sizes and contact forces."""

from typing import TYPE_CHECKING

import numpy as np

from pestle.metrics.packing import size_distribution
from pestle.plots.style import (
    BLUE,
    GREEN,
    INK,
    MICRO,
    MUTED,
    ORANGE,
    new_figure,
    style,
    title,
)
from pestle.results import Frame

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_MOMENTS = (("pressed", ORANGE, "under full load"), ("ejected", GREEN, "free tablet"))


def sizes_and_forces(frames: dict[str, Frame]) -> "Figure":
    """Left: particle diameters. Right: normal contact forces.

    Parameters
    ----------
    frames : dict of str to Frame
        Frames by moment: "filled", "pressed", "ejected"; those missing are left out.
    """
    with style():
        figure = new_figure(9.2, 3.7)
        left, right = figure.subplots(1, 2)
        _sizes(left, next(iter(frames.values())))
        _forces(right, frames)
        return figure


def _sizes(axes: "Axes", frame: Frame) -> None:
    title(axes, "Particle size")
    radius = frame.particles.get("radius_initial", frame.particles["radius"])
    sizes = size_distribution(radius)
    diameter = sizes.diameter / MICRO
    if np.ptp(diameter) < 1e-6 * diameter[-1]:
        axes.text(
            0.5,
            0.5,
            f"all {len(diameter)} particles:\n{diameter[0]:.4g} µm",
            transform=axes.transAxes,
            ha="center",
            va="center",
            color=INK,
        )
        axes.set_axis_off()
        return
    bins = np.histogram_bin_edges(diameter, bins=min(28, max(8, len(diameter) // 12)))
    weights = diameter**3 / np.sum(diameter**3) * 100
    axes.hist(diameter, bins=bins.tolist(), weights=weights, color=BLUE, alpha=0.55)
    axes.set_xlabel("diameter [µm]")
    axes.set_ylabel("part of the volume [%]")
    total = axes.twinx()
    total.plot(diameter, 100 * sizes.by_volume, color=INK, linewidth=1.4)
    total.set_ylim(0, 104)
    total.set_ylabel("smaller, by volume [%]")
    total.grid(visible=False)
    for percent in (10, 50, 90):
        at = sizes.percentile(percent) / MICRO
        total.plot(at, percent, "o", color=INK, markersize=4)
        total.annotate(
            f"d{percent} {at:.0f} µm",
            (at, percent),
            xytext=(8, -9),
            textcoords="offset points",
            fontsize=8,
            color=INK,
        )


def _forces(axes: "Axes", frames: dict[str, Frame]) -> None:
    title(axes, "Contact forces between particles")
    drawn = False
    for moment, colour, label in _MOMENTS:
        if moment not in frames:
            continue
        force = normal_forces(frames[moment])
        mean = float(np.mean(np.abs(force))) if len(force) else 0.0
        if mean <= 0.0:
            continue
        drawn = True
        part = np.clip(force / mean, -2.5, 6.0)
        density, edges = np.histogram(part, bins=np.linspace(-2.5, 6.0, 52))
        density = density / len(part) / np.diff(edges)
        middle = 0.5 * (edges[1:] + edges[:-1])
        used = density > 0
        axes.plot(
            middle[used],
            density[used],
            ".-",
            color=colour,
            linewidth=1.2,
            markersize=5,
            label=f"{label}, mean |F| = {_newton(mean)}",
        )
    if not drawn:
        axes.set_axis_off()
        return
    axes.axvline(0.0, color=MUTED, linewidth=0.8)
    axes.text(
        -0.1,
        0.02,
        "pull",
        transform=axes.get_xaxis_transform(),
        ha="right",
        color=MUTED,
    )
    axes.text(0.1, 0.02, "push", transform=axes.get_xaxis_transform(), color=MUTED)
    axes.set_xlim(min(axes.get_xlim()[0], -0.9), axes.get_xlim()[1])
    axes.set_yscale("log")
    axes.set_ylim(top=5.0 * axes.get_ylim()[1])
    axes.set_xlabel("normal force / mean |F| [-]")
    axes.set_ylabel("probability density [-]")
    axes.legend(loc="upper right")


def normal_forces(frame: Frame) -> np.ndarray:
    """Normal forces between particles [N], repulsion positive."""
    pair = frame.contacts["second"] >= 0
    force, normal = frame.contacts["force"][pair], frame.contacts["normal"][pair]
    return np.asarray(np.einsum("ci,ci->c", force, normal))


def _newton(force: float) -> str:
    for scale, unit in ((1.0, "N"), (1e-3, "mN"), (1e-6, "µN")):
        if force >= scale:
            return f"{force / scale:.3g} {unit}"
    return f"{force / 1e-9:.3g} nN"
