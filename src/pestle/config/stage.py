"""What all steps of the process have."""

from typing import Annotated

from pydantic import Field, PrivateAttr

from pestle.config.base import Section
from pestle.config.quantities import Duration, Text

For = Annotated[Duration, Field(alias="for")]


class Stage(Section):
    """What all steps of the process have."""

    name: Text | None = None
    """Name in the results; by default the step and, if repeated, its number."""
    _written: int | None = PrivateAttr(default=None)

    def place(self, number: int) -> int:
        """Number of the step in the case file, of that with a number in the process.

        They differ behind a step that stands for several.
        """
        return number if self._written is None else self._written
