"""Three dimensions: closed forms, tangent, the axisymmetric lab, die, hydrostatic."""

import json

import numpy as np
import pytest

from lab_setups import HARDENING
from pestle.cli import main
from pestle.errors import InputError
from pestle.lab import confined
from pestle.lab.confined import Confined, ConfinedStop
from pestle.lab.material import Material
from pestle.lab.octant import SolidAssembly, octant
from pestle.lab.sphere import Sphere
from pestle.particle import Shahin2021

MATERIAL = Material(100.0, 0.3)


def test_mesh_fills_an_octant():
    volumes = [
        SolidAssembly(octant(n, n, 0.08 * 6 / n), MATERIAL).weights.sum()
        for n in (4, 8, 12)
    ]
    lacking = 1.0 - np.array(volumes) / (np.pi / 6.0)
    assert (np.diff(lacking) < 0.0).all()
    assert 0.0 < lacking[-1] < 5e-3
    mesh = octant(4, 4)
    assert len(mesh.faces) == 3 * 4 * 4
    assert np.linalg.norm(mesh.points[mesh.surface], axis=1) == pytest.approx(1.0)


@pytest.mark.parametrize("stretch", [0.9, 1.2])
def test_hydrostatic_stretch(stretch):
    assembly = SolidAssembly(octant(2, 2, 0.3), MATERIAL)
    u = assembly.solid.points * (stretch - 1.0)
    answer = assembly.evaluate(u, assembly.fresh_state())
    pressure = -3.0 * MATERIAL.bulk * np.log(stretch)
    np.testing.assert_allclose(answer.stress[..., 0], pressure, atol=1e-13)
    assert np.abs(answer.stress[..., 1]).max() < 1e-12


def test_uniaxial_stress():
    strain, y = -0.2, MATERIAL.yield_stress
    side = -(-MATERIAL.poisson_ratio * y + 0.5 * (strain + y))
    assembly = SolidAssembly(octant(2, 2, 0.3), MATERIAL)
    u = assembly.solid.points * (np.exp([side, side, strain]) - 1.0)
    answer = assembly.evaluate(u, assembly.fresh_state())
    np.testing.assert_allclose(answer.stress[..., 0], y / 3.0, atol=1e-13)
    np.testing.assert_allclose(answer.stress[..., 1], y, atol=1e-13)
    np.testing.assert_allclose(answer.state[..., 6], -strain - y, atol=1e-13)


def deformed(points, amount, seed=3):
    random = np.random.default_rng(seed)
    linear = random.uniform(-1, 1, (3, 3))
    return amount * (points @ linear.T + 0.05 * random.standard_normal(points.shape))


def test_tangent_is_the_derivative():
    mesh = octant(2, 2, 0.3)
    assembly = SolidAssembly(mesh, HARDENING)
    start = deformed(mesh.points, 0.08)
    state = assembly.evaluate(start, assembly.fresh_state()).state
    u = 1.2 * start
    answer = assembly.evaluate(u, state)
    assert np.mean(answer.state[..., 6] > state[..., 6]) > 0.7
    worst, h = 0.0, 2e-5
    for c in range(0, assembly.size, 5):
        column = np.zeros(assembly.size)
        span = slice(assembly.indptr[c], assembly.indptr[c + 1])
        column[assembly.indices[span]] = answer.matrix[span]
        forces = []
        for k in (1, -1, 2, -2):
            moved = u.copy().ravel()
            moved[c] += k * h
            moved = moved.reshape(-1, 3)
            forces.append(assembly.evaluate(moved, state, tangent=False).force)
        a, b, d, e = forces
        numeric = (8 * (a - b) - d + e) / (12 * h)
        worst = max(worst, np.abs(numeric - column).max())
    assert worst < 1e-7 * np.abs(answer.matrix).max()


def test_rotation_turns_the_forces():
    mesh = octant(2, 2, 0.3)
    assembly = SolidAssembly(mesh, HARDENING)
    u = deformed(mesh.points, 0.1)
    turn = np.linalg.qr(np.random.default_rng(5).standard_normal((3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    turned = (mesh.points + u) @ turn.T - mesh.points
    still = assembly.evaluate(u, assembly.fresh_state())
    moved = assembly.evaluate(turned, assembly.fresh_state())
    np.testing.assert_allclose(
        moved.force.reshape(-1, 3), still.force.reshape(-1, 3) @ turn.T, atol=1e-13
    )


def test_simple_compression_is_that_of_the_axisymmetric_lab():
    """Work to 0.15 R within 6 % on 256 elements (the contact has few nodes)."""
    points = Confined(MATERIAL, "simple", edges=4, layers=4, first=0.1).load(0.15)
    d = np.array([0.0, *(p.depth for p in points)])
    force = np.array([0.0, *(p.primary.force for p in points)])
    work = np.trapezoid(force, d)
    assert work == pytest.approx(Sphere(MATERIAL).load_to(0.15).work, rel=0.06)
    assert points[-1].secondary.force == 0.0


def test_hydrostatic_flats_are_alike():
    for point in Confined(MATERIAL, "hydrostatic", edges=4, layers=4).load(0.08):
        assert point.primary.force == pytest.approx(point.secondary.force, rel=1e-5)
        assert point.primary.inner_area < point.primary.area < point.primary.outer_area


def test_bad_input(capsys):
    words = ["--modulus-ratio", "100"]
    assert main(["lab", "confined", "dye", *words]) == 2
    assert "unknown-configuration" in capsys.readouterr().err
    for depth in ("0.001", "0.48"):
        assert main(["lab", "confined", "die", *words, "--to", depth]) == 2
        assert "depth-out-of-range" in capsys.readouterr().err


def test_command(monkeypatch, capfd):
    words = ["--modulus-ratio", "50", "--edges", "4", "--quiet", "--json"]
    assert main(["lab", "confined", "die", *words, "--to", "0.06"]) == 0
    rows = json.loads(capfd.readouterr().out)["steps"]
    assert rows[-1]["d_R"] == 0.06
    assert rows[-1]["primary_F_ER2"] > rows[-1]["secondary_F_ER2"] > 0.0

    def fails(*_, **__):
        raise confined.NotConverged("made to fail")

    monkeypatch.setattr(Confined, "_equilibrium", fails)
    assert main(["lab", "confined", "die", *words, "--to", "0.06"]) == 1
    assert "made to fail" in capfd.readouterr().err
    with pytest.raises(ConfinedStop):
        Confined(MATERIAL, "die").load(0.1)
    with pytest.raises(InputError):
        Confined(MATERIAL, "die").load(0.5)


def die_radius_over_law(modulus_ratio, edges, first):
    """Primary contact radius over that of the law, at each step over 0.03 to 0.3."""
    law = Shahin2021(
        youngs_modulus=1.0, poisson_ratio=0.3, yield_stress=1.0 / modulus_ratio
    )
    material = Material(modulus_ratio, 0.3)
    sphere = Confined(material, "die", edges=edges, layers=edges, first=first)
    points = [p for p in sphere.load(0.3) if p.depth >= 0.03]
    depth = np.array([p.depth for p in points])
    radius = np.sqrt(np.array([p.primary.area for p in points]) / np.pi)
    curve = law.curve(depth, radius=1.0, configuration="die")
    return radius / curve.contact_radius


@pytest.mark.slow
def test_die_radius_is_that_of_shahin_in_the_mean():
    """Within 5 % on 2048 bricks; single steps are so from 0.035 on.

    At 0.03 the law is 8 % above a sphere of E/Y = 150, as the axisymmetric mesh says.
    """
    off = die_radius_over_law(150.0, edges=8, first=0.05) - 1.0
    assert abs(np.mean(off)) < 0.05


@pytest.mark.slow
def test_every_die_radius_of_a_hard_sphere_is_that_of_shahin():
    """Within 5 % at each step, E/Y = 1000 on 4000 bricks; twenty minutes."""
    off = die_radius_over_law(1000.0, edges=10, first=0.03) - 1.0
    assert np.abs(off).max() < 0.05


def test_first_touch_of_a_hard_sphere():
    """Approached through softer ones with patience; where both ways go they meet."""
    hard = Confined(Material(1000.0, 0.3), "die", edges=4, layers=4)
    (point,) = hard.load(hard.first_depth)
    assert 1.0 < 1000.0 * point.primary.force / point.primary.area < 3.0
    case = Confined(Material(20.0, 0.3), "die", edges=3, layers=3)
    virgin = confined._State(
        0.0,
        np.zeros_like(case.mesh.points),
        np.zeros_like(case.open),
        case.assembly.fresh_state(),
    )
    _, plain = case._equilibrium(virgin, None, case.first_depth)
    _, patient = case._equilibrium(virgin, None, case.first_depth, patient=True)
    assert patient.primary.force == pytest.approx(plain.primary.force, rel=1e-5)
