"""Speed and memory of the engine on the dense bed of `bed`.

python benchmarks/engine.py [--laws hertz mdr] [--n 10000] [--threads 1 2] [--json]
"""

import argparse
import json
import time
from typing import Any

import bed
import numba
import numpy as np

from pestle.engine import step
from pestle.engine.engine import Engine

LAWS = {
    "hertz": ("hertz", 0.0),
    "mdr": ("mdr", 0.0),
    "mdr-adhesive": ("mdr", bed.ADHESION),
}


def bytes_of(engine: Engine) -> int:
    """Memory of all arrays of an engine [B]."""
    arrays = [a for a in vars(engine).values() if isinstance(a, np.ndarray)]
    return sum(a.nbytes for a in arrays)


def best_time(engine: Engine, steps: int, repeats: int) -> float:
    """Shortest wall time of a step, rebuilds included [s]."""
    bed.run_steps(engine, 2 * bed.REBUILD)
    best = np.inf
    for _ in range(repeats):
        start = time.perf_counter()
        bed.run_steps(engine, steps)
        best = min(best, (time.perf_counter() - start) / steps)
    return float(best)


def measure(law: str, particles: bed.Bed, threads: int, repeats: int) -> dict[str, Any]:
    """Run one law on a bed and return its figures."""
    numba.set_num_threads(threads)
    name, adhesion = LAWS[law]
    engine = bed.make_engine(particles, name, adhesion=adhesion)
    count = len(particles.radius)
    steps = bed.REBUILD * max(1, 1_000_000 // count // bed.REBUILD)
    seconds = best_time(engine, steps, repeats)
    contacts = float(engine.sums[step.TOUCHING])
    return {
        "law": law,
        "particles": count,
        "threads": threads,
        "particle_steps_per_s": count / seconds,
        "contact_steps_per_s": contacts / seconds,
        "ns_per_particle": 1e9 * seconds / count,
        "contacts_per_particle": contacts / count,
        "pairs_per_particle": len(engine.pa) / count,
        "bytes_per_particle": bytes_of(engine) / count,
    }


def main() -> None:
    """Print one line for every law, size and number of threads."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--laws", nargs="+", choices=LAWS, default=list(LAWS))
    parser.add_argument("--n", nargs="+", type=int, default=[10_000, 50_000])
    parser.add_argument("--threads", nargs="+", type=int, default=[1, 2])
    parser.add_argument("--repeats", type=int, default=10)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    rows = []
    if not options.json:
        print("law            particles thr  Mps/s  Mcs/s  ns/p  cont/p pairs/p  B/p")
    for count in options.n:
        particles = bed.make_bed(count)
        for law in options.laws:
            for threads in options.threads:
                row = measure(law, particles, threads, options.repeats)
                rows.append(row)
                if not options.json:
                    print(
                        f"{law:14s} {count:9d} {threads:3d} "
                        f"{row['particle_steps_per_s'] / 1e6:6.2f} "
                        f"{row['contact_steps_per_s'] / 1e6:6.2f} "
                        f"{row['ns_per_particle']:5.0f} "
                        f"{row['contacts_per_particle']:6.2f} "
                        f"{row['pairs_per_particle']:7.2f} "
                        f"{row['bytes_per_particle']:5.0f}",
                        flush=True,
                    )
    if options.json:
        print(json.dumps(rows, indent=2))


if __name__ == "__main__":
    main()
