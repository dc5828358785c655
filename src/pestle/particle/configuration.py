r"""How flats press a sphere of radius R, and the cell that they leave to it.

Three symmetric arrangements of a simple cubic cell: "simple" (two flats move along one
axis), "die" (two move, four stand), "hydrostatic" (six move alike).  The deformation is
:math:`x = \gamma/2R = \delta/R`, with :math:`\delta` the displacement of each moving
flat towards the centre.  The cell of a confined sphere, relative to the sphere:

.. math::
    \chi = \frac{6}{\pi}(1 - x)^n, \quad n = 1 \text{ (die)},\; 3 \text{ (hydrostatic)}

Reference: M. B. Shahin, thesis, Purdue University (2021), Table 2.3 and Eq. 2.42.
"""

from math import pi
from typing import Any, Literal, get_args

from pestle.errors import InputError, did_you_mean

Configuration = Literal["simple", "die", "hydrostatic"]

CONFIGURATIONS: tuple[Configuration, ...] = get_args(Configuration)

MOVING = {"simple": 2, "die": 2, "hydrostatic": 6}
"""Number of flats that move."""

EXPONENTS = {"die": 1, "hydrostatic": 3}
"""n of a confined cell: along how many axes it shrinks."""


def checked(configuration: str) -> Configuration:
    """Return a configuration, or say which ones there are."""
    for known in CONFIGURATIONS:
        if configuration == known:
            return known
    raise InputError(
        "unknown-configuration",
        f"there is no loading configuration {configuration!r}",
        hint=did_you_mean(configuration, CONFIGURATIONS),
    )


def cell(x: Any, configuration: str) -> Any:
    """Volume of the cell over that of the sphere, chi (2.42) [-]."""
    return 6.0 / pi * (1.0 - x) ** EXPONENTS[configuration]


def cell_slope(x: Any, configuration: str) -> Any:
    """Derivative of chi with x [-]."""
    n = EXPONENTS[configuration]
    return -6.0 / pi * n * (1.0 - x) ** (n - 1)


def deformation(chi: Any, configuration: str) -> Any:
    """Deformation x at a cell volume chi (2.42) [-]."""
    return 1.0 - (pi * chi / 6.0) ** (1.0 / EXPONENTS[configuration])
