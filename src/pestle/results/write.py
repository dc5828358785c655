"""Write the results file: one VTKHDF time series that grows frame by frame."""

from collections.abc import Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from pestle.errors import SimulationError
from pestle.results import schema, vtkhdf
from pestle.results.history import History
from pestle.results.safe_file import SafeFile, journal_path

if TYPE_CHECKING:
    from collections.abc import Iterator

Arrays = Mapping[str, NDArray[Any]]

NO_MESH: Arrays = {
    "corner": np.zeros((0, 3)),
    "triangle": np.zeros((0, 3), np.int64),
    "wall": np.zeros(0, np.int64),
}

__all__ = ["History", "ResultFile"]


class ResultFile:
    """A results file to which frames are appended.

    Each frame arrives completely or not at all, whenever the process is killed.

    Parameters
    ----------
    path : Path
        The file, usually ``results.vtkhdf``.
    mode : {"w", "a"}
        Create a new file, or continue an existing one.
    provenance : Mapping
        What ``provenance.collect`` returns; needed for a new file only.

    Examples
    --------
    >>> import tempfile, numpy as np
    >>> folder = tempfile.TemporaryDirectory()
    >>> file = ResultFile(Path(folder.name) / "results.vtkhdf", provenance={})
    >>> particles = {"id": np.array([1]), "position": np.zeros((1, 3))}
    >>> contacts = {"first": np.array([1]), "second": np.array([-1])}
    >>> file.append(0, 0.0, "fill", particles, contacts)
    >>> file.frames
    1
    >>> folder.cleanup()
    """

    def __init__(
        self,
        path: Path | str,
        mode: Literal["w", "a"] = "w",
        *,
        provenance: Mapping[str, Any] | None = None,
    ) -> None:
        self.path = Path(path)
        if mode == "w":
            self.path.parent.mkdir(parents=True, exist_ok=True)
            journal_path(self.path).unlink(missing_ok=True)
            self.path.write_bytes(b"")
            with self._changes("w") as file:
                vtkhdf.create(file, provenance or {})
        else:
            from pestle.results.read import Results

            with Results(self.path):  # refuses foreign, newer and damaged files
                pass

    @property
    def frames(self) -> int:
        """Number of frames in the file."""
        from pestle.results.read import Results

        with Results(self.path) as results:
            return len(results)

    def append(
        self,
        step: int,
        time: float,
        stage: str,
        particles: Arrays,
        contacts: Arrays,
        meshes: Arrays = NO_MESH,
    ) -> None:
        """Add a frame.

        Parameters
        ----------
        step : int
            Step of the run [-].
        time : float
            Simulated time [s].
        stage : str
            Name of the process stage.
        particles, contacts : Mapping of str to ndarray
            Columns named and oriented as in ``schema``; "id" and "position", "first"
            and "second" are needed, more are welcome. All frames have the same names.
        meshes : Mapping of str to ndarray
            Triangles of walls where they are now, "corner", "triangle" and "wall".
        """
        cells, lines = _cells(particles, contacts, np.asarray(meshes["wall"]))
        corner = np.asarray(meshes["corner"])
        points = {
            k: _padded(_flat(np.asarray(v)), after=len(corner))
            for k, v in particles.items()
            if k != "position"
        }
        with self._changes("r+") as file:
            vtk = file["VTKHDF"]
            vtkhdf.check_names(vtk, points, cells)
            position = np.asarray(particles["position"], float)
            triangle = np.asarray(meshes["triangle"])
            vtkhdf.append_geometry(vtk, position, lines, corner, triangle)
            vtkhdf.append_columns(vtk, "PointData", points, schema.PARTICLE_FIELDS)
            vtkhdf.append_columns(vtk, "CellData", cells, schema.CONTACT_FIELDS)
            vtkhdf.append_steps(vtk, time)
            counts = (len(particles["id"]), len(contacts["first"]))
            vtkhdf.append_frame(file["pestle"], step, time, stage, counts)

    def truncate_after(self, step: int) -> None:
        """Forget every frame of a later step than `step`."""
        with self._changes("r+") as file:
            steps = file["pestle/frames/step"][:]
            keep = int(np.count_nonzero(steps <= step))
            if keep < len(steps):
                vtkhdf.truncate(file, keep)

    @contextmanager
    def _changes(self, mode: str) -> "Iterator[Any]":
        import h5py

        try:
            with SafeFile(self.path, write=True) as safe:
                with h5py.File(safe, mode) as file:
                    yield file
                safe.commit()
        except OSError as error:
            raise SimulationError(
                "results-not-written",
                f"the results file cannot be written: {error}",
                str(self.path),
                "free some disk space or choose another folder with --out",
            ) from error


def _flat(values: NDArray[Any]) -> NDArray[Any]:
    """One row per item, tensors as nine numbers, booleans as bytes."""
    rows = np.ascontiguousarray(values)
    if rows.dtype == np.bool_:
        rows = rows.astype(np.uint8)
    return rows.reshape(len(rows), -1) if rows.ndim > 2 else rows


def _padded(rows: NDArray[Any], *, before: int = 0, after: int = 0) -> NDArray[Any]:
    """Rows with zeros around them."""
    return np.pad(rows, [(before, after)] + [(0, 0)] * (rows.ndim - 1))


def _cells(
    particles: Arrays, contacts: Arrays, wall: NDArray[Any]
) -> tuple[dict[str, NDArray[Any]], NDArray[np.int64]]:
    """Cell columns (particles, contacts, triangles) and the ends of the lines."""
    ids = np.asarray(particles["id"])
    first, second = np.asarray(contacts["first"]), np.asarray(contacts["second"])
    is_wall = second < 0
    start = _indices(ids, first)
    end = np.where(is_wall, start, _indices(ids, np.where(is_wall, first, second)))
    end = np.where(_crosses_boundary(particles, start, end), start, end)
    kind = [0] * len(ids), np.where(is_wall, 2, 1), [3] * len(wall)
    cells = {schema.KIND: np.concatenate(kind).astype(np.uint8)}
    for name, values in contacts.items():
        rows = _flat(np.asarray(values))
        cells[name] = _padded(rows, before=len(ids), after=len(wall))
    cells["first"][len(ids) + len(first) :] = -1 - wall
    return cells, np.stack([start, end], axis=1)


def _indices(ids: NDArray[Any], wanted: NDArray[Any]) -> NDArray[np.int64]:
    """Place of every wanted id in `ids`."""
    order = np.argsort(ids, kind="stable")
    place = np.searchsorted(ids, wanted, sorter=order)
    found = order[np.minimum(place, len(ids) - 1)] if len(ids) else place
    if len(wanted) and (not len(ids) or not np.array_equal(ids[found], wanted)):
        raise ValueError("a contact names a particle that is not in the frame")
    return found.astype(np.int64)


def _crosses_boundary(
    particles: Arrays, start: NDArray[np.int64], end: NDArray[np.int64]
) -> NDArray[np.bool_]:
    """Whether a line would cross a periodic box from side to side."""
    if "radius" not in particles:
        return np.zeros(len(start), dtype=np.bool_)
    position, radius = particles["position"], particles["radius"]
    distance = np.linalg.norm(position[start] - position[end], axis=1)
    return np.asarray(distance > 2.0 * (radius[start] + radius[end]))
