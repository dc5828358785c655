"""The element again by scikit-fem's assembly and tensor algebra: slow and obvious.

Loading from the unloaded state only. Matrices are 3 x 3 over (r, z, t); logarithms and
return mapping go through `numpy.linalg.eigh`, the mean volume ratio through sums.
"""

import numpy as np
from skfem import Basis, ElementQuad1, ElementVector, LinearForm

from pestle.lab.material import Material
from pestle.lab.mesh import Mesh


def flow(material: Material, strain, trial, shear):
    """Plastic increment by bisection."""
    low, high = np.zeros_like(trial), trial / (3 * shear)
    for _ in range(200):
        middle = 0.5 * (low + high)
        above = trial - 3 * shear * middle > material.flow_stress(strain + middle)
        low, high = np.where(above, middle, low), np.where(above, high, middle)
    return np.where(trial > material.flow_stress(strain), low, 0.0)


def cauchy(material: Material, f):
    """Cauchy stress of matrices f (..., 3, 3) for an unloaded material."""
    values, vectors = np.linalg.eigh(f @ np.swapaxes(f, -1, -2))
    strain = 0.5 * np.log(values)
    volume = strain.sum(axis=-1, keepdims=True)
    deviator = strain - volume / 3
    trial = np.sqrt(6.0) * material.shear * np.linalg.norm(deviator, axis=-1)
    step = flow(material, np.zeros_like(trial), trial, material.shear)
    kept = 1.0 - 3.0 * material.shear * step / np.maximum(trial, 1e-300)
    stress = material.bulk * volume + 2 * material.shear * kept[..., None] * deviator
    return np.einsum("...ia,...a,...ja->...ij", vectors, stress, vectors)


def gradient(w):
    """Gradient (3, 3, elements, points) of a field with components r, z."""
    g = np.zeros((3, 3, *np.asarray(w).shape[1:]))
    g[:2, :2] = w.grad
    return g


def forces(mesh: Mesh, material: Material, u):
    """Internal forces at displacements u (nodes, 2), by node and direction."""
    basis = Basis(mesh.skfem, ElementVector(ElementQuad1()), intorder=3)
    field = basis.interpolate(u.ravel()[np.argsort(_order(basis, mesh))])
    r = np.asarray(basis.global_coordinates())[0]
    f = gradient(field) + np.eye(3)[:, :, None, None]
    f[2, 2] += np.asarray(field)[0] / r
    f = np.moveaxis(f, (0, 1), (-2, -1))
    ratio = np.linalg.det(f)
    weight = 2 * np.pi * r * basis.dx
    theta = ((weight * ratio).sum(1) / weight.sum(1))[:, None]
    sigma = cauchy(material, (theta / ratio)[..., None, None] ** (1 / 3) * f)
    mean = np.trace(sigma, axis1=-2, axis2=-1) / 3
    inverse = np.linalg.inv(f)
    # the mean pressure works on the element's change of volume, the rest pointwise
    pressure = (weight * theta * mean).sum(1) / (weight * ratio).sum(1)
    kirchhoff = theta[..., None, None] * (sigma - mean[..., None, None] * np.eye(3))
    kirchhoff = kirchhoff + (pressure[:, None] * ratio)[..., None, None] * np.eye(3)
    first = np.moveaxis(kirchhoff @ np.swapaxes(inverse, -1, -2), (-2, -1), (0, 1))

    @LinearForm
    def work(v, w):
        g = gradient(v)
        g[2, 2] = np.asarray(v)[0] / w.x[0]
        return 2 * np.pi * w.x[0] * np.einsum("ij...,ij...", first, g)

    return work.assemble(basis)[_order(basis, mesh)]


def _order(basis, mesh: Mesh):
    """Unknowns of scikit-fem in the order node, direction."""
    return basis.nodal_dofs[:, np.arange(len(mesh.points))].T.ravel()
