"""Any loading law with any unloading law: a whole cycle, along any path.

Above the largest displacement so far the loading law holds, below it the unloading law
from that peak; reloading retraces it.  Elastic unloading cannot lie above the curve
that it came from: where two laws would have it so, the force follows the loading curve,
and a warning says that they do not fit.  So no closed path gives energy.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from pestle.errors import InputError
from pestle.particle.law import Curve, Loading, Peak, Unloading, warn_once

if TYPE_CHECKING:
    from matplotlib.figure import Figure

TOLERANCE = 1e-6
"""Part of the peak force by which unloading may exceed loading without a warning."""


@dataclass(frozen=True, kw_only=True)
class Cycle:
    """A loading law, and an unloading law unless it is pressed only.

    Examples
    --------
    >>> from pestle.particle import Edmans2020, Shahin2021
    >>> solid = {"youngs_modulus": 5e9, "poisson_ratio": 0.3, "yield_stress": 20e6}
    >>> law = Cycle(loading=Shahin2021(**solid), unloading=Edmans2020(**solid))
    >>> [float(f.round(4)) for f in law.follow([2e-5, 1.99e-5, 0.0], radius=1e-4).force]
    [0.3946, 0.2872, 0.0]
    """

    loading: Loading
    unloading: Unloading | None = None

    @property
    def name(self) -> str:
        """Names of both laws."""
        second = "" if self.unloading is None else f"+{self.unloading.name}"
        return self.loading.name + second

    def follow(
        self, displacement: ArrayLike, *, radius: float, configuration: str = "simple"
    ) -> Curve:
        """Force and contact radius along a path; the last axis is the path.

        Parameters
        ----------
        displacement : array
            Of each moving flat, from the virgin state on [m].
        radius : float
            Radius of the particle [m].
        configuration : {"simple", "die", "hydrostatic"}
            How many flats there are and which move.
        """
        at: dict[str, Any] = {"radius": radius, "configuration": configuration}
        path = np.asarray(displacement, dtype=float)
        largest = np.maximum.accumulate(np.maximum(path, 0.0), axis=-1)
        below = path < largest
        if not np.any(below):
            return self.loading.curve(path, **at)
        if self.unloading is None:
            raise InputError(
                "law-without-unloading",
                f"the path unloads, and {self.name} says how to load only",
                hint=f"add a law of unloading, such as {self.name}+edmans2020",
            )
        top = self.loading.curve(largest, **at)
        virgin = self.loading.curve(np.minimum(path, largest), **at)
        with np.errstate(all="ignore"):  # before the first touch there is no peak
            peaks = np.where(below, largest, np.nan)  # only those that are used
            back = self.unloading.curve(path, Peak(peaks, *top, radius))
        return self._joined(below, top=top, virgin=virgin, back=back)

    def _joined(self, below: Any, *, top: Curve, virgin: Curve, back: Curve) -> Curve:
        inside = below & (top.force > 0.0)
        if np.any((back.force - virgin.force > TOLERANCE * top.force) & inside):
            warn_once(
                self.name,
                "unloading",
                "unloading is softer than loading somewhere: the force follows the "
                "loading curve there",
            )
        elastic = inside & (back.force > virgin.force)
        force = np.where(inside, back.force, virgin.force)
        contact = np.where(inside, back.contact_radius, virgin.contact_radius)
        contact = np.where(inside & (force <= 0.0), 0.0, contact)
        return Curve(
            np.where(elastic, virgin.force, force),
            np.where(elastic, virgin.contact_radius, contact),
        )

    def plot(self, **options: Any) -> "Figure":
        """Draw force and contact radius; options of `pestle.bench.figure.draw_law`."""
        from pestle.bench.figure import draw_law

        return draw_law(self, **options)
