"""Contact laws, one a file; `get(name)` finds one, `register` adds one."""

from importlib.metadata import entry_points

from pestle.errors import EnergyWarning
from pestle.laws import (
    dmt,
    eepa2014,
    hertz,
    jkr,
    luding2008,
    nan2022,
    pasha2014,
    pasha2014_simplified,
    storakers1997,
    thornton_ning1998,
    walton_braun1986,
    zunker2024,
)
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
from pestle.laws._options import PairLaw, choice, parameter
from pestle.laws.dmt import DMT
from pestle.laws.eepa2014 import EEPA2014
from pestle.laws.hertz import Hertz
from pestle.laws.jkr import JKR
from pestle.laws.luding2008 import Luding2008
from pestle.laws.nan2022 import Nan2022
from pestle.laws.pasha2014 import Pasha2014
from pestle.laws.pasha2014_simplified import Pasha2014Simplified
from pestle.laws.storakers1997 import Storakers1997
from pestle.laws.thornton_ning1998 import ThorntonNing1998
from pestle.laws.walton_braun1986 import WaltonBraun1986
from pestle.laws.zunker2024 import Zunker2024

for _entry in entry_points(group="pestle.laws"):
    _entry.load()

__all__ = [
    "DMT",
    "EEPA2014",
    "JKR",
    "EnergyWarning",
    "Geometry",
    "Hertz",
    "Luding2008",
    "Nan2022",
    "Nothing",
    "Pair",
    "PairLaw",
    "Parts",
    "Pasha2014",
    "Pasha2014Simplified",
    "Response",
    "Solid",
    "Storakers1997",
    "ThorntonNing1998",
    "WaltonBraun1986",
    "Zunker2024",
    "choice",
    "dmt",
    "eepa2014",
    "get",
    "hertz",
    "jkr",
    "luding2008",
    "names",
    "nan2022",
    "parameter",
    "parts_of",
    "pasha2014",
    "pasha2014_simplified",
    "register",
    "storakers1997",
    "thornton_ning1998",
    "walton_braun1986",
    "zunker2024",
]
