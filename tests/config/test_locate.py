"""Lines of keys in a TOML text."""

import pytest

from pestle.config.locate import line_of

TEXT = """\
title = "[die]"  # [law]
[law]
name = "hertz"
[contacts]
restitution = 1
[[contacts.pairs]]
between = ["a",
  "b",
]
[[contacts.pairs]]
between = ["a", "c"]
friction = 1
[walls."x plus"]
point = [[1], [2]]
[[process]]
step = "fill"
[[process]]
engine.safety = 1
"""


@pytest.mark.parametrize(
    ("path", "line"),
    [
        (("title",), 1),
        (("law",), 2),
        (("law", "name"), 3),
        (("law", "psi_b"), 2),
        (("contacts", "pairs", 0, "between", 1), 7),
        (("contacts", "pairs", 1, "friction"), 12),
        (("walls", "x plus", "point"), 14),
        (("process", 1, "engine", "safety"), 18),
        (("die",), None),
    ],
)
def test_lines(path, line):
    assert line_of(TEXT, path) == line
