"""Calibrations find what the data were made with, and say what they cannot know."""

import json
import tomllib
from contextlib import nullcontext
from importlib import util
from pathlib import Path

import numpy as np
import pytest
from scipy.stats import multivariate_normal

from pestle.calibrate import calibrate, require, runs
from pestle.calibrate.likelihood import Likelihood
from pestle.calibrate.posterior import sample, values_at, warnings
from pestle.calibrate.runs import Measured, outputs_of
from pestle.calibrate.surrogate import indices, left_out, train
from pestle.config.calibration import CalibrationSettings, Parameter
from pestle.config.study import read_settings
from pestle.errors import InputError
from pestle.sweep import Outcome

EXAMPLE = Path(__file__).parents[2] / "examples" / "calibrate_mcc.toml"
TWO = {"a": Parameter(low=0.0, high=1.0), "b": Parameter(low=0.0, high=1.0)}


def test_one_particle_end_to_end(tmp_path):
    settings = read_settings(CalibrationSettings, EXAMPLE)
    numbers = calibrate(settings, tmp_path)
    found = numbers["parameters"]
    assert found["yield_stress"]["value"] == pytest.approx(2e7, rel=0.02)
    assert found["youngs_modulus"]["value"] == pytest.approx(5e9, rel=0.2)
    least = numbers["least_squares"]["interval_95"]
    for name, row in found.items():
        width = np.ptp(row["interval_95"])
        assert width == pytest.approx(np.ptp(least[name]), rel=0.15), name
    material = tomllib.loads((tmp_path / "material.toml").read_text())["material"]
    assert material["yield_stress"]["source"] == settings.source
    assert material["poisson_ratio"]["value"] == 0.3
    assert "<svg" in (tmp_path / "report.html").read_text()
    json.loads((tmp_path / "calibration.json").read_text())


def test_a_chain_finds_a_normal_density():
    sigma = np.array([0.02, 0.05])
    found = sample(
        TWO,
        lambda u: -0.5 * np.sum(((u - 0.5) / sigma) ** 2, axis=1),
        np.array([0.5, 0.5]),
        seed=1,
    )
    assert found.median == pytest.approx([0.5, 0.5], abs=0.01)
    assert np.std(found.shares, axis=0) == pytest.approx(sigma, rel=0.1)
    assert found.effective > 300
    assert warnings(found) == []


def test_what_cannot_be_known_is_said():
    ridge = sample(
        TWO,
        lambda u: -0.5 * ((u[:, 0] + u[:, 1] - 1.0) / 0.005) ** 2,
        np.array([0.5, 0.5]),
        seed=1,
    )
    told = " ".join(warnings(ridge))
    assert "cannot be told apart" in told
    assert "say little about a" in told


def test_a_short_ridge_is_known_well():
    """Tied to each other, but each narrow: more than a combination is known."""
    ridge = sample(
        TWO,
        lambda u: (
            -0.5
            * (
                ((u[:, 0] + u[:, 1] - 1.0) / 0.005) ** 2
                + ((u[:, 0] - u[:, 1]) / 0.1) ** 2
            )
        ),
        np.array([0.5, 0.5]),
        seed=1,
    )
    (told,) = warnings(ridge)
    assert told.startswith("A combination of a and b is known better")


def test_a_normal_prior_on_a_log_scale_is_one_of_values():
    parameter = Parameter(
        low="1 MPa", high="100 MPa", scale="log", mean="20 MPa", deviation="3 MPa"
    )
    found = sample({"y": parameter}, lambda u: np.zeros(len(u)), np.array([0.6]), 1)
    assert np.mean(found.values) == pytest.approx(2e7, rel=0.03)
    assert np.std(found.values) == pytest.approx(3e6, rel=0.1)


def ishigami_like(u):
    """Two outputs of two inputs; the second ignores b."""
    return np.column_stack([u[:, 0] + 2.0 * u[:, 1] ** 2, np.sin(3.0 * u[:, 0])])


def test_a_surrogate_learns_and_knows_what_matters():
    random = np.random.default_rng(1)
    u, v = random.random((30, 2)), random.random((100, 2))
    surrogate = train(u, ishigami_like(u), seed=1)
    mean, error = surrogate.predict(v)
    for k, model in enumerate(surrogate.models):
        one, deviation = model.predict(v, return_std=True)
        scale = surrogate.scale[k]
        np.testing.assert_allclose(mean[:, k], surrogate.mean[k] + scale * one)
        np.testing.assert_allclose(error[:, k], scale * deviation, rtol=1e-5)
    assert np.abs(mean - ishigami_like(v)).max() < 0.03
    assert error.max() < 0.1
    assert np.abs(left_out(u, ishigami_like(u), surrogate)).max() < 0.2
    total = np.array(indices(surrogate, ("a", "b"), seed=1)["total"])
    assert total[1, 1] < 0.01
    # exact: 1/12 of the first, 4 (1/5 - 1/9) of the second term
    first, second = 1 / 12, 4 * (1 / 5 - 1 / 9)
    assert total[0] == pytest.approx(
        [first / (first + second), second / (first + second)], abs=0.03
    )


def scattering(u, common, seed):
    """Two outputs of one input; a share of their scatter is common to both."""
    noise = np.random.default_rng(seed).normal(0.0, 0.1, (3, len(u)))
    own, both = np.sqrt(1.0 - common), np.sqrt(common)
    return np.column_stack(
        [
            u[:, 0] + own * noise[0] + both * noise[2],
            1.0 + 2.0 * u[:, 0] + own * noise[1] + both * noise[2],
        ]
    )


@pytest.mark.parametrize("common", [0.0, 0.9])
def test_scatter_that_is_common_to_all_numbers_is_known_as_such(common):
    """The likelihood is that of a normal vector; two like numbers tell as one does."""
    u = np.random.default_rng(1).random((60, 1))
    outputs = scattering(u, common, seed=2)
    numbers = [Measured("a", 0.5, 0.01), Measured("b", 2.0, 0.02)]
    surrogate = train(u, outputs, seed=1)
    found = Likelihood.of(numbers, surrogate, u, outputs)
    assert found.correlation[0, 1] == pytest.approx(common, abs=0.15)
    assert found.left_out == pytest.approx([0.1, 0.1], rel=0.25)
    at = np.array([[0.4], [0.55]])
    mean, error = found.predict(at)
    assert (error >= found.left_out).all()
    for k, value in enumerate(found(at)):
        covariance = np.diag([1e-4, 4e-4])
        covariance += found.correlation * np.outer(error[k], error[k])
        exact = multivariate_normal.logpdf([0.5, 2.0], mean[k], covariance)
        assert value - np.log(2.0 * np.pi) == pytest.approx(exact, rel=1e-9)


@pytest.fixture
def made_of_formulas(tmp_path, monkeypatch):
    """A calibration whose runs are formulas: peak = 2 Y, height falls with both."""
    (tmp_path / "case.toml").write_text(
        (EXAMPLE.parent / "small_tablet.toml").read_text()
    )
    jobs = []

    def compute(missing, workers, scheduler=None):
        for job in missing:
            jobs.append(job)
            case = job.case()
            y = case.materials["powder"].yield_stress / 1e8
            f = case.pair("powder", "tool").sliding_friction
            metrics = {"axial": {"value": y + f}, "wall": {"value": y - 0.5 * f}}
            yield job.id, Outcome("done", metrics=metrics)

    monkeypatch.setattr(runs, "finished", compute)

    def make(*metrics: str) -> CalibrationSettings:
        targets = {"axial": 1.5, "wall": 1.05}
        lines = ['source = "formulas"', '[bulk]\ncase = "case.toml"']
        for name in metrics:
            lines.append(
                f'[[bulk.targets]]\nmetric="{name}"\nvalue={targets[name]}\n'
                "deviation = 0.01"
            )
        lines.append(
            '[parameters]\nyield_stress = {low="70 MPa", high="200 MPa"}\n'
            '"contacts.pairs.0.sliding_friction" = {low=0.05, high=0.5}'
        )
        path = tmp_path / "calibration.toml"
        path.write_text("\n".join(lines))
        return read_settings(CalibrationSettings, path)

    return make, jobs


def test_bulk_data_give_both_parameters(tmp_path, made_of_formulas):
    make, jobs = made_of_formulas
    numbers = calibrate(make("axial", "wall"), tmp_path / "out", workers=2)
    y, f = (row["value"] for row in numbers["parameters"].values())
    assert y == pytest.approx(1.2e8, rel=0.02)
    assert f == pytest.approx(0.3, rel=0.1)
    assert numbers["converged"]
    assert len(jobs) == numbers["runs"] <= 60
    assert [job.case().seed for job in jobs] == list(range(1, len(jobs) + 1))
    assert numbers["warnings"] == []
    assert "Sobol" in (tmp_path / "out" / "report.html").read_text()


def test_a_seed_that_is_set_is_that_of_all_runs(tmp_path, made_of_formulas):
    make, jobs = made_of_formulas
    settings = make("axial", "wall")
    settings.bulk.set["seed"] = 7
    calibrate(settings, tmp_path / "out", workers=2)
    assert {job.case().seed for job in jobs} == {7}


def test_a_run_that_ends_before_a_measured_density_has_no_stress_there(
    tmp_path, monkeypatch
):
    """Its last stress does not stand for what it would be further on."""

    class Pressed:
        density = np.array([0.6, 0.7, 0.8])
        axial = transmitted = radial = np.array([0.0, 1e6, 3e6])
        loading = np.arange(3)

    monkeypatch.setattr("pestle.results.folder.RunFolder", nullcontext)
    monkeypatch.setattr("pestle.metrics.die_curves.die_curves", lambda run: Pressed())
    wanted = [
        Measured("a", 1.0, 1.0, curve="axial_stress", density=0.75),
        Measured("b", 1.0, 1.0, curve="transmitted_stress", density=0.81),
    ]
    found = outputs_of(tmp_path, Outcome("done"), wanted)
    assert found[0] == pytest.approx(2e6)
    assert np.isnan(found[1])


def test_one_number_does_not_tell_two_parameters_apart(tmp_path, made_of_formulas):
    make, _ = made_of_formulas
    numbers = calibrate(make("axial"), tmp_path / "out", workers=2)
    told = " ".join(numbers["warnings"])
    assert "cannot be told apart" in told
    assert "die wall" in told


@pytest.mark.parametrize(
    ("text", "id"),
    [
        ('source = "x"\n[parameters]\na = {low = 0, high = 1}', "contradiction"),
        (EXAMPLE.read_text() + "c = {low=1, high=2, mean=1}", "contradiction"),
        (EXAMPLE.read_text() + "c = {low=2, high=1}", "empty-bounds"),
    ],
)
def test_what_cannot_be_meant_is_refused(tmp_path, text, id):
    path = tmp_path / "calibration.toml"
    path.write_text(text)
    with pytest.raises(InputError) as error:
        read_settings(CalibrationSettings, path)
    assert error.value.id == id


def test_values_follow_the_scale():
    parameter = Parameter(low="1 MPa", high="100 MPa", scale="log")
    assert values_at({"y": parameter}, np.array([[0.5]]))[0, 0] == pytest.approx(1e7)
    assert parameter.share(1e7) == pytest.approx(0.5)


def test_a_missing_extra_is_named(monkeypatch):
    monkeypatch.setattr(util, "find_spec", lambda name: None)
    with pytest.raises(InputError, match=r"pestle\[calibrate\]"):
        require()
