"""Laws against the packaged grid."""

import numpy as np
import pytest

from pestle.lab import law_table
from pestle.lab.law_table import Claim
from pestle.lab.material import Material
from pestle.particle import edmans2020


def test_unloading_of_edmans_is_found_again():
    """Numbers read off the law's own curve are those it was made with."""
    found = law_table._unload(
        "shahin2021+edmans2020", Material(100.0, 0.3), 0.2, 0.02, 0.6
    )
    assert found is not None
    rho = edmans2020.secant_stiffness(0.2, 100.0, 0.3)
    alpha = edmans2020.exponent(0.2, 100.0, 0.3)
    assert found == pytest.approx((rho, alpha), rel=2e-3)


def test_deviation_of_a_loading():
    claim = Claim("shahin2021", (200.0, 200.0), (0.1, 0.5))
    errors = law_table._loading(claim)
    assert np.abs(errors["force"]).mean() < 0.05
    product = (1.0 + errors["pressure"]) * (1.0 + errors["area"])
    np.testing.assert_allclose(product, 1.0 + errors["force"], rtol=1e-12)
    rows = list(law_table._deviations(claim, errors))
    assert [row.quantity for row in rows] == ["force", "area", "pressure"]
    assert all(abs(row.mean) <= row.rms <= abs(row.largest) for row in rows)


@pytest.mark.slow
def test_whole_table():
    found = law_table.law_table()
    laws = {row.law for row in found}
    assert {"zunker2024", "shahin2021", "unloading of edmans2020"} <= laws
