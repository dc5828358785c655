r"""The elliptic indenter of an MDR contact: plain functions of numbers.

Equation numbers are those of Zunker & Kamrin (2024), Part I; [Dn] are decisions of the
reading notes.  Like all functions of the law they are scalar and free of data-dependent
loops, so that the compiler turns the engine's loop over contacts into SIMD.
"""

from math import sqrt


def decay(x: float) -> float:
    """exp(x) for -10 <= x <= 0 to 4e-15, by squaring a Taylor polynomial [-]."""
    y = max(x, -10.0) * 0.03125
    p = 1.0 / 39916800.0
    p = p * y + 1.0 / 3628800.0
    p = p * y + 1.0 / 362880.0
    p = p * y + 1.0 / 40320.0
    p = p * y + 1.0 / 5040.0
    p = p * y + 1.0 / 720.0
    p = p * y + 1.0 / 120.0
    p = p * y + 1.0 / 24.0
    p = p * y + 1.0 / 6.0
    p = p * y + 0.5
    p = p * y + 1.0
    p = p * y + 1.0
    p = p * p
    p = p * p
    p = p * p
    p = p * p
    return p * p


def hardening(x: float, rise: float, fall: float) -> float:
    """p_Y / Y = a exp(-b x) + 1 at x = delta_max / R, (16) with [D6] [-]."""
    return rise * decay(-fall * x) + 1.0


def indented(t: float) -> float:
    """acos(1 - 2t) - (1 - 2t) 2 sqrt(t - t^2), 0 <= t <= 1/2, to round-off: (30).

    The function is t^1.5 times a smooth one, here a polynomial: no cancellation.
    """
    p = -0.17221952324072604
    p = p * t + 0.49366742340336056
    p = p * t - 0.6906045821807619
    p = p * t + 0.5758994424222323
    p = p * t - 0.33428270354054423
    p = p * t + 0.1250801684832229
    p = p * t - 0.04614130362037028
    p = p * t - 0.0031433740901652546
    p = p * t - 0.01634846331010071
    p = p * t - 0.021749249631870887
    p = p * t - 0.033663023112940844
    p = p * t - 0.056817744546010074
    p = p * t - 0.11111112365280747
    p = p * t - 0.285714285526146
    p = p * t - 1.6000000000011116
    p = p * t + 5.333333333333335
    return t * sqrt(t) * p


def indented_work(t: float) -> float:
    """Integral of `indented` from 0 to t [-]."""
    p = -0.007615001423107151
    p = p * t + 0.021401708996664666
    p = p * t - 0.02985790004501196
    p = p * t + 0.024603976920906122
    p = p * t - 0.014451594580818088
    p = p * t + 0.005091070956434357
    p = p * t - 0.0023318599436322716
    p = p * t - 0.0007153464577438112
    p = p * t - 0.001646520838079092
    p = p * t - 0.002568203821263391
    p = p * t - 0.004487567786921956
    p = p * t - 0.008741240252004482
    p = p * t - 0.020202020732052517
    p = p * t - 0.06349206348411514
    p = p * t - 0.4571428571429041
    p = p * t + 2.1333333333333333
    return t * t * sqrt(t) * p


def peel(de: float, stretch: float, r: float, pulled: bool) -> tuple[bool, bool, float]:
    """Adhesion: springs stretch to Delta l at the rim, then it peels [D2]-[D4].

    All lengths along the axis are over half the indenter's height, here 1, and radii
    over half its width.  At the rim of a peeling contact of radius r = s^2 the springs
    meet the indenter: u = 1 - sqrt(1 - r^2) = de + stretch s.  Squared this is a
    quartic in s, convex where it counts.

    Parameters
    ----------
    de : float
        Displacement of the indenter, negative when pulled out [-].
    stretch : float
        Delta l of a contact as wide as the indenter [-].
    r : float
        Adhered contact radius [-].
    pulled : bool
        The contact would be smaller than that without adhesion.

    Returns
    -------
    holds, parted : bool
        Adhesion acts; it has just let go.
    r : float
        Contact radius if adhesion holds [-].
    """
    s = sqrt(r)
    u = de + stretch * s
    peels = pulled and u < 1.0 and r * r > u * (2.0 - u)
    parted = False
    for _ in range(4):  # Halley from the right: never passes a root
        u = de + stretch * s
        square = s * s
        over = square * square - u * (2.0 - u)
        grows = 2.0 * square * s - stretch * (1.0 - u)  # its derivative / 2
        bends = over * (6.0 * square + stretch * stretch)  # second derivative / 2
        # a quartic with a root further left falls more steeply than this
        parted = parted or 1.5 * grows * abs(grows) < bends
        s -= 2.0 * over * grows / max(4.0 * grows * grows - bends, 1e-200)
        parted = parted or s <= 0.0
        s = min(max(s, 0.0), 1.0)
    parted = peels and parted
    return pulled and not parted, parted, s * s if peels else r
