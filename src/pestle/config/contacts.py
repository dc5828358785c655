"""[contacts]: friction, damping and adhesion of every pair of materials."""

from dataclasses import dataclass
from typing import Annotated, Any, Literal

from pydantic import AliasChoices, Field, model_validator

from pestle.config.base import Section, problem
from pestle.config.quantities import Adhesion, DampingRatio, Friction, Restitution

ADHESION_ALIASES = ("surface_energy", "effective_surface_energy")
"""Other names of work_of_adhesion in a case file."""

_ADHESION_NAMES = AliasChoices("work_of_adhesion", *ADHESION_ALIASES)


@dataclass(frozen=True, slots=True)
class PairProperties:
    """What two materials do to each other; see `ContactSettings` for the meaning."""

    sliding_friction: float  # mu_s [-]
    rolling_friction: float  # mu_r [-]
    restitution: float | None  # e [-]; None where damping_ratio is given
    damping_ratio: float | None  # eta [-]; None where restitution is given
    work_of_adhesion: float  # W [J/m^2]


class PairSettings(Section):
    """One pair of materials; what is not given here comes from [contacts]."""

    between: tuple[str, str]
    """The two materials; the same twice for particles of one kind."""
    sliding_friction: Friction | None = None
    """Coulomb's coefficient of sliding friction [-]."""
    rolling_friction: Friction | None = None
    """Coefficient of rolling resistance [-]."""
    restitution: Restitution | None = None
    """Coefficient of restitution of an elastic impact [-]; or damping_ratio."""
    damping_ratio: DampingRatio | None = None
    """Factor eta of the viscous damping [-]; or restitution."""
    work_of_adhesion: Annotated[
        Adhesion | None, Field(validation_alias=_ADHESION_NAMES)
    ] = None
    """Work of adhesion W of the pair [J/m^2]; also surface_energy."""

    @model_validator(mode="before")
    @classmethod
    def _one_name(cls, data: Any) -> Any:
        return _refuse_two_names(data)

    @model_validator(mode="after")
    def _one_damping(self) -> "PairSettings":
        _refuse_two_dampings(self)
        return self


class ContactSettings(Section):
    """Default of every pair of materials, walls included."""

    sliding_friction: Friction = 0.0
    """Coulomb's coefficient of sliding friction [-]."""
    rolling_friction: Friction = 0.0
    """Coefficient of rolling resistance [-]."""
    restitution: Restitution | None = None
    """Coefficient of restitution of an elastic impact [-]; or damping_ratio."""
    damping_ratio: DampingRatio | None = None
    """Factor eta of the viscous damping [-]; or restitution."""
    work_of_adhesion: Annotated[Adhesion, Field(validation_alias=_ADHESION_NAMES)] = 0.0
    """Work of adhesion W of a pair of materials [J/m^2]: Gamma and Delta gamma of the
    papers ("effective surface energy"), also accepted as surface_energy. JKR pull-off
    is 1.5 pi W R*. With a surface energy gamma per surface, W = 2 gamma for like
    bodies."""
    sliding_rule: Literal["spring", "total"] = "spring"
    """What Coulomb's limit cuts: "spring", the tangential spring and then its sum with
    the dashpot; "total", that sum alone: the spring of a sliding contact is then what
    the dashpot leaves, as in LAMMPS."""
    pairs: tuple[PairSettings, ...] = ()
    """Pairs that differ from the default."""

    @model_validator(mode="before")
    @classmethod
    def _one_name(cls, data: Any) -> Any:
        return _refuse_two_names(data)

    @model_validator(mode="after")
    def _check(self) -> "ContactSettings":
        _refuse_two_dampings(self)
        if self.restitution is None and self.damping_ratio is None:
            raise problem(
                "missing-key",
                "neither restitution nor damping_ratio is given",
                "add restitution = 0.5",
                key=("restitution",),
            )
        seen: set[frozenset[str]] = set()
        for number, pair in enumerate(self.pairs):
            names = frozenset(pair.between)
            if names in seen:
                what = f"the pair {' - '.join(pair.between)} is given twice"
                raise problem(
                    "contradiction", what, "keep one", ("pairs", number, "between")
                )
            seen.add(names)
        return self

    def pair(self, first: str, second: str) -> PairProperties:
        """Properties of a pair of materials, in either order."""
        own = {}
        for pair in self.pairs:
            if frozenset(pair.between) == frozenset((first, second)):
                own = pair.model_dump(exclude={"between"}, exclude_none=True)
        default = self.model_dump(exclude={"pairs", "sliding_rule"})
        if "restitution" in own or "damping_ratio" in own:
            default.update(restitution=None, damping_ratio=None)
        return PairProperties(**{**default, **own})


def _refuse_two_names(data: Any) -> Any:
    if isinstance(data, dict):
        given = [key for key in ("work_of_adhesion", *ADHESION_ALIASES) if key in data]
        if len(given) > 1:
            raise problem(
                "contradiction",
                f"{' and '.join(given)} are two names of one quantity",
                "keep work_of_adhesion",
                key=(given[-1],),
            )
    return data


def _refuse_two_dampings(section: PairSettings | ContactSettings) -> None:
    if section.restitution is not None and section.damping_ratio is not None:
        raise problem(
            "contradiction",
            "restitution and damping_ratio are both given",
            "keep one: each sets the viscous damping",
            key=("damping_ratio",),
        )
