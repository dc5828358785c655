"""Stress of the powder as a whole."""

import numpy as np
from numpy.typing import NDArray

from pestle.metrics.packing import centre_distance
from pestle.results import Frame

Array = NDArray[np.float64]


def mean_stress_of_particles(frame: Frame, volume: float) -> Array:
    """Average the particles' own stress over a volume.

    Parameters
    ----------
    frame : Frame
        The powder at one moment, with "stress" of the particles.
    volume : float
        Volume that the powder fills, voids included [m^3].

    Returns
    -------
    ndarray
        Stress (3, 3), compression positive [Pa].
    """
    own = 4.0 / 3.0 * np.pi * frame.particles["radius_initial"] ** 3
    return np.asarray(np.einsum("n,nij->ij", own, frame.particles["stress"]) / volume)


def mean_stress_of_contacts(frame: Frame, volume: float) -> Array:
    r"""Love-Weber stress: branch vectors times contact forces over a volume.

    .. math:: \sigma_{ij} = \frac1V \sum_c f_i l_j

    Parameters
    ----------
    frame : Frame
        The powder at one moment.
    volume : float
        Volume that the powder fills, voids included [m^3].

    Returns
    -------
    ndarray
        Stress (3, 3), compression positive [Pa]; not symmetric while particles are
        being turned.

    Notes
    -----
    The branch of a wall contact ends on the wall. Inertia is left out: right while
    the powder is pressed slowly.
    """
    first, second = frame.contact_indices()
    pair = second >= 0
    length = frame.contacts["flat"].astype(np.float64, copy=True)
    length[pair] = centre_distance(frame, first, second, pair)
    branch = frame.contacts["normal"] * length[:, None]
    return np.asarray(np.einsum("ci,cj->ij", frame.contacts["force"], branch) / volume)


def pressure(stress: Array) -> Array:
    """Mean of the normal stresses [Pa] of tensors (..., 3, 3)."""
    return np.asarray(np.trace(stress, axis1=-2, axis2=-1) / 3.0)


def von_mises(stress: Array) -> Array:
    """Equivalent shear stress after von Mises [Pa] of tensors (..., 3, 3).

    Examples
    --------
    >>> float(von_mises(np.diag([3.0, 0.0, 0.0])))
    3.0
    """
    symmetric = 0.5 * (stress + np.swapaxes(stress, -1, -2))
    deviator = symmetric - pressure(symmetric)[..., None, None] * np.eye(3)
    return np.asarray(np.sqrt(1.5 * np.sum(deviator**2, axis=(-2, -1))))
