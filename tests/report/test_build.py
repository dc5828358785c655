"""The report: complete, self-contained, safe, and content with what there is."""

import json
import re
from html.parser import HTMLParser
from pathlib import Path

import pytest

from pestle.config import Case
from pestle.errors import InputError
from pestle.report import build
from pestle.report.inputs import input_tables
from synthetic import CASE, write_run

TRIAXIAL = Path(__file__).parents[2] / "examples" / "triaxial12.toml"


class Page(HTMLParser):
    """Checks nesting and collects what a page refers to."""

    VOID = frozenset({"meta", "img", "input", "br", "hr", "link", "image"})

    def __init__(self, text):
        super().__init__()
        self.open, self.links, self.ids, self.headings, self.tags = [], [], [], [], []
        self.feed(text)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag, attributes):
        self.tags.append(tag)
        found = dict(attributes)
        self.ids += [found["id"]] if "id" in found else []
        self.links += [found[k] for k in ("src", "href", "xlink:href") if k in found]
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        if tag not in self.VOID:
            self.open.pop()

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open and self.open[-1] == "h2":
            self.headings.append(data)


def page_of(folder, **options):
    path = build(folder, pixels=60, **options)
    assert path == folder / "report.html"
    return path.read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return write_run(tmp_path_factory.mktemp("run"), count=40, rounds=12)


@pytest.fixture(scope="module")
def text(folder):
    return page_of(folder, references=["@article{a, title = {<b>}}"])


@pytest.fixture
def copy(folder, tmp_path):
    for name in ("case.toml", "provenance.json", "history.csv", "stages.json"):
        (tmp_path / name).write_bytes((folder / name).read_bytes())
    (tmp_path / "results.vtkhdf").write_bytes((folder / "results.vtkhdf").read_bytes())
    return tmp_path


def test_everything_is_there(text):
    assert Page(text).headings == [
        "The powder",
        "Compaction curve",
        "Stresses",
        "Compressibility",
        "Sizes and forces",
        "Energy ledger",
        "All numbers",
        "What was done",
        "Inputs",
        "Time and place",
        "How to cite",
    ]
    for words in (
        "Tensile strength",
        "in-die",
        "150 MPa",
        "8.75 GPa",
        "2 min 23 s",
        "Inertial number",
    ):
        assert words in text


def test_a_rule_that_is_not_the_usual_one_is_shown():
    case = Case.from_file(TRIAXIAL, {"contacts.sliding_rule": "total"})
    assert ("sliding rule", "total") in input_tables(case)[-1].rows
    usual = input_tables(Case.from_file(TRIAXIAL))[-1].rows
    assert "sliding rule" not in dict(usual)


def test_needs_no_network_and_ids_are_unique(text):
    page = Page(text)
    assert len(page.ids) == len(set(page.ids))
    assert all(link.startswith(("data:image/png", "#")) for link in page.links)
    outside = set(re.findall(r"https?://[^\s\"'<>)]+", text))
    assert {url for url in outside if "w3.org" not in url} == set()
    assert "@import" not in text


def test_what_it_shows_is_escaped(text):
    assert "Avicel PH102 &lt;synthetic &amp; test&gt;" in text
    assert "<synthetic" not in text
    assert "{&lt;b&gt;}" in text


def test_hostile_files_stay_text(copy):
    bad = "</script><script>alert(1)</script>"
    stages = json.loads((copy / "stages.json").read_text())
    for stage in stages:
        stage["end_reason"] = bad
        stage["info"] = {"wall_time_s": bad, "warnings": [bad]}
    stages[0]["step"] = '"><img src=x>'
    (copy / "stages.json").write_text(json.dumps(stages))
    record = {"case_text": bad, "machine": bad, "started": bad, "pestle_version": bad}
    (copy / "provenance.json").write_text(json.dumps(record))
    page = Page(page_of(copy))
    assert page.tags.count("script") == 1
    assert "x" not in page.links


def test_metrics_are_written(folder, text):
    found = json.loads((folder / "metrics.json").read_text())["metrics"]
    assert found["peak_axial_stress"]["value"] == pytest.approx(150e6)
    assert text


@pytest.mark.parametrize(
    ("missing", "gone"),
    [
        (["results.vtkhdf"], {"The powder", "Sizes and forces"}),
        (
            ["history.csv"],
            {"Compaction curve", "Stresses", "Compressibility", "Energy ledger"},
        ),
        (["case.toml"], {"Compaction curve", "Stresses", "Compressibility"}),
        (["provenance.json", "stages.json"], {"What was done"}),
    ],
)
def test_parts_without_data_are_left_out(copy, missing, gone):
    for name in missing:
        (copy / name).unlink()
    headings = set(Page(page_of(copy)).headings)
    assert not gone & headings
    assert ("Wall forces" in headings) == (missing == ["case.toml"])
    assert "How to cite" in headings


def test_a_case_that_cannot_be_read_is_a_warning(copy):
    (copy / "case.toml").write_text(CASE.replace("seed = 7", "sead = 7"))
    text = page_of(copy)
    assert "Read this first" in text
    assert "case.toml cannot be used" in text


def test_an_unfinished_run_says_so(tmp_path):
    folder = write_run(tmp_path / "run", count=30, rounds=6, stop_after="press")
    text = page_of(folder)
    assert "has not reached its end" in text
    assert "unload, eject, relax, crush" in text
    assert "Tablet thickness" not in text


def test_folders_that_are_no_runs(tmp_path):
    with pytest.raises(InputError, match="folder-missing"):
        build(tmp_path / "nowhere")
    with pytest.raises(InputError, match="folder-without-results"):
        build(tmp_path)


def test_a_truncated_results_file_is_a_clear_error(copy):
    data = (copy / "results.vtkhdf").read_bytes()
    (copy / "results.vtkhdf").write_bytes(data[: len(data) // 2])
    with pytest.raises(InputError, match="results-truncated"):
        build(copy, pixels=60)


def test_a_run_that_has_only_begun(copy):
    from pestle.results import ResultFile

    ResultFile(copy / "results.vtkhdf", "a").truncate_after(-1)
    lines = (copy / "history.csv").read_text().splitlines()
    (copy / "history.csv").write_text(lines[0] + "\n")
    (copy / "stages.json").write_text("[]")
    assert Page(page_of(copy)).headings
