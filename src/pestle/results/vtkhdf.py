"""The layout of ``/VTKHDF`` and ``/pestle``: make it, extend it, cut it back."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pestle.results import schema
from pestle.results.provenance import to_json

Arrays = Mapping[str, NDArray[Any]]


def create(file: Any, provenance: Mapping[str, Any]) -> None:
    """Lay out a file without frames."""
    vtk = file.create_group("VTKHDF")
    vtk.attrs["Version"] = np.array(schema.VTKHDF_VERSION, dtype=np.int64)
    vtk.attrs.create("Type", np.bytes_("PolyData"))
    vtk.create_group("PointData")
    vtk.create_group("CellData")
    _column(vtk, "NumberOfPoints", np.zeros(0, np.int64))
    _column(vtk, "Points", np.zeros((0, 3)))
    for topology in schema.TOPOLOGIES:
        group = vtk.create_group(topology)
        for name in (
            "NumberOfCells",
            "NumberOfConnectivityIds",
            "Connectivity",
            "Offsets",
        ):
            _column(group, name, np.zeros(0, np.int64))
    steps = vtk.create_group("Steps")
    steps.attrs["NSteps"] = np.int64(0)
    _column(steps, "Values", np.zeros(0))
    for name in ("PartOffsets", "NumberOfParts", "PointOffsets"):
        _column(steps, name, np.zeros(0, np.int64))
    for name in ("CellOffsets", "ConnectivityIdOffsets"):
        _column(steps, name, np.zeros((0, 4), np.int64))
    steps.create_group("PointDataOffsets")
    steps.create_group("CellDataOffsets")
    ours = file.create_group("pestle")
    ours.attrs["schema_version"] = schema.SCHEMA_VERSION
    ours.create_dataset("provenance", data=to_json(provenance))
    frames = ours.create_group("frames")
    for name in ("step", "particles", "contacts"):
        _column(frames, name, np.zeros(0, np.int64))
    _column(frames, "time", np.zeros(0))
    _column(frames, "stage", np.zeros(0, f"S{schema.STAGE_LENGTH}"))


def _column(group: Any, name: str, rows: NDArray[Any]) -> Any:
    """Make an empty dataset that can grow; `rows` shows its type and width."""
    count = min(max(256, len(rows)), 1 << 16)
    return group.create_dataset(
        name,
        shape=(0, *rows.shape[1:]),
        maxshape=(None, *rows.shape[1:]),
        chunks=(count, *rows.shape[1:]),
        dtype=rows.dtype,
    )


def _grow(group: Any, name: str, rows: Any) -> None:
    """Append rows to a dataset."""
    data = group[name]
    start = data.shape[0]
    data.resize(start + len(rows), axis=0)
    data[start:] = rows


def check_names(vtk: Any, points: Arrays, cells: Arrays) -> None:
    """Refuse a frame whose columns differ from those of the first."""
    for group, columns in (("PointData", points), ("CellData", cells)):
        known = set(vtk[group])
        if known and known != set(columns):
            odd = sorted(known ^ set(columns))
            raise ValueError(f"{group} differs from the first frame in {odd}")


def append_geometry(
    vtk: Any,
    position: NDArray[np.float64],
    lines: NDArray[np.int64],
    corner: NDArray[np.float64],
    triangle: NDArray[np.int64],
) -> None:
    """Points with a vertex for each, lines, triangles with their corners, no strips."""
    points, contacts, faces = len(position), len(lines), len(triangle)
    steps = vtk["Steps"]
    _grow(steps, "PointOffsets", [vtk["Points"].shape[0]])
    parts = {
        "Vertices": (points, np.arange(points), np.arange(points + 1)),
        "Lines": (contacts, lines.ravel(), 2 * np.arange(contacts + 1)),
        "Polygons": (faces, triangle.ravel() + points, 3 * np.arange(faces + 1)),
    }
    nothing = (0, np.zeros(0, np.int64), np.zeros(1, np.int64))
    cell_offsets, connectivity_offsets = [], []
    for topology in schema.TOPOLOGIES:
        group = vtk[topology]
        number, connectivity, offsets = parts.get(topology, nothing)
        cell_offsets.append(int(np.sum(group["NumberOfCells"][:])))
        connectivity_offsets.append(group["Connectivity"].shape[0])
        _grow(group, "NumberOfCells", [number])
        _grow(group, "NumberOfConnectivityIds", [len(connectivity)])
        _grow(group, "Connectivity", connectivity)
        _grow(group, "Offsets", offsets)
    _grow(steps, "CellOffsets", [cell_offsets])
    _grow(steps, "ConnectivityIdOffsets", [connectivity_offsets])
    _grow(vtk, "NumberOfPoints", [points + len(corner)])
    _grow(vtk, "Points", np.concatenate([position, corner]))


def append_columns(
    vtk: Any, where: str, columns: Arrays, fields: Mapping[str, schema.Field]
) -> None:
    """Append the columns of one frame to the group `where`."""
    group, offsets = vtk[where], vtk["Steps"][where + "Offsets"]
    for name, rows in columns.items():
        if name not in group:
            data = _column(group, name, rows)
            _column(offsets, name, np.zeros(0, np.int64))
            if field := fields.get(name):
                data.attrs["unit"] = field.unit
                data.attrs["description"] = field.description
        _grow(offsets, name, [group[name].shape[0]])
        _grow(group, name, rows)


def append_steps(vtk: Any, time: float) -> None:
    """Append the time [s] of one frame."""
    steps = vtk["Steps"]
    number = steps["Values"].shape[0]
    _grow(steps, "Values", [time])
    _grow(steps, "PartOffsets", [number])
    _grow(steps, "NumberOfParts", [1])
    steps.attrs["NSteps"] = np.int64(number + 1)


def append_frame(
    ours: Any, step: int, time: float, stage: str, counts: tuple[int, int]
) -> None:
    """Append one row to our own table of frames."""
    frames = ours["frames"]
    _grow(frames, "step", [step])
    _grow(frames, "time", [time])
    text = stage.encode()[: schema.STAGE_LENGTH].decode(errors="ignore").encode()
    _grow(frames, "stage", np.array([text], f"S{schema.STAGE_LENGTH}"))
    _grow(frames, "particles", [counts[0]])
    _grow(frames, "contacts", [counts[1]])


def truncate(file: Any, keep: int) -> None:
    """Cut every dataset back to the first `keep` frames."""
    vtk, frames = file["VTKHDF"], file["pestle/frames"]
    steps = vtk["Steps"]
    vtk["Points"].resize(int(steps["PointOffsets"][keep]), axis=0)
    vtk["NumberOfPoints"].resize(keep, axis=0)
    for place, topology in enumerate(schema.TOPOLOGIES):
        group = vtk[topology]
        cells = int(steps["CellOffsets"][keep, place])
        group["Offsets"].resize(cells + keep, axis=0)
        ends = int(steps["ConnectivityIdOffsets"][keep, place])
        group["Connectivity"].resize(ends, axis=0)
        group["NumberOfCells"].resize(keep, axis=0)
        group["NumberOfConnectivityIds"].resize(keep, axis=0)
    for where in ("PointData", "CellData"):
        for name, offsets in steps[where + "Offsets"].items():
            vtk[where][name].resize(int(offsets[keep]), axis=0)
            offsets.resize(keep, axis=0)
    for data in [d for d in steps.values() if hasattr(d, "shape")]:
        data.resize(keep, axis=0)
    for data in frames.values():
        data.resize(keep, axis=0)
    steps.attrs["NSteps"] = np.int64(keep)
