"""A whole experiment: load, unload from some depths, numbers of both."""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import pi
from typing import Any

from pestle.errors import InputError, SimulationError
from pestle.lab.material import Material
from pestle.lab.mesh import Fineness
from pestle.lab.pull_off import dimple, relaxed_pull_off
from pestle.lab.sphere import Moment, Point, Sphere, Unloading
from pestle.lab.unloading import unloading_numbers


@dataclass(frozen=True)
class Progress:
    """How far an experiment is.

    Parameters
    ----------
    what : str
        "loading" or "unloading".
    depth, end : float
        Where the flat is and where it goes [R].
    steps : int
        Steps so far.
    """

    what: str
    depth: float
    end: float
    steps: int


@dataclass(frozen=True, eq=False)
class Result:
    """What an experiment gave.

    Parameters
    ----------
    sphere : Sphere
        Mesh and material.
    loading : tuple of Point
        All steps of the loading.
    end : Moment, optional
        Its last moment, with all fields.
    branches : tuple of Unloading
        One for each depth of unloading that was reached.
    stopped : SimulationError, optional
        Why it ended early.
    cpu_time : float
        Processor time [s].
    """

    sphere: Sphere
    loading: tuple[Point, ...]
    end: Moment | None
    branches: tuple[Unloading, ...]
    stopped: SimulationError | None
    cpu_time: float

    def to_dict(self, work_of_adhesion: float | None = None) -> dict[str, Any]:
        """Numbers of the experiment: lengths in R, forces in E R^2, works in E R^3.

        With a work of adhesion [E R] each unloading has the pull-off of its sphere.
        """
        material = self.sphere.material
        return {
            "modulus_ratio": material.modulus_ratio,
            "poisson_ratio": material.poisson_ratio,
            "mesh": self.sphere.mesh.name,
            "elements": len(self.sphere.mesh.cells),
            "reached_R": self.loading[-1].depth if self.loading else 0.0,
            "stopped": str(self.stopped) if self.stopped else None,
            "cpu_s": self.cpu_time,
            "loading": [loading_row(m, material) for m in self.loading],
            "unloading": [self._unloading(b, work_of_adhesion) for b in self.branches],
        }

    def _unloading(self, branch: Unloading, work: float | None) -> dict[str, float]:
        row = unloading_row(branch)
        row["r_peak_R"], row["dimple_R"] = dimple(self.sphere, branch)
        if work is not None:
            found = relaxed_pull_off(self.sphere, branch, work)
            row["pull_off_ER2"], row["a_pull_off_R"] = found.force, found.radius
        return row


def loading_row(point: Point, material: Material) -> dict[str, float]:
    """Numbers of one step."""
    area = pi * point.radius**2
    return {
        "d_R": point.depth,
        "F_ER2": point.force,
        "A_piR2": point.radius**2,
        "pbar_Y": point.force / area * material.modulus_ratio if area else 0.0,
        "r_in": point.inner,
        "r_out": point.outer,
        "work_ER3": point.work,
        "elastic_ER3": point.elastic,
        "plastic_ER3": point.plastic,
        "iterations": point.iterations,
    }


def unloading_row(branch: Unloading) -> dict[str, float]:
    """Numbers of one unloading; the first five are those of the studies."""
    found = unloading_numbers(branch)
    return {
        "dmax_R": found.depth,
        "d0_R": found.separation,
        "rho": found.rho,
        "alpha": found.alpha,
        "Fmax_ER2": found.force,
        "R2": found.r_squared,
        "returned_ER3": branch.start.work - branch.relaxed.work,
    }


def press(
    material: Material,
    depth: float,
    unload: Sequence[float] = (),
    *,
    mesh: str | Fineness = "coarse",
    progress: Callable[[Progress], None] | None = None,
    each: Callable[[Sphere, Moment], None] | None = None,
) -> Result:
    """Load a sphere once and unload it from several depths of the way.

    Parameters
    ----------
    material : Material
        Its material.
    depth : float
        Largest depth [R].
    unload : sequence of float
        Depths to unload from [R], at most `depth`, in any order.
    mesh : str or Fineness
        How fine.
    progress : callable, optional
        Called after every step with how far it is.
    each : callable, optional
        Called after every step with the sphere and all its fields.

    Returns
    -------
    Result
        Everything; also if the loading had to stop early.

    Examples
    --------
    >>> result = press(Material(20.0, 0.3), 0.02, [0.01])
    >>> [round(row["rho"], 1) for row in result.to_dict()["unloading"]]
    [100.0]
    """
    start = time.process_time()
    sphere = Sphere(material, mesh)
    goals = sorted({*unload, depth})
    if goals and goals[-1] > depth:
        raise InputError(
            "unloading-beyond-loading",
            f"unloading from {goals[-1]:g} R is asked for, but the loading ends at "
            f"{depth:g} R",
            hint="raise --to or leave that depth out",
        )
    loading: list[Point] = []
    branches: list[Unloading] = []
    moment = stopped = None
    try:
        for moment in sphere.load(goals):
            loading.append(moment.point)
            if each:
                each(sphere, moment)
            if progress:
                progress(Progress("loading", moment.depth, depth, len(loading)))
            if moment.depth in unload:
                branches.append(sphere.unload(moment))
                if progress:
                    progress(Progress("unloading", moment.depth, depth, len(loading)))
    except SimulationError as error:
        stopped = error
    cpu = time.process_time() - start
    return Result(sphere, tuple(loading), moment, tuple(branches), stopped, cpu)
