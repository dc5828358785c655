"""What every section of a case file shares: strictness and its error messages."""

from typing import Any

from pydantic import BaseModel, ConfigDict, ValidationError
from pydantic_core import PydanticCustomError

from pestle.errors import PestleError


class Section(BaseModel):
    """A table of the case file: immutable, unknown keys refused."""

    model_config = ConfigDict(
        extra="forbid",
        frozen=True,
        populate_by_name=True,
        use_attribute_docstrings=True,
        validate_default=False,
        allow_inf_nan=False,
    )

    def __init__(self, **data: Any) -> None:
        try:
            super().__init__(**data)
        except ValidationError as error:
            from pestle.config.translate import translated

            raise translated(error, type(self)) from None

    # Tells pydantic that a nested section may be built without this __init__,
    # so that one error carries the whole path from the top of the file.
    __init__.__pydantic_base_init__ = True  # type: ignore[attr-defined]


def problem(
    id: str, what: str, hint: str | None = None, key: tuple[str | int, ...] = ()
) -> PydanticCustomError:
    """Error for a validator to raise; `key` leads from its section to the culprit."""
    context = {"id": id, "what": what, "hint": hint, "key": key}
    return PydanticCustomError("pestle", "{what}", context)


def reworded(error: PestleError) -> PydanticCustomError:
    """Turn an error of a lower layer into one that pydantic gives a place to."""
    return problem(error.id, error.what, error.hint)
