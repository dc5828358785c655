"""Errors say what, where and what to do."""

import pytest

from pestle.errors import InputError, PestleError, SimulationError, nearest


def test_an_error_reads_like_a_compiler_message():
    error = InputError(
        "bad-key", 'unknown key "a"', "case.toml:3  a", 'did you mean "b"?'
    )
    assert str(error).splitlines() == [
        'error[bad-key]: unknown key "a"',
        "  --> case.toml:3  a",
        '  hint: did you mean "b"?',
    ]


def test_place_and_hint_may_be_left_out():
    assert str(PestleError("x", "what")) == "error[x]: what"


def test_further_errors_follow():
    error = InputError("one", "first")
    error.others = (InputError("two", "second"),)
    assert str(error) == "error[one]: first\nerror[two]: second"


@pytest.mark.parametrize(("kind", "code"), [(InputError, 2), (SimulationError, 1)])
def test_exit_codes(kind, code):
    assert kind("x", "what").exit_code == code


def test_nearest_ignores_case():
    assert nearest("HERTZ", ["hertz", "mdr"]) == "hertz"
    assert nearest("completely different", ["hertz", "mdr"]) is None
