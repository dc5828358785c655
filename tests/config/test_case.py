"""Case files become SI floats; the same objects are built from Python."""

import math
from contextlib import suppress

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import pestle
from broken_cases import CASE
from pestle.config import (
    Case,
    CylinderWall,
    DieSettings,
    Fill,
    Hold,
    Move,
    PlaneWall,
    Press,
    SizeDistribution,
)
from pestle.errors import InputError
from pestle.laws import Zunker2024

POWDER = {
    "youngs_modulus": "1 GPa",
    "poisson_ratio": 0.3,
    "density": 1000,
    "yield_stress": "10 MPa",
}


@pytest.fixture
def path(tmp_path):
    (tmp_path / "case.toml").write_text(CASE)
    return tmp_path / "case.toml"


def small(**changes):
    """The smallest case: two walls, one step, whatever is changed."""
    case = {
        "law": "hertz",
        "materials": {"powder": POWDER, "tool": {"rigid": True}},
        "contacts": {"restitution": 0.5},
        "particles": {"material": "powder", "count": 10, "radius": "1 mm"},
        "box": {"lengths": ["10 mm", "10 mm", "10 mm"]},
        "process": [{"step": "relax", "for": "1 ms"}],
    }
    return Case(**{**case, **changes})


def test_a_file_becomes_si_floats(path):
    case = Case.from_file(path)
    assert case.source == path
    assert case.materials["powder"].youngs_modulus == 8.75e9
    assert case.particles[0].count == 1000
    assert case.particles[0].radius.mean == 0.00015
    assert case.die.radius == 0.0016
    assert case.engine.gravity == (0.0, 0.0, -9.81)
    assert case.engine.time_step == "auto"
    fill, press, hold, _ = case.process
    assert isinstance(fill, Fill)
    assert isinstance(press, Press)
    assert (press.to_stress, press.to_force, press.to_displacement) == (
        1.5e8,
        None,
        None,
    )
    assert (press.at, press.wall) == (1.0, "upper_punch")
    assert isinstance(hold, Hold)
    assert hold.duration == 1e-4


@pytest.mark.parametrize(
    ("to", "attribute", "value"),
    [
        ("150 MPa", "to_stress", 1.5e8),
        ("30 N", "to_force", 30.0),
        ("2 mm", "to_displacement", 0.002),
    ],
)
def test_the_unit_of_a_target_tells_what_it_is(to, attribute, value):
    assert getattr(Press(to=to, at=1), attribute) == value


def test_the_law_is_built():
    case = small(law={"name": "mdr", "psi_b": 0.4})
    assert case.law.name == "zunker2024"
    assert case.law.build() == Zunker2024(psi_b=0.4)


def test_a_law_may_be_an_object():
    law = Zunker2024(psi_b=0.3)
    case = small(law=law)
    assert case.law.build() is law
    assert case.law.options["psi_b"] == 0.3


def test_pairs_override_the_default(path):
    case = Case.from_file(path)
    wall = case.pair("tool", "powder")
    assert wall == case.pair("powder", "tool")
    assert (wall.sliding_friction, wall.restitution) == (0.1, 0.5)
    assert wall.work_of_adhesion == 300.0
    assert case.pair("powder", "powder").sliding_friction == 0.5


def test_a_pair_may_damp_in_the_other_way():
    pairs = [{"between": ["powder", "tool"], "damping_ratio": 0.2}]
    case = small(contacts={"restitution": 0.5, "pairs": pairs})
    pair = case.pair("powder", "tool")
    assert (pair.restitution, pair.damping_ratio) == (None, 0.2)


@pytest.mark.parametrize("name", ["surface_energy", "effective_surface_energy"])
def test_work_of_adhesion_has_aliases(name):
    case = small(contacts={"restitution": 0.5, name: "2 J/m^2"})
    assert case.contacts.work_of_adhesion == 2.0


SET = "scaled_tableting_zunker2025"


def test_a_material_set_fills_what_the_case_leaves_out():
    materials = {"powder": {"set": SET, "poisson_ratio": 0.35}, "tool": {"rigid": True}}
    case = small(materials=materials)
    assert case.materials["powder"].youngs_modulus == 5e6
    assert case.materials["powder"].poisson_ratio == 0.35
    assert case.pair("powder", "powder").sliding_friction == 0.7
    assert case.pair("powder", "powder").work_of_adhesion == 2.0
    assert case.pair("powder", "tool").sliding_friction == 0.1
    assert case.pair("powder", "tool").work_of_adhesion == 0.0


def test_the_case_wins_over_a_material_set():
    materials = {"powder": {"set": SET}, "tool": {"rigid": True}}
    pairs = [{"between": ["tool", "powder"], "work_of_adhesion": 3}]
    contacts = {"restitution": 0.5, "sliding_friction": 0.2, "pairs": pairs}
    case = small(materials=materials, contacts=contacts)
    assert case.pair("powder", "powder").sliding_friction == 0.2
    assert case.pair("powder", "tool").sliding_friction == 0.2
    assert case.pair("powder", "tool").work_of_adhesion == 3.0


def test_a_die_makes_walls():
    walls = DieSettings(radius="2 mm", height="8 mm", material="tool").walls()
    assert list(walls) == ["die", "lower_punch", "upper_punch"]
    assert isinstance(walls["die"], CylinderWall)
    assert walls["upper_punch"].point == (0.0, 0.0, 0.008)
    assert walls["upper_punch"].normal == (0.0, 0.0, -1.0)


def test_normals_become_unit_vectors():
    wall = PlaneWall(point=[0, 0, 0], normal=[3, 0, 4], material="tool")
    assert wall.normal == pytest.approx((0.6, 0.0, 0.8))


@pytest.mark.parametrize("kind", ["normal", "lognormal"])
def test_tails_are_cut_by_default(kind):
    sizes = SizeDistribution(distribution=kind, mean="150 um", deviation="20 um")
    assert (sizes.minimum, sizes.maximum) == pytest.approx((1e-4, 2e-4))


def test_a_uniform_distribution_needs_only_its_limits():
    sizes = SizeDistribution(distribution="uniform", minimum="1 mm", maximum="3 mm")
    assert sizes.mean == pytest.approx(0.002)
    assert sizes.deviation == pytest.approx(0.002 / math.sqrt(12))


def test_turning_needs_no_target():
    move = Move(at="1 m/s", turn_at="0.35 m")
    assert (move.turn_at, move.back_to, move.to) == (0.35, 0.0, None)


def test_stages_have_unique_names():
    relax = {"step": "relax", "for": 1}
    case = small(process=[relax, {**relax, "name": "rest"}, relax])
    assert case.stage_names == ("relax", "rest", "relax 2")


def test_a_case_cannot_be_changed(path):
    case = Case.from_file(path)
    with pytest.raises(ValueError, match="frozen"):
        case.seed = 2


def test_the_canonical_text_does_not_depend_on_the_spelling(tmp_path):
    other = CASE.replace('"8.75 GPa"', "8.75e9").replace('"1.6 mm"', "0.0016")
    for name, text in (("a.toml", CASE), ("b.toml", other)):
        (tmp_path / name).write_text(text)
    one, two = (Case.from_file(tmp_path / name) for name in ("a.toml", "b.toml"))
    assert one.canonical() == two.canonical()
    assert one.canonical() != one.from_file(tmp_path / "a.toml", ["seed=2"]).canonical()


def test_the_copy_of_a_case_is_the_same_case(path):
    extra = {"title": 'a "quoted"\n\ttitle \x7f ü', "process.press.name": "main"}
    case = Case.from_file(path, extra)
    copy = path.with_name("copy.toml")
    copy.write_text(case.to_toml(), encoding="utf-8")
    again = Case.from_file(copy)
    assert again.canonical() == case.canonical()
    assert again.to_toml() == case.to_toml()


def test_particles_are_read_relative_to_the_case(path):
    rows = "id,radius_m,density_kg_m3,x_m,y_m,z_m\n3,1e-4,1500,0,0,1e-3\n"
    (path.parent / "a.csv").write_text(rows)
    text = CASE.replace('count = 1000\nradius = "150 um"', 'file = "a.csv"')
    path.write_text(text.replace('[[process]]\nstep = "fill"\n', ""))
    case = Case.from_file(path)
    table = case.read_particles()
    assert table.id.tolist() == [3]
    assert table.position.tolist() == [[0.0, 0.0, 0.001]]
    assert str(path.parent / "a.csv") in case.to_toml()


def test_python_gets_the_same_errors():
    with pytest.raises(InputError) as caught:
        small(contacts={"restituton": 0.5})
    assert caught.value.where == "contacts.restituton"
    assert "restitution" in caught.value.hint


def test_the_package_offers_the_case():
    assert pestle.Case is Case


keys = st.sampled_from(
    [*Case.model_fields, "name", "step", "to", "at", "radius", "kind", "pairs", "set"]
)
values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.dictionaries(keys | st.text(max_size=5), inner, max_size=4)
    ),
    max_leaves=12,
)


@settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(st.dictionaries(keys, values, max_size=8))
def test_whatever_is_given_the_error_is_an_input_error(data):
    with suppress(InputError):
        small(**data)
