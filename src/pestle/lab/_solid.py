"""The element loop in three dimensions: eight-node elements with a mean volume ratio.

The same material and F-bar as in `_element`; components at a point are in the principal
axes of the trial elastic strain, of which `axes` holds the directions in its columns.
"""

from math import exp, log

import numpy as np

from pestle.lab._compile import inner, kernel
from pestle.lab._constitutive import log_difference, update


@inner
def gradient_of(g, u, f):
    """F of one point from nodal displacements; returns J."""
    for i in range(3):
        for k in range(3):
            f[i, k] = 1.0 if i == k else 0.0
            for a in range(8):
                f[i, k] += u[a, i] * g[a, k]
    return (
        f[0, 0] * (f[1, 1] * f[2, 2] - f[1, 2] * f[2, 1])
        - f[0, 1] * (f[1, 0] * f[2, 2] - f[1, 2] * f[2, 0])
        + f[0, 2] * (f[1, 0] * f[2, 1] - f[1, 1] * f[2, 0])
    )


@inner
def trial(f, scale, state, out, constants, table):
    """Principal axes and values of b, and the return mapping into `out`."""
    metric = np.empty((3, 3))
    metric[0, 0], metric[1, 1], metric[2, 2] = state[0], state[1], state[2]
    metric[0, 1] = metric[1, 0] = state[3]
    metric[1, 2] = metric[2, 1] = state[4]
    metric[0, 2] = metric[2, 0] = state[5]
    g = scale * f
    values, axes = np.linalg.eigh(g @ metric @ g.T)
    update(
        0.5 * log(values[0]),
        0.5 * log(values[1]),
        0.5 * log(values[2]),
        state[6],
        constants[0],
        constants[1],
        int(constants[2]),
        table,
        out,
    )
    return values, axes


@inner
def keep(f, scale, axes, out, old, new):
    """New inverse plastic metric and plastic strain."""
    new[:] = old
    if out[6] > old[6]:
        elastic = np.zeros((3, 3))
        for a in range(3):
            b = exp(2.0 * out[3 + a])
            for i in range(3):
                for j in range(3):
                    elastic[i, j] += b * axes[i, a] * axes[j, a]
        inverse = np.linalg.inv(scale * f)
        metric = inverse @ elastic @ inverse.T
        new[0], new[1], new[2] = metric[0, 0], metric[1, 1], metric[2, 2]
        new[3], new[4], new[5] = metric[0, 1], metric[1, 2], metric[0, 2]
        new[6] = out[6]


@inner
def shear_moduli(values, factor, shear, turn):
    """Factors of l_ab b_b + l_ba b_a in the shear stress between two axes."""
    for a in range(3):
        for b in range(3):
            high, low = max(values[a], values[b]), min(values[a], values[b])
            slope = log_difference(0.5 * (high + low), 0.5 * (high - low))
            turn[a, b] = shear * factor * slope


@inner
def add_solid_point(
    weight, gamma, axes, shift, values, turn, bulk, shear, out, first, force, matrix
):
    """Add forces and stiffness of one point; gamma = spatial gradients (8, 3)."""
    p = (out[0] + out[1] + out[2]) / 3.0
    turned = gamma @ axes
    bar = np.empty((24, 3, 3))
    rates = np.empty((24, 3, 3))
    works = np.empty(24)
    g2 = 2.0 * shear * out[7]
    for i in range(24):
        node, direction = i // 3, i % 3
        for a in range(3):
            for b in range(3):
                bar[i, a, b] = axes[direction, a] * turned[node, b]
            bar[i, a, a] += shift[i]
        volume = bar[i, 0, 0] + bar[i, 1, 1] + bar[i, 2, 2]
        along = 0.0
        for a in range(3):
            along += out[8] * out[9 + a] * bar[i, a, a]
        works[i] = 0.0
        for a in range(3):
            works[i] += out[a] * bar[i, a, a]
            for b in range(3):
                rates[i, a, b] = turn[a, b] * (
                    bar[i, a, b] * values[b] + bar[i, b, a] * values[a]
                )
            plain = (bulk - g2 / 3.0) * volume
            rates[i, a, a] = plain + g2 * bar[i, a, a] - along * out[9 + a]
        force[i] += weight * works[i]
    for i in range(24):
        for j in range(24):
            total = works[i] * first[j]
            for a in range(3):
                for b in range(3):
                    total += bar[i, a, b] * rates[j, a, b]
            other, spin = 0.0, 0.0
            for a in range(3):
                both = axes[i % 3, a] * turned[j // 3, a]
                other += both
                spin += out[a] * both
            matrix[i, j] += weight * (total + gamma[i // 3, j % 3] * (p * other - spin))


@kernel
def solid_pass(
    u,
    cells,
    gradients,
    weights,
    state,
    constants,
    table,
    forces,
    matrices,
    new_state,
    stress,
):
    """Forces, stiffness and new state of all elements.

    As `pestle.lab._element.element_pass` with u (nodes, 3), cells (elements, 8),
    gradients (elements, 8, 8, 3), weights (elements, 8), states (elements, 8, 7) =
    inverse plastic metric (xx, yy, zz, xy, yz, xz) and plastic strain, stress
    (elements, 8, 3) = pressure, von Mises stress, volume ratio.
    """
    local = np.empty((8, 3))
    f = np.empty((8, 3, 3))
    gamma = np.empty((8, 8, 3))
    first, shift = np.empty(24), np.empty(24)
    second = np.empty((24, 24))
    ratio = np.empty(8)
    out = np.empty(17)
    turn = np.empty((3, 3))
    for k in range(cells.shape[0]):
        for a in range(8):
            for i in range(3):
                local[a, i] = u[cells[k, a], i]
        first[:] = 0.0
        second[:, :] = 0.0
        volume, total = 0.0, 0.0
        for q in range(8):
            ratio[q] = gradient_of(gradients[k, q], local, f[q])
            if ratio[q] <= 0.0:
                return 1
            wj = weights[k, q] * ratio[q]
            volume += wj
            total += weights[k, q]
            gamma[q] = gradients[k, q] @ np.linalg.inv(f[q])
            for i in range(24):
                first[i] += wj * gamma[q, i // 3, i % 3]
                for j in range(24):
                    second[i, j] += wj * (
                        gamma[q, i // 3, i % 3] * gamma[q, j // 3, j % 3]
                        - gamma[q, i // 3, j % 3] * gamma[q, j // 3, i % 3]
                    )
        theta = volume / total
        for i in range(24):
            first[i] /= volume
        force, matrix = forces[k], matrices[k]
        force[:] = 0.0
        matrix[:, :] = 0.0
        pressure = 0.0
        for q in range(8):
            scale = (theta / ratio[q]) ** (1.0 / 3.0)
            values, axes = trial(f[q], scale, state[k, q], out, constants, table)
            keep(f[q], scale, axes, out, state[k, q], new_state[k, q])
            shear_moduli(values, out[7], constants[1], turn)
            for i in range(24):
                shift[i] = (first[i] - gamma[q, i // 3, i % 3]) / 3.0
            weight = weights[k, q] * theta
            add_solid_point(
                weight,
                gamma[q],
                axes,
                shift,
                values,
                turn,
                constants[0],
                constants[1],
                out,
                first,
                force,
                matrix,
            )
            mean = (out[0] + out[1] + out[2]) / 3.0
            pressure += weight * mean
            stress[k, q, 0], stress[k, q, 1] = -mean, out[12]
            stress[k, q, 2] = theta
        for i in range(24):
            for j in range(24):
                matrix[i, j] += pressure * (second[i, j] / volume - first[i] * first[j])
    return 0
