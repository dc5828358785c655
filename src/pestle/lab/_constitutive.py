"""Elastic-plastic response at a point, in principal axes of the trial state.

sigma = C : ln V with von Mises yield on the Cauchy stress. Numbers are plain floats, so
that the same functions run compiled and in plain Python. Sources of the formulas: E. A.
de Souza Neto, D. Peric and D. R. J. Owen, Computational Methods for Plasticity (2008),
chapters 7 (return mapping) and 14 (logarithmic strain).
"""

from math import atanh, sqrt

from pestle.lab._compile import inner

PERFECT, POWER, TABLE = 0, 1, 2
"""Kinds of hardening."""

_ITERATIONS = 100


@inner
def flow_stress(kind, table, strain):
    """Yield stress [Pa] and its slope [Pa] at a plastic strain [-].

    `table` holds rows (plastic strain, yield stress); a power law keeps (reference
    strain, initial yield stress) in its first and (exponent, 0) in its second row:
    sigma = Y (1 + strain / reference)^exponent.
    """
    if kind == 0:
        return table[0, 1], 0.0
    if kind == 1:
        reference, start, exponent = table[0, 0], table[0, 1], table[1, 0]
        base = 1.0 + strain / reference
        stress = start * base**exponent
        return stress, exponent * stress / (base * reference)
    last = table.shape[0] - 1
    if strain >= table[last, 0]:
        return table[last, 1], 0.0
    i = 0
    while strain >= table[i + 1, 0]:
        i += 1
    slope = (table[i + 1, 1] - table[i, 1]) / (table[i + 1, 0] - table[i, 0])
    return table[i, 1] + slope * (strain - table[i, 0]), slope


@inner
def plastic_increment(trial, strain, three_g, kind, table):
    """Root of trial - 3 G d = sigma_y(strain + d): Newton, kept inside a bracket."""
    low, high = 0.0, trial / three_g
    d = 0.0
    stress, slope = flow_stress(kind, table, strain)
    for _ in range(_ITERATIONS):
        value = trial - three_g * d - stress
        if value > 0.0:
            low = d
        else:
            high = d
        new = d + value / (three_g + slope)
        if not low <= new <= high:
            new = 0.5 * (low + high)
        done = abs(new - d) <= 1e-15 * new
        d = new
        stress, slope = flow_stress(kind, table, strain + d)
        if done:
            break
    return d, slope


@inner
def log_difference(mean, radius):
    """Return (ln b1 - ln b2) / (b1 - b2) for b = mean +- radius.

    atanh(x)/(x mean), x = radius/mean, without cancellation.
    """
    x = radius / mean
    if x < 1e-3:
        y = x * x
        return (1.0 + y * (1.0 / 3.0 + y * (0.2 + y / 7.0))) / mean
    return atanh(x) / (x * mean)


@inner
def update(e1, e2, e3, strain, bulk, shear, kind, table, out):
    """Return map the trial logarithmic strains; the answer is written to `out`.

    out[0:3] principal Cauchy stresses, out[3:6] elastic strains, out[6] plastic
    strain, out[7] factor of the trial deviator, out[8] coefficient of n (x) n in the
    modulus, out[9:12] unit deviator n, out[12] von Mises stress.
    """
    volume = e1 + e2 + e3
    third = volume / 3.0
    d1, d2, d3 = e1 - third, e2 - third, e3 - third
    norm = sqrt(d1 * d1 + d2 * d2 + d3 * d3)
    trial = sqrt(6.0) * shear * norm
    stress, _ = flow_stress(kind, table, strain)
    factor, coefficient, step = 1.0, 0.0, 0.0
    if trial > stress:
        three_g = 3.0 * shear
        step, slope = plastic_increment(trial, strain, three_g, kind, table)
        ratio = three_g * step / trial
        factor = 1.0 - ratio
        coefficient = 2.0 * shear * (three_g / (three_g + slope) - ratio)
    p = bulk * volume
    two_g = 2.0 * shear * factor
    out[0], out[1], out[2] = p + two_g * d1, p + two_g * d2, p + two_g * d3
    out[3], out[4], out[5] = (
        third + factor * d1,
        third + factor * d2,
        third + factor * d3,
    )
    out[6] = strain + step
    out[7] = factor
    out[8] = coefficient
    inverse = 1.0 / norm if norm > 0.0 else 0.0
    out[9], out[10], out[11] = d1 * inverse, d2 * inverse, d3 * inverse
    out[12] = factor * trial
