"""What the functions of MDR pass to each other about a pair and its two sides.

Equation numbers are those of Zunker & Kamrin (2024), Part I.
"""

from typing import NamedTuple


class Constants(NamedTuple):
    """Each side against the flat (suffix i, j); the second side of a wall is unused."""

    modulus_i: float  # E_c [Pa]: composite with an elastic wall
    modulus_j: float
    yield_i: float  # Y [Pa]
    yield_j: float
    poisson_i: float  # nu [-]
    poisson_j: float
    shear_i: float  # G [Pa]
    shear_j: float
    bulk_i: float  # kappa [Pa]
    bulk_j: float
    onset_i: float  # delta_Y / R, the root of (41) [-]
    onset_j: float
    adhesion: float  # work of adhesion of the pair [J/m^2]
    rise: float  # a of (16) [-]
    fall: float  # b of (16) [-]
    always: float  # radius rule: 0 plastic, 1 eq37


class State(NamedTuple):
    """What a pair remembers; all zero before the first touch."""

    share: float  # part of the approach that moves the flat into side i, loading [-]
    share_back: float  # the same, unloading [-]
    flat_i: float  # displacement of the flat against the initial sphere, delta_o [m]
    flat_j: float
    peak_i: float  # delta_max while below it, -1 while at it [m]
    peak_j: float
    offset_i: float  # c_A of a yielded side, 0 before [m^2]
    offset_j: float
    radius_i: float  # adhered contact radius [m]
    radius_j: float


class SideConstants(NamedTuple):
    """Material of one side."""

    modulus: float  # E_c [Pa]
    yield_stress: float  # Y [Pa]
    poisson: float  # nu [-]
    shear: float  # G [Pa]
    bulk: float  # kappa [Pa]
    onset: float  # delta_Y / R [-]
    adhesion: float  # work of adhesion borne by this side [J/m^2]
    rise: float  # a of (16) [-]
    fall: float  # b of (16) [-]
    always: float  # 1: R grows by (37) in every step, as printed


class Side(NamedTuple):
    """Response and new state of one side."""

    force: float  # [N]
    radius: float  # contact radius a [m]
    stiffness: float  # dF/d delta on the elastic branch, bulk included [N/m]
    slope: float  # dF/d delta while loading, bulk included [N/m]
    elastic: float  # elastic depth of the indenter, A/2 [m]
    stored: float  # energy of the indenter [J]
    sinking: float  # work of the indenter on the sinking surface [J]
    peak: float  # delta_max below the maximum, -1 at it [m]
    offset: float  # c_A, 0 before yield [m^2]
    push: float  # force of the bulk response [N]
    cut: float  # area that the flat cuts from the sphere [m^2]
    area: float  # A_C [m^2]
    depth: float  # delta_max [m]
    at_peak: float  # 1 at the maximum
    parted: float  # 1 if adhesion has just let go


def first_side(k: Constants, w: float) -> SideConstants:
    """Constants of the first side, which bears a work of adhesion w [J/m^2]."""
    one = k.modulus_i, k.yield_i, k.poisson_i, k.shear_i, k.bulk_i, k.onset_i
    return SideConstants(*one, w, k.rise, k.fall, k.always)


def second_side(k: Constants, w: float) -> SideConstants:
    """Constants of the second side, which bears a work of adhesion w [J/m^2]."""
    two = k.modulus_j, k.yield_j, k.poisson_j, k.shear_j, k.bulk_j, k.onset_j
    return SideConstants(*two, w, k.rise, k.fall, k.always)
