"""One particle between rigid flats: laws of loading and unloading; MDR exactly.

A law answers with force and contact radius of a moving flat in simple, die or
hydrostatic compression.  `build("shahin2021+edmans2020", parameters)` makes one that
follows any path; `names()` and `unloading_names()` list them.  `Particle` is the exact
solution of MDR for any number of flats, `explicit_path` the step-by-step scheme of its
Appendix E.
"""

from pestle.errors import EnergyWarning
from pestle.particle.biwa1995 import Biwa1995
from pestle.particle.contact import ParticleMaterial
from pestle.particle.cycle import Cycle
from pestle.particle.cylinders2020 import Cylinders2020, CylindersUnloading
from pestle.particle.edmans2020 import Edmans2020
from pestle.particle.etsion2005 import Etsion2005
from pestle.particle.explicit import explicit_path
from pestle.particle.law import Curve, Loading, Peak, RangeWarning, Unloading, register
from pestle.particle.leg import Resolution
from pestle.particle.library import build, fields, find, names, unloading_names
from pestle.particle.linear_unloading import Luding2008, Walton1986
from pestle.particle.mesarovic2000 import Mesarovic2000
from pestle.particle.pull_off import PullOffPoint, pull_off
from pestle.particle.shahin2021 import Shahin2021
from pestle.particle.shahin2021_hardening_law import Shahin2021Hardening
from pestle.particle.solver import Particle, follow
from pestle.particle.state import FlatState, ParticleState, RadiusRule
from pestle.particle.zunker2024 import Zunker2024

__all__ = [
    "Biwa1995",
    "Curve",
    "Cycle",
    "Cylinders2020",
    "CylindersUnloading",
    "Edmans2020",
    "EnergyWarning",
    "Etsion2005",
    "FlatState",
    "Loading",
    "Luding2008",
    "Mesarovic2000",
    "Particle",
    "ParticleMaterial",
    "ParticleState",
    "Peak",
    "PullOffPoint",
    "RadiusRule",
    "RangeWarning",
    "Resolution",
    "Shahin2021",
    "Shahin2021Hardening",
    "Unloading",
    "Walton1986",
    "Zunker2024",
    "build",
    "explicit_path",
    "fields",
    "find",
    "follow",
    "names",
    "pull_off",
    "register",
    "unloading_names",
]
