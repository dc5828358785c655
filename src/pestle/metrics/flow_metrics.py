"""Flow energy of a blade that is driven through a bed, against its depth."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from pestle.metrics.metric import Group, Metric
from pestle.results.folder import RunFolder
from pestle.results.stages import Stage

_FLOW = Group("Flow")
Array = npt.NDArray[Any]


@dataclass(frozen=True, slots=True)
class FlowCurve:
    """What a blade spends on its way down or up.

    Parameters
    ----------
    stage : str
        Name of the step.
    depth : ndarray
        Depth of the blade's lowest point below the surface [m].
    energy : ndarray
        Work of the blade since it met the surface, or since the start, if deeper [J].
    torque, force : ndarray
        Torque about the axis [N m] and vertical force [N] on the powder.
    role : str
        What the energy counts for.
    tip_speed : float
        Speed of the tips [m/s].
    mass : float
        Of the powder [kg].
    """

    stage: str
    depth: Array
    energy: Array
    torque: Array
    force: Array
    role: str = "test"
    tip_speed: float = float("nan")
    mass: float = float("nan")

    @property
    def goes_down(self) -> bool:
        """Whether the blade goes down."""
        return bool(self.depth[-1] > self.depth[0])


def flow_curves(folder: RunFolder) -> list[FlowCurve]:
    """Curve of every step `stir` that has been finished."""
    if folder.history is None:
        return []
    curves = (flow_curve(folder, s) for s in folder.stages if s.step == "stir")
    return [curve for curve in curves if curve is not None]


def flow_curve(folder: RunFolder, stage: Stage) -> FlowCurve | None:
    """Curve of one step; None if it has too few rows."""
    history, info = folder.history, stage.info
    assert history is not None
    rows = np.array([name == stage.name for name in history.stages])
    if rows.sum() < 2 or "wall" not in info:
        return None
    wall = info["wall"]
    depth = history[f"{wall}.displacement [m]"][rows]
    depth = depth - info["displacement_at_start"] + info["depth_at_start"]
    work = history[f"{wall}.work [J]"][rows]
    met = float(np.interp(0.0, depth, work)) if depth[-1] > depth[0] else work[0]
    return FlowCurve(
        stage.name,
        depth,
        work - met,
        history[f"{wall}.torque_z [N m]"][rows],
        history[f"{wall}.force_z [N]"][rows],
        info.get("role", "test"),
        info.get("tip_speed", float("nan")),
        info.get("mass", float("nan")),
    )


def flow_metrics(folder: RunFolder) -> list[Metric]:
    """Flow energies, indices of a sequence, and the bulk density of the bed before."""
    curves = flow_curves(folder)
    found: list[Metric] = []
    tests = [curve for curve in curves if curve.role == "test"]
    for number, curve in enumerate(tests, start=1):
        place = "" if number == 1 else f"_{number}"
        found.append(
            _FLOW.metric(
                f"flow_energy{place}",
                f"Flow energy, {curve.stage}",
                curve.energy[-1],
                unit="J",
                definition="Work of the blade, torque times angular velocity and force "
                "times velocity, from the surface to the end of the step.",
            )
        )
    found += _indices(curves)
    densities = [
        s.info["bulk_density"] for s in folder.stages if "bulk_density" in s.info
    ]
    if densities:
        found.append(
            _FLOW.metric(
                "bulk_density",
                "Bulk density",
                densities[0],
                unit="kg/m^3",
                definition="Mass of the particles over the volume of the vessel below "
                "the surface, before the blade comes.",
            )
        )
    return found


def _indices(curves: list[FlowCurve]) -> list[Metric]:
    """What the standard sequence of a powder rheometer is read for."""
    stable = [c for c in curves if c.role == "stability"]
    down = [float(c.energy[-1]) for c in stable if c.goes_down]
    up = [float(c.energy[-1] / c.mass) for c in stable if not c.goes_down]
    found = []
    if down:
        found.append(
            _FLOW.metric(
                "basic_flowability_energy",
                "Basic flowability energy",
                down[-1],
                unit="J",
                definition="Flow energy of the last stability test, downwards.",
            )
        )
    if len(down) > 1:
        found.append(
            _FLOW.metric(
                "stability_index",
                "Stability index",
                down[-1] / down[0],
                unit="-",
                definition="Flow energy of the last stability test over the first.",
            )
        )
    if up:
        found.append(
            _FLOW.metric(
                "specific_energy",
                "Specific energy",
                float(np.mean(up[-2:])),
                unit="J/kg",
                definition="Energy of the way up over the mass of the powder, mean of "
                "the last two stability tests.",
            )
        )
    rates = [c for c in curves if c.role == "flow-rate" and c.goes_down]
    if len(rates) > 1:
        slow = min(rates, key=lambda c: c.tip_speed)
        fast = max(rates, key=lambda c: c.tip_speed)
        found.append(
            _FLOW.metric(
                "flow_rate_index",
                "Flow-rate index",
                float(slow.energy[-1] / fast.energy[-1]),
                unit="-",
                definition="Flow energy at the slowest of the tip speeds over that at "
                "the fastest.",
            )
        )
    return found
