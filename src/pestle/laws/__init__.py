"""Contact laws, one a file; `get(name)` finds one, `register` adds one."""

from importlib.metadata import entry_points

from pestle.laws import hertz, zunker2024
from pestle.laws._base import (
    Geometry,
    Nothing,
    Pair,
    Parts,
    Response,
    Solid,
    get,
    names,
    parts_of,
    register,
)
from pestle.laws.hertz import Hertz
from pestle.laws.zunker2024 import Zunker2024

for _entry in entry_points(group="pestle.laws"):
    _entry.load()

__all__ = [
    "Geometry",
    "Hertz",
    "Nothing",
    "Pair",
    "Parts",
    "Response",
    "Solid",
    "Zunker2024",
    "get",
    "hertz",
    "names",
    "parts_of",
    "register",
    "zunker2024",
]
