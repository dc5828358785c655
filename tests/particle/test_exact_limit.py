"""The exact solver against the reference paths without their event resolution.

Those paths resolve events to 1e-10 radii or less; where an unloaded contact is loaded
again, this leaves up to 1.3e-8 of the largest force in them.  Elsewhere they are exact.
"""

import json
from pathlib import Path

import pytest

from pestle.particle import Resolution
from verification.features import _mdr_paths
from verification.test_reference_values import compare

FILE = Path(__file__).parents[1] / "data" / "reference" / "mdr.json"
CASES = {c["id"]: c for c in json.loads(FILE.read_text(encoding="utf-8"))["cases"]}


@pytest.mark.parametrize(
    ("name", "rtol"),
    [
        ("uniaxial_plastic-09", 1e-11),
        ("uniaxial_plastic-17", 1e-10),
        ("uniaxial_loading-01", 1e-11),
        ("uniaxial_eq37-03", 1e-8),
        ("uniaxial_eq37-13", 1e-11),
        ("die-01", 1e-10),
        ("hydrostatic-01", 1e-11),
        ("asymmetric-01", 2e-8),
        ("adhesive_path-01", 1e-10),
    ],
)
def test_agrees(monkeypatch, name, rtol):
    monkeypatch.setattr(_mdr_paths, "RESOLUTION", Resolution())
    case = CASES[name]
    got = _mdr_paths.path(case["inputs"])
    assert not compare(name, got, case["outputs"], rtol=rtol, atol=1e-12)
