"""Powder compaction with elastic-plastic adhesive particles.

The public names are imported when they are first used, so that
``import pestle`` costs nothing.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pestle.config import Case
    from pestle.errors import InputError, PestleError, SimulationError
    from pestle.materials import Material
    from pestle.simulation import Plan, Progress, RunResult, plan, run

__version__ = "0.1.0"

_HOME = {
    "Case": "pestle.config",
    "InputError": "pestle.errors",
    "Material": "pestle.materials",
    "PestleError": "pestle.errors",
    "Plan": "pestle.simulation",
    "Progress": "pestle.simulation",
    "RunResult": "pestle.simulation",
    "SimulationError": "pestle.errors",
    "plan": "pestle.simulation",
    "run": "pestle.simulation",
}

__all__ = [
    "Case",
    "InputError",
    "Material",
    "PestleError",
    "Plan",
    "Progress",
    "RunResult",
    "SimulationError",
    "__version__",
    "plan",
    "run",
]


def __getattr__(name: str) -> Any:
    """Import a public name on first use."""
    if name not in _HOME:
        raise AttributeError(f"module 'pestle' has no attribute {name!r}")
    value = getattr(import_module(_HOME[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
