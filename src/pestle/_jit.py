"""The one compiler decorator and its on-disk cache.

``njit`` is Numba's ``njit`` with the options that every kernel shares: no fastmath,
NumPy error model (no exceptions inside kernels), no Python fallback. The compiler may
not even make a product and a sum one operation: which ones it does may differ between a
kernel just compiled and the same one from disk, and a run resumed elsewhere has to go
on with the same bits. ``multiply_add`` says where they are one.

``cached`` adds a disk cache to a kernel that closes over other compiled functions, such
as a contact law. Numba's own cache looks at the file of the cached function only, so an
edited law would silently run as it was; here the key holds the source of this whole
package and the fingerprint of the law.
"""

import hashlib
import os
import shutil
import types
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

# a thread waits some 0.1 ms for the others before it sleeps: to be woken costs a good
# part of a step of few particles, to spin without end starves who else needs the core
os.environ.setdefault("OMP_WAIT_POLICY", "passive")
os.environ.setdefault("GOMP_SPINCOUNT", "3000")

import numba
from numba.core import types as nb
from numba.core.caching import CompileResultCacheImpl, FunctionCache, _CacheLocator
from numba.core.typing import signature
from numba.extending import lower_builtin, type_callable

OPTIONS: dict[str, Any] = {"error_model": "numpy", "fastmath": False}


def multiply_add(a: float, b: float, c: float) -> float:
    """Return a b + c; compiled it is one operation, rounded once.

    Without the compiler it is rounded twice: Python has no such operation before 3.13.
    """
    return a * b + c


def _types_of_multiply_add(context: Any) -> Callable[..., Any]:
    return lambda a, b, c: signature(*4 * (nb.float64,))


def _code_of_multiply_add(context: Any, builder: Any, sig: Any, args: Any) -> Any:
    return builder.fma(*args)


type_callable(multiply_add)(_types_of_multiply_add)
lower_builtin(multiply_add, *3 * (nb.float64,))(_code_of_multiply_add)


def njit(function: Callable[..., Any] | None = None, **options: Any) -> Any:
    """Compile a function with the options shared by all kernels.

    A function of one of our modules is kept on disk as it is: the folder of the cache
    is named by our sources.  One that is made inside another function needs `cached`.
    """
    if function is None:
        return lambda f: njit(f, **options)
    if not numba.config.DISABLE_JIT and "." in function.__qualname__:
        # kernels of two laws, compiled by different processes, may meet in a third: if
        # their machine code had the same names, one law would run the other's code
        function.__qualname__ += f"_{fingerprint(function)[:16]}"
    compiled = numba.njit(**{**OPTIONS, **options})(function)
    is_ours = function.__module__.partition(".")[0] == "pestle"
    if is_ours and not options and "<" not in function.__qualname__:
        cached(compiled, function.__qualname__)
    return compiled


def inline(function: Callable[..., Any]) -> Any:
    """Compile a scalar function so that LLVM always inlines it (SIMD needs that).

    Plain functions that it calls by name are compiled in the same way, so that a law
    stays plain Python: it is read, tested and debugged without the compiler.
    """
    if numba.config.DISABLE_JIT:
        return function
    return _inline(getattr(function, "py_func", function), {})


def _inline(function: Any, done: dict[Any, Any]) -> Any:
    if function in done:
        return done[function]
    done[function] = function  # an attribute may have the function's own name
    names = dict(function.__globals__)
    for name in function.__code__.co_names:
        value = names.get(name)
        if isinstance(value, types.FunctionType) and value is not multiply_add:
            names[name] = _inline(value, done)
    clone = types.FunctionType(
        function.__code__,
        names,
        function.__name__,
        function.__defaults__,
        function.__closure__,
    )
    clone.__module__, clone.__qualname__ = function.__module__, function.__qualname__
    done[function] = njit(clone, forceinline=True)
    return done[function]


@cache
def package_fingerprint() -> str:
    """Hash of every source file of the package: any edit makes a new cache."""
    digest = hashlib.sha256(numba.__version__.encode())
    root = Path(__file__).parent
    for folder in (root, root / "laws", root / "engine"):
        for path in sorted(folder.glob("*.py")):
            digest.update(path.name.encode() + path.read_bytes())
    return digest.hexdigest()[:16]


def fingerprint(function: Any) -> str:
    """Hash of a function and of all functions and numbers that it refers to."""
    digest = hashlib.sha256()
    _feed(digest, function, set())
    return digest.hexdigest()


def _feed(digest: Any, value: Any, seen: set[int]) -> None:
    value = getattr(value, "py_func", value)
    if id(value) in seen:
        return
    if isinstance(value, types.FunctionType):
        seen.add(id(value))
        _feed(digest, value.__code__, seen)
        for name in value.__code__.co_names:
            if name in value.__globals__:
                digest.update(name.encode())
                _feed(digest, value.__globals__[name], seen)
        for cell in value.__closure__ or ():
            _feed(digest, cell.cell_contents, seen)
    elif isinstance(value, types.CodeType):
        digest.update(value.co_code)
        digest.update(repr((value.co_names, value.co_varnames)).encode())
        for constant in value.co_consts:
            _feed(digest, constant, seen)
    elif isinstance(value, type) and hasattr(value, "_fields"):
        digest.update(repr((value.__name__, value._fields)).encode())
    elif isinstance(value, (int, float, str, bytes, tuple, bool, type(None))):
        digest.update(repr(value).encode())


def _cache_root() -> Path:
    base = os.environ.get("PESTLE_CACHE_DIR") or os.environ.get("XDG_CACHE_HOME")
    return (Path(base) if base else Path.home() / ".cache") / "pestle"


@cache
def cache_folder() -> Path:
    """Folder of the compiled kernels of this version of the source [path]."""
    folder = _cache_root() / f"kernels-{package_fingerprint()}"
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.parent.glob("kernels-*"):
        if old != folder and len(list(folder.parent.glob("kernels-*"))) > 4:
            shutil.rmtree(old, ignore_errors=True)
    return folder


class _Locator(_CacheLocator):  # type: ignore[misc]
    """Puts all compiled kernels into one folder of the user's cache."""

    def __init__(self, py_func: Any, py_file: str) -> None:
        self._name = f"{py_func.__module__}.{py_func.__qualname__}"

    def get_cache_path(self) -> str:
        return str(cache_folder())

    def get_source_stamp(self) -> str:
        return package_fingerprint()

    def get_disambiguator(self) -> str:
        return hashlib.sha256(self._name.encode()).hexdigest()[:10]

    @classmethod
    def from_function(cls, py_func: Any, py_file: str) -> "_Locator":
        return cls(py_func, py_file)


class _Impl(CompileResultCacheImpl):  # type: ignore[misc]
    _locator_classes = [_Locator]  # noqa: RUF012 - Numba reads a class attribute


class _KernelCache(FunctionCache):  # type: ignore[misc]
    _impl_class = _Impl

    def __init__(self, py_func: Any, key: str) -> None:
        super().__init__(py_func)
        self._key = key

    def _index_key(self, sig: Any, codegen: Any) -> tuple[Any, ...]:
        return (sig, codegen.magic_tuple(), self._key)


def cached(kernel: Any, key: str) -> Any:
    """Keep a compiled kernel on disk; `key` must name all that it closes over."""
    if not numba.config.DISABLE_JIT:
        kernel._cache = _KernelCache(kernel.py_func, key)
    return kernel
