"""Zunker and Kamrin (2024) as a law of a single particle: the exact solver of MDR.

It follows a path with all its memory, so that it needs no law of unloading.  Points are
computed one after the other, each from the state before.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, cast

import numpy as np
from numpy.typing import ArrayLike

from pestle.errors import InputError
from pestle.particle.configuration import checked
from pestle.particle.contact import ParticleMaterial
from pestle.particle.law import Array, Curve, Loading, choice, parameter, register
from pestle.particle.solver import Particle
from pestle.particle.state import RadiusRule

if TYPE_CHECKING:
    from pestle.particle.state import ParticleState

COUNTS = {"simple": (2,), "die": (2, 4), "hydrostatic": (6,)}


@register
@dataclass(frozen=True, kw_only=True)
class Zunker2024(Loading):
    """Elastic-plastic adhesive particle that keeps its volume (MDR)."""

    youngs_modulus: float = parameter("Young's modulus E", "Pa")
    poisson_ratio: float = parameter("Poisson ratio nu", "1", -1.0, 0.5)
    yield_stress: float = parameter("uniaxial yield stress Y", "Pa")
    work_of_adhesion: float = parameter(
        "work of adhesion W of particle and flat", "J/m^2", closed=True, default=0.0
    )
    radius_rule: str = choice(
        "when the apparent radius may grow",
        ("plastic", "loading", "eq37", "frozen"),
        default="plastic",
    )

    name: ClassVar[str] = "zunker2024"
    summary: ClassVar[str] = "MDR, solved exactly: loading, unloading, adhesion"
    validity: ClassVar[str] = (
        "elastic-perfectly plastic, up to the fill of the cell; contacts see each "
        "other through the volume only"
    )
    citation: ClassVar[str] = (
        "@article{zunker2024, author={Zunker, W. and Kamrin, K.}, title={A "
        "mechanically-derived contact model for adhesive elastic-perfectly plastic "
        "particles, Part I: Utilizing the method of dimensionality reduction}, "
        "journal={Journal of the Mechanics and Physics of Solids}, volume={183}, "
        "pages={105492}, year={2024}}"
    )

    def _curve(self, x: Array, radius: float, configuration: str) -> Curve:
        order = np.argsort(x, axis=None)
        out = self._run(np.ravel(x)[order] * radius, radius, configuration)
        back = np.empty_like(order)
        back[order] = np.arange(order.size)
        return Curve(*(part[back].reshape(np.shape(x)) for part in out))

    def follow(
        self, displacement: ArrayLike, *, radius: float, configuration: str = "simple"
    ) -> Curve:
        """Force and contact radius along one path of the moving flats."""
        path = np.asarray(displacement, dtype=float)
        if path.ndim != 1:
            raise InputError(
                "one-path-only",
                f"{self.name} follows one path at a time, not an array of shape "
                f"{path.shape}",
                hint="call it once for each path",
            )
        return self._run(path, radius, checked(configuration))

    def _run(self, path: Array, radius: float, configuration: str) -> Curve:
        material = ParticleMaterial(
            youngs_modulus=float(self.youngs_modulus),
            poisson_ratio=float(self.poisson_ratio),
            yield_stress=float(self.yield_stress),
            work_of_adhesion=float(self.work_of_adhesion),
        )
        counts = COUNTS[configuration]
        rule = cast(RadiusRule, self.radius_rule)
        particle = Particle(material, radius, counts=counts, radius_rule=rule)
        still = (0.0,) * (len(counts) - 1)
        flats = [_flat(particle.move((d, *still))) for d in path]
        return Curve(*np.array(flats, dtype=float).reshape(-1, 2).T)


def _flat(state: "ParticleState") -> tuple[Any, Any]:
    flat = state.flats[0]
    return flat.force, flat.contact_radius
