"""An elastic sphere between two flats, exactly but for small strains.

Hertz' force is that of a half space.  Here the flats press Hertz' pressure on both
poles of a sphere; its even Legendre coefficients give the displacements of the surface
mode by mode (E. Sternberg and F. Rosenthal, J. Appl. Mech. 19 (1952) 413-421, solve the
same sphere under point loads).  What the approach is more than Hertz', averaged with
the pressure of a flat punch, is by reciprocity what the force is less.  Lengths in
radii, stresses in Young's moduli.
"""

import numpy as np


def force_over_hertz(poisson, depth):
    """Force at a depth over that of Hertz, to first order in the contact radius."""
    a = np.sqrt(depth)
    n = np.arange(2.0, 3000.0 / a, 2.0)
    peak = 2.0 * a / np.pi / (1.0 - poisson**2)
    k = n + 0.5  # Legendre's polynomial near the pole is J_0(k r)
    sine, bessel = np.sin(k * a) / (k * a), _j1(k * a)
    load = (2.0 * n + 1.0) * peak * a**2 * bessel / (k * a)
    radial, along = modes(n, poisson)
    # averages of J_0(k r) and of k r J_1(k r) with 1/sqrt(a^2 - r^2)
    approach = np.sum(load * (radial * sine + along * k * a * bessel))
    approach += peak * a**2 / 3.0 * (1.0 - 2.0 * poisson)  # n = 0: all-round pressure
    return 1.0 - 1.5 * (approach - 2.0 * depth / 3.0) / depth


def modes(n, poisson):
    """Radial displacement over P_n, and the one along the surface over dP_n/dtheta.

    For a pressure P_n on the sphere, displacements towards the centre.  They are
    a grad(phi) + r^2 grad(phi) + c x phi with the harmonic phi = r^n P_n; c is what
    makes them an equilibrium, a what leaves the surface without shear.
    """
    ratio = poisson / (1.0 - 2.0 * poisson)
    c = -2.0 * (3.0 * n + 1.0 - 2.0 * poisson * (2.0 * n + 1.0))
    c /= n + 5.0 - 4.0 * poisson
    a = -(2.0 * n + c) / (2.0 * (n - 1.0))
    stress = a * n * (n - 1.0) + (n + c) * (n + 1.0)
    stress += ratio * (2.0 * n + c * (n + 3.0))
    stress /= 1.0 + poisson  # 2 G
    return (a * n + n + c) / stress, (a + 1.0) / stress


def _j1(x):
    return (np.sin(x) - x * np.cos(x)) / x**2
