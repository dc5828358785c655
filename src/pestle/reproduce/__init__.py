"""Figures and tables of the papers, recomputed from our laws.

`PAPERS` has a `Paper` a name; each of its items makes a `Result`: panels of a figure or
columns of a table, and a sentence on how it agrees with print.  Where our reading of an
equation differs from print, the figure shows both.  Finite elements are our own: tables
that `pestle lab study` wrote.  Measurements of others are left out, or their printed
numbers are shown as points.
"""

from pestle.reproduce import (  # these add their items to the papers
    edmans2020_lab,
    nan2022_impact,
    shahin2021_hardening,
    shahin2021_lab,
    shahin2021_response,
    shahin2021_standing,
    zunker2024_adhesion,
    zunker2024_lab,
)
from pestle.reproduce.edmans2020 import EDMANS2020
from pestle.reproduce.item import Item, Line, Panel, Paper, Result
from pestle.reproduce.nan2022 import NAN2022
from pestle.reproduce.shahin2021 import SHAHIN2021
from pestle.reproduce.zunker2024 import ZUNKER2024

PAPERS = {p.name: p for p in (ZUNKER2024, SHAHIN2021, EDMANS2020, NAN2022)}

__all__ = [
    "PAPERS",
    "Item",
    "Line",
    "Panel",
    "Paper",
    "Result",
    "edmans2020_lab",
    "nan2022_impact",
    "shahin2021_hardening",
    "shahin2021_lab",
    "shahin2021_response",
    "shahin2021_standing",
    "zunker2024_adhesion",
    "zunker2024_lab",
]
