"""Case files: what a run depends on, read from TOML or built in Python."""

from pestle.config.case import Case
from pestle.config.contacts import ContactSettings, PairProperties, PairSettings
from pestle.config.flow_sequence import FlowSequence
from pestle.config.geometry import (
    BladeWall,
    BoxSettings,
    CylinderWall,
    DieSettings,
    MeshWall,
    PlaneWall,
    ShearHead,
)
from pestle.config.law import LawSettings
from pestle.config.materials import MaterialSettings
from pestle.config.particles import ParticleSettings
from pestle.config.process import (
    Crush,
    Deform,
    Eject,
    Fill,
    Hold,
    Move,
    Press,
    Relax,
    Servo,
    Unload,
)
from pestle.config.process_bodies import Carry, Level, Lift, Shear, Stir
from pestle.config.settings import EngineSettings, OutputSettings
from pestle.config.sizes import SizeDistribution

__all__ = [
    "BladeWall",
    "BoxSettings",
    "Carry",
    "Case",
    "ContactSettings",
    "Crush",
    "CylinderWall",
    "Deform",
    "DieSettings",
    "Eject",
    "EngineSettings",
    "Fill",
    "FlowSequence",
    "Hold",
    "LawSettings",
    "Level",
    "Lift",
    "MaterialSettings",
    "MeshWall",
    "Move",
    "OutputSettings",
    "PairProperties",
    "PairSettings",
    "ParticleSettings",
    "PlaneWall",
    "Press",
    "Relax",
    "Servo",
    "Shear",
    "ShearHead",
    "SizeDistribution",
    "Stir",
    "Unload",
]
