"""Adhesion of the single particle: unloading, pull-off, separation."""

import numpy as np
import pytest

from pestle.errors import InputError
from pestle.particle import EnergyWarning, Particle, ParticleMaterial, follow, pull_off
from pestle.reference import ellipse, peeling
from pestle.reference.peeling import Peel


def particle(modulus=910.0, yield_stress=72.8, rule="plastic"):
    """W = R_o = 1."""
    material = ParticleMaterial(
        youngs_modulus=modulus,
        poisson_ratio=0.3,
        yield_stress=yield_stress,
        work_of_adhesion=1.0,
    )
    return Particle(material, 1.0, radius_rule=rule)


def test_loading_does_not_feel_adhesion():
    adhesive = particle().move([0.3])
    plain = Particle(
        ParticleMaterial(youngs_modulus=910.0, poisson_ratio=0.3, yield_stress=72.8),
        1.0,
    ).move([0.3])
    assert adhesive.flats[0].force == pytest.approx(plain.flats[0].force, rel=1e-13)
    assert adhesive.flats[0].peel is Peel.NO_TENSION


def test_elastic_unloading_is_the_peeling_ellipse():
    p = particle(20020.0, 1e9)
    a, modulus = 0.0, p.material.constants.modulus
    for d in (0.01, 0.006, 0.002, -0.001, -0.002, -0.0021, 0.001):
        flat = p.move([d]).flats[0]
        expected = peeling.adhere(
            ellipse.of_sphere(1.0), d, a, modulus=modulus, work_of_adhesion=1.0
        )
        a = expected.radius
        assert flat.force == pytest.approx(expected.force, rel=1e-10, abs=1e-12)
        assert flat.peel is expected.state


@pytest.mark.parametrize("most", [0.05, 0.2, 0.5])
def test_pull_off_is_what_the_path_meets(most):
    loaded = particle()
    loaded.move([most])
    found = pull_off(loaded)
    path = np.linspace(most, found.displacement_separation + 1e-9, 4001)
    states = follow(loaded, path[:, None])
    forces = [s.flats[0].force for s in states]
    assert min(forces) == pytest.approx(found.force, rel=1e-6)
    assert states[-1].flats[0].contact_radius > 0.0
    assert forces[-1] == pytest.approx(found.force_separation, rel=1e-2)
    gone = loaded.move([found.displacement_separation - 1e-9]).flats[0]
    assert gone.peel is Peel.SEPARATED
    assert gone.force == 0.0


def test_separated_contact_adheres_again_only_in_compression():
    p = particle()
    loaded = p.move([0.3])
    p.move([0.1])
    found = pull_off(p)
    assert found.radius_separation == 0.0
    assert p.move([0.24]).flats[0].force >= 0.0
    again = p.move([0.3])
    assert again.flats[0].force == pytest.approx(loaded.flats[0].force, rel=1e-13)


def test_adhesion_dissipates_in_a_cycle():
    p = particle()
    p.move([0.3])
    path = np.concatenate([np.linspace(0.3, 0.2, 801), np.linspace(0.2, 0.3, 801)])
    states = follow(p, path[:, None])
    force = [s.flats[0].force for s in states]
    assert np.trapezoid(force, path) > 0.0


def test_pull_off_of_a_growing_particle_is_refused():
    with pytest.warns(EnergyWarning):
        p = particle(rule="eq37")
    p.move([0.2])
    with pytest.raises(InputError, match="eq37"):
        pull_off(p)
