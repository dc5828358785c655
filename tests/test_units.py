"""Text with a unit to SI floats."""

import math
from contextlib import suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pestle.errors import InputError
from pestle.units import DIMENSIONS, EXAMPLES, dimension, to_si


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("150 um", "m", 0.00015),
        ("150 µm", "m", 0.00015),
        ("150um", "m", 0.00015),
        ("1.5e2 um", "m", 0.00015),
        ("5 GPa", "Pa", 5e9),
        ("5 N/mm^2", "Pa", 5e6),
        ("5 N/mm2", "Pa", 5e6),
        ("300 J/m^2", "J/m^2", 300.0),
        ("300 J/m²", "J/m^2", 300.0),
        ("300 N/m", "J/m^2", 300.0),
        ("1.56 g/cm^3", "kg/m^3", 1560.0),
        ("10 1/s", "1/s", 10.0),
        ("10 s^-1", "1/s", 10.0),
        ("-9.81 m/s^2", "m/s^2", -9.81),
        ("1 kg m/s^2", "N", 1.0),
        ("20 ns", "s", 2e-8),
        ("5 %", "1", 0.05),
        (3, "Pa", 3.0),
        (0.1, "1", 0.1),
    ],
)
def test_values(text, unit, value):
    assert to_si(text, unit) == pytest.approx(value, rel=1e-14)


@pytest.mark.parametrize(("unit", "text"), EXAMPLES.items())
def test_every_example_has_its_unit(unit, text):
    assert dimension(text) == unit
    assert unit in DIMENSIONS


def test_decimal_prefixes_are_exact():
    assert to_si("0.3 mm", "m") == 0.0003
    assert to_si("0.1 GPa", "Pa") == 1e8


@pytest.mark.parametrize(
    ("value", "id"),
    [
        ("5 mm", "wrong-unit"),
        ("20 degC", "wrong-unit"),
        ("5", "bad-quantity"),
        ("", "bad-quantity"),
        ("five GPa", "bad-quantity"),
        ("5 GPa + 3 GPa", "bad-quantity"),
        ("2**9999999 Pa", "bad-quantity"),
        ("5 GPa" * 50, "bad-quantity"),
        (True, "bad-quantity"),
        (None, "bad-quantity"),
        ([5], "bad-quantity"),
        ("5 gpa", "unknown-unit"),
        ("5 if", "unknown-unit"),
        ("1e999 Pa", "not-finite"),
        (float("nan"), "not-finite"),
        (10**400, "not-finite"),
    ],
)
def test_refused(value, id):
    with pytest.raises(InputError) as caught:
        to_si(value, "Pa")
    assert caught.value.id == id
    assert caught.value.hint


@given(st.text(max_size=80))
def test_any_text_gives_a_number_or_an_input_error(text):
    with suppress(InputError):
        assert math.isfinite(to_si(text, "m"))


@given(st.floats(min_value=-1e200, max_value=1e200))
def test_prefixes_only_move_the_point(number):
    assert to_si(f"{number!r} mm", "m") == pytest.approx(number / 1000, rel=1e-15)
