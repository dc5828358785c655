"""[materials.*]: constants of each material."""

from typing import Any

from pydantic import model_validator

from pestle.config.base import Section, problem
from pestle.config.quantities import Density, Flag, Modulus, PoissonRatio, Stress
from pestle.errors import InputError


class MaterialSettings(Section):
    """One material: from a packaged set, from values, or a rigid tool."""

    set: str | None = None
    """Packaged material set, see `pestle materials`; values given here win."""
    rigid: Flag = False
    """A tool that does not deform: the particle's own constants act (walls only)."""
    youngs_modulus: Modulus | None = None
    """Young's modulus E [Pa]."""
    poisson_ratio: PoissonRatio | None = None
    """Poisson ratio nu [-]."""
    density: Density | None = None
    """True (solid) density, not bulk density [kg/m^3]."""
    yield_stress: Stress | None = None
    """Uniaxial yield stress Y [Pa]; neither hardness nor limiting pressure."""

    @model_validator(mode="before")
    @classmethod
    def _fill_from_set(cls, data: Any) -> Any:
        if not isinstance(data, dict) or not isinstance(data.get("set"), str):
            return data
        from pestle.materials import Material, load

        if data.get("rigid") is True:
            raise problem(
                "contradiction",
                "a rigid material cannot have a material set",
                "remove rigid or set",
                key=("rigid",),
            )
        try:
            material: Material = load(data["set"])
        except InputError as error:
            raise problem(error.id, error.what, error.hint, key=("set",)) from None
        return {**material.constants(), **data}

    @model_validator(mode="after")
    def _check(self) -> "MaterialSettings":
        elastic = (self.youngs_modulus, self.poisson_ratio)
        if self.rigid and any(v is not None for v in (*elastic, self.yield_stress)):
            raise problem(
                "contradiction",
                "rigid = true contradicts elastic constants",
                "remove rigid, or remove youngs_modulus, poisson_ratio, yield_stress",
                key=("rigid",),
            )
        if not self.rigid:
            for key in ("youngs_modulus", "poisson_ratio"):
                if getattr(self, key) is None:
                    raise problem(
                        "missing-key",
                        f"{key} is missing",
                        "give it, name a set, or say rigid = true for a tool",
                        key=(key,),
                    )
        if self.yield_stress is not None and self.youngs_modulus is not None:
            self._check_yield(self.yield_stress, self.youngs_modulus)
        return self

    @staticmethod
    def _check_yield(stress: float, modulus: float) -> None:
        if stress < modulus:
            return
        raise problem(
            "yield-above-modulus",
            f"yield_stress {stress:g} Pa is not below youngs_modulus {modulus:g} Pa",
            "a yield stress is usually 0.1-5 % of the modulus",
            key=("yield_stress",),
        )
