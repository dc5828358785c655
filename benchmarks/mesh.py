"""What a floor of many triangles costs under the dense bed of `bed`.

python benchmarks/mesh.py [--n 100000] [--triangles 2 1000 100000] [--threads 2]

The same bed on a plane and on sheets of ever more triangles in that plane, which ought
to answer alike: `off` is the largest difference of the particles' places from those on
the plane, over the mean radius.
"""

import argparse
import time

import bed
import numba
import numpy as np

from pestle.engine import step
from pestle.engine import walls as wl
from pestle.engine.engine import Engine
from pestle.engine.mesh import Surface

FLOOR = 4  # number of the bed's lower wall


def sheet(side: float, triangles: int) -> Surface:
    """Square sheet in the plane z = 0 that reaches a tenth beyond the bed."""
    cells = max(round((triangles / 2) ** 0.5), 1)
    line = np.linspace(-0.1 * side, 1.1 * side, cells + 1)
    x, y = (axis.ravel() for axis in np.meshgrid(line, line, indexing="ij"))
    a = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
    b, c, d = a + cells + 1, a + 1, a + cells + 2
    faces = np.concatenate([np.column_stack([a, b, d]), np.column_stack([a, d, c])])
    return Surface(np.column_stack([x, y, np.zeros_like(x)]), faces)


def engine_on(particles: bed.Bed, surface: Surface | None) -> Engine:
    """Engine with the bed on a plane or on a sheet."""
    engine = bed.make_engine(particles, "hertz")
    if surface is not None:
        wall = engine.wall.copy()
        wall[FLOOR, wl.KIND] = wl.MESH
        engine.set_walls(wall, engine.move.copy(), {FLOOR: surface})
    return engine


def main() -> None:
    """Print one line for the plane and for every sheet."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--n", type=int, default=100_000)
    parser.add_argument(
        "--triangles", nargs="+", type=int, default=[2, 1000, 10_000, 100_000]
    )
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--steps", type=int, default=200)
    options = parser.parse_args()
    numba.set_num_threads(options.threads)
    particles = bed.make_bed(options.n)
    print("triangles  made s  rebuild ms  step ms  to plane   off")
    plane, base = np.empty(0), 0.0
    for count in (None, *options.triangles):
        surface = None if count is None else sheet(particles.side, count)
        start = time.perf_counter()
        engine = engine_on(particles, surface)
        made = time.perf_counter() - start
        bed.run_steps(engine, 2 * bed.REBUILD)
        start = time.perf_counter()
        bed.run_steps(engine, options.steps)
        each = (time.perf_counter() - start) / options.steps
        start = time.perf_counter()
        engine.rebuild()
        rebuild = time.perf_counter() - start
        place = engine.pos[np.argsort(engine.ids), :3]
        if count is None:
            plane, base = place, each
        faces = 0 if surface is None else len(surface.faces)
        off = np.abs(place - plane).max() / bed.RADIUS
        print(
            f"{faces or 'plane':>9}  {made:6.2f}  {1e3 * rebuild:10.1f}  "
            f"{1e3 * each:7.2f}  {each / base:8.2f}  {off:.1e}  "
            f"{engine.sums[step.TOUCHING]:.0f} contacts",
            flush=True,
        )


if __name__ == "__main__":
    main()
