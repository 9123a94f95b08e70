"""Session logs as files: JSON Lines, as the command line, the page and the teaching terminal read and write them."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ._native import Agent, Session, parse_log
from .frames import of_beliefs

if TYPE_CHECKING:
    from .frames import Frame


def read_log(path: str | os.PathLike[str]) -> list[Session]:
    """The sessions of a log, in their order, in homes or in worlds.

    Raises `FormatError` with the line and the field at fault, and `OSError` if the file cannot be read.
    """
    return parse_log(Path(path).read_bytes(), file=os.fspath(path))


def write_log(path: str | os.PathLike[str], sessions: Iterable[Session], *, append: bool = False) -> None:
    """Writes sessions as a log, all in homes or all in worlds. An existing file is not replaced; `append=True` adds to it.

    Raises `FormatError` if a session could not be read again, `ValueError` if some are in homes and some in worlds, and `FileExistsError`.
    """
    text = "".join(line + "\n" for line in _lines(sessions)).encode()
    with open(path, "a+b" if append else "xb") as file:
        # The last line of a log may have no end.
        if append and file.seek(0, os.SEEK_END) and file.seek(-1, os.SEEK_END) >= 0 and file.read() != b"\n":
            text = b"\n" + text
        file.write(text)


def _lines(sessions: Iterable[Session]) -> Iterator[str]:
    """The lines of a log. The line of a world comes once for all sessions in a row that are in it."""
    last: str | None = None
    for number, session in enumerate(sessions):
        lines = session.lines()
        world = lines.pop(0) if session.world is not None else None
        if number and (world is None) != (last is None):
            raise ValueError("a log has sessions in homes or in worlds, and not both; write two logs")
        if world is not None and world != last:
            yield world
        last = world
        yield from lines


@dataclass(frozen=True)
class Posterior:
    """An agent's beliefs in a session."""

    session: Session
    """The session."""
    tasks: list[str]
    """Its possible tasks."""
    beliefs: NDArray[np.float32]
    """How probable each task was: shape (steps + 1, tasks), each row of sum 1. The first row is of the words alone."""

    @property
    def intended(self) -> NDArray[np.float32] | None:
        """How probable the intended task was: shape (steps + 1,). None if it is not known or not possible."""
        meant = self.session.intended
        return self.beliefs[:, self.tasks.index(meant)] if meant in self.tasks else None

    def to_frame(self) -> Frame:
        """The beliefs as a frame of pandas: a row for each step, 0 before the first one, and a column for each task."""
        return of_beliefs(self.tasks, self.beliefs)

    def __repr__(self) -> str:
        return f"<goodbot.Posterior: {self.session.command!r}, {len(self.beliefs) - 1} steps, {len(self.tasks)} tasks>"


def posteriors(log: str | os.PathLike[str] | Iterable[Session], agent: Agent | None = None, *, learn: bool | None = None) -> list[Posterior]:
    """Replays a log, and returns for each session the agent's beliefs before the first step and after each.

    `log` is a file or sessions; without `agent` a new one hears it, made for the world of the first session if it is in one. It learns from the sessions that say so; `learn` overrides them. The
    numbers are those of `goodbot replay LOG`, bit for bit.

    Raises `FormatError`, `ValueError` if a session cannot be replayed, and `OSError`.

    >>> home = goodbot.Home.random(1, "A")
    >>> sessions = [goodbot.Session("go there", home, [("north", "reward"), ("noop", "neutral")])]
    >>> [first] = goodbot.posteriors(sessions)
    >>> first.beliefs.shape == (3, len(first.tasks))
    True
    """
    sessions = read_log(log) if isinstance(log, (str, os.PathLike)) else list(log)
    agent = Agent(domain=sessions[0].world if sessions else None) if agent is None else agent
    return [Posterior(session, *session.posteriors(agent, learn=learn)) for session in sessions]
