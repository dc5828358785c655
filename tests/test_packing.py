"""Radii that are drawn against the closed forms of their distributions."""

import numpy as np
import pytest

from pestle.config import SizeDistribution
from pestle.errors import InputError
from pestle.packing import draw_mass, draw_radii

COUNT = 40_000
SPREAD = 4.5  # standard errors; both tails together 7e-6

NORMAL = {"distribution": "normal", "mean": "100 um", "deviation": "10 um"}
LOGNORMAL = {**NORMAL, "distribution": "lognormal"}
UNIFORM = {"distribution": "uniform", "minimum": "80 um", "maximum": "120 um"}
ROSIN = {"distribution": "rosin-rammler", "scale": "100 um", "exponent": 3.5}
TABLE = [["50 um", 0], ["80 um", 0.3], ["100 um", 0.3], ["120 um", 1]]
BY_NUMBER = {"distribution": "table", "table": TABLE, "by": "number"}
BY_VOLUME = {"distribution": "table", "table": TABLE}


def drawn(options, count=COUNT, seed=7):
    sizes = SizeDistribution(**options)
    return sizes, draw_radii(sizes, count, np.random.default_rng(seed))


def finer_by_number(sizes, r):
    """Share by number finer than r, in closed form, limits included."""
    from scipy.stats import lognorm, norm

    if sizes.distribution == "uniform":
        return (r - sizes.minimum) / (sizes.maximum - sizes.minimum)
    if sizes.distribution == "normal":
        curve = norm(sizes.mean, sizes.deviation).cdf
    elif sizes.distribution == "lognormal":
        spread = np.log(1.0 + (sizes.deviation / sizes.mean) ** 2)
        middle = sizes.mean * np.exp(-spread / 2)
        curve = lognorm(np.sqrt(spread), scale=middle).cdf
    else:  # rosin-rammler: by number a gamma distribution of (r/scale)^n

        def curve(x):
            from scipy.special import gammainc

            n = sizes.exponent
            return gammainc(1.0 - 3.0 / n, (x / sizes.scale) ** n)

    low, high = curve(sizes.minimum), curve(sizes.maximum)
    return (curve(r) - low) / (high - low)


@pytest.mark.parametrize("options", [UNIFORM, NORMAL, LOGNORMAL, ROSIN])
def test_quantiles_by_number(options):
    """Shares finer than nine radii, within binomial bands."""
    sizes, radii = drawn(options)
    assert sizes.minimum <= radii.min() < radii.max() <= sizes.maximum
    for r in np.quantile(radii, np.linspace(0.1, 0.9, 9)).round(7):
        share = finer_by_number(sizes, r)
        error = np.sqrt(share * (1.0 - share) / COUNT)
        assert abs(np.mean(radii <= r) - share) < SPREAD * error


@pytest.mark.parametrize("options", [UNIFORM, ROSIN, BY_NUMBER, BY_VOLUME])
def test_mean_deviation_and_cube_are_those_that_the_case_states(options):
    sizes, radii = drawn(options)
    root = np.sqrt(COUNT)
    assert abs(radii.mean() - sizes.mean) < SPREAD * radii.std() / root
    square, cube = (radii - sizes.mean) ** 2, radii**3
    assert abs(square.mean() - sizes.deviation**2) < SPREAD * square.std() / root
    assert abs(cube.mean() - sizes.mean_cube) < SPREAD * cube.std() / root


def test_rosin_rammler_holds_by_volume():
    """1 - exp(-(r/scale)^n) of the volume is finer than r, between the cut tails."""
    sizes, radii = drawn(ROSIN)
    volume = radii**3
    low, high = (
        -np.expm1(-((r / 1e-4) ** 3.5)) for r in (sizes.minimum, sizes.maximum)
    )
    assert (low, high) == pytest.approx((0.01, 0.99))
    for r in (60e-6, 90e-6, 100e-6, 130e-6):
        finer = (-np.expm1(-((r / 1e-4) ** 3.5)) - low) / (high - low)
        part = volume * ((radii <= r) - finer)  # mean zero if it holds
        assert abs(part.mean()) < SPREAD * part.std() / np.sqrt(COUNT)


@pytest.mark.parametrize("options", [BY_NUMBER, BY_VOLUME])
def test_a_table_comes_out_again(options):
    _, radii = drawn(options)
    weight = radii**3 if options is BY_VOLUME else np.ones(COUNT)
    rows = [(65e-6, 0.15), (80e-6, 0.3), (90e-6, 0.3), (110e-6, 0.65)]
    for r, finer in rows:
        part = weight * ((radii <= r) - finer)
        assert abs(part.mean()) < SPREAD * part.std() / np.sqrt(COUNT)
    assert not np.any((radii > 80.0001e-6) & (radii < 99.9999e-6))


def test_a_mass_is_met_to_half_a_particle():
    sizes = SizeDistribution(**BY_VOLUME)
    for seed in range(5):
        volume = 3e-9
        radii = draw_mass(sizes, volume, np.random.default_rng(seed))
        each = 4.0 / 3.0 * np.pi * radii**3
        assert abs(each.sum() - volume) <= 0.5 * each.max()
        assert len(radii) == pytest.approx(
            volume / (4.0 / 3.0 * np.pi * sizes.mean_cube), rel=0.1
        )


def test_the_same_seed_draws_the_same():
    assert (drawn(ROSIN, 100)[1] == drawn(ROSIN, 100)[1]).all()


BROKEN = [
    ({"distribution": "rosin-rammler", "scale": "1 mm"}, "missing-key", "exponent"),
    ({**ROSIN, "minimum": "2 mm"}, "contradiction", "minimum"),
    ({**NORMAL, "scale": "1 mm"}, "contradiction", "scale"),
    ({"distribution": "table"}, "missing-key", "table"),
    ({"distribution": "table", "table": [["1 mm", 0]]}, "contradiction", "from 0 to 1"),
    ({"distribution": "table", "table": TABLE[:-1]}, "contradiction", "from 0 to 1"),
    ({"distribution": "table", "table": TABLE[::-1]}, "contradiction", "rising"),
    ({**BY_VOLUME, "maximum": "1 mm"}, "contradiction", "limits"),
    ({"distribution": "table", "table": [["1 kg", 0], [2, 1]]}, "wrong-unit", "table"),
]


@pytest.mark.parametrize(("options", "error", "words"), BROKEN)
def test_what_is_wrong_is_said(options, error, words):
    with pytest.raises(InputError) as found:
        SizeDistribution(**options)
    assert found.value.id == error
    assert words in str(found.value)


@pytest.mark.parametrize("options", [ROSIN, BY_NUMBER, BY_VOLUME])
def test_what_is_read_back_is_the_same(options):
    sizes = SizeDistribution(**options)
    data = sizes.model_dump(mode="json", exclude_none=True)
    assert SizeDistribution(**data) == sizes
