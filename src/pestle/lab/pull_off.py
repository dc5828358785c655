r"""Adhesion of a relaxed profile: its MDR image, peeled until it separates.

.. math::
    g(x) &= |x| \int_0^{|x|} \frac{f'(r)}{\sqrt{x^2 - r^2}}\,dr \\
    d(a) &= g(a) - \sqrt{2 \pi a W / E^*} \\
    F(a) &= 2 E^* \int_0^a [d(a) - g(x)]\,dx

f is the height of the relaxed surface over the distance from the axis, a the contact
radius while the flat is withdrawn by d, W the work of adhesion.  The most tensile force
before d turns is the pull-off force.

Reference: W. Zunker and K. Kamrin, J. Mech. Phys. Solids 183 (2024) 105492, Eqs. (1),
(11), appendix F.2.
"""

from typing import NamedTuple

import numpy as np

from pestle.errors import InputError
from pestle.lab.measure import profile
from pestle.lab.mesh import Floats
from pestle.lab.sphere import Sphere, Unloading

_POINTS = 1500


class PullOff(NamedTuple):
    """Where a flat comes off."""

    force: float  # most tensile force, negative [E R^2]
    radius: float  # contact radius there [R]
    separation_radius: float  # contact radius at which it separates [R]


def mdr_image(radii: Floats, heights: Floats, x: Floats) -> Floats:
    """Image g at positions x of a profile that is straight between its points [R].

    Examples
    --------
    >>> r = np.linspace(0.0, 0.1, 2001)
    >>> g = mdr_image(r, 0.5 * r**2, np.array([0.05, 0.1]))
    >>> g.round(6).tolist()
    [0.0025, 0.01]
    """
    slopes = np.diff(heights) / np.diff(radii)
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.arcsin(np.clip(radii[None, :] / x[:, None], 0.0, 1.0))
    image = x * np.sum(slopes * np.diff(share, axis=1), axis=1)
    return np.asarray(np.where(x > 0.0, image, 0.0))


def peel(
    radii: Floats, heights: Floats, work_of_adhesion: float, modulus: float
) -> PullOff:
    """Withdraw a flat from a profile, from its last point inwards.

    Parameters
    ----------
    radii, heights : arrays
        The relaxed profile from the axis to the largest contact radius [R].
    work_of_adhesion : float
        W [E R].
    modulus : float
        E* [E].
    """
    if not work_of_adhesion > 0.0:
        raise InputError(
            "no-adhesion",
            f"a work of adhesion of {work_of_adhesion!r} pulls nothing off",
            hint="give a positive one, in Young's modulus times radius",
        )
    from scipy.interpolate import PchipInterpolator

    fine = np.linspace(0.0, radii[-1], _POINTS)
    smooth = PchipInterpolator(radii, heights)(fine)
    a = fine[1:]
    g = mdr_image(fine, smooth - smooth[0], a)
    steps = np.diff(fine)
    inner = np.concatenate([[0.0], g])
    area = np.cumsum(0.5 * (inner[1:] + inner[:-1]) * steps)
    depth = g - np.sqrt(2.0 * np.pi * a * work_of_adhesion / modulus)
    force = 2.0 * modulus * (a * depth - area)
    turn = np.flatnonzero(np.diff(depth)[::-1] <= 0.0)  # from outside inwards
    last = len(a) - 1 - (int(turn[0]) if turn.size else len(a) - 1)
    path = slice(last, None)
    best = last + int(np.argmin(force[path]))
    return PullOff(float(force[best]), float(a[best]), float(a[last]))


def relaxed_pull_off(
    sphere: Sphere, branch: Unloading, work_of_adhesion: float
) -> PullOff:
    """Pull-off of the relaxed sphere of a branch, from its largest contact radius.

    Parameters
    ----------
    sphere : Sphere
        Mesh and material.
    branch : Unloading
        Where it was unloaded from.
    work_of_adhesion : float
        W [E R].
    """
    r, z = profile(sphere.mesh, branch.relaxed.equilibrium.u)
    inside = r < branch.start.radius[1]
    if np.count_nonzero(inside) < 4:
        raise InputError(
            "mesh-too-coarse",
            "the contact has fewer than 4 nodes: its profile is not resolved",
            hint="a finer mesh or a deeper contact",
        )
    modulus = sphere.material.plane_strain_modulus
    return peel(r[inside], z[inside], work_of_adhesion, modulus)


def dimple(sphere: Sphere, branch: Unloading) -> tuple[float, float]:
    """Place r_peak and depth Xi of a relaxed profile's lowest ring, 0 without one [R].

    Zunker and Kamrin, appendix F.1.
    """
    r, z = profile(sphere.mesh, branch.relaxed.equilibrium.u)
    low = int(np.argmin(z))
    return float(r[low]), float(z[0] - z[low])
