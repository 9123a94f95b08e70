"""The paper's experiment for many seeds."""

from __future__ import annotations

import os
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Literal

from ._native import run_course
from .names import Kind, Learner, Weights
from .progress import progressing


def run_courses(
    seeds: Iterable[int],
    *,
    trainer: Kind = "balanced",
    layouts: Literal["fixed", "random"] = "fixed",
    learner: Learner = "roles",
    weights: Weights | None = None,
    threads: int | None = None,
    progress: bool = True,
) -> list[dict[str, Any]]:
    """`run_course` for each of the seeds, on all cores: the rows of all of them, ready for `pandas.DataFrame`.

    The same seeds give the same rows, whatever the number of threads. A bar shows how far it is where `tqdm` is installed.

    >>> import goodbot
    >>> rows = goodbot.run_courses(range(1, 4), progress=False)
    >>> sum(row["right"] for row in rows if row["kind"] == "test"), "of", 3 * 5
    (15, 'of', 15)
    """
    seeds = list(seeds)
    rows: list[dict[str, Any]] = []
    with ThreadPoolExecutor(threads or os.cpu_count()) as pool:
        courses = [
            pool.submit(run_course, seed, trainer=trainer, layouts=layouts, learner=learner, weights=weights) for seed in seeds
        ]
        try:
            for course in progressing(courses, "training agents", shown=progress):
                rows.extend(course.result())
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    return rows
