"""[engine] and [output]: how the run is computed and what it writes."""

from typing import Literal

from pestle.config.base import Section
from pestle.config.quantities import Acceleration, Factor, Fraction, Steps, TimeStep


class EngineSettings(Section):
    """Numbers of the time integration."""

    gravity: tuple[Acceleration, Acceleration, Acceleration] = (0.0, 0.0, -9.81)
    """Acceleration of gravity [m/s^2]."""
    time_step: Literal["auto"] | TimeStep = "auto"
    """Time step [s], or "auto": from the stiffest state reached."""
    safety: Fraction = 0.5
    """Automatic time step over the critical one [-]."""
    mass_scaling: Factor = 1.0
    """Factor on all masses, to allow a longer step [-]; the run reports the inertial
    number that it leads to."""


class OutputSettings(Section):
    """What is written and how often."""

    history_every: Steps = 100
    """Steps between two rows of history.csv."""
    frames: Steps = 10
    """Frames of results.vtkhdf per stage; the ends of stages are always written."""
    checkpoint_every: Steps = 20_000
    """Steps between two checkpoints."""
