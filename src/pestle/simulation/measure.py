"""What is measured at the end of a stage: recovery and strength of the tablet."""

from math import pi
from typing import TYPE_CHECKING, Any

import numpy as np

from pestle.config.geometry import ShearHead
from pestle.engine import walls as wl
from pestle.simulation.output import enclosed

if TYPE_CHECKING:
    from pestle.simulation.runner import Runner


def stage_info(run: "Runner", step: Any) -> dict[str, Any]:
    """Facts of a finished stage for stages.json."""
    info: dict[str, Any] = {}
    if step.step == "stir":
        info |= run.memory["stir"]
    if step.step == "shear":
        info |= run.memory["shear"]
        info["weight_above"] = weight_above(run, step.wall)
    if run.case.die is None:
        return info
    if step.step in ("press", "hold"):
        order = np.argsort(run.engine.ids)
        run.memory["pressed"] = run.engine.pos[order, :3].tolist()
        run.memory["pressed_height"] = enclosed(run)[1]
    if "pressed" in run.memory and step.step not in ("press", "hold", "crush"):
        axial, radial = recovery(run)
        info["axial_recovery"] = axial
        info["radial_recovery"] = radial
        info["height"] = run.memory["pressed_height"] * (1.0 + axial)
        info["diameter"] = 2.0 * run.case.die.radius * (1.0 + radial)
        run.memory["tablet"] = [info["height"], info["diameter"]]
    if step.step == "crush" and "tablet" in run.memory:
        height, diameter = run.memory["tablet"]
        info["breaking_force"] = run.memory["peak"]
        info["tensile_strength"] = 2.0 * run.memory["peak"] / (pi * diameter * height)
        info["height"], info["diameter"] = height, diameter
    return info


def recovery(run: "Runner") -> tuple[float, float]:
    """Axial and radial strain of the tablet since it was pressed [-].

    Slopes of a straight line through the particles' places now against then; particles
    that broke away (beyond three standard deviations of the fit) are left out.
    """
    then = np.array(run.memory["pressed"])
    now = run.engine.pos[np.argsort(run.engine.ids), :3]
    return _slope(then[:, 2], now[:, 2]) - 1.0, 0.5 * (
        _slope(then[:, 0], now[:, 0]) + _slope(then[:, 1], now[:, 1])
    ) - 1.0


def _slope(x: Any, y: Any) -> float:
    use = np.ones(len(x), bool)
    slope = 1.0
    for _ in range(3):
        slope, base = np.polyfit(x[use], y[use], 1)
        rest = y - slope * x - base
        spread = float(np.std(rest[use]))
        use = np.abs(rest) <= 3.0 * spread + 1e-300
    return float(slope)


def weight_above(run: "Runner", name: str) -> float:
    """Weight of the powder above the edges of a head's vanes, over its area [Pa]."""
    engine, head = run.engine, run.case.walls[name]
    assert isinstance(head, ShearHead)
    edge = float(engine.wall[run.wall(name), wl.POINT + 2]) - head.vane_depth
    order = np.argsort(engine.ids)  # the same sum however the particles are sorted
    z, r = engine.pos[order, 2], engine.pos[order, 3]
    cap = np.clip(z + r - edge, 0.0, 2.0 * r)
    share = cap**2 * (3.0 * r - cap) / (4.0 * r**3)
    weight = -float(np.sum(engine.vel[order, 3] * share) * engine.gravity[2])
    return weight / head.area
