"""Compile a plain function together with all plain functions of ours that it calls.

The functions of a path stay plain Python: they are read, tested and debugged without
the compiler.  Names are followed through modules too, `mdr.penetration` for one, by
giving the compiled twin of a function twins of the modules that it looks into.
"""

import dis
import hashlib
import types
from functools import cache
from pathlib import Path
from typing import Any

import numba

from pestle._jit import cached, njit

ROOT = Path(__file__).parent.parent


@cache
def sources_fingerprint() -> str:
    """Hash of the sources of `particle` and `reference`."""
    digest = hashlib.sha256()
    for folder in ("particle", "reference"):
        for path in sorted((ROOT / folder).glob("*.py")):
            digest.update(path.name.encode() + path.read_bytes())
    return digest.hexdigest()[:16]


@cache
def compiled(function: Any) -> Any:
    """Twin of a function that runs as machine code, kept on disk."""
    if numba.config.DISABLE_JIT:  # type: ignore[attr-defined]
        return function
    kernel = _twin(function, {})
    return cached(kernel, f"{function.__qualname__}-{sources_fingerprint()}")


def _twin(function: Any, done: dict[Any, Any]) -> Any:
    if function in done:
        return done[function]
    names = dict(function.__globals__)
    code = function.__code__  # Numba takes no argument that is by keyword only
    count = code.co_argcount + code.co_kwonlyargcount
    code = code.replace(co_argcount=count, co_kwonlyargcount=0)
    clone = types.FunctionType(code, names, function.__name__)
    clone.__module__ = function.__module__
    clone.__qualname__ = f"{function.__qualname__}_{sources_fingerprint()}"
    done[function] = njit(clone, nogil=True)  # an option: not kept on disk by itself
    for each in dis.get_instructions(function):
        if each.opname == "LOAD_GLOBAL" and each.argval in names:  # not a builtin
            names[each.argval] = _followed(names[each.argval], function, done)
    return done[function]


def _followed(value: Any, function: Any, done: dict[Any, Any]) -> Any:
    """Value of a global name as the twin of a function sees it."""
    if isinstance(value, types.FunctionType) and _is_ours(value):
        return _twin(value, done)
    if isinstance(value, types.ModuleType) and _is_ours(value):
        twin = types.ModuleType(value.__name__)
        for name in function.__code__.co_names:
            if hasattr(value, name):
                found = getattr(value, name)
                setattr(twin, name, _followed(found, function, done))
        return twin
    return value


def _is_ours(value: Any) -> bool:
    name = value.__name__ if isinstance(value, types.ModuleType) else value.__module__
    return name.partition(".")[0] == "pestle"
