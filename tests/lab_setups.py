"""Small meshes and loadings that several tests of the lab share."""

import numpy as np

from pestle.lab.assembly import Assembly
from pestle.lab.material import Hardening, Material
from pestle.lab.mesh import MESHES, Mesh, scaled

SOFT = Material(20.0, 0.3)
HARD = Material(200.0, 0.3)
HARDENING = Material(100.0, 0.2, Hardening(exponent=0.2))
TABLE = Material(50.0, 0.3, Hardening(table=((0.0, 1.0), (0.05, 1.4), (0.4, 1.7))))
MATERIALS = {"perfect": HARD, "power": HARDENING, "table": TABLE}
TINY = scaled("coarse", 4.0)


def block(r, z, *, wobble=0.0, seed=0):
    """Cells between lists of r and z; inner nodes are off by `wobble` cells."""
    r, z = np.asarray(r, float), np.asarray(z, float)
    n, m = len(r), len(z)
    points = np.stack(np.meshgrid(r, z, indexing="ij"), axis=-1)
    random = np.random.default_rng(seed).uniform(-1, 1, (n - 2, m - 2, 2))
    size = np.array([np.diff(r).min(), np.diff(z).min()])
    points[1:-1, 1:-1] += wobble * size * random
    number = np.arange(n * m).reshape(n, m)
    corners = (number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:])
    cells = np.stack([c.ravel() for c in corners], axis=1)
    return Mesh("block", MESHES["coarse"], points.reshape(-1, 2), cells, number[:, 0])


def rim(mesh):
    """Which nodes of a block lie on its boundary."""
    low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
    on = np.isclose(mesh.points, low) | np.isclose(mesh.points, high)
    return on.any(axis=1)


def relax(assembly: Assembly, u, state, fixed, *, tolerance=1e-13):
    """Newton's method with prescribed unknowns as they are in u; answer and history."""
    sizes = []
    for _ in range(30):
        answer = assembly.evaluate(u, state)
        residual = np.where(fixed, 0.0, -answer.force)
        sizes.append(np.linalg.norm(residual))
        if sizes[-1] < tolerance:
            break
        zero = np.zeros(assembly.size)
        step = assembly.solve(answer.matrix, residual, fixed, zero)
        u = u + step.reshape(-1, 2)
    return u, answer, sizes


def strained(mesh, *, amount=0.05, seed=1):
    """A displacement field that is smooth and irregular, zero on the axis in r."""
    random = np.random.default_rng(seed)
    r, z = mesh.points.T
    field = np.zeros_like(mesh.points)
    for k in range(1, 4):
        a = random.uniform(-1, 1, 4)
        field[:, 0] += r * (a[0] * np.cos(k * z) + a[1] * np.sin(k * r)) / k
        field[:, 1] += (a[2] * np.sin(k * z) + a[3] * np.cos(k * r)) / k
    return amount * field
