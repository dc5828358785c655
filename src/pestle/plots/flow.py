"""Flow energy of a blade against its depth."""

from typing import TYPE_CHECKING

from pestle.metrics.flow_metrics import FlowCurve
from pestle.plots.style import literal, new_figure, style

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def flow_energy(curves: list[FlowCurve]) -> "Figure | None":
    """Energy and torque against depth, a line for each test; None without one."""
    sequence = any(curve.role != "test" for curve in curves)
    if sequence:
        tests = ("stability", "flow-rate")
        curves = [c for c in curves if c.role in tests and c.goes_down]
    if not curves:
        return None
    with style():
        figure = new_figure(7.6, 4.0)
        energy, torque = figure.subplots(1, 2)
        for curve in curves:
            depth = 1e3 * curve.depth
            energy.plot(depth, 1e3 * curve.energy, label=literal(curve.stage))
            torque.plot(depth, 1e3 * curve.torque, linewidth=0.8)
        energy.set_ylabel("flow energy [mJ]")
        torque.set_ylabel("torque [mN m]")
        for axes in (energy, torque):
            axes.set_xlabel("depth of the blade [mm]")
        energy.legend(loc="upper left")
        return figure
