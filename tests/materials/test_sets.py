"""Packaged material sets: every value has its source."""

import re

import pytest

from pestle import materials
from pestle.config.contacts import ContactSettings
from pestle.errors import InputError
from pestle.units import DIMENSIONS

DOI = re.compile(r"10\.\d{4,9}/\S+")


@pytest.mark.parametrize("name", materials.names())
def test_every_value_has_a_unit_and_a_source(name):
    material = materials.load(name)
    assert material.title
    assert material.values()
    for key, entry in material.values().items():
        assert DOI.fullmatch(entry.source), key
        assert entry.unit in DIMENSIONS, key
        if entry.low is not None:
            assert entry.low <= entry.value <= entry.high, key
            assert "range" in entry.note, key


@pytest.mark.parametrize("name", materials.names())
def test_keys_are_keys_of_a_case_file(name):
    material = materials.load(name)
    assert set(material.material) == set(materials.CONSTANTS)
    known = set(ContactSettings.model_fields)
    assert set(material.between) | set(material.walls) <= known


@pytest.mark.parametrize("name", materials.names())
def test_the_sources_can_be_cited(name):
    material = materials.load(name)
    for entry in material.values().values():
        assert entry.source in material.citation


def test_avicel_has_the_published_values():
    constants = materials.load("avicel_ph102_zunker2025").constants()
    assert 7.5e9 <= constants["youngs_modulus"] <= 10e9
    assert constants["poisson_ratio"] == 0.3
    assert constants["yield_stress"] == 150e6
    assert constants["density"] == 1560.0


def test_an_unknown_set_is_an_input_error():
    with pytest.raises(InputError, match="avicel_ph102_zunker2025"):
        materials.load("avicel_ph102_zunker")


@pytest.mark.parametrize("name", ["../errors", "/etc/passwd", ""])
def test_a_set_is_a_name_not_a_path(name):
    with pytest.raises(InputError):
        materials.load(name)
