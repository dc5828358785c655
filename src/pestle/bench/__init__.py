"""The bench: drive one contact or one particle, hit a wall, compare laws.

`PairContact` takes a law of `pestle.laws`, `SingleParticle` one of `pestle.particle`;
`drive` follows waypoints of displacement or force, `restitution` and `collide` are
impacts, `write_table` and the figures show what came out.
"""

from pestle.bench.drive import Displacement, Force, Run, cyclic, drive
from pestle.bench.impact import (
    Collision,
    Impact,
    collide,
    restitution,
    sticking_velocity,
)
from pestle.bench.subject import PairContact, SingleParticle, Trace
from pestle.bench.table import write_table

__all__ = [
    "Collision",
    "Displacement",
    "Force",
    "Impact",
    "PairContact",
    "Run",
    "SingleParticle",
    "Trace",
    "collide",
    "cyclic",
    "drive",
    "restitution",
    "sticking_velocity",
    "write_table",
]
