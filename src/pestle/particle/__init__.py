"""One elastic-plastic adhesive particle between rigid flats: the exact MDR solution.

`Particle` follows any path of any number of flats in the limit of small steps;
`explicit_path` is the step-by-step scheme of the paper's Appendix E, of first order.

Reference: Zunker and Kamrin, J. Mech. Phys. Solids 183 (2024) 105492.
"""

from pestle.particle.contact import ParticleMaterial
from pestle.particle.explicit import explicit_path
from pestle.particle.leg import Resolution
from pestle.particle.pull_off import PullOffPoint, pull_off
from pestle.particle.solver import EnergyWarning, Particle, follow
from pestle.particle.state import FlatState, ParticleState, RadiusRule

__all__ = [
    "EnergyWarning",
    "FlatState",
    "Particle",
    "ParticleMaterial",
    "ParticleState",
    "PullOffPoint",
    "RadiusRule",
    "Resolution",
    "explicit_path",
    "follow",
    "pull_off",
]
