"""What a law of a single particle is: a loading curve, and ways to unload from it.

A particle of a radius is pressed by flats in a configuration.  `displacement` is that
of each moving flat towards the centre [m], positive in compression; two platens that
approach by s have moved by s/2 each.  A loading law answers with force and contact
radius of one moving flat, an unloading law with those below a peak, and a `Cycle` of
both follows any path.  Arrays in, arrays out; a parameter may be an array that
broadcasts against `displacement`.
"""

import warnings
from abc import ABC, abstractmethod
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pestle.errors import InputError
from pestle.laws._options import Checked
from pestle.particle.configuration import CONFIGURATIONS, checked

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Array = NDArray[np.float64]


class Curve(NamedTuple):
    """Force [N] and contact radius [m] of one moving flat; nan where a law has none."""

    force: Array
    contact_radius: Array


class Peak(NamedTuple):
    """Where unloading begins."""

    displacement: Array  # [m]
    force: Array  # [N]
    contact_radius: Array  # [m]
    radius: float  # of the particle [m]


class Range(NamedTuple):
    """Where a law has been checked, and by whom."""

    low: float
    high: float
    source: str


class RangeWarning(UserWarning):
    """A law is used outside the range it was made for."""


_WARNED: set[tuple[str, str]] = set()
_SILENT = ContextVar("_SILENT", default=False)


@contextmanager
def no_range_warnings() -> Iterator[None]:
    """Neither warn nor remember: for a search that tries what it may not keep."""
    token = _SILENT.set(True)
    try:
        yield
    finally:
        _SILENT.reset(token)


def warn_once(law: str, quantity: str, text: str) -> None:
    """Warn about a quantity of a law, the first time only."""
    if not _SILENT.get() and (law, quantity) not in _WARNED:
        _WARNED.add((law, quantity))
        warnings.warn(f"{law}: {text}", RangeWarning, stacklevel=4)


def warn_outside(law: str, quantity: str, value: Any, limits: Range) -> None:
    """Warn once if any value of a quantity lies outside its range."""
    value = np.asarray(value, dtype=float)
    value = value[np.isfinite(value)]
    low, high = np.min(value, initial=np.inf), np.max(value, initial=-np.inf)
    slack = 1e-9 * abs(limits.high)
    if low < limits.low - slack or high > limits.high + slack:
        worst = low if low < limits.low else high
        warn_once(
            law,
            quantity,
            f"{quantity} = {worst:.4g} is outside {limits.low:.6g} to "
            f"{limits.high:.6g}, the range of {limits.source}",
        )


@dataclass(frozen=True, kw_only=True)
class ParticleLaw(Checked, ABC):
    """What loading and unloading laws share: a name, a source, checked parameters."""

    name: ClassVar[str]
    summary: ClassVar[str]
    citation: ClassVar[str]
    validity: ClassVar[str]


@dataclass(frozen=True, kw_only=True)
class Loading(ParticleLaw):
    """A law of a particle that is pressed for the first time."""

    configurations: ClassVar[tuple[str, ...]] = CONFIGURATIONS

    @abstractmethod
    def _curve(self, x: Array, radius: float, configuration: str) -> Curve:
        """Curve at deformations x = displacement/radius >= 0."""

    def curve(
        self,
        displacement: ArrayLike,
        *,
        radius: float,
        configuration: str = "simple",
    ) -> Curve:
        """Force and contact radius of one moving flat while it is pressed.

        Parameters
        ----------
        displacement : array
            Of each moving flat [m]; no contact below zero.
        radius : float
            Radius of the particle [m].
        configuration : {"simple", "die", "hydrostatic"}
            How many flats there are and which move.
        """
        if checked(configuration) not in self.configurations:
            raise InputError(
                "configuration-without-law",
                f"{self.name} says nothing about {configuration} compression",
                hint=f"it holds for {', '.join(self.configurations)}",
            )
        x = np.asarray(displacement, dtype=float) / radius
        if np.any(~(x < 1.0)):
            raise InputError(
                "flat-beyond-centre",
                f"a displacement of {np.max(x) * radius:.6g} m is not possible for a "
                f"particle of radius {radius:.6g} m",
                hint="displacements are finite and below the radius",
            )
        with np.errstate(all="ignore"):  # what a mask takes away may be anything
            force, contact = self._curve(np.maximum(x, 0.0), radius, configuration)
        touch = x > 0.0
        return Curve(np.where(touch, force, 0.0), np.where(touch, contact, 0.0))

    def plot(self, **options: Any) -> "Figure":
        """Draw force and contact radius; options of `pestle.bench.figure.draw_law`."""
        from pestle.bench.figure import draw_law

        return draw_law(self, **options)


@dataclass(frozen=True, kw_only=True)
class Unloading(ParticleLaw):
    """A law of what a particle gives back."""

    @abstractmethod
    def curve(self, displacement: Array, peak: Peak) -> Curve:
        """Force and contact radius at displacements below a peak."""


LOADING: dict[str, type[Loading]] = {}
UNLOADING: dict[str, type[Unloading]] = {}


Law = TypeVar("Law", bound=type[ParticleLaw])


def register(law: Law) -> Law:
    """Make a law known by its name; a class decorator."""
    if issubclass(law, Loading):
        LOADING[law.name] = law
    if issubclass(law, Unloading):
        UNLOADING[law.name] = law
    return law
