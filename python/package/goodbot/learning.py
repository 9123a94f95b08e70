"""An agent that has learned from a log: `goodbot learn`, from Python."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ._native import Agent
from .command import arguments, file_of, run

if TYPE_CHECKING:
    from .names import Log, Option


def learn(
    log: Log, *, tasks: Sequence[str] | None = None, seed: int = 0, out: str | os.PathLike[str] | None = None, **options: Option
) -> Agent:
    """Learns from all sessions of a log at once, and returns the agent. It has room for all of them.

    `log` is a file or sessions, or the lines of a log of worlds as dicts. `tasks` are the kinds of tasks that commands may mean, as
    `Agent` takes them. `out` is a model file to write; it records whether the log was of worlds, for `evaluate(with_=out)`. The other options
    are those of `goodbot learn --help`, with `_` for `-`: `learner="paper"`, `believes="population"`, `starter="en"`, `without=["b3"]`.

    Raises `ValueError` with the command line's message if a log or an option is at fault, and `RuntimeError` if the command fails.

    >>> home = goodbot.Home.random(1, "A")
    >>> sessions = [goodbot.Session("go there", home, [("north", "reward"), ("noop", "neutral")])]
    >>> agent = goodbot.learn(sessions)
    >>> agent.sessions, agent.words
    (1, ['go', 'there'])
    """
    for name in ("routes", "task", "only_these_tasks"):
        if name in options:
            raise ValueError(f"{name}: name the kinds of tasks by tasks=, as for an Agent; the agent must know them too")
    kinds = [] if tasks is None else ["--only-these-tasks", *(f"--task={kind}" for kind in tasks)]
    with file_of(log) as file, tempfile.TemporaryDirectory() as folder:
        model = Path(folder, "learned.goodbot") if out is None else Path(out)
        run("learn", "--quiet", *kinds, *arguments(options), f"--out={model}", "--", str(file))
        return Agent.load(model, tasks, seed=seed)
