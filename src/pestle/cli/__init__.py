"""The command line; `main` turns every ending into an exit code.

0 done, 1 simulation failed, 2 bad input, 3 a bug of ours, 130 interrupted.
"""

import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pestle.errors import PestleError

BUG = 3
INTERRUPTED = 130


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit code."""
    from pestle.errors import PestleError

    argv = list(sys.argv[1:] if arguments is None else arguments)
    try:
        return _run(argv)
    except PestleError as error:
        return _report(error, as_json="--json" in argv)
    except KeyboardInterrupt:
        print("interrupted", file=sys.stderr)
        return INTERRUPTED
    except BrokenPipeError:  # the reader of a pipe, such as head, has enough
        sys.stdout = None
        return 0
    except MemoryError:
        what = "there is not enough memory"
        hint = "`pestle plan` says how much a case needs"
        lack = PestleError("out-of-memory", what, hint=hint)
        return _report(lack, as_json="--json" in argv)
    except Exception as error:
        return _usage(error) if hasattr(error, "show") else _report_bug()


def _run(argv: list[str]) -> int:
    import typer

    from pestle.cli.app import app

    try:
        result = app(argv, prog_name="pestle", standalone_mode=False)
    except typer.Abort:
        raise KeyboardInterrupt from None
    return result if isinstance(result, int) else 0


def _usage(error: Any) -> int:
    """Show a wrong option; typer has a click of its own, so we go by its methods."""
    error.show()
    return int(error.exit_code)


def _report(error: "PestleError", *, as_json: bool) -> int:
    if as_json:
        import json

        parts = [error, *error.others]
        keys = ("id", "what", "where", "hint")
        errors = [{key: getattr(part, key) for key in keys} for part in parts]
        print(json.dumps({"errors": errors}, indent=2))
    print(error, file=sys.stderr)
    return error.exit_code


def _report_bug() -> int:
    """Keep the traceback in a file: it is for us, not for the user's screen."""
    import tempfile
    import traceback

    text = traceback.format_exc()
    last = text.strip().splitlines()[-1]
    print(
        f"error[bug]: this is a bug in pestle, not in your case: {last}",
        file=sys.stderr,
    )
    with tempfile.NamedTemporaryFile(
        "w", prefix="pestle-bug-", suffix=".txt", delete=False
    ) as file:
        file.write(text)
    print(f"  hint: please report it with {file.name}", file=sys.stderr)
    return BUG
