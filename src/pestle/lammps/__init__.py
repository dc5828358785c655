"""The same case on LAMMPS, for what LAMMPS has."""

from pestle.lammps.deck import Deck, make_deck
from pestle.lammps.program import command, version
from pestle.lammps.run import run
from pestle.lammps.support import check

__all__ = ["Deck", "check", "command", "make_deck", "run", "version"]
