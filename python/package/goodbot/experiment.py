"""The paper's experiment, for one seed and for many, also with a trainer or a language model of your own."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Literal

from . import _native
from ._native import Agent, Trainer, exercises
from .language import LanguageModel, hear
from .lesson import Judge, teach
from .names import Kind, Learner, Weights
from .progress import progressing


def run_course(
    seed: int,
    *,
    trainer: Kind | Callable[[int], Judge] | None = None,
    layouts: Literal["fixed", "random"] = "fixed",
    learner: Learner = "roles",
    weights: Weights | None = None,
    language: Callable[[int], LanguageModel] | None = None,
) -> list[dict[str, Any]]:
    """Trains a new agent through the seven lessons and asks the five tests, as `goodbot paper --seed SEED` does: twelve rows.

    Each row has `seed`, `kind`, `number`, `command` and `right`; lessons also have `steps`, `ending`, `reward`, `punish` and `neutral`,
    tests the `probability` of the intended task. `layouts` is `fixed` or `random`.

    `trainer` and `language` may be classes of your own, or functions, which make a `Judge` and a `LanguageModel` for a seed. The
    course then goes step by step in Python, with other random numbers than the command line's.

    >>> rows = goodbot.run_course(1)
    >>> [row["right"] for row in rows if row["kind"] == "test"]
    [True, True, True, True, True]
    >>> class Strict:
    ...     def __init__(self, seed): pass
    ...     def judge(self, step): return "reward" if step.correct else "punish"
    >>> len(goodbot.run_course(1, trainer=Strict))
    12
    """
    if language is None and not callable(trainer):
        return _native.run_course(seed, trainer=trainer, layouts=layouts, learner=learner, weights=weights)
    if layouts not in ("fixed", "random"):
        raise ValueError(f"no layouts are called {layouts!r}; give fixed or random")
    judge = trainer(seed) if callable(trainer) else Trainer(trainer, seed=seed)
    model = language(seed) if language else None
    agent = Agent(learner=learner, weights=weights, capacities="small", seed=seed)
    rows: list[dict[str, Any]] = []
    numbers = {"lesson": 0, "test": 0}
    for exercise in exercises(seed if layouts == "random" else None):
        kind, command, intended, home = (exercise[name] for name in ("kind", "command", "intended", "home"))
        numbers[kind] += 1
        row = {"seed": seed, "kind": kind, "number": numbers[kind], "command": command}
        if kind == "lesson":
            taught = teach(agent, home, home.start, command, intended, trainer=judge, language=model)
            row |= {"right": taught.understood, "steps": len(taught.steps), "ending": taught.ending, **taught.feedback}
        else:
            hear(agent, home, home.start, command, language=model)
            row |= {"right": agent.most_likely == intended, "probability": float(agent.beliefs[agent.tasks.index(intended)])}
            agent.forget()
        rows.append(row)
    return rows


def run_courses(
    seeds: Iterable[int],
    *,
    trainer: Kind | Callable[[int], Judge] = "balanced",
    layouts: Literal["fixed", "random"] = "fixed",
    learner: Learner = "roles",
    weights: Weights | None = None,
    language: Callable[[int], LanguageModel] | None = None,
    threads: int | None = None,
    progress: bool = True,
) -> list[dict[str, Any]]:
    """`run_course` for each of the seeds, on all cores: the rows of all of them, ready for `pandas.DataFrame`.

    The same seeds give the same rows, whatever the number of threads. A bar shows the progress if `tqdm` is installed.

    >>> import goodbot
    >>> rows = goodbot.run_courses(range(1, 4), progress=False)
    >>> sum(row["right"] for row in rows if row["kind"] == "test"), "of", 3 * 5
    (15, 'of', 15)
    """
    seeds = list(seeds)
    settings = {"trainer": trainer, "layouts": layouts, "learner": learner, "weights": weights, "language": language}
    rows: list[dict[str, Any]] = []
    with ThreadPoolExecutor(threads or os.cpu_count()) as pool:
        courses = [pool.submit(run_course, seed, **settings) for seed in seeds]  # type: ignore[arg-type]
        try:
            for course in progressing(courses, "training agents", shown=progress):
                rows.extend(course.result())
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    return rows
