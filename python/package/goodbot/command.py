"""The command line, called from Python: options as arguments with names, logs as files, faults as exceptions."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from ._native import Session
from .logs import write_log

if TYPE_CHECKING:
    from .names import Log, Option


def run(*arguments: str) -> str:
    """The output of a command. Raises `ValueError` with its message if its input is at fault, and `RuntimeError` if it fails."""
    command = [sys.executable, "-m", "goodbot", *arguments]
    done = subprocess.run(command, capture_output=True, text=True, encoding="utf-8", check=False)
    if done.returncode != 0:
        message = done.stderr.strip().removeprefix("error: ")
        raise (ValueError if done.returncode == 2 else RuntimeError)(message)
    return done.stdout


@contextmanager
def file_of(log: Log | None) -> Iterator[str | None]:
    """The file of a log; one that is not a file is written to a temporary one."""
    if log is None or isinstance(log, (str, os.PathLike)):
        yield None if log is None else os.fspath(log)
        return
    with tempfile.TemporaryDirectory() as folder:
        file, items = Path(folder) / "log.jsonl", list(log)
        sessions = [it for it in items if isinstance(it, Session)]
        if not sessions and items:
            file.write_text("\n".join(map(json.dumps, items)), encoding="utf-8")
        elif len(sessions) == len(items):
            write_log(file, sessions)
        else:
            raise ValueError("a log has sessions, or the lines of worlds and of commands in them, and not both")
        yield str(file)


def arguments(options: Mapping[str, Option | None]) -> Iterator[str]:
    """Options as they are typed: `k_fold=10` is `--k-fold=10`. None is left out."""
    for name, value in options.items():
        if value is None:
            continue
        flag = "--" + name.rstrip("_").replace("_", "-")
        if isinstance(value, bool):
            yield from [flag] if value else []
            continue
        several = [value] if isinstance(value, (int, float, str, os.PathLike)) else value
        for one in several:
            yield f"{flag}={os.fspath(one) if isinstance(one, os.PathLike) else one}"
