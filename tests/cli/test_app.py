"""The commands, with a simulation that does nothing."""

import json
import os
import signal
import sys
from pathlib import Path
from types import ModuleType, SimpleNamespace

import pytest

import pestle
from broken_cases import CASE
from pestle.cli import main
from pestle.errors import SimulationError
from pestle.simulation import Plan


def progress(index=0, step=0, fraction=0.0):
    return SimpleNamespace(
        stage=("fill", "press")[index],
        stage_index=index,
        stages=2,
        step=step,
        time=1e-6 * step,
        fraction=fraction,
        eta_s=75.0,
        stress=1.5e8 if index else None,
        particle_steps_per_s=2.5e6,
    )


class FakeSimulation(ModuleType):
    """Stands for pestle.simulation; `ending` is raised or is the stop reason."""

    def __init__(self):
        super().__init__("pestle.simulation")
        self.calls = []
        self.ending = "finished"

    def run(self, case, out, threads, resume, progress):
        self.calls.append(
            SimpleNamespace(case=case, out=out, threads=threads, resume=resume)
        )
        out.mkdir(parents=True, exist_ok=True)
        (out / "history.csv").write_text("time [s]\n")
        if progress is not None:
            for step in range(3):
                progress(globals()["progress"](0, step, step / 2))
            progress(globals()["progress"](1, 3, 0.5))
        if isinstance(self.ending, BaseException):
            raise self.ending
        return SimpleNamespace(
            out=out,
            stop_reason=self.ending,
            steps=4,
            wall_time=75.0,
            metrics={"warnings": ["odd"], "metrics": {"a": float("nan")}},
        )

    def plan(self, case):
        return Plan(
            particles=case.particles[0].count,
            time_step=2.5e-8,
            time_step_reason="stiffest pair",
            steps=1_000_000,
            memory_bytes=2_500_000,
            wall_time_s=75.0,
            stages=[{"name": "fill", "time [s]": 0.0598, "steps": 36}],
        )


@pytest.fixture
def simulation(monkeypatch):
    fake = FakeSimulation()
    monkeypatch.setitem(sys.modules, "pestle.simulation", fake)
    monkeypatch.setattr(pestle, "simulation", fake, raising=False)
    built = []

    def build(folder, references):
        built.append(references)
        (folder / "report.html").write_text("<html></html>")
        return folder / "report.html"

    monkeypatch.setitem(sys.modules, "pestle.report", SimpleNamespace(build=build))
    before = signal.getsignal(signal.SIGTERM)
    yield fake
    signal.signal(signal.SIGTERM, before)


@pytest.fixture
def case(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("case.toml").write_text(CASE)
    return "case.toml"


def test_run_writes_into_runs_and_says_where_the_report_is(case, simulation, capsys):
    assert main(["run", case, "--set", "psi_b=0.4", "--threads", "2"]) == 0
    (call,) = simulation.calls
    assert call.out == Path("runs/case")
    assert (call.threads, call.resume) == (2, False)
    assert call.case.law.options["psi_b"] == 0.4
    shown = capsys.readouterr()
    assert "report: runs/case/report.html" in shown.out
    assert "warning: odd" in shown.out


def test_progress_is_plain_lines_when_not_a_terminal(case, simulation, capsys):
    main(["run", case])
    lines = capsys.readouterr().err.splitlines()
    assert lines[0].startswith("[1/2] fill: 0 %")
    assert lines[1].startswith("[2/2] press: 50 %")
    assert "punch 150.0 MPa" in lines[1]
    assert "1 min 15 s left" in lines[1]
    assert len(lines) == 2
    assert "\x1b" not in "".join(lines)


def test_progress_is_a_bar_on_a_terminal(case, simulation, capsys, monkeypatch):
    monkeypatch.setattr("sys.stderr.isatty", lambda: True, raising=False)
    assert main(["run", case]) == 0
    assert "punch 150.0 MPa" in capsys.readouterr().err


def test_quiet_says_nothing(case, simulation, capsys):
    assert main(["run", case, "--quiet"]) == 0
    assert capsys.readouterr() == ("", "")


def test_json_is_all_there_is_on_standard_output(case, simulation, capsys):
    assert main(["run", case, "--json", "--quiet"]) == 0
    result = json.loads(capsys.readouterr().out)
    assert result["stop_reason"] == "finished"
    assert result["metrics"]["metrics"]["a"] is None
    assert result["report"] == "runs/case/report.html"


def test_an_earlier_run_is_not_overwritten_by_accident(case, simulation, capsys):
    assert main(["run", case, "--out", "here"]) == 0
    assert main(["run", case, "--out", "here"]) == 2
    assert "--resume" in capsys.readouterr().err
    assert main(["run", case, "--out", "here", "--resume"]) == 0
    assert simulation.calls[-1].resume


def test_overwrite_removes_what_a_run_writes_and_nothing_else(case, simulation):
    main(["run", case, "--out", "here"])
    Path("here/notes.txt").write_text("mine")
    Path("here/checkpoint.npz").write_text("old")
    assert main(["run", case, "--out", "here", "--overwrite"]) == 0
    assert Path("here/notes.txt").exists()
    assert not Path("here/checkpoint.npz").exists()


def test_resume_and_overwrite_contradict_each_other(case, simulation):
    assert main(["run", case, "--resume", "--overwrite"]) == 2


def test_the_output_folder_must_not_be_a_file(case, simulation, capsys):
    assert main(["run", case, "--out", case]) == 2
    assert "is a file" in capsys.readouterr().err


def test_a_failed_simulation_is_code_1(case, simulation, capsys):
    simulation.ending = SimulationError(
        "nan", "position is NaN", "step 7", "smaller step"
    )
    assert main(["run", case]) == 1
    assert "step 7" in capsys.readouterr().err


def test_errors_are_json_too(case, simulation, capsys):
    simulation.ending = SimulationError("nan", "position is NaN", "step 7")
    assert main(["run", case, "--json"]) == 1
    (error,) = json.loads(capsys.readouterr().out)["errors"]
    assert (error["id"], error["where"], error["hint"]) == ("nan", "step 7", None)


@pytest.mark.parametrize("ending", ["interrupted", KeyboardInterrupt()])
def test_an_interrupted_run_says_how_to_go_on(case, simulation, capsys, ending):
    simulation.ending = ending
    assert main(["run", case, "--set", "title=a b", "--threads", "2"]) == 130
    text = capsys.readouterr().err
    words = (
        "pestle run case.toml --out runs/case --threads 2 --set 'title=a b' --resume"
    )
    assert words in text


def test_termination_is_like_ctrl_c(case, simulation):
    # a worker of pytest-xdist ignores Ctrl-C
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        main(["run", case])
        with pytest.raises(KeyboardInterrupt):
            os.kill(os.getpid(), signal.SIGTERM)
    finally:
        signal.signal(signal.SIGINT, before)


def test_a_bug_is_code_3_and_keeps_its_traceback_in_a_file(case, simulation, capsys):
    simulation.ending = ZeroDivisionError("oh")
    assert main(["run", case]) == 3
    text = capsys.readouterr().err
    assert "Traceback" not in text
    file = Path(text.split()[-1])
    assert "ZeroDivisionError: oh" in file.read_text()
    file.unlink()


def test_lack_of_memory_is_code_1(case, simulation, capsys):
    simulation.ending = MemoryError()
    assert main(["run", case]) == 1
    assert "pestle plan" in capsys.readouterr().err


def test_plan(case, simulation, capsys):
    assert main(["plan", case, "--set", "count=500"]) == 0
    text = capsys.readouterr().out
    for words in ("500", "25 ns", "stiffest pair", "2.5 MB", "1 min 15 s", "59.8 ms"):
        assert words in text


def test_plan_as_json(case, simulation, capsys):
    assert main(["plan", case, "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["steps"] == 1_000_000


def test_report(simulation, capsys, tmp_path):
    (tmp_path / "case.toml").write_text(CASE)
    assert main(["report", str(tmp_path)]) == 0
    assert "report.html" in capsys.readouterr().out


@pytest.mark.parametrize("words", [[], ["nonsense"], ["run"], ["run", "a", "--no"]])
def test_wrong_words_are_code_2(words, capsys):
    assert main(words) == 2
    assert "Traceback" not in capsys.readouterr().err


def test_version(capsys):
    assert main(["--version"]) == 0
    assert capsys.readouterr().out.strip() == pestle.__version__


def test_laws(capsys):
    from pestle import laws, particle

    assert main(["laws"]) == 0
    lines = capsys.readouterr().out.splitlines()
    everything = [*laws.names(), *particle.names(), *particle.unloading_names()]
    shown = [line.split() for line in lines if line.startswith("  ")]
    assert sorted(words[0] for words in shown) == sorted(everything)
    assert all(len(words) > 3 for words in shown)  # one line that says something
    assert main(["laws", "mdr"]) == 0
    assert "psi_b" in capsys.readouterr().out
    assert main(["laws", "mdr", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert [law["kind"] for law in found] == ["pair", "loading"]
    assert {law["name"] for law in found} == {"zunker2024"}
    assert main(["laws", "hetz"]) == 2
    assert "hertz" in capsys.readouterr().err


def test_materials(capsys):
    assert main(["materials"]) == 0
    assert "avicel_ph102_zunker2025" in capsys.readouterr().out
    assert main(["materials", "avicel_ph102_zunker2025"]) == 0
    assert "10.1016/j.powtec.2025.120972" in capsys.readouterr().out
    assert main(["materials", "--json"]) == 0
    assert len(json.loads(capsys.readouterr().out)) >= 2
    assert main(["materials", "avicel"]) == 2


def test_cite_names_each_source_once(case, capsys):
    assert main(["cite", case, "--set", "powder.set=avicel_ph102_zunker2025"]) == 0
    text = capsys.readouterr().out
    for key in ("zunker2024,", "zunker2025,", "cundall1979,", "{pestle,"):
        assert text.count(key) == 1
    assert pestle.__version__ in text


def test_schema(case, capsys):
    assert main(["schema"]) == 0
    assert "$defs" in json.loads(capsys.readouterr().out)
    assert main(["schema", "--out", "case.schema.json"]) == 0
    assert "$defs" in json.loads(Path("case.schema.json").read_text())
    assert main(["schema", "--out", "no/such/folder.json"]) == 2
