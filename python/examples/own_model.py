"""A language model and a trainer of one's own, in the paper's course.

    python own_model.py --runs 20                                     the course, with both
    goodbot study --languages own --language "python own_model.py --serve"    the language model in a study

The language model is log-linear: a weight for each pair of a word and a feature of a task. After each session the weights move so that the
tasks that were believed in become more probable.
"""

from __future__ import annotations

import argparse
import math
from collections import defaultdict
from collections.abc import Sequence
from typing import Literal

import numpy as np
from numpy.typing import NDArray

import goodbot


class LogLinear:
    """The probability of a task is proportional to the exponential of its weights' sum."""

    def __init__(self, seed: int = 0, *, rate: float = 0.3, passes: int = 10) -> None:
        self.weights: defaultdict[tuple[str, str], float] = defaultdict(float)
        self.rate, self.passes = rate, passes
        self.sessions: list[tuple[list[list[tuple[str, str]]], NDArray[np.float32]]] = []

    def log_likelihood(self, words: Sequence[str], tasks: Sequence[goodbot.Task]) -> list[float]:
        return self._scores(self._pairs(words, tasks))

    def learn(self, words: Sequence[str], tasks: Sequence[goodbot.Task], beliefs: NDArray[np.float32]) -> None:
        self.sessions.append((self._pairs(words, tasks), beliefs))
        for _ in range(self.passes):
            for pairs, believed in self.sessions:
                scores = np.array(self._scores(pairs))
                expected = np.exp(scores - scores.max())
                for task, error in zip(pairs, believed - expected / expected.sum(), strict=True):
                    for pair in task:
                        self.weights[pair] += self.rate * float(error) / math.sqrt(len(task))

    @staticmethod
    def _pairs(words: Sequence[str], tasks: Sequence[goodbot.Task]) -> list[list[tuple[str, str]]]:
        return [[(word, feature) for word in words for feature in task.features] for task in tasks]

    def _scores(self, pairs: list[list[tuple[str, str]]]) -> list[float]:
        return [sum(self.weights.get(pair, 0.0) for pair in task) / math.sqrt(len(task)) for task in pairs]


class Encouraging:
    """A trainer who praises each step nearer to the goal, and blames only the second wrong step in a row."""

    def __init__(self, seed: int = 0) -> None:
        self.wrong = 0

    def judge(self, step: goodbot.Step) -> Literal["reward", "punish", "neutral"]:
        self.wrong = 0 if step.correct else self.wrong + 1
        if step.correct:
            return "reward"
        return "punish" if self.wrong >= 2 else "neutral"


def main() -> None:
    """Runs the course and prints what it came to, or serves the language model to `goodbot study`."""
    parser = argparse.ArgumentParser(description="A language model and a trainer of one's own, in the paper's course")
    parser.add_argument("--runs", type=int, default=20, help="how many seeds")
    parser.add_argument("--serve", action="store_true", help="serve the language model to goodbot study")
    options = parser.parse_args()
    if options.serve:
        goodbot.serve(LogLinear)
        return
    rows = goodbot.run_courses(range(1, options.runs + 1), trainer=Encouraging, language=LogLinear, layouts="random")
    tests = [row["right"] for row in rows if row["kind"] == "test"]
    steps = [row["steps"] for row in rows if row["kind"] == "lesson"]
    print(f"tests right: {sum(tests)} of {len(tests)}; steps of a lesson: {sum(steps) / len(steps):.1f}")


if __name__ == "__main__":
    main()
