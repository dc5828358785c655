"""The element: closed forms, patch test, tangent, rotation, and its slow twin."""

from itertools import pairwise

import numpy as np
import pytest

from lab_setups import HARD, MATERIALS, SOFT, block, relax, rim, strained
from pestle.lab._element import respond
from pestle.lab.assembly import Assembly
from pestle.lab.material import Material
from pestle.lab.mesh import quarter_disc

CELLS = {
    "one at the axis": block([0, 1], [0, 1]),
    "one": block([0.5, 1.7], [0.2, 1.1]),
    "patch": block([0, 0.3, 0.8, 1.0], [0, 0.4, 0.7, 1.0], wobble=0.3),
}


def stretched(mesh, radial, axial):
    """Displacements of a uniform stretch."""
    return mesh.points * (np.array([radial, axial]) - 1.0)


@pytest.mark.parametrize("mesh", CELLS.values(), ids=CELLS.keys())
@pytest.mark.parametrize("stretch", [0.8, 0.97, 1.05, 1.3])
def test_hydrostatic(mesh, stretch):
    """sigma = 3 K ln(stretch), no plastic strain at any pressure."""
    assembly = Assembly(mesh, HARD)
    u = stretched(mesh, stretch, stretch)
    answer = assembly.evaluate(u, assembly.fresh_state())
    pressure = 3.0 * HARD.bulk * np.log(stretch)
    expected = [pressure, 0.0, pressure, pressure]
    np.testing.assert_allclose(answer.stress[..., :4] - expected, 0.0, atol=1e-14)
    assert answer.state[..., 4].max() == 0.0
    work = answer.force @ (mesh.points * stretch).ravel()
    volume = assembly.weights.sum() * stretch**3
    assert work == pytest.approx(3.0 * pressure * volume, rel=1e-12)


@pytest.mark.parametrize("mesh", CELLS.values(), ids=CELLS.keys())
@pytest.mark.parametrize("name", MATERIALS)
@pytest.mark.parametrize("strain", [-0.4, -0.03, 0.002, 0.1])
def test_uniaxial(mesh, name, strain):
    """Free sides: sigma_z = E ln V_e on the flow curve, sides follow nu and volume."""
    material = MATERIALS[name]
    assembly = Assembly(mesh, material)
    y, sign = material.yield_stress, np.sign(strain)
    stress, plastic = abs(strain), 0.0
    if stress > y:  # |strain| = flow(plastic) + plastic, by bisection
        low, high = 0.0, abs(strain)
        for _ in range(200):
            plastic = 0.5 * (low + high)
            excess = material.flow_stress(np.array(plastic)) + plastic - abs(strain)
            low, high = (plastic, high) if excess < 0 else (low, plastic)
        stress = float(material.flow_stress(np.array(plastic)))
    side = -sign * (material.poisson_ratio * stress + 0.5 * plastic)
    u = stretched(mesh, np.exp(side), np.exp(strain))
    answer = assembly.evaluate(u, assembly.fresh_state())
    expected = [0.0, 0.0, sign * stress, 0.0]
    np.testing.assert_allclose(answer.stress[..., :4] - expected, 0.0, atol=3e-13)
    np.testing.assert_allclose(answer.state[..., 4], plastic, atol=1e-12)
    top = mesh.points[:, 1] == mesh.points[:, 1].max()
    area = np.pi * np.ptp(mesh.points[:, 0] ** 2) * np.exp(2 * side)
    force = answer.force.reshape(-1, 2)[top, 1].sum()
    assert force == pytest.approx(sign * stress * area, rel=1e-9)


@pytest.mark.parametrize("material", MATERIALS.values(), ids=MATERIALS.keys())
def test_patch(material):
    """A uniform strain on the rim of distorted cells is found inside."""
    mesh = CELLS["patch"]
    assembly = Assembly(mesh, material)
    exact = stretched(mesh, 1.02, 0.93)
    fixed = np.repeat(rim(mesh), 2)
    fixed[2 * mesh.axis] = True
    start = np.where(fixed.reshape(-1, 2), exact, 0.9 * exact)
    u, answer, _ = relax(assembly, start, assembly.fresh_state(), fixed)
    np.testing.assert_allclose(u, exact, atol=1e-12)
    spread = np.ptp(answer.stress[..., :4].reshape(-1, 4), axis=0)
    assert spread.max() < 1e-11


@pytest.mark.parametrize("material", MATERIALS.values(), ids=MATERIALS.keys())
def test_tangent_is_the_derivative(material):
    """Against fourth-order differences, loaded plastically from a plastic state."""
    mesh = CELLS["patch"]
    assembly = Assembly(mesh, material)
    fresh = assembly.fresh_state()
    state = assembly.evaluate(strained(mesh, amount=0.1), fresh).state
    u = strained(mesh, amount=0.13)
    answer = assembly.evaluate(u, state)
    assert np.mean(answer.state[..., 4] > state[..., 4]) > 0.7
    dense = np.zeros((assembly.size, assembly.size))
    for c in range(assembly.size):
        span = slice(assembly.indptr[c], assembly.indptr[c + 1])
        dense[assembly.indices[span], c] = answer.matrix[span]

    def force(j, h):
        moved = u.copy().ravel()
        moved[j] += h
        return assembly.evaluate(moved.reshape(-1, 2), state, tangent=False).force

    h = 2e-5
    numeric = np.stack(
        [
            (8 * (force(j, h) - force(j, -h)) - force(j, 2 * h) + force(j, -2 * h))
            / (12 * h)
            for j in range(assembly.size)
        ],
        axis=1,
    )
    assert np.abs(dense - numeric).max() < 1e-7 * np.abs(dense).max()


@pytest.mark.parametrize("angle", [0.1, 0.7, 2.0, -1.3])
def test_objectivity(angle):
    """A rotation after the deformation turns the stress and nothing else."""
    constants, table = MATERIALS["power"].kernel_constants()
    f = np.array([1.1, 0.2, -0.15, 0.9, 1.05])
    state = np.array([1.05, 0.03, 0.97, 0.98, 0.1])
    c, s = np.cos(angle), np.sin(angle)
    turn = np.array([[c, -s], [s, c]])
    turned = f.copy()
    turned[:4] = (turn @ f[:4].reshape(2, 2)).ravel()
    tensors, outs = [], []
    for gradient in (f, turned):
        out = np.zeros(17)
        cos, sin, *_ = respond(gradient, 1.0, state, constants, table, out)
        axes = np.array([[cos, -sin], [sin, cos]])
        tensors.append(axes @ np.diag(out[:2]) @ axes.T)
        outs.append(out.copy())
    np.testing.assert_allclose(tensors[1], turn @ tensors[0] @ turn.T, atol=1e-14)
    np.testing.assert_allclose(outs[1], outs[0], atol=1e-14)
    assert outs[0][6] > state[4]


def test_rigid_shift_changes_nothing():
    mesh = CELLS["patch"]
    assembly = Assembly(mesh, HARD)
    u = strained(mesh)
    still = assembly.evaluate(u, assembly.fresh_state())
    moved = assembly.evaluate(u + np.array([0.0, 0.7]), assembly.fresh_state())
    np.testing.assert_allclose(moved.force, still.force, atol=1e-15)


@pytest.mark.parametrize("material", MATERIALS.values(), ids=MATERIALS.keys())
def test_newton_is_quadratic(material):
    """Each residual is a multiple of the square of the one before."""
    mesh = CELLS["patch"]
    assembly = Assembly(mesh, material)
    exact = strained(mesh, amount=0.08)
    fixed = np.repeat(rim(mesh), 2)
    start = np.where(fixed.reshape(-1, 2), exact, 0.7 * exact)
    _, _, sizes = relax(assembly, start, assembly.fresh_state(), fixed)
    last = [x for x in sizes if 1e-14 < x < 1e-2 * sizes[0]][-3:]
    assert len(last) >= 2
    assert sizes[-1] < 1e-13
    constants = [b / a**2 for a, b in pairwise(last)]
    assert max(constants) * last[0] < 0.05


def test_order_in_the_mesh():
    """Nearly incompressible tube: nodes at second order against a fine mesh."""
    material = Material(0.01, 0.495)
    results = []
    for n in (4, 8, 16):
        mesh = block(np.linspace(0.5, 1.0, n + 1), np.linspace(0, 0.5, n + 1))
        assembly = Assembly(mesh, material)
        u = np.zeros_like(mesh.points)
        inner = np.isclose(mesh.points[:, 0], 0.5)
        u[inner, 0] = 1e-8
        fixed = np.zeros((len(u), 2), dtype=bool)
        fixed[:, 1] = True
        fixed[inner, 0] = True
        u, _, _ = relax(
            assembly, u, assembly.fresh_state(), fixed.ravel(), tolerance=1e-13
        )
        nu, outer = 0.495, 1.0  # u = a r + b/r, no stress at the outer surface
        ratio = (1.0 - 2.0 * nu) / outer**2  # a / b
        r = mesh.points[:, 0]
        exact = 1e-8 * (ratio * r + 1.0 / r) / (ratio * 0.5 + 1.0 / 0.5)
        results.append(np.abs(u[:, 0] - exact).max() / 1e-8)
    orders = np.log2(np.array(results[:-1]) / results[1:])
    assert orders == pytest.approx([2.0, 2.0], abs=0.2)
    assert results[-1] < 1e-5


def test_order_in_the_step():
    """Backward Euler along a bent path of plastic strain: first order."""
    mesh = CELLS["patch"]
    assembly = Assembly(mesh, MATERIALS["power"])
    bend, turn = strained(mesh, amount=0.05), strained(mesh, amount=0.05, seed=2)

    def force(steps):
        state = assembly.fresh_state()
        for t in np.arange(1, steps + 1) / steps:
            u = t * bend + (1.0 - np.cos(np.pi * t)) * turn
            answer = assembly.evaluate(u, state, tangent=False)
            state = answer.state
        return answer.force

    exact = 2.0 * force(1024) - force(512)
    errors = [np.linalg.norm(force(n) - exact) for n in (16, 32, 64)]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert orders == pytest.approx([1.0, 1.0], abs=0.15)


@pytest.mark.parametrize("material", [SOFT, MATERIALS["power"]])
def test_slow_twin(material):
    """scikit-fem's assembly of the same virtual work gives the same forces."""
    from lab_twin import forces

    mesh = quarter_disc("coarse")
    assembly = Assembly(mesh, material)
    u = strained(mesh, amount=0.03)
    answer = assembly.evaluate(u, assembly.fresh_state(), tangent=False)
    twin = forces(mesh, material, u)
    assert np.abs(answer.force - twin).max() < 1e-12 * np.abs(twin).max()
    assert answer.state[..., 4].max() > 0.01
