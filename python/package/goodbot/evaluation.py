"""How well commands are understood that were not trained on: `goodbot evaluate`, from Python."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .logs import write_log

if TYPE_CHECKING:
    from .names import Log, Option

@dataclass(frozen=True)
class Evaluation:
    """What `evaluate` found."""

    answers: list[dict[str, Any]]
    """For each command that was asked: what was answered, how sure, and whether that is right. `goodbot evaluate --json` has the same fields."""
    summary: dict[str, Any]
    """The figures of all answers: shares of right answers with their intervals, log loss, calibration, and the controls."""


def evaluate(train: Log | None = None, *, test: Log | None = None, **options: Option) -> Evaluation:
    """Trains on some sessions of a log and asks the others.

    `train` and `test` are files or sessions. Without `test` each session of `train` is asked in its turn, by a model of the others. The options
    are those of `goodbot evaluate --help`, with `_` for `-`: `k_fold=10`, `group="worker"`, `leave_environment_out=True`, `learner="paper"`,
    `seed=2`, `with_="words.goodbot"`, a list for what may come several times.

    Raises `ValueError` with the command line's message where a log or an option is at fault, and `RuntimeError` where the command fails.

    >>> import goodbot
    >>> home, trainer, agent = goodbot.Home.random(seed=1), goodbot.Trainer(seed=1), goodbot.Agent()
    >>> tasks = {goal.split(",")[1]: goal for goal in home.tasks() if goal.startswith("agentInRoom")}
    >>> lessons = [trainer.teach(agent, home, home.start, f"go to {room[:-1]}", goal) for room, goal in tasks.items() for _ in range(2)]
    >>> found = goodbot.evaluate([lesson.session for lesson in lessons])
    >>> len(found.answers) == len(lessons)
    True
    """
    with _file(train) as trained, _file(test) as tested:
        arguments = ["evaluate", "--json", "--quiet", *_arguments(options)]
        arguments += [] if tested is None else ["--test", tested]
        arguments += [] if trained is None else ["--", trained]
        done = subprocess.run(
            [sys.executable, "-m", "goodbot", *arguments], capture_output=True, text=True, encoding="utf-8", check=False
        )
    if done.returncode != 0:
        message = done.stderr.strip().removeprefix("error: ")
        raise (ValueError if done.returncode == 2 else RuntimeError)(message)
    *answers, summary = (json.loads(line) for line in done.stdout.splitlines())
    return Evaluation(answers, summary)


@contextmanager
def _file(log: Log | None) -> Iterator[str | None]:
    """The file of a log, which is written where it is not one."""
    if log is None or isinstance(log, (str, os.PathLike)):
        yield None if log is None else os.fspath(log)
        return
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "sessions.jsonl"
        write_log(file, log)
        yield str(file)


def _arguments(options: dict[str, Option]) -> Iterator[str]:
    for name, value in options.items():
        flag = "--" + name.rstrip("_").replace("_", "-")
        if isinstance(value, bool):
            yield from [flag] if value else []
            continue
        several = [value] if isinstance(value, (int, float, str, os.PathLike)) else value
        for one in several:
            yield f"{flag}={os.fspath(one) if isinstance(one, os.PathLike) else one}"
