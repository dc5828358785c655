"""Files of an experiment: tables, profiles, frames for ParaView."""

import csv
import json
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from pestle.lab.measure import pressure_profile, profile
from pestle.lab.press import Result, loading_row
from pestle.lab.sphere import Moment, Sphere

WRITTEN = ("sphere.json", "loading.csv", "unloading.csv", "pressure.csv", "profile.csv")
"""Names in the folder of an experiment; frames lie in `frames/`."""


def write(result: Result, numbers: dict[str, Any], folder: Path) -> None:
    """Write an experiment and its numbers into an existing folder.

    Frames show the starts of unloadings, the end and the relaxed spheres.
    """
    sphere = result.sphere
    text = json.dumps(numbers, indent=1)
    (folder / "sphere.json").write_text(text + "\n", encoding="utf-8")
    _table(folder / "loading.csv", _steps(result))
    _table(folder / "unloading.csv", numbers["unloading"])
    tops = [branch.start for branch in result.branches]
    if result.end is not None and result.end not in tops:
        tops.append(result.end)
    _table(folder / "pressure.csv", _pressures(sphere, tops))
    _table(folder / "profile.csv", _profiles(result))
    frames = folder / "frames"
    for number, moment in enumerate(tops):
        write_frame(sphere, moment, frames / f"top_{number:03d}.vtu")
    for number, branch in enumerate(result.branches):
        write_frame(sphere, branch.relaxed, frames / f"relaxed_{number:03d}.vtu")


class Frames:
    """Writes a frame of every step of the loading into a folder."""

    def __init__(self, folder: Path) -> None:
        self._folder, self._number = folder / "frames", 0

    def __call__(self, sphere: Sphere, moment: Moment) -> None:
        """Write the next frame."""
        write_frame(sphere, moment, self._folder / f"step_{self._number:04d}.vtu")
        self._number += 1


def _steps(result: Result) -> list[dict[str, Any]]:
    """Rows of the loading and of all unloadings."""
    material = result.sphere.material
    rows: list[dict[str, Any]] = []
    for point in result.loading:
        row = loading_row(point, material)
        rows.append({"branch": "load", "dmax_R": "", **row})
    for branch in result.branches:
        for point in branch.points[1:]:
            row = loading_row(point, material)
            rows.append({"branch": "unload", "dmax_R": branch.start.depth, **row})
    return rows


def _pressures(sphere: Sphere, moments: Iterable[Moment]) -> list[dict[str, float]]:
    rows = []
    for moment in moments:
        found = moment.equilibrium
        r, p = pressure_profile(sphere.mesh, found.u, found.pushes, found.active)
        ratio = sphere.material.modulus_ratio
        for radius, value in zip(r, p, strict=True):
            row = {"d_R": moment.depth, "r_R": radius, "p_Y": value * ratio}
            rows.append({key: float(number) for key, number in row.items()})
    return rows


def _profiles(result: Result) -> list[dict[str, float]]:
    """Heights of the relaxed surface above its lowest point."""
    rows = []
    for branch in result.branches:
        r, z = profile(result.sphere.mesh, branch.relaxed.equilibrium.u)
        for radius, height in zip(r, z - z.min(), strict=True):
            row = {
                "dmax_R": branch.start.depth,
                "amax_R": branch.start.radius[0],
                "r_R": radius,
                "z_R": height,
            }
            rows.append({key: float(number) for key, number in row.items()})
    return rows


def _table(path: Path, rows: Sequence[Mapping[str, Any]]) -> None:
    """Write rows with equal keys; no file without rows."""
    if not rows:
        return
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)


def write_frame(sphere: Sphere, moment: Moment, path: Path) -> None:
    """Write the deformed mesh with means over the elements as a VTU file."""
    import meshio

    path.parent.mkdir(exist_ok=True)
    mesh, found = sphere.mesh, moment.equilibrium
    place = mesh.points + found.u
    flat = np.column_stack([place, np.zeros(len(place))])
    shift = np.column_stack([found.u, np.zeros(len(place))])
    push = np.zeros(len(place))
    push[mesh.surface] = np.where(found.active, found.pushes, 0.0)
    stress = found.answer.stress.mean(axis=1)
    names = ("stress_rr", "stress_rz", "stress_zz", "stress_tt", "mises")
    cells = {name: [stress[:, i]] for i, name in enumerate(names)}
    cells["plastic_strain"] = [found.answer.state[:, :, 4].mean(axis=1)]
    cells["volume_ratio"] = [stress[:, 6]]
    frame = meshio.Mesh(
        flat,
        [("quad", mesh.cells)],
        point_data={"displacement": shift, "contact_force": push},
        cell_data=cells,
    )
    frame.write(path)
