"""One powder is a table, several are an array of tables or a column of a file."""

import json

import pytest

from broken_cases import CASE
from pestle.config import Case
from pestle.errors import InputError

TABLE = '[particles]\nmaterial = "powder"\ncount = 1000\nradius = "150 um"\n'
SOFT = """
[materials.soft]
youngs_modulus = "1 GPa"
poisson_ratio = 0.3
density = "1200 kg/m^3"
yield_stress = "20 MPa"
"""
TWO = (
    SOFT
    + """
[[particles]]
material = "powder"
count = 300
radius = "150 um"
[[particles]]
material = "soft"
count = 200
radius = { distribution = "normal", mean = "120 um", deviation = "10 um" }
"""
)
FILE = SOFT + '[particles]\nfile = "a.csv"\n'
HEADER = "id,radius_m,density_kg_m3,x_m,y_m,z_m,material\n"
ROWS = (
    HEADER + "1,1e-4,1500,0,0,1e-3,soft\n2,1e-4,1500,0,0,2e-3,powder\n"
    "3,1e-4,1500,0,0,3e-3,soft\n"
)
BARE = ROWS.replace(",material", "").replace(",soft", "").replace(",powder", "")


@pytest.fixture
def read(tmp_path):
    def read(particles, *settings, rows=None, name="case.toml"):
        text = CASE.replace(TABLE, particles)
        assert text != CASE
        if rows is not None:
            (tmp_path / "a.csv").write_text(rows)
            text = text.replace('[[process]]\nstep = "fill"\n', "")
        (tmp_path / name).write_text(text)
        return Case.from_file(tmp_path / name, list(settings))

    return read


def refused(read, *arguments, **options):
    with pytest.raises(InputError) as caught:
        read(*arguments, **options)
    return caught.value


def test_one_powder_is_wrapped(read):
    one = read(TABLE + "\n")
    array = read(TABLE.replace("[particles]", "[[particles]]"))
    assert len(one.particles) == 1
    assert one.canonical() == array.canonical()
    assert one.powders == ("powder",)
    assert "\n[particles]\n" in one.to_toml()


def test_several_powders(read, tmp_path):
    case = read(TWO)
    assert [p.count for p in case.particles] == [300, 200]
    assert case.powders == ("powder", "soft")
    assert case.is_generated
    copy = tmp_path / "copy.toml"
    copy.write_text(case.to_toml())
    assert Case.from_file(copy).canonical() == case.canonical()


def test_two_sizes_of_one_powder(read):
    case = read(TWO.replace('material = "soft"', 'material = "powder"'))
    assert len(case.particles) == 2
    assert case.powders == ("powder",)


def test_a_powder_answers_to_its_material_and_number(read):
    assert read(TWO, "particles.soft.count=7").particles[1].count == 7
    assert read(TWO, "particles.0.count=7").particles[0].count == 7


def test_an_error_points_into_the_right_powder(read):
    broken = CASE.replace(TABLE, TWO).replace("count = 200", "count = 0")
    line = broken.splitlines().index("count = 0") + 1
    error = refused(read, TWO.replace("count = 200", "count = 0"))
    assert error.where.endswith(f":{line}  particles.1.count")


def test_an_error_points_to_the_only_powder_of_an_array(read):
    array = TABLE.replace("[particles]", "[[particles]]").replace("1000", "100000")
    line = CASE.splitlines().index("[particles]") + 1
    assert f":{line}  particles" in refused(read, array).where


def test_an_unknown_material_is_found_in_every_powder(read):
    error = refused(read, TWO.replace('material = "soft"', 'material = "sofd"'))
    assert error.id == "unknown-material"
    assert error.where.endswith("particles.1.material")
    assert "soft" in error.hint


def test_every_powder_needs_what_the_law_needs(read):
    error = refused(read, TWO.replace('yield_stress = "20 MPa"\n', ""))
    assert error.where.endswith("materials.soft.yield_stress")


def test_all_powders_together_must_fit(read):
    error = refused(read, TWO.replace("count = 200", "count = 9000"))
    assert error.id == "overfull"
    assert "9300 particles" in error.what


def test_all_powders_together_are_bounded(read):
    million = TWO.replace("count = 300", "count = 1e8")
    error = refused(read, million)
    assert error.id == "out-of-range"
    assert "100000200" in error.what


def test_the_largest_particle_of_any_powder_must_fit(read):
    error = refused(read, TWO.replace('"120 um"', '"3 mm"'))
    assert error.id == "die-too-small"


def test_read_and_generated_particles_do_not_mix(read):
    mixed = TWO.replace('count = 300\nradius = "150 um"', 'file = "a.csv"')
    error = refused(read, mixed)
    assert error.id == "contradiction"
    assert error.where.endswith("particles.0.file")


def test_a_file_may_hold_several_powders(read):
    case = read(FILE, rows=ROWS)
    assert case.powders == ("soft", "powder")
    assert case.read_particles().material.tolist() == [0, 1, 0]


@pytest.mark.parametrize(
    ("particles", "rows", "words"),
    [
        (FILE, ROWS.replace("powder", "powdr"), ["powdr", "a.csv:3", "powder"]),
        (FILE, ROWS.replace("powder", "tool"), ["rigid", "a.csv"]),
        (FILE + 'material = "soft"\n', ROWS, ["both", "a.csv:1"]),
        (FILE, BARE, ["nowhere", "material"]),
        (FILE.replace('yield_stress = "20 MPa"\n', ""), ROWS, ["yield_stress", "soft"]),
    ],
    ids=["unknown", "rigid", "twice", "never", "no yield stress"],
)  # fmt: skip
def test_the_column_material_is_checked(read, particles, rows, words):
    error = str(refused(read, particles, rows=rows))
    for word in words:
        assert word in error


def test_generated_particles_need_a_material(read):
    error = refused(read, TABLE.replace('material = "powder"\n', "\n"))
    assert error.id == "missing-key"
    assert error.where.endswith("particles.material")


def test_each_powder_brings_the_contacts_of_its_set():
    name = "scaled_tableting_zunker2025"
    case = Case(
        law="hertz",
        materials={
            "one": {"set": name},
            "two": {"set": "avicel_ph102_zunker2025"},
            "tool": {"rigid": True},
        },
        contacts={"restitution": 0.5},
        particles=[
            {"material": material, "count": 10, "radius": "1 mm"}
            for material in ("one", "two")
        ],
        box={"lengths": ["10 mm", "10 mm", "10 mm"]},
        process=[{"step": "relax", "for": "1 ms"}],
    )
    assert case.pair("one", "one").work_of_adhesion == 2.0
    assert case.pair("two", "two").work_of_adhesion == 310.0
    assert case.pair("one", "two").work_of_adhesion == 0.0
    assert case.pair("one", "tool").sliding_friction == 0.1


def test_the_canonical_text_holds_the_content_of_the_file(read, tmp_path):
    one = read(FILE, rows=ROWS).canonical()
    (tmp_path / "b.csv").write_text(ROWS)
    same = read(FILE.replace("a.csv", "b.csv"), rows=ROWS).canonical()
    other = read(FILE, rows=ROWS.replace("3e-3", "4e-3")).canonical()
    assert one == same
    assert one != other


def test_an_earlier_run_says_its_powders(read, tmp_path):
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / "checkpoint.npz").write_bytes(b"")
    record = tmp_path / "run" / "provenance.json"
    text = SOFT + '[particles]\nstart_from = "run"\n'
    assert refused(read, text, rows="").id == "no-such-file"
    record.write_text("{}")
    assert refused(read, text, rows="").id == "provenance-damaged"
    record.write_text(json.dumps({"particle_materials": ["soft", "powder"]}))
    assert read(text, rows="").powders == ("soft", "powder")
    record.write_text(json.dumps({"particle_materials": ["sand"]}))
    assert refused(read, text, rows="").id == "unknown-material"
