"""A language model and a trainer of one's own, in the paper's course.

    python own_model.py --runs 20

The language model translates features of tasks, such as `agentInRoom` or `blockInRoom 0 color blue`, into words. After each session it is trained
anew on all sessions, each with the belief at its end.
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


class Translation:
    """IBM Model 1: each word is a translation of one of the task's features, or of none of them."""

    UNKNOWN = 0.01

    def __init__(self, seed: int = 0, *, rounds: int = 10) -> None:
        self.rounds = rounds
        self.sessions: list[tuple[Sequence[str], Sequence[goodbot.Task], NDArray[np.float32]]] = []
        self.chance: dict[tuple[str, str], float] = {}

    def log_likelihood(self, words: Sequence[str], tasks: Sequence[goodbot.Task]) -> list[float]:
        return [sum(math.log(sum(self._shares(word, task).values()) / (len(task.features) + 1)) for word in words) for task in tasks]

    def learn(self, words: Sequence[str], tasks: Sequence[goodbot.Task], beliefs: NDArray[np.float32]) -> None:
        self.sessions.append((words, tasks, beliefs))
        self.chance = {}
        for _ in range(self.rounds):
            counts: defaultdict[tuple[str, str], float] = defaultdict(float)
            for said, possible, believed in self.sessions:
                for task, belief in zip(possible, believed, strict=True):
                    for word in said:
                        shares = self._shares(word, task)
                        whole = sum(shares.values())
                        for feature, share in shares.items():
                            counts[word, feature] += float(belief) * share / whole
            totals: defaultdict[str, float] = defaultdict(float)
            for (_, feature), count in counts.items():
                totals[feature] += count
            self.chance = {(word, feature): count / totals[feature] for (word, feature), count in counts.items()}

    def _shares(self, word: str, task: goodbot.Task) -> dict[str, float]:
        """How probable the word is for each feature of the task, and for none of them (`""`)."""
        return {feature: self.chance.get((word, feature), 0.0) + self.UNKNOWN for feature in ("", *task.features)}


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
    """Runs the course and prints the results."""
    parser = argparse.ArgumentParser(description="A language model and a trainer of one's own, in the paper's course")
    parser.add_argument("--runs", type=int, default=20, help="how many seeds")
    options = parser.parse_args()
    rows = goodbot.run_courses(range(1, options.runs + 1), trainer=Encouraging, language=Translation, layouts="random")
    tests = [row["right"] for row in rows if row["kind"] == "test"]
    steps = [row["steps"] for row in rows if row["kind"] == "lesson"]
    print(f"tests right: {sum(tests)} of {len(tests)}; steps of a lesson: {sum(steps) / len(steps):.1f}")


if __name__ == "__main__":
    main()
