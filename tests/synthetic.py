"""A made-up but plausible die compaction, to build and test reports against.

The packing is relaxed geometrically, the stresses follow a Heckel line of known
constants, the energies add up: every number in the report has a value to be compared
with. Nothing here is physics.
"""

from pathlib import Path

import numpy as np

from pestle.results import (
    History,
    ResultFile,
    Stage,
    collect,
    write_provenance,
    write_stages,
)
from synthetic_powder import DIE_RADIUS, Powder

YIELD_PRESSURE = 90e6
PEAK = 150e6
RADIAL_RATIO = 0.45
RESIDUAL = 14e6
EJECTION_FORCE = 9.0
CRUSH_FORCE = 6.5
AXIAL_SPRING_BACK = 0.031
RADIAL_SPRING_BACK = 0.012

CASE = """\
schema_version = 1
title = "Avicel PH102 <synthetic & test>"
seed = 7

[law]
name = "zunker2024"

[materials.powder]
youngs_modulus = "8.75 GPa"
poisson_ratio = 0.3
density = "1560 kg/m^3"
yield_stress = "150 MPa"

[materials.tool]
rigid = true

[contacts]
sliding_friction = 1.0
restitution = 0.5
work_of_adhesion = "300 J/m^2"

[[contacts.pairs]]
between = ["powder", "tool"]
sliding_friction = 0.1
work_of_adhesion = 0

[particles]
material = "powder"
count = {count}
[particles.radius]
distribution = "normal"
mean = "{radius} um"
deviation = "{deviation} um"

[die]
radius = "1 mm"
height = "{height} mm"
material = "tool"

[engine]
gravity = [0, 0, -9.81]

[[process]]
step = "fill"

[[process]]
step = "press"
to = "150 MPa"
at = "1 m/s"

[[process]]
step = "unload"
at = "1 m/s"

[[process]]
step = "eject"
at = "1 m/s"

[[process]]
step = "relax"
for = "0.2 ms"

[[process]]
step = "crush"
at = "1 m/s"
"""


def density_of(pressure):
    """Heckel line with A = 0.65 above a soft start."""
    return 1 - np.exp(-pressure / YIELD_PRESSURE - 0.65 * np.tanh(pressure / 5e6) - 0.5)


def write_run(folder: Path, count=120, seed=7, rounds=60, stop_after=None):
    """Write an output folder; `stop_after` names the last stage."""
    folder.mkdir(parents=True, exist_ok=True)
    rng = np.random.default_rng(seed)
    bed = 1.4e-3
    mean = (0.46 * np.pi * DIE_RADIUS**2 * bed / (4 / 3 * np.pi * count)) ** (1 / 3)
    initial = np.clip(rng.normal(mean, 0.12 * mean, count), 0.7 * mean, 1.3 * mean)
    solid = float(np.sum(4 / 3 * np.pi * initial**3))
    length = solid / (np.pi * DIE_RADIUS**2)
    curves = _curves(length)
    text = CASE.format(
        count=count,
        radius=f"{mean * 1e6:.4g}",
        deviation=f"{0.12 * mean * 1e6:.4g}",
        height=f"{1.3 * bed * 1e3:.4g}",
    )
    (folder / "case.toml").write_text(text)
    record = collect(case_text=text, seed=seed, threads=2)
    record["wall_time_s"] = 143.2
    write_provenance(folder / "provenance.json", record)
    stages = [name for name in curves["order"]]
    if stop_after:
        stages = stages[: stages.index(stop_after) + 1]
    _write_history(folder / "history.csv", curves, stages, solid)
    _write_stages(folder / "stages.json", curves, stages)
    powder = _loose(rng, initial, bed)
    powder.relax(3 * rounds)
    file = ResultFile(folder / "results.vtkhdf", provenance=record)
    for name in stages:
        for step, state, bound in _states(name, powder, initial, curves, rounds):
            contacts = state.contacts(bound)
            time = float(np.interp(step, curves["step"], curves["time"]))
            file.append(step, time, name, state.particles(initial, contacts), contacts)
    return folder


def _loose(rng, initial, bed):
    position = np.empty((len(initial), 3))
    across = (DIE_RADIUS - initial) * np.sqrt(rng.random(len(initial)))
    angle = 2 * np.pi * rng.random(len(initial))
    position[:, 0], position[:, 1] = across * np.cos(angle), across * np.sin(angle)
    position[:, 2] = initial + (bed - 2 * initial) * rng.random(len(initial))
    return Powder(position, initial.copy(), bed)


def _states(name, powder, initial, curves, rounds):
    rows = np.flatnonzero(curves["stage"] == name)
    last = int(curves["step"][rows[-1]])
    if name == "press":
        for part in (0.5, 1.0):
            row = rows[int(part * (len(rows) - 1))]
            height = float(curves["height"][row])
            for now in np.linspace(powder.height, height, 6)[1:]:
                powder.position[:, 2] *= now / powder.height
                powder.height = now
                powder.relax(rounds // 6)
                powder.radius = initial * (1 + 0.25 * max(0.0, 0.9 - now / 1.4e-3))
            yield int(curves["step"][row]), powder, True
    elif name in ("eject", "relax", "crush"):
        free = Powder(powder.position.copy(), powder.radius.copy(), powder.height)
        stretch = [1 + RADIAL_SPRING_BACK, 1 + RADIAL_SPRING_BACK]
        free.position *= [*stretch, 1 + AXIAL_SPRING_BACK]
        if name == "crush":
            side = np.sign(free.position[:, 0] + 0.1 * free.position[:, 2])
            free.position[:, 0] += 0.06 * DIE_RADIUS * side
        free.position[:, 2] += curves["die_height"]
        yield last, free, False
    else:
        yield last, powder, True


def _curves(length):
    """Height, stresses and forces row by row."""
    die_height = 1.3 * 1.4e-3
    start = die_height
    rows = {}
    pressure = PEAK * np.linspace(0.0, 1.0, 300) ** 2
    press_height = np.concatenate(
        [
            np.linspace(start, length / density_of(0.0), 30)[:-1],
            length / density_of(pressure),
        ]
    )
    press_axial = np.concatenate([np.zeros(29), pressure])
    bottom = press_height[-1]
    relief = np.linspace(1.0, 0.0, 80)
    plan = [
        ("fill", np.full(20, start), np.zeros(20), np.zeros(20)),
        ("press", press_height, press_axial, RADIAL_RATIO * press_axial),
        (
            "unload",
            np.append(
                bottom * (1 + 0.02 * (1 - relief)), bottom * np.linspace(1.02, 1.1, 10)
            ),
            np.append(PEAK * relief**1.5, np.zeros(10)),
            np.append(
                RESIDUAL + (RADIAL_RATIO * PEAK - RESIDUAL) * relief,
                np.full(10, RESIDUAL),
            ),
        ),
        (
            "eject",
            np.full(80, bottom * 1.1),
            np.zeros(80),
            np.linspace(RESIDUAL, 0.0, 80),
        ),
        ("relax", np.full(10, bottom * 1.1), np.zeros(10), np.zeros(10)),
        ("crush", np.full(60, bottom * 1.1), np.zeros(60), np.zeros(60)),
    ]
    rows["order"] = [name for name, *_ in plan]
    rows["stage"] = np.concatenate([[name] * len(h) for name, h, *_ in plan])
    rows["height"] = np.concatenate([h for _, h, *_ in plan])
    rows["axial"] = np.concatenate([a for _, _, a, _ in plan])
    rows["radial"] = np.concatenate([r for *_, r in plan])
    rows["step"] = 1000 * np.arange(len(rows["stage"]))
    rows["time"] = 2e-8 * rows["step"]
    rows["die_height"] = die_height
    return rows


def _write_history(path, curves, stages, solid):
    area = np.pi * DIE_RADIUS**2
    height, axial, stage = curves["height"], curves["axial"], curves["stage"]
    ejecting, crushing = stage == "eject", stage == "crush"
    columns = {"time [s]": curves["time"], "step": curves["step"], "stage": stage}
    zero = np.zeros(len(stage))
    lower = 0.8 * axial * area
    along = np.linspace(0, 1, ejecting.sum())
    lower[ejecting] = EJECTION_FORCE * np.minimum(along / 0.1, 1) * (1 - along)
    crush = zero.copy()
    along = np.linspace(0, 1, crushing.sum())
    crush[crushing] = CRUSH_FORCE * np.where(along < 0.7, along / 0.7, 0.3)
    down = curves["die_height"] - height
    walls = {
        "die": (zero, zero, zero, -0.2 * axial * area, None),
        "lower_punch": (zero, zero, zero, lower, lower),
        "upper_punch": (down, zero, zero, -axial * area, axial * area),
        "platen_left": (zero, crush, zero, zero, crush),
        "platen_right": (zero, -crush, zero, zero, crush),
    }
    for wall, (moved, *force, normal) in walls.items():
        columns[f"{wall}.displacement [m]"] = moved
        for axis, values in zip("xyz", force, strict=True):
            columns[f"{wall}.force_{axis} [N]"] = values
        if normal is None:
            normal = curves["radial"] * 2 * np.pi * DIE_RADIUS * height
        columns[f"{wall}.normal_force [N]"] = normal
    force = axial * area
    work = np.concatenate(
        [[0], np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(down))]
    )
    lost = np.maximum.accumulate(work)
    stored = 0.06 * lost.max() * axial / PEAK
    gravity = 2e-3 * lost.max() * (1.0 - np.minimum(curves["time"] / 3e-4, 1.0))
    columns["energy.kinetic [J]"] = 0.002 * lost.max() * np.exp(-curves["time"] / 2e-4)
    columns["energy.stored [J]"] = stored
    columns["energy.gravity [J]"] = gravity
    columns["energy.wall_work [J]"] = work
    kinetic = columns["energy.kinetic [J]"]
    rest = work + gravity[0] - gravity - stored - kinetic + kinetic[0]
    for name, share in (("contact_dissipation", 0.68), ("friction", 0.27)):
        columns[f"energy.{name} [J]"] = share * rest
    columns["energy.damping [J]"] = 0.049 * rest
    columns["energy.residual [J]"] = 0.001 * rest
    columns["relative_density [-]"] = solid / (area * height)
    columns["coordination [-]"] = 5.0 + 4.0 * axial / PEAK
    columns["height [m]"] = height
    columns["inertial_number [-]"] = np.where(axial > 0, 8e-4, np.nan)
    columns["imbalance [-]"] = np.full(len(stage), 4e-4)
    columns["energy.negative_increments [J]"] = zero
    with History(path, list(columns)) as history:
        for row in range(len(stage)):
            if stage[row] in stages:
                history.row([values[row] for values in columns.values()])


def _write_stages(path, curves, stages):
    reasons = {
        "fill": "the powder is at rest",
        "press": "axial stress reached 150 MPa",
        "unload": "the punch force is zero",
        "eject": "the tablet is out of the die",
        "relax": "0.2 ms have passed",
        "crush": "approach reached 10 % of the diameter",
    }
    rows = []
    for name in stages:
        at = np.flatnonzero(curves["stage"] == name)
        step, time = curves["step"][at], curves["time"][at]
        rows.append(
            Stage(
                name,
                name,
                int(step[0]),
                int(step[-1]),
                float(time[0]),
                float(time[-1]),
                reasons[name],
                {"wall_time_s": 20.0 + len(at) / 10},
            )
        )
    write_stages(path, rows)
