"""Read the results file frame by frame."""

import json
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from pestle.errors import InputError
from pestle.results import schema
from pestle.results.safe_file import SafeFile, journal_path

_SIGNATURE = b"\x89HDF\r\n\x1a\n"
_DAMAGE = (
    AttributeError,
    KeyError,
    MemoryError,
    OSError,
    OverflowError,
    RuntimeError,
    TypeError,
    ValueError,
)
"""What h5py raises when it meets a damaged file."""

POLYGONS = schema.TOPOLOGIES.index("Polygons")

Columns = dict[str, NDArray[Any]]


@dataclass(frozen=True, slots=True)
class Frame:
    """The powder at one moment.

    Parameters
    ----------
    step : int
        Step of the run [-].
    time : float
        Simulated time [s].
    stage : str
        Name of the process stage.
    particles, contacts, meshes : dict of str to ndarray
        Columns as in ``schema``; stress is (N, 3, 3).
    """

    step: int
    time: float
    stage: str
    particles: Columns
    contacts: Columns
    meshes: Columns

    def contact_indices(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Rows of both particles of every contact; -1 - w for wall number w."""
        ids = self.particles["id"]
        order = np.argsort(ids, kind="stable")
        ends = []
        for name in ("first", "second"):
            wanted = self.contacts[name]
            place = np.searchsorted(ids, wanted, sorter=order)
            found = order[np.minimum(place, max(len(ids) - 1, 0))]
            ends.append(np.where(wanted < 0, wanted, found).astype(np.int64))
        return ends[0], ends[1]


class Results:
    """A results file, open for reading.

    Parameters
    ----------
    path : Path
        The file, usually ``results.vtkhdf``.

    Raises
    ------
    InputError
        If the file is missing, empty, cut short, damaged, of another program or of
        a newer pestle.
    """

    def __init__(self, path: Path | str) -> None:
        self.path = Path(path)
        self._safe, self._file = _open(self.path)
        try:
            self._read_table()
        except _DAMAGE as error:
            self.close()
            raise _damaged(self.path, str(error)) from error
        except InputError:
            self.close()
            raise

    def _read_table(self) -> None:
        if "VTKHDF" not in self._file or "pestle" not in self._file:
            raise InputError(
                "results-foreign",
                f"{self.path.name} was not written by pestle",
                str(self.path),
                "give the results.vtkhdf of an output folder",
            )
        ours = self._file["pestle"]
        version = int(ours.attrs["schema_version"])
        if version > schema.SCHEMA_VERSION:
            raise InputError(
                "results-newer",
                f"{self.path.name} has schema version {version}; this pestle reads "
                f"up to {schema.SCHEMA_VERSION}",
                str(self.path),
                "install a newer pestle",
            )
        _check_sizes(self._file, self.path)
        frames = ours["frames"]
        self.schema_version = version
        self.steps: NDArray[np.int64] = frames["step"][:]
        self.times: NDArray[np.float64] = frames["time"][:]
        self.stages: list[str] = [s.decode("utf-8", "replace") for s in frames["stage"]]
        self._counts = np.stack([frames["particles"][:], frames["contacts"][:]], axis=1)
        text = ours["provenance"][()].decode("utf-8", "replace")
        self.provenance: dict[str, Any] = json.loads(text)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Close the file."""
        try:
            self._file.close()
        finally:
            self._safe.close()

    def __len__(self) -> int:
        return len(self.steps)

    def __iter__(self) -> Iterator[Frame]:
        return (self[number] for number in range(len(self)))

    def __getitem__(self, number: int) -> Frame:
        place = number + len(self) if number < 0 else number
        if not 0 <= place < len(self):
            raise IndexError(f"frame {number} of {len(self)}")
        try:
            return self._frame(place)
        except _DAMAGE as error:
            raise _damaged(self.path, str(error)) from error

    def last_of(self, stage: str) -> Frame | None:
        """Last frame of the stage of this name, None if there is none."""
        found = [n for n, name in enumerate(self.stages) if name == stage]
        return self[found[-1]] if found else None

    def _frame(self, place: int) -> Frame:
        vtk = self._file["VTKHDF"]
        count, pairs = (int(n) for n in self._counts[place])
        start = int(vtk["Steps/PointOffsets"][place])
        position = vtk["Points"][start : start + count]
        particles = {"position": _checked(position, count)}
        for name, data in vtk["PointData"].items():
            begin = int(vtk["Steps/PointDataOffsets"][name][place])
            particles[name] = _rows(data, begin, count)
        contacts = {}
        for name, data in vtk["CellData"].items():
            if name != schema.KIND:
                begin = int(vtk["Steps/CellDataOffsets"][name][place]) + count
                contacts[name] = _rows(data, begin, pairs)
        return Frame(
            int(self.steps[place]),
            float(self.times[place]),
            self.stages[place],
            particles,
            contacts,
            self._meshes(place, start + count, count, pairs),
        )

    def _meshes(self, place: int, start: int, count: int, pairs: int) -> Columns:
        vtk = self._file["VTKHDF"]
        corners = int(vtk["NumberOfPoints"][place]) - count
        faces = int(vtk["Polygons/NumberOfCells"][place])
        begin = int(vtk["Steps/ConnectivityIdOffsets"][place][POLYGONS])
        ends = _rows(vtk["Polygons/Connectivity"], begin, 3 * faces) - count
        if np.any((ends < 0) | (ends >= corners)):
            raise ValueError("a triangle has a corner that is not there")
        wall = np.zeros(0, np.int64)
        if faces:
            begin = int(vtk["Steps/CellDataOffsets/first"][place]) + count + pairs
            wall = -1 - _rows(vtk["CellData/first"], begin, faces)
        return {
            "corner": _rows(vtk["Points"], start, corners),
            "triangle": ends.reshape(-1, 3),
            "wall": wall,
        }


def _check_sizes(file: Any, path: Path) -> None:
    """Refuse an array that claims to be larger than the whole file."""
    import h5py

    limit = path.stat().st_size

    def check(name: str, data: Any) -> None:
        if isinstance(data, h5py.Dataset) and data.size * data.dtype.itemsize > limit:
            raise ValueError(f"{name} claims more numbers than the file can hold")

    file.visititems(check)


def _rows(data: Any, begin: int, count: int) -> NDArray[Any]:
    rows = _checked(data[begin : begin + count], count)
    return rows.reshape(count, 3, 3) if rows.shape[1:] == (9,) else rows


def _checked(rows: NDArray[Any], count: int) -> NDArray[Any]:
    if len(rows) != count:
        raise ValueError(f"{len(rows)} rows where {count} belong")
    return rows


def _open(path: Path) -> tuple[SafeFile, Any]:
    """Open the file, or say in one sentence why that is impossible."""
    import h5py

    if not path.is_file():
        raise InputError(
            "results-missing",
            f"there is no results file {path.name}",
            str(path),
            "give an output folder of pestle run",
        )
    if path.stat().st_size == 0 and not journal_path(path).exists():
        raise InputError("results-empty", f"{path.name} is empty", str(path))
    safe = SafeFile(path, write=False)
    if safe.read(len(_SIGNATURE)) != _SIGNATURE:
        safe.close()
        raise InputError(
            "results-foreign",
            f"{path.name} is not an HDF5 file",
            str(path),
            "give the results.vtkhdf of an output folder",
        )
    try:
        return safe, h5py.File(safe, "r")
    except _DAMAGE as error:
        safe.close()
        if "truncated" in str(error):
            raise InputError(
                "results-truncated",
                f"{path.name} is cut short: a part of it is missing",
                str(path),
                "copy it again, or continue the run with --resume",
            ) from error
        raise _damaged(path, str(error)) from error


def _damaged(path: Path, detail: str) -> InputError:
    short = " ".join(detail.split())[:160]
    return InputError(
        "results-damaged",
        f"{path.name} is damaged: {short}",
        str(path),
        "copy it again, or continue the run with --resume",
    )
