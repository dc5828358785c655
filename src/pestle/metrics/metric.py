"""One number that people read off a run, with its unit and definition."""

import math
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Metric:
    """A number with what is needed to understand it.

    Parameters
    ----------
    key : str
        Name in ``metrics.json``.
    label : str
        Name for people.
    value : float
        SI value.
    unit : str
        SI unit, "-" if none.
    definition : str
        How it was measured, in one sentence.
    group : str
        Heading under which it is shown.
    """

    key: str
    label: str
    value: float
    unit: str
    definition: str
    group: str

    @property
    def is_known(self) -> bool:
        """Whether the value is a finite number."""
        return math.isfinite(self.value)


@dataclass(frozen=True, slots=True)
class Group:
    """Makes metrics under one heading."""

    name: str

    def metric(
        self, key: str, label: str, value: float, *, unit: str, definition: str
    ) -> Metric:
        """Make a metric of this group."""
        return Metric(key, label, float(value), unit, definition, self.name)
