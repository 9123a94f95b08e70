"""An agent that has learned from a log: `goodbot learn`, from Python."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from ._native import Agent, Session
from .command import arguments, file_of, run

if TYPE_CHECKING:
    from ._native import Home, World
    from .domain import Domain
    from .names import Log, Starter


def learn(
    log: Log,
    *,
    tasks: Sequence[str] | None = None,
    domain: Home | World | Domain | None = None,
    seed: int = 0,
    out: str | os.PathLike[str] | None = None,
    learner: Literal["default", "roles", "paper"] | None = None,
    starter: Starter | None = None,
    believes: str | None = None,
    without: str | Sequence[str] | None = None,
    limit: int | None = None,
    keep_going: bool = False,
    force: bool = False,
) -> Agent:
    """Learns from all sessions of a log at once, and returns the agent. It has room for all of them.

    `log` is a file or sessions, or the lines of a log of worlds as dicts. `tasks` are the kinds of tasks that commands may mean, as
    `Agent` takes them. `domain` is the world that the agent is for; of sessions in a world, it is that of the first. `out` is a model file to write (`force`: over any file); it records whether the log was of worlds, for
    `evaluate(with_=out)`. `starter` begins with everyday sentences in a language. `believes` are the trainers to expect, such as `population`.
    `without` leaves out sessions by their `id`. `limit` reads the first sessions alone, `keep_going` skips faults.

    Raises `ValueError` with the command line's message if a log or an option is at fault, and `RuntimeError` if the command fails.

    >>> home = goodbot.Home.random(1, "A")
    >>> sessions = [goodbot.Session("go there", home, [("north", "reward"), ("noop", "neutral")])]
    >>> agent = goodbot.learn(sessions)
    >>> agent.sessions, agent.words
    (1, ['go', 'there'])
    """
    options = {
        "learner": learner,
        "starter": starter,
        "believes": believes,
        "without": without,
        "limit": limit,
        "keep_going": keep_going,
        "force": force,
    }
    kinds = [] if tasks is None else ["--only-these-tasks", *(f"--task={kind}" for kind in tasks)]
    if not isinstance(log, (str, os.PathLike)):
        items: list[Any] = list(log)
        log = items
        if domain is None and items and isinstance(items[0], Session):
            domain = items[0].world
    with file_of(log) as file, tempfile.TemporaryDirectory() as folder:
        model = Path(folder, "learned.goodbot") if out is None else Path(out)
        run("learn", "--quiet", *kinds, *arguments(options), f"--out={model}", "--", str(file))
        return Agent.load(model, tasks, domain=domain, seed=seed)
