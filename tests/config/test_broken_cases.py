"""Broken case files: exit code 2, key and value named, never a traceback."""

import os

import pytest

from broken_cases import ADDED, CASE, PARTICLE_FILES, REPLACED, SET, WHOLE
from pestle.cli import main
from pestle.config import Case
from pestle.errors import InputError


def check(capsys, path, words, *options):
    """The command ends with code 2 and an error with all the words."""
    code = main(["plan", str(path), *options])
    shown = capsys.readouterr()
    assert "Traceback" not in shown.err + shown.out
    assert shown.err.startswith("error[")
    for word in words:
        assert word in shown.err, shown.err
    assert code == 2, shown.err


@pytest.fixture
def case(tmp_path):
    return tmp_path / "case.toml"


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [pytest.param(old, new, words, id=name) for name, old, new, *words in REPLACED],
)
def test_a_value_is_wrong(case, capsys, old, new, words):
    assert old in CASE
    case.write_text(CASE.replace(old, new, 1))
    check(capsys, case, words)


@pytest.mark.parametrize(
    ("text", "words"),
    [pytest.param(text, words, id=name) for name, text, *words in ADDED],
)
def test_a_table_is_wrong(case, capsys, text, words):
    case.write_text(CASE + text)
    check(capsys, case, words)


@pytest.mark.parametrize(
    ("data", "words"),
    [pytest.param(data, words, id=name) for name, data, *words in WHOLE],
)
def test_the_file_is_no_case(case, capsys, data, words):
    case.write_bytes(data)
    check(capsys, case, words)


@pytest.mark.parametrize(
    ("option", "words"), [pytest.param(o, words, id=repr(o)) for o, *words in SET]
)
def test_an_override_is_wrong(case, capsys, option, words):
    case.write_text(CASE)
    check(capsys, case, words, "--set", option)


@pytest.mark.parametrize(
    ("text", "words"),
    [pytest.param(text, words, id=name) for name, text, *words in PARTICLE_FILES],
)
def test_the_particle_file_is_wrong(case, capsys, text, words):
    reading = CASE.replace('count = 1000\nradius = "150 um"', 'file = "a.csv"')
    case.write_text(reading.replace('[[process]]\nstep = "fill"\n', ""))
    if text is not None:
        (case.parent / "a.csv").write_text(text)
    check(capsys, case, words)


def test_the_earlier_run_is_missing(case, capsys):
    reading = CASE.replace('count = 1000\nradius = "150 um"', 'start_from = "fill"')
    case.write_text(reading.replace('[[process]]\nstep = "fill"\n', ""))
    check(capsys, case, ['start_from = "fill"', ":27"])


def test_the_file_does_not_exist(case, capsys):
    case.write_text(CASE)
    check(capsys, case.with_name("cas.toml"), ["does not exist", "case.toml"])


def test_the_file_is_a_directory(case, capsys):
    case.mkdir()
    check(capsys, case, ["directory"])


def test_the_file_is_a_pipe(case, capsys):
    os.mkfifo(case)
    check(capsys, case, ["not a regular file"])


def test_the_file_name_has_a_null_byte():
    with pytest.raises(InputError, match="does not exist"):
        Case.from_file("a\0b.toml")


def test_the_file_may_not_be_read(case, capsys, monkeypatch):
    case.write_text(CASE)

    def refuse(path):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr("pathlib.Path.read_bytes", refuse)
    check(capsys, case, ["Permission denied"])


def test_all_mistakes_are_told_at_once(case, capsys):
    broken = CASE.replace("restitution", "restituton").replace("count", "cuont")
    case.write_text(broken)
    check(capsys, case, ['"restituton"', '"cuont"'])


def test_the_unbroken_case_is_fine(case, capsys):
    """So it is the break that every test above sees."""
    case.write_text(CASE)
    assert main(["cite", str(case)]) == 0
    assert "@article{zunker2024" in capsys.readouterr().out


def test_there_are_enough():
    assert len(REPLACED) + len(ADDED) + len(WHOLE) + len(PARTICLE_FILES) >= 60
