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
    """

    stage: str
    depth: Array
    energy: Array
    torque: Array
    force: Array


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
    )


def flow_metrics(folder: RunFolder) -> list[Metric]:
    """Flow energy of every step `stir`, and the bulk density of the bed before it."""
    found: list[Metric] = []
    for number, curve in enumerate(flow_curves(folder), start=1):
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
