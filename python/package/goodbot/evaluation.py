"""How well unseen commands are understood: `goodbot evaluate`, from Python."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from .command import arguments, file_of, run
from .frames import of_lines

if TYPE_CHECKING:
    from .frames import Frame
    from .names import Compared, Group, Log, Starter


@dataclass(frozen=True)
class Evaluation:
    """The result of `evaluate`."""

    answers: list[dict[str, Any]] = field(repr=False)
    """For each tested command: the answer, its probability, and whether it is right. `goodbot evaluate --json` has the same fields."""
    summary: dict[str, Any] = field(repr=False)
    """The figures of all answers: shares of right answers with their intervals, log loss, calibration, and the controls."""

    def to_frame(self) -> Frame:
        """The answers as a frame of pandas: a row for each, with the columns `session`, `command`, `expected`, `predicted`, `right` and others."""
        return of_lines(self.answers)

    def __repr__(self) -> str:
        low, high = self.summary["interval"] or (None, None)
        interval = "" if low is None else f", {low:.1%} to {high:.1%}"
        return f"<goodbot.Evaluation: {self.summary['right']} of {self.summary['asked']} are right{interval}>"


def evaluate(
    train: Log | None = None,
    *,
    test: Log | None = None,
    k_fold: int | None = None,
    kfold: int | None = None,
    leave_one_out: bool = False,
    leave_environment_out: bool = False,
    leave_task_out: bool = False,
    group: Group | None = None,
    learner: Compared | None = None,
    starter: Starter | None = None,
    task: str | Sequence[str] | None = None,
    only_these_tasks: bool = False,
    routes: bool = False,
    synonyms: str | os.PathLike[str] | None = None,
    novel_environments: int | None = None,
    clear: float | None = None,
    with_: str | os.PathLike[str] | None = None,
    seed: int | None = None,
    limit: int | None = None,
    keep_going: bool = False,
    plot: str | os.PathLike[str] | None = None,
    curve: str | os.PathLike[str] | None = None,
    runs: int | None = None,
    force: bool = False,
) -> Evaluation:
    """Trains on some sessions of a log and tests the others.

    `train` and `test` are files or sessions, or the lines of a log of worlds as dicts. Without `test` each session of `train` is tested in
    turn, with a model trained on the others:

    - `k_fold`, also `kfold`: all but one of so many parts train, in turn. Up to 500 sessions the default is `leave_one_out`, above it 10 parts;
    - `leave_environment_out`, `leave_task_out`: the model never saw the home, or the task there;
    - `group`: what is left out together, such as all of a `worker` or all copies of a `command`;
    - `seed`: the seed of the parts.

    `learner` and `starter` (a language, such as `en`) are the model. `task` is a kind of task beside the paper's two, or several; with
    `only_these_tasks` in place of them; `routes` adds ways. `synonyms` is a table in a file. `novel_environments` asks each command in so many random
    homes. `clear`, such as 0.9, asks sessions that do not say what was meant, too, where their steps make a task more probable than that; the
    summary counts them apart, in `by_the_steps`. `with_` is a model file in place of training. `limit` reads the first sessions alone, `keep_going` skips faults. `plot` and `curve` are
    pictures to write (`force`: over any file), `runs` the orders behind a curve.

    Raises `ValueError` with the command line's message if a log or an option is at fault, and `RuntimeError` if the command fails.

    >>> import goodbot
    >>> home, trainer, agent = goodbot.Home.random(seed=1), goodbot.Trainer(seed=1), goodbot.Agent()
    >>> tasks = {goal.split(",")[1]: goal for goal in home.tasks() if goal.startswith("agentInRoom")}
    >>> lessons = [trainer.teach(agent, home, home.start, f"go to {room[:-1]}", goal) for room, goal in tasks.items() for _ in range(2)]
    >>> found = goodbot.evaluate([lesson.session for lesson in lessons], k_fold=2)
    >>> len(found.answers) == len(lessons)
    True
    """
    if k_fold is not None and kfold is not None:
        raise ValueError("k_fold and kfold are one option; give one of them")
    options = {
        "k_fold": kfold if k_fold is None else k_fold,
        "leave_one_out": leave_one_out,
        "leave_environment_out": leave_environment_out,
        "leave_task_out": leave_task_out,
        "group": group,
        "learner": learner,
        "starter": starter,
        "task": task,
        "only_these_tasks": only_these_tasks,
        "routes": routes,
        "synonyms": synonyms,
        "novel_environments": novel_environments,
        "clear": clear,
        "with": with_,
        "seed": seed,
        "limit": limit,
        "keep_going": keep_going,
        "plot": plot,
        "curve": curve,
        "runs": runs,
        "force": force,
    }
    with file_of(train) as trained, file_of(test) as tested:
        given = [] if tested is None else ["--test", tested]
        given += [] if trained is None else ["--", trained]
        printed = run("evaluate", "--json", "--quiet", *arguments(options), *given)
    *answers, summary = (json.loads(line) for line in printed.splitlines())
    return Evaluation(answers, summary)
