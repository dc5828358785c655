"""Numbers that people read off a compaction."""

from pestle.metrics.compaction import HeckelFit, KawakitaFit, heckel, kawakita
from pestle.metrics.metric import Metric
from pestle.metrics.strength import diametral_tensile_strength
from pestle.metrics.summary import Summary, summarise, write_metrics

__all__ = [
    "HeckelFit",
    "KawakitaFit",
    "Metric",
    "Summary",
    "diametral_tensile_strength",
    "heckel",
    "kawakita",
    "summarise",
    "write_metrics",
]
