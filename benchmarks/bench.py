"""Curve points a second of every law on the bench; 1e5 is the least that is asked for.

python benchmarks/bench.py [--json FILE]

Loads to x = 0.3 and unloads, in one array; parameter arrays are 1,000 materials of 200
points each; impacts are 200 velocities.  The best of three, compiled before.
"""

import json
import sys
import time
import warnings

import numpy as np

from pestle import laws
from pestle.bench import PairContact, SingleParticle, restitution
from pestle.particle import RangeWarning, Zunker2024, build, names, unloading_names

POINTS = 200_000
RADIUS = 5e-5
VALUES = {
    "youngs_modulus": 5e9,
    "poisson_ratio": 0.3,
    "yield_stress": 2e7,
    "strength": 3e7,
    "hardening_exponent": 0.4,
    "stiffness_ratio": 20.0,
    "transition": 0.1,
    "stiffening": 5e5,
}
STIFFNESS = {
    "luding2008": {"loading_stiffness": 1e3, "unloading_stiffness": 5e3},
    "walton_braun1986": {"loading_stiffness": 1e3, "unloading_stiffness": 5e3},
    "pasha2014": {"elastic_stiffness": 5e3, "plastic_stiffness": 1e3},
    "pasha2014_simplified": {"plastic_stiffness": 1e3, "elastic_stiffness": 5e3},
}


def best(function, *arguments):
    """Shortest of three times [s]."""
    function(*arguments)
    times = []
    for _ in range(3):
        start = time.perf_counter()
        function(*arguments)
        times.append(time.perf_counter() - start)
    return min(times)


def path(largest, points=POINTS):
    t = np.linspace(0.0, 2.0, points)
    return largest * np.minimum(t, 2.0 - t)


def particles():
    """Particle laws by name: every loading law, and one with every unloading law."""
    from pestle.particle import fields

    pairs = [f"shahin2021+{second}" for second in unloading_names()]
    for name in [*names(), *pairs]:
        known = fields(name)
        yield build(name, {k: v for k, v in VALUES.items() if k in known})


def contacts():
    solid = laws.Solid(
        youngs_modulus=5e9, poisson_ratio=0.3, yield_stress=2e7, density=1500.0
    )
    pair = laws.Pair(first=solid, second=laws.Solid(), work_of_adhesion=0.05, wall=True)
    for name in laws.names():
        if name != "zunker2024":  # its contacts see each other
            law = laws.get(name)(**STIFFNESS.get(name, {}))
            yield PairContact(law=law, pair=pair, radius=RADIUS)


def measure():
    speeds = np.geomspace(0.02, 2.0, 200)
    for law in particles():
        subject = SingleParticle(law=law, radius=RADIUS, density=1500.0)
        whole = isinstance(law, Zunker2024)
        way = path(0.3 * RADIUS)
        if not whole and law.unloading is None:
            way = np.sort(way)
        yield law.name, len(way) / best(subject.follow, way)
    moduli = np.linspace(3e9, 1e10, 1000)[:, None]
    many = build("shahin2021+edmans2020", {**VALUES_OF_SOLID, "youngs_modulus": moduli})
    ways = np.broadcast_to(path(0.3 * RADIUS, 200), (1000, 200))
    follow = SingleParticle(law=many, radius=RADIUS).follow
    yield "shahin2021+edmans2020, 1000 materials", ways.size / best(follow, ways)
    for subject in contacts():
        yield subject.name, POINTS / best(subject.follow, path(1e-6))
        impacts = len(speeds) / best(restitution, subject, speeds)
        yield f"{subject.name}, impacts", impacts


VALUES_OF_SOLID = {
    key: VALUES[key] for key in ("youngs_modulus", "poisson_ratio", "yield_stress")
}


def main():
    warnings.simplefilter("ignore", RangeWarning)
    found = {}
    for name, rate in measure():
        found[name] = rate
        unit = "impacts/s" if name.endswith("impacts") else "points/s"
        print(f"{name:40s} {rate:10.3g} {unit}", flush=True)
    if "--json" in sys.argv:
        with open(sys.argv[sys.argv.index("--json") + 1], "w") as file:
            json.dump(found, file, indent=2)


if __name__ == "__main__":
    main()
