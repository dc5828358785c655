"""Every case of every reference file, each to its own tolerance.

The files are those of the folder named by the environment variable PESTLE_REFERENCE,
else of ``tests/data/reference``.
"""

import json
import math
import os
from pathlib import Path
from typing import Any

import pytest

from verification.features import find

OURS = Path(__file__).parents[1] / "data" / "reference"
FOLDER = Path(os.environ.get("PESTLE_REFERENCE") or OURS)


def cases():
    """All cases with the name of their file."""
    for file in sorted(FOLDER.glob("*.json")):
        for case in json.loads(file.read_text(encoding="utf-8"))["cases"]:
            yield pytest.param(file.stem, case, id=f"{file.stem}:{case['id']}")


def is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def numbers(value: Any) -> list[float]:
    """All numbers in nested lists."""
    if isinstance(value, list | tuple):
        return [x for item in value for x in numbers(item)]
    return [abs(value)] if is_number(value) else []


def compare(name: str, got: Any, want: Any, *, rtol: float, atol: float) -> list[str]:
    """What differs beyond the tolerance; a list is measured by its largest entry."""
    if isinstance(want, dict):
        problems = []
        for key, value in want.items():
            if not isinstance(got, dict) or key not in got:
                problems.append(f"{name}.{key} is not computed")
            else:
                problems += compare(
                    f"{name}.{key}", got[key], value, rtol=rtol, atol=atol
                )
        return problems
    allowed = rtol * max(numbers(want), default=0.0) + atol
    return differences(name, got, want, allowed)


def differences(name: str, got: Any, want: Any, allowed: float) -> list[str]:
    """Entries of nested lists that differ by more than `allowed`."""
    if isinstance(want, list):
        if not isinstance(got, list | tuple) or len(got) != len(want):
            return [f"{name}: {got!r} is not a list of {len(want)}"]
        pairs = enumerate(zip(got, want, strict=True))
        return [
            problem
            for n, (g, w) in pairs
            for problem in differences(f"{name}[{n}]", g, w, allowed)
        ]
    if is_number(want):
        near = is_number(got) and abs(got - want) <= allowed
        same = is_number(got) and math.isnan(want) and math.isnan(got)
        if near or same:
            return []
        return [f"{name}: {got!r}, not {want!r} within {allowed:.3g}"]
    return (
        []
        if type(got) is type(want) and got == want
        else [f"{name}: {got!r}, not {want!r}"]
    )


def check(file: str, case: dict[str, Any]) -> list[str]:
    """All that is wrong with a case."""
    found = find(file, case["feature"])
    if found is None:
        return [f"feature {case['feature']!r} of {file}.json is unknown"]
    compute, default = found
    atol = case.get("atol", case.get("atol_f", default))
    got = compute(case["inputs"])
    return compare(case["feature"], got, case["outputs"], rtol=case["rtol"], atol=atol)


@pytest.mark.parametrize(("file", "case"), list(cases()))
def test_case(file, case):
    problems = check(file, case)
    assert not problems, "\n".join(problems)


def test_folder_has_cases():
    assert any(True for _ in cases()), f"no reference cases in {FOLDER}"


class TestHarness:
    """The harness itself finds what it should."""

    def test_unknown_feature_is_a_failure(self):
        case = {"feature": "phlogiston", "inputs": {}, "outputs": {}, "rtol": 1.0}
        assert "unknown" in check("mdr", case)[0]

    def test_missing_output_is_a_failure(self):
        assert compare("x", {}, {"a": 1.0}, rtol=1.0, atol=1.0)

    def test_scalar_within_rtol_passes_and_beyond_fails(self):
        assert not compare("x", 1.0 + 0.9e-9, 1.0, rtol=1e-9, atol=0.0)
        assert compare("x", 1.0 + 1.1e-9, 1.0, rtol=1e-9, atol=0.0)

    def test_list_is_measured_by_its_largest_entry(self):
        assert not compare("x", [0.5e-9, 1.0], [0.0, 1.0], rtol=1e-9, atol=0.0)
        assert compare("x", [2e-9, 1.0], [0.0, 1.0], rtol=1e-9, atol=0.0)

    @pytest.mark.parametrize(
        ("got", "want"),
        [(1.0, True), (None, 0.0), (0.0, None), ("ok", "peak"), ([], [1])],
    )
    def test_other_kinds_must_be_equal(self, got, want):
        assert compare("x", got, want, rtol=1.0, atol=1.0)

    def test_nan_is_not_near_anything(self):
        assert compare("x", math.nan, 1.0, rtol=1.0, atol=1.0)
