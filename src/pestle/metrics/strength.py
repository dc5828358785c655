"""Strength of a flat-faced tablet."""

import math


def diametral_tensile_strength(
    force: float, diameter: float, thickness: float
) -> float:
    r"""Tensile strength from diametral compression of a flat tablet.

    .. math:: \sigma_t = \frac{2 F}{\pi D t}

    Parameters
    ----------
    force : float
        Force at which the tablet breaks [N].
    diameter, thickness : float
        Size of the tablet after ejection [m].

    Returns
    -------
    float
        Tensile strength [Pa].

    Notes
    -----
    Exact for a line load on an elastic disc that breaks in tension along the loaded
    diameter (Fell and Newton, J. Pharm. Sci. 59 (1970) 688-691).

    Examples
    --------
    >>> round(diametral_tensile_strength(100.0, 8e-3, 4e-3))
    1989437
    """
    return 2.0 * force / (math.pi * diameter * thickness)
