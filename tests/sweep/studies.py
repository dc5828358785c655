"""A study of two balls in a die: a run takes a tenth of a second, or about one."""

from pathlib import Path

from pestle.config.study import StudySettings, read_settings
from pestle.sweep import compute, planned, table
from pestle.sweep.study import _with

CASE = """
[law]
name = "hertz"
[materials.powder]
youngs_modulus = "5 MPa"
poisson_ratio = 0.3
density = 1500
[materials.tool]
rigid = true
[contacts]
restitution = 0.5
[particles]
material = "powder"
file = "balls.csv"
[die]
radius = "2 mm"
height = "6 mm"
material = "tool"
[[process]]
step = "press"
to = "2.5 mm"
at = "{at}"
[output]
history_every = 50
frames = 1
checkpoint_every = {every}
"""
BALLS = """id,radius_m,density_kg_m3,x_m,y_m,z_m
1,1e-3,1500,2e-4,0,1e-3
2,1e-3,1500,-2e-4,0,3.1e-3
"""
STUDY = """
case = "case.toml"
[vary]
contacts.restitution = [0.3, 0.6, 0.9]
materials.powder.youngs_modulus = ["2 MPa", 5e6]
"""
SLOW = {"at": "3 mm/s", "every": 2_000}
"""Speed of the punch and steps between checkpoints of a run of about a second."""


def write(folder: Path, study: str = STUDY, **changes: object) -> StudySettings:
    """Write case and study into a folder and read the study."""
    folder.mkdir(parents=True, exist_ok=True)
    values = {"at": "1 m/s", "every": 100} | changes
    (folder / "case.toml").write_text(CASE.format(**values))
    (folder / "balls.csv").write_text(BALLS)
    path = folder / "study.toml"
    path.write_text(study)
    return read_settings(StudySettings, path)


def alone(study: StudySettings, folder: Path) -> bytes:
    """Table of a study that is computed run by run, without a cluster."""
    rows = planned(study, folder)
    known = {row.job.id: compute(row.job) for row in rows if row.job}
    table.write(folder / "table.parquet", [_with(row, known) for row in rows])
    return (folder / "table.parquet").read_bytes()


def finished(folder: Path) -> dict[Path, int]:
    """Outcomes that are there, and when each was written [ns]."""
    return {p: p.stat().st_mtime_ns for p in folder.glob("runs/*/outcome.json")}
