"""The case: everything that a run depends on, in SI units, checked."""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import AfterValidator, Field, PrivateAttr, model_validator

from pestle.config.base import Section
from pestle.config.checks import check_case, fill_contacts
from pestle.config.contacts import ContactSettings, PairProperties
from pestle.config.flow_sequence import written_out
from pestle.config.geometry import AnyWall, BoxSettings, DieSettings, Wall
from pestle.config.law import LawSettings
from pestle.config.materials import MaterialSettings
from pestle.config.particles import Powders
from pestle.config.process import Step
from pestle.config.quantities import Name, Seed, Text
from pestle.config.settings import EngineSettings, OutputSettings

if TYPE_CHECKING:
    from pestle.config.particle_file import ParticleTable


class Case(Section):
    """A case: law, materials, particles, walls and process.

    Read one with `Case.from_file`, or build it in Python with the same keys::

        Case(
            law="zunker2024",
            materials={"powder": {"set": "avicel_ph102_zunker2025"}, ...},
            ...
        )
    """

    schema_version: Literal[1] = 1
    """Version of the case-file format [-]."""
    title: Text = ""
    """Shown in the report."""
    seed: Seed = 1
    """The one seed of all random numbers [-]."""
    law: LawSettings
    """Contact law of all particles."""
    materials: dict[Name, MaterialSettings] = Field(min_length=1)
    """Materials by name."""
    contacts: ContactSettings
    """What pairs of materials do to each other."""
    particles: Powders
    """The powder, or several: one table or an array of tables."""
    die: DieSettings | None = None
    """Cylindrical die with two punches."""
    walls: dict[Name, Wall] = Field(default_factory=dict)
    """Walls by name, besides those of the die."""
    box: BoxSettings | None = None
    """Periodic box."""
    engine: EngineSettings = EngineSettings()
    """Numbers of the time integration."""
    process: Annotated[
        tuple[Step, ...],
        Field(min_length=1, max_length=1000),
        AfterValidator(written_out),
    ]
    """Steps, one after the other."""
    output: OutputSettings = OutputSettings()
    """What is written and how often."""
    _source: Path | None = PrivateAttr(default=None)
    _table: Any = PrivateAttr(default=None)
    _surfaces: dict[str, Any] = PrivateAttr(default_factory=dict)
    _powders: tuple[str, ...] | None = PrivateAttr(default=None)
    _hash: dict[str, str] | None = PrivateAttr(default=None)

    @model_validator(mode="before")
    @classmethod
    def _fill(cls, data: Any) -> Any:
        return fill_contacts(data)

    @model_validator(mode="after")
    def _check(self) -> "Case":
        check_case(self)
        return self

    @classmethod
    def from_file(
        cls, path: str | Path, overrides: dict[str, Any] | list[str] | None = None
    ) -> "Case":
        """Read a case file.

        Parameters
        ----------
        path : str or Path
            TOML file.
        overrides : dict or list of str, optional
            Values to replace: ``{"law.psi_b": 0.4}`` or ``["law.psi_b=0.4"]``; the last
            part of a path is enough where it is unique.

        Raises
        ------
        InputError
            Naming file, line, key, value and reason.
        """
        from pestle.config.file import read_case

        return read_case(cls, Path(path), overrides)

    @property
    def source(self) -> Path | None:
        """File that the case was read from."""
        return self._source

    def resolve(self, path: str) -> Path:
        """Path of a file that the case names, relative to the case file."""
        base = self._source.parent if self._source else Path()
        return base / path

    def read_particles(self) -> "ParticleTable":
        """Read and check the particle file that the case names."""
        from pestle.config.powders import particle_table

        if self._table is None:
            self._table = particle_table(self)
        table: ParticleTable = self._table
        return table

    def surface(self, name: str) -> tuple[Any, Any]:
        """Vertices from its point [m] and triangles of a wall of kind mesh or blade."""
        from pestle.config.bodies import surface_of

        if name not in self._surfaces:
            self._surfaces[name] = surface_of(self, name)
        found: tuple[Any, Any] = self._surfaces[name]
        return found

    @property
    def powders(self) -> tuple[str, ...]:
        """Materials of the particles; the results number them in this order."""
        from pestle.config.powders import powder_names

        if self._powders is None:
            self._powders = powder_names(self)
        return self._powders

    @property
    def is_generated(self) -> bool:
        """Whether the particles are generated, not read."""
        return all(group.is_generated for group in self.particles)

    @property
    def generated(self) -> tuple[int, ...]:
        """Number of particles to generate of each powder; of a mass, to be expected."""
        densities = (self.materials.get(g.material or "") for g in self.particles)
        return tuple(
            group.number((material and material.density) or 1.0)
            for group, material in zip(self.particles, densities, strict=True)
        )

    def pair(self, first: str, second: str) -> PairProperties:
        """Friction, damping and adhesion of a pair of materials."""
        return self.contacts.pair(first, second)

    @property
    def all_walls(self) -> dict[str, AnyWall]:
        """Walls of the die, then the others, by name."""
        return {**(self.die.walls() if self.die else {}), **self.walls}

    @property
    def stage_names(self) -> tuple[str, ...]:
        """Unique name of every step of the process."""
        names: list[str] = []
        for stage in self.process:
            name, number = stage.name or stage.step, 1
            while name in names:
                number += 1
                name = f"{stage.name or stage.step} {number}"
            names.append(name)
        return tuple(names)

    def canonical(self) -> str:
        """Return the case as JSON with sorted keys; equal text means equal runs.

        What the case reads stands there by the hash of its content, not by its path.
        """
        from pestle.config.bodies import mesh_hash
        from pestle.config.powders import content_hash

        data = self.model_dump(mode="json")
        for name, content in mesh_hash(self).items():
            data["walls"][name]["file"] = content
        if self._hash is None and not self.is_generated:
            self._hash = content_hash(self)
        if self._hash is not None:
            data["particles"][0] |= {"file": None, "start_from": None, **self._hash}
        return json.dumps(data, sort_keys=True, allow_nan=False)

    def canonical_law(self) -> str:
        """Return law, materials and pairs as JSON: contact histories need them."""
        parts = self.model_dump(mode="json", include={"law", "materials", "contacts"})
        return json.dumps(parts, sort_keys=True, allow_nan=False)

    def to_toml(self) -> str:
        """Return a case file with all values in SI units and absolute paths."""
        from pestle.config.write import case_toml

        return case_toml(self)
