"""Figures of laws: force and contact radius along a path; restitution."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from pestle.plots.style import (
    BLUE,
    GREEN,
    GREY,
    MUTED,
    ORANGE,
    PURPLE,
    RED,
    SAND,
    new_figure,
    style,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from pestle.bench.drive import Run
    from pestle.bench.impact import Collision, Impact
    from pestle.bench.subject import Array, PairContact
    from pestle.laws import Pair

COLOURS = (BLUE, ORANGE, GREEN, PURPLE, RED, SAND, GREY)
DASHES = ("-", "--", "-.", ":")


def unit_of(largest: float, base: str) -> tuple[float, str]:
    """Unit that suits values up to the largest, and its name.

    Examples
    --------
    >>> unit_of(3e-4, "N"), unit_of(2e-5, "m")
    ((1e-06, 'µN'), (1e-06, 'µm'))
    """
    for factor, prefix in ((1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n")):
        if largest >= factor:
            return factor, prefix + base
    return 1e-12, "p" + base


def look(number: int) -> dict[str, Any]:
    """Colour and dash of a curve; told apart in print without colour."""
    return {
        "color": COLOURS[number % len(COLOURS)],
        "linestyle": DASHES[number % len(DASHES)],
    }


def draw_runs(
    runs: Mapping[str, "Run"], *, radius: float | None = None, title: str = ""
) -> "Figure":
    """Draw force and contact radius of one or more paths.

    Parameters
    ----------
    runs : mapping of str to Run
        Paths by the name in the legend.
    radius : float, optional
        Radius that displacements are divided by [m]; lengths without it.
    title : str
        Heading.
    """
    with style():
        figure = new_figure(7.2, 3.4)
        left, right = figure.subplots(1, 2)
        _curves(left, runs, "force", "force", "N", radius)
        _curves(right, runs, "contact_radius", "contact radius", "m", radius)
        if len(runs) > 1 or not title:
            left.legend(frameon=False, fontsize=8)
        figure.suptitle(title, x=0.01, ha="left", fontsize=10)
    return figure


def _curves(
    axes: "Axes",
    runs: Mapping[str, "Run"],
    field: str,
    label: str,
    base: str,
    radius: float | None,
) -> None:
    traces = {name: run.trace for name, run in runs.items()}
    lengths = [np.nanmax(np.abs(t.displacement)) for t in traces.values()]
    scale, unit = unit_of(max(lengths), "m") if radius is None else (radius, "")
    values = {name: getattr(trace, field) for name, trace in traces.items()}
    factor, shown = unit_of(_largest(list(values.values())), base)
    for number, (name, trace) in enumerate(traces.items()):
        if not np.all(np.isnan(values[name])):
            axes.plot(
                trace.displacement / scale,
                values[name] / factor,
                label=name,
                linewidth=1.4,
                **look(number),
            )
    axes.axhline(0.0, color=MUTED, linewidth=0.6)
    axes.set_xlabel(
        f"displacement [{unit}]" if radius is None else "displacement / radius [-]"
    )
    axes.set_ylabel(f"{label} [{shown}]")


def _largest(values: "list[Array]") -> float:
    finite = [np.abs(v[np.isfinite(v)]) for v in values]
    return float(max((np.max(v) for v in finite if v.size), default=1.0))


def draw_impacts(impacts: "Mapping[str, Impact | Collision]") -> "Figure":
    """Draw restitution against velocity, a curve a law."""
    with style():
        figure = new_figure(5.0, 3.4)
        axes = figure.subplots()
        for number, (name, impact) in enumerate(impacts.items()):
            axes.plot(impact.velocity, impact.restitution, label=name, **look(number))
        axes.set_xscale("log")
        axes.set_ylim(-0.02, 1.04)
        axes.set_xlabel("velocity [m/s]")
        axes.set_ylabel("coefficient of restitution [-]")
        axes.legend(frameon=False, fontsize=8)
    return figure


def draw_law(
    law: Any,
    *,
    radius: float = 1e-4,
    configuration: str = "simple",
    peaks: Sequence[float] = (0.1, 0.2, 0.3),
) -> "Figure":
    """Draw a law of a particle: loading, and unloading from each peak if it has any.

    Parameters
    ----------
    law : Loading or Cycle
        The law.
    radius : float
        Radius of the particle [m].
    configuration : str
        "simple", "die" or "hydrostatic".
    peaks : sequence of float
        Displacements over the radius at which it unloads [-].
    """
    from pestle.bench.drive import Displacement, Waypoint, drive
    from pestle.bench.subject import SingleParticle
    from pestle.particle.cycle import Cycle

    whole = law if hasattr(law, "follow") else Cycle(loading=law)
    subject = SingleParticle(law=whole, radius=radius, configuration=configuration)
    tops: list[Waypoint] = [Displacement(x * radius) for x in sorted(peaks)]
    unloads = getattr(whole, "unloading", whole) is not None
    end = Displacement(-0.01 * radius if subject.reach else 0.0)
    points = [w for top in tops for w in (top, end)] if unloads else tops[-1:]
    run = drive(subject, points)
    return draw_runs(
        {law.name: run}, radius=radius, title=f"{law.name}, {configuration}"
    )


def draw_pair_law(
    law: Any,
    *,
    pair: "Pair | None" = None,
    radius: float = 5e-5,
    other_radius: float = 0.0,
    peaks: Sequence[float] = (0.0005, 0.001, 0.002),
) -> "Figure":
    """Draw a law of a pair: loading, and unloading from each peak until it parts.

    A law whose contacts see each other is drawn as its particle between two flats.

    Parameters
    ----------
    law : object
        A law of `pestle.laws`, or one's own that is registered.
    pair : Pair, optional
        The materials; E = 5 GPa, nu = 0.3, Y = 20 MPa, W = 0.1 J/m^2 against a rigid
        wall without it.
    radius, other_radius : float
        Radii, the second 0 for a wall [m].
    peaks : sequence of float
        Overlaps over the first radius at which it unloads [-].
    """
    from pestle.bench.drive import Displacement, Waypoint, drive
    from pestle.bench.subject import PairContact
    from pestle.laws import Nothing, Pair, Solid, parts_of
    from pestle.particle.zunker2024 import Zunker2024

    pair = pair or Pair(
        first=Solid(youngs_modulus=5e9, poisson_ratio=0.3, yield_stress=2e7),
        second=Solid(),
        work_of_adhesion=0.1,
        wall=True,
    )
    if parts_of(law).particle is not Nothing:
        solid = pair.first
        particle = Zunker2024(
            youngs_modulus=solid.youngs_modulus,
            poisson_ratio=solid.poisson_ratio,
            yield_stress=solid.yield_stress,
            work_of_adhesion=pair.work_of_adhesion,
            radius_rule=law.radius_rule,
        )
        return draw_law(particle, radius=radius, peaks=peaks)
    subject = PairContact(law=law, pair=pair, radius=radius, other_radius=other_radius)
    end = Displacement(-1.001 * subject.reach)
    points: list[Waypoint] = []
    for x in sorted(peaks):
        points += [Displacement(x * radius), end]
    run = drive(subject, points, points=2000)
    return draw_runs({law.name: run}, title=f"{law.name}, {_of_pair(subject)}")


def _of_pair(subject: "PairContact") -> str:
    against = "a wall" if subject.other_radius == 0.0 else "a particle"
    size, unit = unit_of(subject.radius, "m")
    return f"{subject.radius / size:.4g} {unit} against {against}"
