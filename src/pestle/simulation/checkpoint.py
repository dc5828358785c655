"""Checkpoints: one file, replaced in one piece, so that one is always readable."""

import json
import os
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np

from pestle.errors import InputError

NAME = "checkpoint.npz"
VERSION = 3


def write(folder: Path, arrays: dict[str, Any], facts: dict[str, Any]) -> None:
    """Write arrays and plain facts; the earlier file stays until this is whole."""
    draft = folder / (NAME + ".new")
    text = json.dumps({"version": VERSION, **facts})
    with draft.open("wb") as file:
        np.savez(file, facts=np.array(text), **arrays)
        file.flush()
        os.fsync(file.fileno())
    draft.replace(folder / NAME)


def read(folder: Path) -> tuple[dict[str, Any], dict[str, Any]]:
    """Read the checkpoint of a run.

    Raises
    ------
    InputError
        If there is none, or it is damaged or of a newer version.
    """
    path = folder / NAME
    if not path.exists():
        raise InputError(
            "no-checkpoint",
            f"{folder} holds no checkpoint to resume from",
            "--resume",
            "run without --resume",
        )
    try:
        with np.load(path, allow_pickle=False) as file:
            arrays = {name: file[name] for name in file.files}
        facts = json.loads(str(arrays.pop("facts")))
    except (OSError, ValueError, KeyError, BadZipFile, EOFError) as error:
        raise InputError(
            "checkpoint-damaged",
            f"{path.name} cannot be read: {error}",
            str(path),
            "it was changed or cut by something else; run anew with --overwrite",
        ) from error
    if facts.get("version") != VERSION:
        raise InputError(
            "checkpoint-version",
            f"{path.name} has version {facts.get('version')}, this is {VERSION}",
            str(path),
            "resume with the pestle version that wrote it",
        )
    return arrays, facts
