"""What the history of a die says over time, as stresses and densities."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pestle.metrics.compaction import axial_stress, die_wall_stress
from pestle.results.folder import RunFolder
from pestle.results.history import HistoryTable

Array = NDArray[np.float64]

UPPER, LOWER, DIE = "upper_punch", "lower_punch", "die"
DENSITY, HEIGHT, TIME = "relative_density [-]", "height [m]", "time [s]"

FIRST_TOUCH = 0.002
"""Part of the peak stress at which the punch has met the powder [-]."""

RELEASED = 0.01
"""Part of the peak stress at which the punch has left it [-]: a last particle that
sticks out of the tablet does not count."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DieCurves:
    """Stresses in a die over time; compression is positive.

    Parameters
    ----------
    time : ndarray
        Simulated time [s].
    stages : tuple of str
        Name of the process stage of every row.
    kinds : tuple of str
        Kind of process step of every row.
    axial, transmitted : ndarray
        Stress of the upper and of the lower punch [Pa].
    radial : ndarray
        Stress of the die wall [Pa], NaN where unknown.
    density : ndarray
        Relative density between the punches [-].
    height : ndarray
        Distance of the punches [m].
    touch, peak, release : int
        Rows at which the punch has met the powder, presses hardest, has left it.
    die_radius : float
        Radius of the die [m].
    """

    time: Array
    stages: tuple[str, ...]
    kinds: tuple[str, ...]
    axial: Array
    transmitted: Array
    radial: Array
    density: Array
    height: Array
    touch: int
    peak: int
    release: int
    die_radius: float

    @property
    def loading(self) -> NDArray[np.int64]:
        """Rows from first touch to the peak, without a hold."""
        rows = np.arange(self.touch, self.peak + 1)
        return rows[[self.kinds[row] != "hold" for row in rows]]

    @property
    def unloading(self) -> NDArray[np.int64]:
        """Rows from the peak until the punch has left."""
        return np.arange(self.peak, self.release + 1)

    @property
    def is_released(self) -> bool:
        """Whether the punch has left the powder after the peak."""
        return bool(self.axial[self.release] <= RELEASED * self.axial[self.peak])

    def rows_of(self, *kinds: str) -> NDArray[np.int64]:
        """Rows of process steps of these kinds."""
        return np.flatnonzero([kind in kinds for kind in self.kinds])


def die_curves(folder: RunFolder) -> DieCurves | None:
    """Stresses over time, None if the run has no die or nothing was pressed."""
    case, history = folder.case, folder.history
    if case is None or case.die is None or history is None or not len(history):
        return None
    radius = case.die.radius
    axial = axial_stress(-history[f"{UPPER}.force_z [N]"], radius)
    kinds = tuple(folder.kind_of(stage) for stage in history.stages)
    in_die = [kind not in ("eject", "relax", "crush") for kind in kinds]
    pressed = np.where(in_die, axial, -np.inf)
    peak = int(np.argmax(pressed))
    if not pressed[peak] > 0.0:
        return None
    height = _height(history, case.die.height)
    before = np.flatnonzero(axial[: peak + 1] < FIRST_TOUCH * axial[peak])
    after = np.flatnonzero(axial[peak:] <= RELEASED * axial[peak])
    return DieCurves(
        time=history[TIME],
        stages=history.stages,
        kinds=kinds,
        axial=axial,
        transmitted=axial_stress(history[f"{LOWER}.force_z [N]"], radius),
        radial=_radial(history, radius, height),
        density=history[DENSITY],
        height=height,
        touch=int(before[-1]) + 1 if len(before) else 0,
        peak=peak,
        release=peak + int(after[0]) if len(after) else len(axial) - 1,
        die_radius=radius,
    )


def _height(history: HistoryTable, initial: float) -> Array:
    if HEIGHT in history:
        return history[HEIGHT]
    moved = [history[f"{wall}.displacement [m]"] for wall in (UPPER, LOWER)]
    return initial - moved[0] - moved[1]


def _radial(history: HistoryTable, radius: float, height: Array) -> Array:
    column = f"{DIE}.normal_force [N]"
    if column not in history:
        return np.full(len(history), np.nan)
    return die_wall_stress(np.abs(history[column]), radius, height)
