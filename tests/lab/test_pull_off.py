"""Adhesion of profiles through the MDR transform."""

import numpy as np
import pytest

from lab_setups import HARD
from pestle.errors import InputError
from pestle.lab.material import Material
from pestle.lab.mesh import scaled
from pestle.lab.press import press
from pestle.lab.pull_off import dimple, mdr_image, peel, relaxed_pull_off


@pytest.mark.parametrize(
    ("power", "factor"), [(1, np.pi / 2), (2, 2.0), (4, 8.0 / 3.0)]
)
def test_images_of_powers(power, factor):
    """r^n has the image n sqrt(pi)/2 Gamma(n/2)/Gamma((n+1)/2) x^n."""
    r = np.linspace(0.0, 0.3, 3001)
    x = np.array([0.1, 0.2, 0.3])
    np.testing.assert_allclose(mdr_image(r, r**power, x), factor * x**power, rtol=2e-4)


@pytest.mark.parametrize("work", [1e-6, 1e-5])
def test_parabola_is_jkr(work):
    r = np.linspace(0.0, 0.2, 400)
    found = peel(r, 0.5 * r**2, work, 1.1)
    assert found.force == pytest.approx(-1.5 * np.pi * work, rel=2e-3)
    radius = (9.0 * np.pi * work / (8.0 * 1.1)) ** (1.0 / 3.0)
    assert found.radius == pytest.approx(radius, rel=0.02)
    assert found.separation_radius < found.radius


def test_flat_punch_is_kendall():
    """A flat profile comes off at once: F = -sqrt(8 pi E* W a^3)."""
    r = np.linspace(0.0, 0.2, 50)
    found = peel(r, 0.0 * r, 1e-6, 1.1)
    exact = -np.sqrt(8.0 * np.pi * 1.1 * 1e-6 * 0.2**3)
    assert found.force == pytest.approx(exact, rel=1e-3)
    assert found.radius == pytest.approx(0.2)


def test_relaxed_spheres():
    """Flattening makes adhesion stronger; dimples appear at large depth only."""
    result = press(HARD, 0.3, [0.05, 0.3], mesh=scaled("coarse", 1.5))
    sphere = result.sphere
    work = 1e-5
    forces = [relaxed_pull_off(sphere, b, work).force for b in result.branches]
    assert forces[1] < forces[0] < 2.0 * -1.5 * np.pi * work
    shallow, deep = (dimple(sphere, b) for b in result.branches)
    assert shallow[1] < 1e-5
    # appendix F: r_peak = 1.1 a (d - d_Y - 0.135)^(1/3) at E/Y = 200 and 0.3 R
    expected = 1.1 * (0.3 - 0.135) ** (1.0 / 3.0) * result.branches[1].start.radius[0]
    assert deep[0] == pytest.approx(expected, rel=0.12)


def test_elastic_sphere_keeps_its_pull_off():
    result = press(Material(2.0, 0.3), 0.05, [0.05], mesh="coarse")
    found = relaxed_pull_off(result.sphere, result.branches[0], 1e-4)
    assert found.force == pytest.approx(-1.5 * np.pi * 1e-4, rel=0.02)


def test_without_adhesion():
    r = np.linspace(0.0, 0.2, 50)
    with pytest.raises(InputError, match="pulls nothing off"):
        peel(r, r**2, 0.0, 1.0)
