"""Figures of a run."""

from pestle.plots.compaction import compaction_curve, heckel_and_kawakita
from pestle.plots.distributions import sizes_and_forces
from pestle.plots.energy import energy_ledger
from pestle.plots.flow import flow_energy
from pestle.plots.heap import heap_profile
from pestle.plots.scene import picture
from pestle.plots.shear import shear_cell
from pestle.plots.stress import stress_paths
from pestle.plots.style import to_svg
from pestle.plots.walls import wall_forces

__all__ = [
    "compaction_curve",
    "energy_ledger",
    "flow_energy",
    "heap_profile",
    "heckel_and_kawakita",
    "picture",
    "shear_cell",
    "sizes_and_forces",
    "stress_paths",
    "to_svg",
    "wall_forces",
]
