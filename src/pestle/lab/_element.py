"""The element loop: four-node axisymmetric elements with a mean volume ratio (F-bar).

F-bar = (theta/J)^(1/3) F, theta = the element's mean of J, and the virtual work uses
the variation of F-bar itself: then the work of the forces is the work of the stresses,
element by element. Components are (r, z) in the plane and t around the axis.
Everything at a point happens in the principal axes of the trial elastic strain.
"""

from math import exp, log, sqrt

import numpy as np

from pestle.lab._compile import inner, kernel
from pestle.lab._constitutive import log_difference, update

INVERTED = 1
"""Status: an element is turned inside out."""


@inner
def plane_gradient(g, u, gradient):
    """F of one point from nodal displacements: (rr, rz, zr, zz, tt) and J."""
    frr, frz, fzr, fzz, ftt = 1.0, 0.0, 0.0, 1.0, 1.0
    for a in range(4):
        frr += u[a, 0] * g[a, 0]
        frz += u[a, 0] * g[a, 1]
        fzr += u[a, 1] * g[a, 0]
        fzz += u[a, 1] * g[a, 1]
        ftt += u[a, 0] * g[a, 2]
    gradient[0], gradient[1], gradient[2] = frr, frz, fzr
    gradient[3], gradient[4] = fzz, ftt
    return (frr * fzz - frz * fzr) * ftt


@inner
def volume_part(g, f, weight, h, first, second, tangent):
    """Spatial gradients h of the 8 shape vectors; adds a point to mean-volume sums.

    h[i] = (rr, rz, zr, zz, tt); first = sum w J tr h_i,
    second = sum w J (tr h_i tr h_j - tr(h_i h_j)).
    """
    j2 = f[0] * f[3] - f[1] * f[2]
    wj = weight * j2 * f[4]
    for a in range(4):
        gr = (g[a, 0] * f[3] - g[a, 1] * f[2]) / j2
        gz = (-g[a, 0] * f[1] + g[a, 1] * f[0]) / j2
        r, z = 2 * a, 2 * a + 1
        h[r, 0], h[r, 1], h[r, 2], h[r, 3], h[r, 4] = gr, gz, 0.0, 0.0, g[a, 2] / f[4]
        h[z, 0], h[z, 1], h[z, 2], h[z, 3], h[z, 4] = 0.0, 0.0, gr, gz, 0.0
    for i in range(8):
        trace = h[i, 0] + h[i, 3] + h[i, 4]
        first[i] += wj * trace
        if tangent:
            for j in range(8):
                second[i, j] += wj * (
                    trace * (h[j, 0] + h[j, 3] + h[j, 4])
                    - h[i, 0] * h[j, 0]
                    - h[i, 3] * h[j, 3]
                    - h[i, 4] * h[j, 4]
                    - h[i, 1] * h[j, 2]
                    - h[i, 2] * h[j, 1]
                )


@inner
def respond(f, scale, state, constants, table, out):
    """Trial strain, return mapping; new inverse plastic metric into out[13:17].

    `state` = (C_p^-1 rr, rz, zz, tt, plastic strain). Returns the direction (cos, sin)
    of the first principal axis and (ln b1 - ln b2)/(b1 - b2).
    """
    frr, frz, fzr, fzz, ftt = (
        scale * f[0],
        scale * f[1],
        scale * f[2],
        scale * f[3],
        scale * f[4],
    )
    crr, crz, czz, ctt = state[0], state[1], state[2], state[3]
    xr, yr = frr * crr + frz * crz, frr * crz + frz * czz
    xz, yz = fzr * crr + fzz * crz, fzr * crz + fzz * czz
    brr, brz, bzz = xr * frr + yr * frz, xr * fzr + yr * fzz, xz * fzr + yz * fzz
    btt = ftt * ftt * ctt
    mean, half, radius = 0.5 * (brr + bzz), 0.5 * (brr - bzz), 0.0
    radius = sqrt(half * half + brz * brz)
    slope = log_difference(mean, radius)
    j2 = frr * fzz - frz * fzr
    det = j2 * j2 * (crr * czz - crz * crz)
    middle = 0.25 * log(det)
    spread = 0.5 * slope * radius
    c, s = 1.0, 0.0
    if radius > 0.0:
        cos2 = half / radius
        if cos2 > 0.0:
            c = sqrt(0.5 * (1.0 + cos2))
            s = 0.5 * brz / (radius * c)
        else:
            s = sqrt(0.5 * (1.0 - cos2))
            c = 0.5 * brz / (radius * s)
    kind = int(constants[2])
    update(
        middle + spread,
        middle - spread,
        0.5 * log(btt),
        state[4],
        constants[0],
        constants[1],
        kind,
        table,
        out,
    )
    if out[6] > state[4]:
        b1, b2, b3 = exp(2.0 * out[3]), exp(2.0 * out[4]), exp(2.0 * out[5])
        err, ezz = c * c * b1 + s * s * b2, s * s * b1 + c * c * b2
        erz = c * s * (b1 - b2)
        irr, irz, izr, izz = fzz / j2, -frz / j2, -fzr / j2, frr / j2
        xr, yr = irr * err + irz * erz, irr * erz + irz * ezz
        xz, yz = izr * err + izz * erz, izr * erz + izz * ezz
        out[13], out[14] = xr * irr + yr * irz, xr * izr + yr * izz
        out[15], out[16] = xz * izr + yz * izz, b3 / (ftt * ftt)
    else:
        out[13], out[14], out[15], out[16] = crr, crz, czz, ctt
    return c, s, slope, mean, radius


@inner
def to_axes(h, c, s, rotated):
    """Turn gradients (rr, rz, zr, zz, tt) to principal axes (11, 12, 21, 22, tt)."""
    for i in range(8):
        rr, rz, zr, zz = h[i, 0], h[i, 1], h[i, 2], h[i, 3]
        both = c * s * (rz + zr)
        rotated[i, 0] = c * c * rr + both + s * s * zz
        rotated[i, 3] = s * s * rr - both + c * c * zz
        rotated[i, 1] = c * s * (zz - rr) + c * c * rz - s * s * zr
        rotated[i, 2] = c * s * (zz - rr) - s * s * rz + c * c * zr
        rotated[i, 4] = h[i, 4]


@inner
def stress_rates(bar, bulk, shear, out, geometry, rates):
    """Change of the stress (11, 12+21, 22, tt) along each of the 8 gradients l.

    `geometry` = (ln b1 - ln b2)/(b1 - b2), b1, b2.
    """
    g2 = 2.0 * shear * out[7]
    turn = 0.5 * g2 * geometry[0]
    for i in range(8):
        volume = bar[i, 0] + bar[i, 3] + bar[i, 4]
        plain = (bulk - g2 / 3.0) * volume
        along = out[8] * (
            out[9] * bar[i, 0] + out[10] * bar[i, 3] + out[11] * bar[i, 4]
        )
        rates[i, 0] = plain + g2 * bar[i, 0] - along * out[9]
        rates[i, 2] = plain + g2 * bar[i, 3] - along * out[10]
        rates[i, 3] = plain + g2 * bar[i, 4] - along * out[11]
        rates[i, 1] = turn * (bar[i, 1] * geometry[2] + bar[i, 2] * geometry[1])


@inner
def add_point(weight, h, bar, rates, out, first, force, matrix, tangent):
    """Add one point's forces and stiffness; weight = w theta."""
    s1, s2, s3 = out[0], out[1], out[2]
    p = (s1 + s2 + s3) / 3.0
    for i in range(8):
        work = s1 * bar[i, 0] + s2 * bar[i, 3] + s3 * bar[i, 4]
        force[i] += weight * work
        if not tangent:
            continue
        for j in range(8):
            a = h[i, 0] * h[j, 0]
            b = h[i, 3] * h[j, 3]
            d = h[i, 4] * h[j, 4]
            e, o = h[i, 1] * h[j, 2], h[i, 2] * h[j, 1]
            matrix[i, j] += weight * (
                bar[i, 0] * rates[j, 0]
                + bar[i, 3] * rates[j, 2]
                + bar[i, 4] * rates[j, 3]
                + (bar[i, 1] + bar[i, 2]) * rates[j, 1]
                + work * first[j]
                - s1 * (a + e)
                - s2 * (b + o)
                - s3 * d
                + p * (a + b + d + e + o)
            )


@kernel
def element_pass(
    u,
    cells,
    gradients,
    weights,
    state,
    constants,
    table,
    tangent,
    forces,
    matrices,
    new_state,
    stress,
):
    """Forces, stiffness and new state of all elements.

    Parameters
    ----------
    u : array (nodes, 2)
        Displacements.
    cells : array (elements, 4)
        Node numbers.
    gradients : array (elements, 4, 4, 3)
        dN/dr, dN/dz, N/r of each node at each of the 4 points.
    weights : array (elements, 4)
        Reference volume of the points, around the whole axis.
    state : array (elements, 4, 5)
        Inverse plastic metric (rr, rz, zz, tt) and plastic strain at the last step.
    constants : array (3,)
        Bulk and shear modulus, kind of hardening.
    table : array
        See `flow_stress`.
    tangent : bool
        Whether to build the stiffness.
    forces, matrices : arrays (elements, 8), (elements, 8, 8)
        Output.
    new_state : array (elements, 4, 5)
        Output.
    stress : array (elements, 4, 7)
        Output: Cauchy stress rr, rz, zz, tt, von Mises stress, elastic energy per
        current volume, volume ratio.

    Returns
    -------
    int
        0, or 1 if an element is turned inside out.
    """
    local = np.empty((4, 2))
    f = np.empty((4, 5))
    h = np.empty((4, 8, 5))
    bar = np.empty((8, 5))
    axes = np.empty((8, 5))
    rates = np.empty((8, 4))
    first = np.empty(8)
    second = np.empty((8, 8))
    ratio = np.empty(4)
    out = np.empty(17)
    geometry = np.empty(3)
    bulk, shear = constants[0], constants[1]
    for k in range(cells.shape[0]):
        for a in range(4):
            local[a, 0], local[a, 1] = u[cells[k, a], 0], u[cells[k, a], 1]
        first[:] = 0.0
        second[:, :] = 0.0
        volume, total = 0.0, 0.0
        for q in range(4):
            ratio[q] = plane_gradient(gradients[k, q], local, f[q])
            if ratio[q] <= 0.0 or f[q, 4] <= 0.0:
                return 1
            volume += weights[k, q] * ratio[q]
            total += weights[k, q]
            volume_part(
                gradients[k, q], f[q], weights[k, q], h[q], first, second, tangent
            )
        theta = volume / total
        for i in range(8):
            first[i] /= volume
        force, matrix = forces[k], matrices[k]
        force[:] = 0.0
        matrix[:, :] = 0.0
        pressure = 0.0
        for q in range(4):
            scale = (theta / ratio[q]) ** (1.0 / 3.0)
            c, s, slope, mean, radius = respond(
                f[q], scale, state[k, q], constants, table, out
            )
            weight = weights[k, q] * theta
            to_axes(h[q], c, s, axes)
            for i in range(8):
                shift = (first[i] - axes[i, 0] - axes[i, 3] - axes[i, 4]) / 3.0
                bar[i, 0], bar[i, 3] = axes[i, 0] + shift, axes[i, 3] + shift
                bar[i, 4] = axes[i, 4] + shift
                bar[i, 1], bar[i, 2] = axes[i, 1], axes[i, 2]
            if tangent:
                geometry[0] = slope
                geometry[1], geometry[2] = mean + radius, mean - radius
                stress_rates(bar, bulk, shear, out, geometry, rates)
            add_point(weight, axes, bar, rates, out, first, force, matrix, tangent)
            pressure += weight * (out[0] + out[1] + out[2]) / 3.0
            for i in range(4):
                new_state[k, q, i] = out[13 + i]
            new_state[k, q, 4] = out[6]
            stress[k, q, 0] = c * c * out[0] + s * s * out[1]
            stress[k, q, 1] = c * s * (out[0] - out[1])
            stress[k, q, 2] = s * s * out[0] + c * c * out[1]
            stress[k, q, 3] = out[2]
            stress[k, q, 4] = out[12]
            stress[k, q, 5] = 0.5 * (
                out[0] * out[3] + out[1] * out[4] + out[2] * out[5]
            )
            stress[k, q, 6] = theta
        if tangent:
            for i in range(8):
                for j in range(8):
                    matrix[i, j] += pressure * (
                        second[i, j] / volume - first[i] * first[j]
                    )
    return 0
