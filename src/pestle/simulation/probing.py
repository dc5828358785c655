"""A short timed probe of an engine: what a step of a pressed powder costs.

The kernels are those of the run.  The powder is a lattice in which every particle
touches eight others, held still: the state in which a compaction spends its steps,
reached without computing how it gets there.
"""

from dataclasses import dataclass
from time import perf_counter
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from pestle.engine import step as st

if TYPE_CHECKING:
    from pestle.config import Case
    from pestle.engine.engine import Engine

Array = npt.NDArray[Any]

LARGEST = 20_000
"""Most particles of a probe; more are extrapolated [-]."""

TIME = 0.6
"""Wall time that a probe measures [s]."""

OVERLAP = 0.01
"""Overlap of two particles of the lattice over their diameter [-]."""


@dataclass(frozen=True, slots=True)
class Sample:
    """Particles that stand for those of a case."""

    count: int  # of the case [-]
    radius: Array  # [m]
    density: Array  # mass scaling included [kg/m^3]
    material: Array  # number of the powder [-]

    @property
    def mean(self) -> float:
        """Mean radius [m]."""
        return float(np.mean(self.radius))

    @property
    def mean_volume(self) -> float:
        """Mean volume of a particle [m^3]."""
        return float(np.mean(4.0 / 3.0 * np.pi * self.radius**3))

    @property
    def mean_mass(self) -> float:
        """Mean mass of a particle [kg]."""
        return float(np.mean(4.0 / 3.0 * np.pi * self.radius**3 * self.density))


@dataclass(frozen=True, slots=True)
class Probe:
    """What was measured."""

    cost: float  # wall time of a step of all particles [s]
    memory: int  # of all particles [bytes]
    longest_step: float  # time step of a loose powder [s]
    compiling: float  # wall time until the first step was done [s]


def sample_of(case: "Case") -> Sample:
    """Return at most `LARGEST` particles in the proportions of the case's powders."""
    from pestle.simulation.start import drawn, earlier

    scale = case.engine.mass_scaling
    if case.particles[0].file is not None:
        table = case.read_particles()
        some = slice(None, None, -(-len(table.radius) // LARGEST))
        density = table.density[some] * scale
        return Sample(
            len(table.radius), table.radius[some], density, table.material[some]
        )
    if case.particles[0].start_from is not None:
        _, _, radius, density, material = earlier(case)
        some = slice(None, None, -(-len(radius) // LARGEST))
        return Sample(len(radius), radius[some], density[some], material[some])
    total = sum(case.generated)
    random = np.random.default_rng(case.seed)
    radius, density, material = drawn(case, random, min(1.0, LARGEST / total))
    return Sample(total, radius, density * scale, material)


def probe(engine: "Engine", sample: Sample) -> Probe:
    """Measure the steps of an engine that has its materials but no particles yet."""
    place, edges = _lattice(len(sample.radius), sample.mean)
    engine.set_walls([], [])
    engine.gravity = np.zeros(3)
    engine.box[0] = edges
    engine.box[1] = np.where(engine.box[1] > 0.0, 1.0 / edges, 0.0)
    engine.box[3] = 0.0
    longest = _longest_step(engine, place, sample)
    engine.clock[st.AUTO] = 0.0
    engine.clock[st.DT] = engine.clock[st.DT_MAX] = 1e-9 * longest
    radius = np.full(len(place), sample.mean)
    engine.set_particles(place, radius, sample.material, sample.density)
    begin = perf_counter()
    engine.start()
    engine.advance(1)
    compiling = perf_counter() - begin
    begin, first, steps = perf_counter(), engine.steps, 1
    while (spent := perf_counter() - begin) < TIME:
        engine.advance(steps)
        steps = min(2 * steps, 200)
    more = sample.count / len(place)
    arrays = [a for a in vars(engine).values() if isinstance(a, np.ndarray)]
    memory = int(more * sum(a.nbytes for a in arrays))
    cost = more * spent / (engine.steps - first)
    return Probe(cost, memory, longest, compiling)


def _longest_step(engine: "Engine", place: Array, sample: Sample) -> float:
    """Step that the engine begins with [s]."""
    if engine.clock[st.AUTO] == 0.0:
        return float(engine.clock[st.DT])
    engine.pos = np.column_stack([place, sample.radius])
    engine.mat = sample.material
    engine.vel = np.zeros((len(place), 8))
    engine.vel[:, 3] = 4.0 / 3.0 * np.pi * sample.radius**3 * sample.density
    return engine.longest_step()


def _lattice(count: int, radius: float) -> tuple[Array, Array]:
    """Body-centred cubic places of so many spheres and the edges around them [m]."""
    edge = 4.0 * radius * (1.0 - OVERLAP) / 3.0**0.5
    side = int(np.ceil((count / 2) ** (1.0 / 3.0)))
    corner = np.stack(np.meshgrid(*3 * [np.arange(side)], indexing="ij"), axis=-1)
    corner = corner.reshape(-1, 3)
    place = np.stack([corner, corner + 0.5], axis=1).reshape(-1, 3)[:count]
    # away from the edges, so that no particle touches its own image
    return edge * (place + 1.0), np.full(3, edge * (side + 2.0))
