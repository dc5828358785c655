"""One self-contained page about a run."""

from pestle.report.build import build

__all__ = ["build"]
