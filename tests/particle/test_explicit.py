"""The explicit scheme of Appendix E converges to the exact solution."""

from math import log2

import pytest

from pestle.particle import Particle, ParticleMaterial, explicit_path, follow


def material(ratio, w=0.0):
    return ParticleMaterial(
        youngs_modulus=1.0,
        poisson_ratio=0.3,
        yield_stress=1 / ratio,
        work_of_adhesion=w,
    )


def errors(ratio, path, step, counts=(2,), w=0.0, **other):
    """Force error at each corner, over the largest force of its flat."""
    exact = follow(Particle(material(ratio, w), 1.0, counts=counts), path)
    found = explicit_path(
        material(ratio, w), 1.0, path, counts=counts, step=step, **other
    )
    out = []
    for group in range(len(counts)):
        scale = max(abs(s.flats[group].force) for s in exact)
        out += [
            abs(a.flats[group].force - b.flats[group].force) / scale
            for a, b in zip(found, exact, strict=True)
        ]
    return out


@pytest.mark.parametrize(
    ("path", "counts"),
    [
        ([[0.3], [0.2985]], (2,)),
        ([[0.3, 0.0], [0.298, 0.0]], (2, 4)),
        ([[0.15]], (6,)),
    ],
    ids=["uniaxial", "die", "hydrostatic"],
)
def test_is_of_first_order_loading_and_unloading(path, counts):
    coarse, fine = (max(errors(200.0, path, h, counts)) for h in (2e-3, 5e-4))
    assert fine < 12 * 5e-4
    assert log2(coarse / fine) / 2 == pytest.approx(1.0, abs=0.15)


@pytest.mark.parametrize(
    ("ratio", "target", "expected"), [(200.0, 0.3, -6.4e-4), (200.0, 0.5, -1.1e-3)]
)
def test_error_is_as_large_as_known(ratio, target, expected):
    exact = Particle(material(ratio), 1.0).move([target]).flats[0].force
    found = (
        explicit_path(material(ratio), 1.0, [[target]], step=1e-3)[-1].flats[0].force
    )
    assert found / exact - 1.0 == pytest.approx(expected, rel=0.05)


def test_unloading_without_the_carry_is_wrong_by_the_whole_recovery():
    path = [[0.5], [0.4985]]
    assert errors(200.0, path, 1e-3, carry_largest=False)[-1] > 0.3
    assert errors(200.0, path, 1e-3)[-1] < 2e-3


def test_adhesive_unloading_converges():
    path = [[0.2], [0.1984], [0.1962], [0.1946]]
    other = {"w": 1.0 / 91000.0}
    coarse, fine = (max(errors(200.0, path, h, **other)) for h in (1e-3, 2.5e-4))
    assert fine < 5 * 2.5e-4
    assert coarse / fine > 3.0


@pytest.mark.parametrize("rule", ["loading", "frozen"])
def test_other_rules_converge_too(rule):
    exact = Particle(material(12.5), 1.0, radius_rule=rule).move([0.3])
    found = explicit_path(material(12.5), 1.0, [[0.3]], radius_rule=rule, step=5e-4)[-1]
    assert found.radius == pytest.approx(exact.radius, abs=1e-3)
    assert found.flats[0].force == pytest.approx(exact.flats[0].force, rel=2e-3)
