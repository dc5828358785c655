"""A plan comes close to what the run then takes, quickly, and says what it left out."""

from pathlib import Path
from time import perf_counter

import pytest

from pestle import simulation
from pestle.cli import main
from pestle.config import Case
from pestle.simulation.planning import duration
from pestle.simulation.probing import sample_of
from simulation.cases import tiny_case

EXAMPLES = Path(__file__).parents[2] / "examples"
# calibrations are no cases
CASES = [p for p in sorted(EXAMPLES.glob("*.toml")) if "[[process]]" in p.read_text()]


def test_a_plan_is_near_the_run(tmp_path: Path) -> None:
    case = Case.from_file(tiny_case(tmp_path))
    simulation.plan(case)  # compiles, if need be
    begin = perf_counter()
    plan = simulation.plan(case)
    assert perf_counter() - begin < 6.0  # two probes of 0.6 s
    result = simulation.run(case, tmp_path / "run", threads=1)
    assert plan.particles == 30
    assert plan.compile_time_s < 4.0
    assert result.steps / 4 < plan.steps < result.steps * 4
    assert [stage["name"] for stage in plan.stages] == list(case.stage_names)
    assert plan.steps == sum(stage["steps"] for stage in plan.stages)
    assert 0.0 < plan.wall_time_s < 60.0
    _, press, *_ = plan.stages
    assert 1e-4 < press["inertial number [-]"] < 1.0


def test_the_command_says_that_compiling_is_not_counted(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["plan", str(tiny_case(tmp_path))]) == 0
    shown = capsys.readouterr().out
    assert "without compiling" in shown
    assert "inertial number" in shown


def test_a_huge_case_is_planned_without_its_memory(tmp_path: Path) -> None:
    sizes = ["count=1e8", "die.radius=1 m", "die.height=2 m"]
    case = Case.from_file(tiny_case(tmp_path), sizes)
    plan = simulation.plan(case)
    assert plan.particles == 100_000_000
    assert plan.memory_bytes > 1e10


def test_the_length_of_every_step_of_the_rheometer_is_known() -> None:
    case = Case.from_file(EXAMPLES / "ft4.toml")
    sample = sample_of(case)
    fill, level, stir = (duration(case, step, sample) for step in case.process)
    assert 0.05 < fill < 1.0
    assert level == 0.0
    # 10 mm deep and 0.5 mm of clearance at 0.25 m/s sin(5 deg)
    assert stir == pytest.approx(0.0105 / 0.0217889, rel=1e-5)


@pytest.mark.parametrize("path", CASES, ids=lambda p: p.stem)
def test_steps_of_all_examples_have_a_length(path: Path) -> None:
    case = Case.from_file(path)
    sample = sample_of(case)
    assert all(duration(case, step, sample) >= 0.0 for step in case.process)
