"""Every test may see the first warning of a law."""

import pytest

from pestle.particle import law


@pytest.fixture(autouse=True)
def _first_warnings(monkeypatch):
    monkeypatch.setattr(law, "_WARNED", set())
