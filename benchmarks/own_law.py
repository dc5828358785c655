"""A user's law against the built-in one that it repeats: the same speed.

python benchmarks/own_law.py [--n 10000] [--repeats 15]

Both compute Hertz's force in a file of their own; one is registered by pestle, the
other by this script as a user would do it.  Exits with 1 if the user's is over
20 % slower.
"""

import argparse
import sys
from dataclasses import dataclass
from math import sqrt
from typing import ClassVar, NamedTuple

import bed
import numba
import numpy as np

from engine import best_time
from pestle.laws import Geometry, Hertz, Nothing, Pair, Response, register


class Constants(NamedTuple):
    """What the kernel needs."""

    modulus: float  # E* [Pa]


@dataclass(frozen=True, slots=True, kw_only=True)
class MyHertz:
    """Hertz once more."""

    name: ClassVar[str] = "my_hertz"
    summary: ClassVar[str] = "Hertz, written by a user"

    def constants(self, pair: Pair) -> Constants:
        """Reduce a pair of materials."""
        return Constants(pair.modulus)


def contact(k: Constants, g: Geometry, s: Nothing) -> tuple[Response, Nothing]:
    """Hertz's force."""
    x = max(g.overlap, 0.0)
    a = sqrt(g.radius * x)
    slope = 2.0 * k.modulus * a
    force = slope * x * (2.0 / 3.0)
    return Response(force, a, slope, 0.4 * force * x, 1.0), s


register(MyHertz, constants=Constants, state=Nothing, contact=contact)


def main() -> None:
    """Print both speeds and their ratio."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--n", type=int, default=10_000)
    parser.add_argument("--repeats", type=int, default=15)
    options = parser.parse_args()
    numba.set_num_threads(1)
    particles = bed.make_bed(options.n)
    seconds = {"hertz": np.inf, "my_hertz": np.inf}
    engines = {
        law.name: bed.make_engine(particles, law) for law in (Hertz(), MyHertz())
    }
    for _ in range(3):  # in turns: the machine may be busy for a while
        for name, engine in engines.items():
            seconds[name] = min(
                seconds[name], best_time(engine, 2 * bed.REBUILD, options.repeats)
            )
    for name, time in seconds.items():
        print(f"{name:10s} {options.n / time / 1e6:6.2f} M particle-steps/s")
    ratio = seconds["my_hertz"] / seconds["hertz"]
    print(f"time of the user's law over the built-in one's: {ratio:.3f}")
    sys.exit(ratio > 1.2)


if __name__ == "__main__":
    main()
