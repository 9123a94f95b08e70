"""How well unseen commands are understood: `goodbot evaluate`, from Python."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from .command import arguments, file_of, run

if TYPE_CHECKING:
    from .names import Log, Option


@dataclass(frozen=True)
class Evaluation:
    """The result of `evaluate`."""

    answers: list[dict[str, Any]]
    """For each tested command: the answer, its probability, and whether it is right. `goodbot evaluate --json` has the same fields."""
    summary: dict[str, Any]
    """The figures of all answers: shares of right answers with their intervals, log loss, calibration, and the controls."""


def evaluate(train: Log | None = None, *, test: Log | None = None, **options: Option) -> Evaluation:
    """Trains on some sessions of a log and tests the others.

    `train` and `test` are files or sessions, or the lines of a log of worlds as dicts. Without `test` each session of `train` is tested in
    turn, with a model trained on the others. The options are those of `goodbot evaluate --help`, with `_` for `-`: `k_fold=10`,
    `group="worker"`, `leave_environment_out=True`, `learner="paper"`, `seed=2`, `with_="words.goodbot"`; a repeated option is a list.

    Raises `ValueError` with the command line's message if a log or an option is at fault, and `RuntimeError` if the command fails.

    >>> import goodbot
    >>> home, trainer, agent = goodbot.Home.random(seed=1), goodbot.Trainer(seed=1), goodbot.Agent()
    >>> tasks = {goal.split(",")[1]: goal for goal in home.tasks() if goal.startswith("agentInRoom")}
    >>> lessons = [trainer.teach(agent, home, home.start, f"go to {room[:-1]}", goal) for room, goal in tasks.items() for _ in range(2)]
    >>> found = goodbot.evaluate([lesson.session for lesson in lessons])
    >>> len(found.answers) == len(lessons)
    True
    """
    with file_of(train) as trained, file_of(test) as tested:
        given = [] if tested is None else ["--test", tested]
        given += [] if trained is None else ["--", trained]
        printed = run("evaluate", "--json", "--quiet", *arguments(options), *given)
    *answers, summary = (json.loads(line) for line in printed.splitlines())
    return Evaluation(answers, summary)
