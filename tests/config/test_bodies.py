"""[walls.*] of kind mesh and blade: read, refused, repaired, made."""

import numpy as np
import pytest
import trimesh

from pestle.config import Case
from pestle.config.bodies import mesh_hash
from pestle.errors import InputError

CASE = """
law.name = "hertz"
[materials.powder]
youngs_modulus = "5 MPa"
poisson_ratio = 0.3
density = 1500
[materials.tool]
rigid = true
[contacts]
sliding_friction = 0.5
restitution = 0.5
[particles]
material = "powder"
count = 30
radius = "0.5 mm"
[die]
radius = "5 mm"
height = "40 mm"
material = "tool"
[walls.body]
{wall}
material = "tool"
[[process]]
step = "fill"
[[process]]
{step}
"""
MESH = 'kind = "mesh"\nfile = "body.{kind}"\nunit = "1 mm"'
CARRY = (
    'step = "carry"\nwall = "body"\n'
    'program = [["0 s", 0, 0, "1 cm/s", 0, 0, "60 rpm"], ["2 ms", 0, 0, 0, 0, 0, 0]]'
)
STIR = """step = "stir"
wall = "body"
tip_speed = "0.1 m/s"
helix_angle = "5 deg"
to = "2 mm"
"""
BLADE = """kind = "blade"
diameter = "9 mm"
chord = "3 mm"
thickness = "0.5 mm"
tip_angle = "30 deg"
shaft_diameter = "1.5 mm"
shaft_height = "20 mm"
"""


def case(folder, mesh=None, *, wall=MESH, step=CARRY, kind="stl", more=""):
    """Write a mesh and a case that names it, and read the case."""
    if mesh is not None:
        mesh.export(folder / f"body.{kind}")
    text = CASE.format(wall=wall.format(kind=kind) + more, step=step)
    path = folder / "case.toml"
    path.write_text(text, encoding="utf-8")
    return Case.from_file(path)


def cube(**options):
    return trimesh.creation.box((3.0, 2.0, 4.0), **options)


def refused(folder, mesh, **options):
    with pytest.raises(InputError) as error:
        case(folder, mesh, **options)
    return error.value


@pytest.mark.parametrize("kind", ["stl", "ply", "obj"])
def test_all_formats_give_the_same_body(tmp_path, kind):
    vertices, faces = case(tmp_path, cube(), kind=kind).surface("body")
    assert (len(vertices), len(faces)) == (8, 12)
    np.testing.assert_allclose(np.ptp(vertices, axis=0), [3e-3, 2e-3, 4e-3], rtol=1e-6)


def test_rows_of_a_program_have_units(tmp_path):
    program = case(tmp_path, cube()).process[1].program
    assert program[0][3] == pytest.approx(0.01)
    assert program[0][6] == pytest.approx(2 * np.pi)


def test_double_vertices_and_triangles_are_merged(tmp_path):
    mesh = cube()
    soup = trimesh.Trimesh(
        mesh.vertices[mesh.faces].reshape(-1, 3),
        np.arange(36).reshape(-1, 3),
        process=False,
    )
    twice = trimesh.Trimesh(
        soup.vertices, np.concatenate([soup.faces, soup.faces[:3]]), process=False
    )
    vertices, faces = case(tmp_path, twice).surface("body")
    assert (len(vertices), len(faces)) == (8, 12)


def test_winding_does_not_matter(tmp_path):
    mesh = cube()
    mesh.invert()
    assert len(case(tmp_path, mesh).surface("body")[1]) == 12


def test_holes_are_refused_unless_it_is_a_sheet(tmp_path):
    mesh = cube()
    mesh.update_faces(np.arange(12) > 0)
    assert refused(tmp_path, mesh).id == "mesh-holes"
    assert len(case(tmp_path, mesh, more="\nopen = true").surface("body")[1]) == 11


def test_edges_of_three_triangles_are_refused(tmp_path):
    mesh = cube()
    fin = trimesh.Trimesh(
        [*mesh.vertices, [9.0, 9.0, 9.0]],
        [*mesh.faces, [*mesh.faces[0][:2], 8]],
        process=False,
    )
    assert refused(tmp_path, fin).id == "mesh-not-manifold"


def test_triangles_without_area_are_refused(tmp_path):
    mesh = cube()
    a, b, c = mesh.faces[0]
    middle = 0.5 * (mesh.vertices[a] + mesh.vertices[b])
    faces = [*mesh.faces[1:], [a, 8, c], [8, b, c], [a, b, 8]]
    thin = trimesh.Trimesh([*mesh.vertices, middle], faces, process=False)
    assert refused(tmp_path, thin, kind="ply").id == "mesh-zero-area"


@pytest.mark.parametrize("unit", ["1 m", "1 nm"])
def test_wrong_units_are_noticed(tmp_path, unit):
    error = refused(tmp_path, cube(), wall=MESH.replace("1 mm", unit))
    assert error.id == "mesh-size"
    assert "unit" in error.where


@pytest.mark.parametrize(
    "data", [b"", b"solid nothing\nendsolid", b"\x00" * 200, b"\xff" * 84 + b"\x07"]
)
def test_damaged_files_are_refused(tmp_path, data):
    (tmp_path / "body.stl").write_bytes(data)
    assert refused(tmp_path, None).id in ("mesh-unreadable", "mesh-size")


def test_other_files_and_missing_ones_are_refused(tmp_path):
    assert refused(tmp_path, None).id == "unreadable"
    assert refused(tmp_path, None, kind="step").id == "mesh-format"


def test_the_content_of_the_mesh_is_part_of_the_case(tmp_path):
    one = case(tmp_path, cube())
    before, text = mesh_hash(one), one.canonical()
    assert case(tmp_path, cube()).canonical() == text
    other = case(tmp_path, trimesh.creation.box((3.0, 2.0, 5.0)))
    assert mesh_hash(other) != before
    assert other.canonical() != text


def test_a_case_written_reads_the_same(tmp_path):
    one = case(tmp_path, cube())
    again = tmp_path / "deep" / "again.toml"
    again.parent.mkdir()
    again.write_text(one.to_toml(), encoding="utf-8")
    assert Case.from_file(again).canonical() == one.canonical()


def test_a_blade_is_closed_and_has_its_measures(tmp_path):
    vertices, faces = case(tmp_path, wall=BLADE, step=STIR).surface("body")
    mesh = trimesh.Trimesh(vertices, faces, process=False)
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    assert np.hypot(*vertices[:, :2].T).max() == pytest.approx(4.5e-3, rel=1e-12)
    assert vertices[:, 2].min() == pytest.approx(-1.5e-3, rel=0.05)
    wings, shaft = sorted(mesh.split(), key=lambda part: part.extents[2])
    assert wings.volume == pytest.approx(9e-3 * 3e-3 * 0.5e-3, rel=0.03)
    assert shaft.volume > 0.0
    # anticlockwise, what looks forward pushes the powder down
    for side in (1.0, -1.0):
        far = side * wings.triangles_center[:, 0] > 3e-3
        forward = far & (side * wings.face_normals[:, 1] > 0.3)
        push = wings.area_faces[forward] @ wings.face_normals[forward]
        assert push[2] < -0.5 * side * push[1] < 0.0


@pytest.mark.parametrize(
    ("old", "new", "id_"),
    [
        ('"0.5 mm"', '"5 mm"', "contradiction"),
        ('"20 mm"', '"1 mm"', "contradiction"),
        ('"30 deg"', '"95 deg"', "out-of-range"),
    ],
)
def test_impossible_blades_are_refused(tmp_path, old, new, id_):
    wall = BLADE.replace(f"thickness = {old}", f"thickness = {new}")
    wall = wall.replace(f"height = {old}", f"height = {new}")
    wall = wall.replace(f"angle = {old}", f"angle = {new}")
    assert refused(tmp_path, None, wall=wall).id == id_


def test_steps_name_bodies_that_they_can_move(tmp_path):
    assert refused(tmp_path, cube(), step=STIR).id == "wrong-wall"
    assert (
        refused(tmp_path, cube(), step=CARRY.replace("body", "bdy")).id
        == "unknown-wall"
    )
    late = CARRY.replace('"0 s"', '"1 ms"')
    assert refused(tmp_path, cube(), step=late).id == "contradiction"
