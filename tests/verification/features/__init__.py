"""What computes the features of the reference files: one module a file.

A module is named after its file (``mdr.py`` for ``mdr.json``) and fills a `Features`
with one function a feature, which takes the inputs of a case and returns its outputs.
"""

import pkgutil
from collections.abc import Callable
from dataclasses import dataclass, field
from importlib import import_module
from typing import Any

Compute = Callable[[dict[str, Any]], dict[str, Any]]


@dataclass
class Features:
    """The features of one reference file."""

    atol: float  # absolute tolerance of a case that gives none
    functions: dict[str, Compute] = field(default_factory=dict)

    def register(self, *names: str) -> Callable[[Compute], Compute]:
        """Make a function compute one or more features."""

        def remember(function: Compute) -> Compute:
            for name in names:
                assert name not in self.functions, f"feature {name} twice"
                self.functions[name] = function
            return function

        return remember


def modules() -> dict[str, Features]:
    """All feature modules by name."""
    return {
        info.name: import_module(f"{__name__}.{info.name}").FEATURES
        for info in pkgutil.iter_modules(__path__)
        if not info.name.startswith("_")
    }


def find(file: str, feature: str) -> tuple[Compute, float] | None:
    """Find the function and absolute tolerance of a feature; its own file's first."""
    known = modules()
    for name in sorted(known, key=lambda name: not file.startswith(name)):
        features = known[name]
        if feature in features.functions:
            return features.functions[feature], features.atol
    return None
