"""What the README shows works."""

import re
from pathlib import Path

from pestle.config import Case

ROOT = Path(__file__).parent.parent
README = (ROOT / "README.md").read_text(encoding="utf-8")


def test_the_case_is_a_case(tmp_path):
    (text,) = re.findall(r"```toml\n(.*?)```", README, flags=re.DOTALL)
    path = tmp_path / "case.toml"
    path.write_text(text)
    case = Case.from_file(path, {"law.psi_b": 0.4})
    assert case.pair("powder", "tool").sliding_friction == 0.1


def test_links_to_files_lead_somewhere():
    for target in re.findall(r"\]\((?!http)([^)#]+)\)", README):
        assert (ROOT / target).exists(), target


def test_the_two_commands_exist():
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    first = README.partition("```sh\n")[2].partition("```")[0]
    targets = re.findall(r"(?m)^make (\w+)", first)
    assert targets == ["demo", "test"]
    for target in targets:
        assert f"\n{target}:" in makefile
