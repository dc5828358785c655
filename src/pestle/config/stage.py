"""What all steps of the process have."""

from typing import Annotated

from pydantic import Field

from pestle.config.base import Section
from pestle.config.quantities import Duration, Text

For = Annotated[Duration, Field(alias="for")]


class Stage(Section):
    """What all steps of the process have."""

    name: Text | None = None
    """Name in the results; by default the step and, if repeated, its number."""
