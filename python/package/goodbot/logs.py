"""Session logs as files: JSON Lines, as the command line, the page and the teaching terminal read and write them."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

from ._native import Session, parse_log


def read_log(path: str | os.PathLike[str]) -> list[Session]:
    """The sessions of a log, in their order.

    Raises `FormatError` with the line and the field at fault, and `OSError` where the file cannot be read.
    """
    return parse_log(Path(path).read_bytes(), file=os.fspath(path))


def write_log(path: str | os.PathLike[str], sessions: Iterable[Session], *, append: bool = False) -> None:
    """Writes sessions as a log. A file that is there is not replaced: `append=True` adds to it.

    Raises `FormatError` where a session could not be read again, and `FileExistsError`.
    """
    lines = [line for session in sessions for line in session.lines()]
    with open(path, "a" if append else "x", encoding="utf-8", newline="\n") as file:
        file.writelines(line + "\n" for line in lines)
