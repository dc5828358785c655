"""Every pair law keeps the contract of `pestle.testing`."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from laws.setups import LAWS, NAMES
from pestle import laws, testing


@pytest.mark.parametrize("name", NAMES)
def test_contract(name):
    testing.check_law(LAWS[name])


@pytest.mark.parametrize("name", NAMES)
def test_contract_without_adhesion(name):
    pair = laws.Pair(first=testing.SOLID, second=testing.SOLID)
    testing.check_law(LAWS[name], pair=pair)


@pytest.mark.parametrize("name", NAMES)
def test_contract_against_a_rigid_wall(name):
    pair = laws.Pair(
        first=testing.SOLID, second=laws.Solid(), work_of_adhesion=0.01, wall=True
    )
    testing.check_law(LAWS[name], pair=pair, radius=3e-5, depth=1e-6)


@pytest.mark.parametrize("name", NAMES)
@settings(max_examples=10, deadline=None)
@given(peaks=st.lists(st.floats(-0.02, 1.0), min_size=1, max_size=6))
def test_no_closed_path_creates_energy(name, peaks):
    """From parted to parted: the work is what was lost, never less than nothing."""
    law, depth = LAWS[name], 4e-6
    reach = laws.parts_of(law).reach(law.constants(testing.PAIR), testing.geometry(0.0))
    apart = -1.1 * reach - 1e-9
    path = testing.legs([apart, *(depth * p for p in peaks), apart], 120)
    spent, noise = testing.dissipation(testing.follow(law, path))
    assert (spent >= -noise).all()
    answer = testing.follow(law, path)
    work = np.trapezoid(answer["force"], path)
    assert work >= -noise.sum()


@pytest.mark.filterwarnings("ignore:thornton_ning1998")
@pytest.mark.parametrize("adhesion", [0.5, 2.0])
@pytest.mark.parametrize("name", NAMES)
def test_no_closed_path_creates_energy_however_sticky(name, adhesion):
    """Ten and forty times as sticky: adhesion alone makes a touching contact yield."""
    pair = replace(testing.PAIR, work_of_adhesion=adhesion)
    for path in testing.paths(LAWS[name], pair, testing.RADIUS, 4e-6, 5):
        answer = testing.follow(LAWS[name], path, pair=pair)
        _, noise = testing.dissipation(answer)
        assert np.trapezoid(answer["force"], path) >= -noise.sum()


def test_every_pair_law_is_checked():
    known = {
        name
        for name in laws.names()
        if laws.parts_of(name).particle is laws.Nothing and "." not in name
    }
    checked = {law.name for law in LAWS.values()}
    assert known - {"walton1986"} <= checked
