"""The compiler decorator of this package: kernels of `pestle._jit`, kept on disk.

The cache of the engine's kernels is named by the sources of engine and laws; the key
here is the source of this package, so that an edited kernel is compiled anew.
"""

import hashlib
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

from pestle._jit import cached, njit


@cache
def sources_fingerprint() -> str:
    """Hash of the kernels' sources."""
    digest = hashlib.sha256()
    for path in sorted(Path(__file__).parent.glob("_*.py")):
        digest.update(path.name.encode() + path.read_bytes())
    return digest.hexdigest()[:16]


def kernel(function: Callable[..., Any]) -> Any:
    """Compile a kernel of the lab and keep it on disk."""
    compiled = njit(function, boundscheck=False)
    return cached(compiled, f"{function.__qualname__}-{sources_fingerprint()}")


def inner(function: Callable[..., Any]) -> Any:
    """Compile a scalar function that kernels call; it is not kept by itself."""
    return njit(function, inline="never")
