"""--set: paths, their ends, values."""

import pytest

from broken_cases import CASE
from pestle.config import Case
from pestle.errors import EnergyWarning, InputError

MOVE = """
[[process]]
step = "move"
walls = ["upper_punch"]
at = "1 m/s"
to = "1 mm"
"""


@pytest.fixture
def read(tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(CASE + MOVE)
    return lambda *overrides: Case.from_file(path, list(overrides))


def test_a_full_path(read):
    assert read("law.psi_b=0.3").law.options["psi_b"] == 0.3


def test_the_last_key_is_enough(read):
    case = read("psi_b=0.3", "seed=7", "checkpoint_every=5", "safety=0.1")
    assert case.law.options["psi_b"] == 0.3
    assert (case.seed, case.output.checkpoint_every, case.engine.safety) == (7, 5, 0.1)


def test_a_key_that_the_file_does_not_have(read):
    with pytest.warns(EnergyWarning):
        case = read("turn_at=0.5 mm", "radius_rule=eq37")
    assert case.process[-1].turn_at == 0.0005
    assert case.law.options["radius_rule"] == "eq37"


def test_the_file_wins_where_the_schema_has_more(read):
    """work_of_adhesion stands once in the file, though a pair could have it too."""
    assert read("work_of_adhesion=5").contacts.work_of_adhesion == 5.0
    assert read("surface_energy=5 J/m^2").contacts.work_of_adhesion == 5.0


def test_steps_answer_to_their_word_and_number(read):
    assert read("process.press.at=2").process[1].at == 2.0
    assert read("press.at=2 m/s").process[1].at == 2.0
    assert read("process.3.at=2 m/s").process[3].at == 2.0


def test_a_target_replaces_the_target(read):
    press = read("press.to=30 N").process[1]
    assert (press.to_stress, press.to_force) == (None, 30.0)
    assert read("press.to_displacement=1 mm").process[1].to_displacement == 0.001


def test_one_damping_replaces_the_other(read):
    contacts = read("contacts.damping_ratio=0.2").contacts
    assert (contacts.restitution, contacts.damping_ratio) == (None, 0.2)


def test_a_table_may_be_set(read):
    sizes = '{ distribution = "normal", mean = "150 um", deviation = "20 um" }'
    case = read(f"particles.radius={sizes}")
    assert case.particles[0].radius.distribution == "normal"


def test_a_material_answers_to_its_name(read):
    assert read("powder.poisson_ratio=0.2").materials["powder"].poisson_ratio == 0.2


def test_values_from_python(tmp_path):
    (tmp_path / "case.toml").write_text(CASE)
    case = Case.from_file(tmp_path / "case.toml", {"law.psi_b": 0.3, "title": "a = b"})
    assert case.law.options["psi_b"] == 0.3
    assert case.title == "a = b"


def test_an_error_points_to_the_option(read):
    with pytest.raises(InputError) as caught:
        read("engine.safety=2")
    assert caught.value.where == "--set engine.safety"


def test_an_ambiguous_key_lists_what_it_means(read):
    with pytest.raises(InputError) as caught:
        read("at=2")
    assert "process.1.at, process.3.at" in caught.value.hint
