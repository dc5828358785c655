"""What a run leaves behind: results file, history, stages, provenance."""

from pestle.results.folder import RunFolder
from pestle.results.history import History, HistoryTable, read_history
from pestle.results.provenance import collect, read_provenance, write_provenance
from pestle.results.read import Frame, Results
from pestle.results.stages import Stage, read_stages, write_stages
from pestle.results.write import ResultFile

__all__ = [
    "Frame",
    "History",
    "HistoryTable",
    "ResultFile",
    "Results",
    "RunFolder",
    "Stage",
    "collect",
    "read_history",
    "read_provenance",
    "read_stages",
    "write_provenance",
    "write_stages",
]
