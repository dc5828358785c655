"""The results file: what goes in comes out, and VTK agrees."""

import os
import shutil
from pathlib import Path

import h5py
import numpy as np
import pytest

from pestle.errors import InputError, SimulationError
from pestle.results import ResultFile, Results
from pestle.results.safe_file import SafeFile, journal_path

NONE = np.zeros((0, 3), int)


def powder(seed, particles, contacts):
    """A frame of random numbers."""
    rng = np.random.default_rng(seed)
    ids = rng.permutation(particles) + 1
    first = rng.choice(ids, contacts) if particles else np.zeros(0, int)
    second = np.where(rng.random(contacts) < 0.3, -2, np.roll(first, 1))
    columns = {
        "id": ids,
        "position": rng.random((particles, 3)),
        "radius": np.full(particles, 2.0),
        "stress": rng.random((particles, 3, 3)),
        "plastic_contacts": rng.integers(0, 9, particles),
    }
    ends = {
        "first": first,
        "second": second,
        "force": rng.random((contacts, 3)),
        "yielded": rng.random(contacts) < 0.5,
    }
    triangles = seed % 3 * 20  # of two walls, none in every third frame
    mesh = {
        "corner": rng.random((triangles, 3)),
        "triangle": rng.integers(0, triangles, (triangles, 3)) if triangles else NONE,
        "wall": np.sort(rng.integers(5, 7, triangles)),
    }
    return columns, ends, mesh


SIZES = [(5, 0), (7, 4), (7, 30), (3000, 1200), (6, 2)]


@pytest.fixture
def path(tmp_path):
    file = ResultFile(
        tmp_path / "results.vtkhdf", provenance={"case_text": "é" * 90000}
    )
    for k, (particles, contacts) in enumerate(SIZES):
        stage = "fill" if k < 3 else "press"
        file.append(10 * k, k / 10, stage, *powder(k, particles, contacts))
    return tmp_path / "results.vtkhdf"


def assert_is_frame(frame, k):
    particles, contacts, mesh = powder(k, *SIZES[k])
    assert (frame.step, frame.time) == (10 * k, k / 10)
    for name, values in particles.items():
        np.testing.assert_array_equal(frame.particles[name], values)
    for name, values in contacts.items():
        np.testing.assert_array_equal(frame.contacts[name], values)
    for name, values in mesh.items():
        np.testing.assert_array_equal(frame.meshes[name], values)


def test_reads_what_was_written(path):
    with Results(path) as results:
        assert len(results) == len(SIZES)
        assert results.stages == ["fill"] * 3 + ["press"] * 2
        assert results.provenance["case_text"] == "é" * 90000
        for k, frame in enumerate(results):
            assert_is_frame(frame, k)
        assert results.last_of("fill").step == 20
        assert results.last_of("eject") is None


def test_contact_indices_point_at_the_rows(path):
    with Results(path) as results:
        frame = results[2]
    first, second = frame.contact_indices()
    np.testing.assert_array_equal(frame.particles["id"][first], frame.contacts["first"])
    np.testing.assert_array_equal(second < 0, frame.contacts["second"] < 0)
    pair = second >= 0
    np.testing.assert_array_equal(
        frame.particles["id"][second[pair]], frame.contacts["second"][pair]
    )


def test_truncate_then_append_equals_an_unbroken_run(path):
    file = ResultFile(path, "a")
    file.truncate_after(25)
    assert file.frames == 3
    for k in (3, 4):
        file.append(10 * k, k / 10, "press", *powder(k, *SIZES[k]))
    with Results(path) as results:
        for k, frame in enumerate(results):
            assert_is_frame(frame, k)


def test_truncate_to_nothing(path):
    file = ResultFile(path, "a")
    file.truncate_after(-1)
    assert file.frames == 0
    file.append(0, 0.0, "fill", *powder(0, *SIZES[0]))
    with Results(path) as results:
        assert_is_frame(results[0], 0)


def test_vtk_reads_every_step(path):
    reader_module = pytest.importorskip(
        "vtkmodules.vtkIOHDF", reason="VTK is not installed (extra: view)"
    )
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline

    reader = reader_module.vtkHDFReader()
    reader.SetFileName(str(path))
    reader.UpdateInformation()
    times = reader.GetOutputInformation(0).Get(
        vtkStreamingDemandDrivenPipeline.TIME_STEPS()
    )
    np.testing.assert_array_equal(times, [k / 10 for k in range(len(SIZES))])
    for k in (4, 0, 2, 1, 3):  # in any order
        reader.UpdateTimeStep(times[k])
        shape = reader.GetOutputDataObject(0)
        particles, contacts, mesh = powder(k, *SIZES[k])
        assert shape.GetClassName() == "vtkPolyData"
        assert shape.GetNumberOfVerts() == len(particles["id"])
        assert shape.GetNumberOfLines() == len(contacts["first"])
        assert shape.GetNumberOfPolys() == len(mesh["triangle"])
        assert shape.GetNumberOfStrips() == 0
        points = vtk_to_numpy(shape.GetPoints().GetData())
        count = len(particles["id"])
        np.testing.assert_array_equal(points[:count], particles["position"])
        np.testing.assert_array_equal(points[count:], mesh["corner"])
        faces = vtk_to_numpy(shape.GetPolys().GetConnectivityArray()).reshape(-1, 3)
        np.testing.assert_array_equal(faces - count, mesh["triangle"])
        kind = vtk_to_numpy(shape.GetCellData().GetArray("kind"))
        assert np.count_nonzero(kind == 3) == len(faces)
        wall = vtk_to_numpy(shape.GetCellData().GetArray("first"))[kind == 3]
        np.testing.assert_array_equal(-1 - wall, mesh["wall"])
        tensor = vtk_to_numpy(shape.GetPointData().GetArray("stress"))
        np.testing.assert_array_equal(
            tensor[:count], particles["stress"].reshape(-1, 9)
        )
        assert not tensor[count:].any()
        force = vtk_to_numpy(shape.GetCellData().GetArray("force"))
        lines = slice(count, count + len(contacts["first"]))
        np.testing.assert_array_equal(force[lines], contacts["force"])
        assert not force[:count].any()
        assert not force[lines.stop :].any()
        ends = vtk_to_numpy(shape.GetLines().GetConnectivityArray()).reshape(-1, 2)
        first, second = contacts["first"], contacts["second"]
        ids = np.stack([first, np.where(second < 0, first, second)], axis=1)
        np.testing.assert_array_equal(particles["id"][ends], ids.reshape(-1, 2))


def test_lines_do_not_cross_a_periodic_box(tmp_path):
    particles = {
        "id": np.array([1, 2]),
        "position": np.array([[0.1, 0, 0], [9.9, 0, 0]]),
        "radius": np.array([0.15, 0.15]),
    }
    contacts = {"first": np.array([1]), "second": np.array([2])}
    file = ResultFile(tmp_path / "r.vtkhdf", provenance={})
    file.append(0, 0.0, "shear", particles, contacts)
    with h5py.File(tmp_path / "r.vtkhdf") as stored:
        assert stored["VTKHDF/Lines/Connectivity"][:].tolist() == [0, 0]


def test_units_stand_beside_the_numbers(path):
    with h5py.File(path) as stored:
        assert stored["VTKHDF/PointData/stress"].attrs["unit"] == "Pa"
        assert stored["VTKHDF/CellData/force"].attrs["unit"] == "N"


def test_unknown_particle_and_changed_columns_are_refused(path):
    file = ResultFile(path, "a")
    particles, contacts, _ = powder(9, 5, 3)
    with pytest.raises(ValueError, match="not in the frame"):
        file.append(90, 9.0, "x", particles, contacts | {"first": np.array([77] * 3)})
    del particles["radius"]
    with pytest.raises(ValueError, match="radius"):
        file.append(90, 9.0, "x", particles, contacts)
    with Results(path) as results:  # nothing of it arrived
        assert len(results) == len(SIZES)
        assert_is_frame(results[-1], 4)


def test_a_full_disk_leaves_the_frames_before(path, monkeypatch):
    def no_space(self, pages):
        raise OSError(28, "No space left on device")

    file = ResultFile(path, "a")
    monkeypatch.setattr(SafeFile, "_write_journal", no_space)
    with pytest.raises(SimulationError, match="results-not-written"):
        file.append(90, 9.0, "press", *powder(3, *SIZES[3]))
    with Results(path) as results:
        assert len(results) == len(SIZES)
        assert_is_frame(results[-1], 4)


class KillAt:
    """Stands for the file of the operating system; dies at the n-th change."""

    def __init__(self, file, budget):
        self.file, self.budget = file, budget

    def __getattr__(self, name):
        return getattr(self.file, name)

    def _spend(self):
        self.budget[0] -= 1
        if self.budget[0] < 0:
            self.file.flush()
            os._exit(9)

    def write(self, data):
        self._spend()
        half = len(data) // 2
        self.file.write(data[:half])
        self._spend()
        return half + self.file.write(data[half:])

    def truncate(self, size=None):
        self._spend()
        return self.file.truncate(size)


def append_and_die(path, budget):
    """In a child process: append a frame, dying at change number `budget`."""
    child = os.fork()
    if child:
        return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    try:
        left = [budget]
        original = SafeFile.__init__
        rename, unlink = Path.replace, Path.unlink

        def opening(self, *args, **options):
            original(self, *args, **options)
            self._file = KillAt(self._file, left)

        def dying(action):
            def act(self, *args, **options):
                left[0] -= 1
                if left[0] < 0:
                    os._exit(9)
                return action(self, *args, **options)

            return act

        SafeFile.__init__ = opening
        Path.replace, Path.unlink = dying(rename), dying(unlink)
        ResultFile(path, "a").append(30, 0.3, "press", *powder(3, *SIZES[3]))
        os._exit(0)
    except BaseException:
        os._exit(5)


@pytest.fixture
def base(tmp_path):
    file = ResultFile(tmp_path / "base.vtkhdf", provenance={})
    for k in range(3):
        file.append(10 * k, k / 10, "fill", *powder(k, *SIZES[k]))
    return tmp_path / "base.vtkhdf"


@pytest.mark.parametrize("stride", [41, pytest.param(1, marks=pytest.mark.slow)])
def test_killed_at_any_change_of_the_file(base, monkeypatch, stride):
    monkeypatch.setattr(os, "fsync", lambda number: None)  # slow, and not the point
    seen, budget, code = set(), 0, 9
    while code:
        path = base.with_name("killed.vtkhdf")
        journal_path(path).unlink(missing_ok=True)
        shutil.copy(base, path)
        code = append_and_die(path, budget)
        assert code in (0, 9)
        with Results(path) as results:  # without touching the file
            frames = len(results)
            for k, frame in enumerate(results):
                assert_is_frame(frame, k)
        seen.add((frames, journal_path(path).exists()))
        again = ResultFile(path, "a")
        again.truncate_after(20)
        again.append(30, 3 / 10, "press", *powder(3, *SIZES[3]))
        with Results(path) as results:
            assert len(results) == 4
            assert_is_frame(results[3], 3)
        budget += stride
    assert seen == {(3, False), (4, True), (4, False)}


@pytest.mark.parametrize("length", [0, 5, 8, 100, 600, 5000, -4000, -1])
def test_a_truncated_file_is_a_clear_error(path, length):
    data = path.read_bytes()
    path.write_bytes(data[:length])
    with pytest.raises(InputError) as caught, Results(path) as results:
        list(results)
    assert caught.value.id.startswith("results-")
    assert str(path) in str(caught.value)


def test_a_damaged_file_never_ends_in_another_error(path):
    data = bytearray(path.read_bytes())
    rng = np.random.default_rng(3)
    for _ in range(60):
        broken = bytearray(data)
        start = int(rng.integers(0, 20000))
        broken[start : start + 64] = rng.bytes(64)
        path.write_bytes(broken)
        try:
            with Results(path) as results:
                list(results)
        except InputError:
            pass


def test_foreign_files_are_refused(tmp_path):
    path = tmp_path / "results.vtkhdf"
    with pytest.raises(InputError, match="results-missing"):
        Results(path)
    path.write_text("not HDF5")
    with pytest.raises(InputError, match="results-foreign"):
        Results(path)
    with h5py.File(path, "w") as file:
        file["x"] = [1, 2]
    with pytest.raises(InputError, match="results-foreign"):
        ResultFile(path, "a")
    with pytest.raises(InputError, match="results-missing"):
        Results(tmp_path)


def test_an_array_larger_than_the_file_is_refused(path):
    with h5py.File(path, "r+") as file:
        file["VTKHDF/Points"].resize(10**13, axis=0)
        file["pestle/frames/particles"][0] = 10**12
    with pytest.raises(InputError, match="than the file can hold"):
        Results(path)


def test_a_newer_schema_is_refused_by_number(path):
    with h5py.File(path, "r+") as file:
        file["pestle"].attrs["schema_version"] = 99
    with pytest.raises(InputError, match="results-newer"):
        Results(path)
