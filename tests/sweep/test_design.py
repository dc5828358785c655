"""Points of a study, and files that are refused."""

import numpy as np
import pytest

from pestle.errors import InputError
from pestle.sweep import planned, points
from sweep.studies import STUDY, write

HEAD = 'case = "case.toml"\n'


def test_a_grid_is_every_combination(tmp_path):
    found = points(write(tmp_path))
    assert len(found) == 6
    assert found[1] == {
        "contacts.restitution": 0.3,
        "materials.powder.youngs_modulus": 5e6,
    }


def test_an_interval_in_a_grid_has_its_unit(tmp_path):
    text = 'vary.youngs_modulus = {low="1 MPa", high="0.1 GPa", scale="log", points=3}'
    found = [p["youngs_modulus"] for p in points(write(tmp_path, HEAD + text))]
    values = [float(text.removesuffix(" Pa")) for text in found]
    assert values == pytest.approx([1e6, 1e7, 1e8])


@pytest.mark.parametrize("design", ["latin_hypercube", "sobol"])
def test_a_spread_has_one_point_in_every_layer(tmp_path, design):
    text = f'{HEAD}design = "{design}"\nsamples = 8\n'
    text += "vary.restitution = {low=0.1, high=0.9}\nvary.seed = [5, 6]\n"
    study = write(tmp_path, text)
    found = points(study)
    layers = [int(8 * (p["restitution"] - 0.1) / 0.8) for p in found]
    assert sorted(layers) == list(range(8))
    assert np.bincount([p["seed"] for p in found]).tolist() == [0] * 5 + [4, 4]
    assert points(study) == found


def test_replicates_differ_by_their_seed(tmp_path):
    rows = planned(write(tmp_path, f"replicates = 2\n{STUDY}"), tmp_path / "out")
    assert [row.seed for row in rows[:4]] == [1, 2, 1, 2]
    assert len({row.job.id for row in rows}) == 12


def test_equal_cases_share_a_run(tmp_path):
    text = f'{HEAD}vary.youngs_modulus = ["5 MPa", 5e6]'
    first, second = planned(write(tmp_path, text), tmp_path / "out")
    assert first.job.id == second.job.id


def test_a_case_that_is_refused_is_a_failure_of_its_own(tmp_path):
    text = f"{HEAD}vary.poisson_ratio = [0.3, 0.6]"
    good, bad = planned(write(tmp_path, text), tmp_path / "out")
    assert good.job is not None
    assert bad.outcome.status == "failed"
    assert "out-of-range" in bad.outcome.reason


@pytest.mark.parametrize(
    ("text", "id"),
    [
        ("vary.restitutionn = [0.1]", "unknown-key"),
        ("vary.restitution = []", "missing-key"),
        ("vary.restitution = {low=0.9, high=0.1, points=2}", "empty-bounds"),
        ("vary.restitution = {low=0.1, high=0.9}", "contradiction"),
        ('vary.youngs_modulus = {low="1 m", high="2 Pa", points=2}', "wrong-unit"),
        ("samples = 4\nvary.restitution = [0.1]", "contradiction"),
        ('design = "sobol"\nvary.restitution = [0.1]', "missing-key"),
        ('design="sobol"\nsamples=6\nvary.restitution=[0.1]', "not-a-power-of-two"),
        ("replicates = 2\nvary.seed = [1, 2]", "contradiction"),
        ("replicates = 90000\nvary.restitution = [0.1, 0.2]", "too-many-runs"),
        ("vary.poisson_ratio = [0.6]", "no-valid-run"),
        ('design = "cube"\nvary.restitution = [0.1]', "unknown-choice"),
    ],
)
def test_what_cannot_be_meant_is_refused(tmp_path, text, id):
    with pytest.raises(InputError) as error:
        planned(write(tmp_path, HEAD + text), tmp_path / "out")
    assert error.value.id == id
