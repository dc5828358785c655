"""Tiny cases that the tests of the simulation run."""

from pathlib import Path

CASE = """
schema_version = 1
seed = 3
[law]
name = "{law}"
[materials.powder]
youngs_modulus = "5 MPa"
poisson_ratio = 0.3
yield_stress = "0.1 MPa"
density = 1500
[materials.tool]
rigid = true
[contacts]
sliding_friction = 0.5
restitution = 0.3
work_of_adhesion = {adhesion}
[particles]
material = "powder"
count = {count}
radius = {{ distribution = "uniform", minimum = "0.4 mm", maximum = "0.6 mm" }}
[die]
radius = "2 mm"
height = "{height}"
material = "tool"
[[process]]
step = "fill"
[[process]]
step = "press"
to = "{to}"
at = "{at}"
[[process]]
step = "hold"
for = "{hold}"
stress = "{to}"
[[process]]
step = "unload"
at = "0.2 m/s"
[output]
history_every = 100
frames = 3
checkpoint_every = {every}
"""


def tiny_case(folder: Path, **changes: object) -> Path:
    """Write a case of thirty particles into a folder."""
    values: dict[str, object] = {
        "law": "zunker2024",
        "adhesion": 0.1,
        "count": 30,
        "height": "12 mm",
        "to": "5 kPa",
        "at": "0.2 m/s",
        "hold": "1 ms",
        "every": 500,
    }
    path = folder / "case.toml"
    path.write_text(CASE.format(**(values | changes)))
    return path
