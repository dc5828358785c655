"""Laws draw themselves: axes with units, unloading where there is any."""

import pytest

from laws.setups import LAWS
from pestle.bench.figure import draw_pair_law
from pestle.laws import Zunker2024


@pytest.mark.parametrize("name", [n for n in LAWS if " " not in n])
def test_a_pair_law_draws_itself(name):
    figure = LAWS[name].plot()
    left, right = figure.axes
    assert left.get_ylabel().startswith("force [")
    assert right.get_ylabel().startswith("contact radius [")
    x, y = left.lines[0].get_data()
    assert x.max() == pytest.approx(100.0)  # 0.002 radii of 50 um, in nm
    assert y.max() > 0.0
    assert name in figure.get_suptitle()


def test_mdr_is_drawn_as_its_particle():
    figure = draw_pair_law(Zunker2024(), peaks=(0.1, 0.2))
    assert figure.axes[0].get_xlabel() == "displacement / radius [-]"
