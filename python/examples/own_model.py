"""Language models and a trainer of one's own, in the paper's course and in a study.

    python own_model.py --runs 20
    python own_model.py --runs 20 --language sentences
    goodbot study --courses paper --program "python own_model.py --serve" --agents sabl+roles,sabl+program

One language model translates features of tasks, such as `agentInRoom` or `blockInRoom 0 color blue`, into words. After each session it is trained
anew on all sessions, each with the belief at its end.

The other, `sentences`, compares whole sentences: a command means what was meant by the sentences that are most like it. It embeds them with
sentence-transformers if that is installed (`pip install sentence-transformers`; the first use fetches a model, `--model`). Otherwise it counts words and
pairs of words, weighted by their rarity (TF-IDF): a stand-in that knows nothing of words before a lesson, and no figure about sentence embeddings.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
from collections import Counter, defaultdict
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, Literal

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


class Sentences:
    """Nearest sentences: tasks share the features of the tasks that similar sentences of earlier lessons meant."""

    # How much less a sentence counts that is less alike, and the share of all tasks whatever was said. Neither was tuned.
    WIDTH, BACKGROUND = 0.1, 0.05

    def __init__(self, seed: int = 0, *, embed: Callable[[str], NDArray[np.float32]] | None = None) -> None:
        self.embed = embed
        self.lessons: list[tuple[str, list[tuple[frozenset[str], float]]]] = []

    def log_likelihood(self, words: Sequence[str], tasks: Sequence[goodbot.Task]) -> list[float]:
        return self.of_features(words, [task.features for task in tasks])

    def learn(self, words: Sequence[str], tasks: Sequence[goodbot.Task], beliefs: NDArray[np.float32]) -> None:
        self.learn_features(words, [task.features for task in tasks], beliefs.tolist())

    def of_features(self, words: Sequence[str], tasks: Sequence[Sequence[str]]) -> list[float]:
        """The log likelihoods of tasks that are told by their features."""
        said = " ".join(words)
        weights = [math.exp((self._alike(said, other) - 1) / self.WIDTH) for other, _ in self.lessons]
        scores = []
        for features in map(frozenset, tasks):
            shared = [sum(belief * len(features & meant) / len(features | meant) for meant, belief in lesson) for _, lesson in self.lessons]
            scores.append(sum(weight * share for weight, share in zip(weights, shared, strict=True)))
        whole = sum(scores) or 1.0
        return [math.log(self.BACKGROUND / len(tasks) + score / whole) for score in scores]

    def learn_features(self, words: Sequence[str], tasks: Sequence[Sequence[str]], beliefs: Sequence[float]) -> None:
        """Learns from a session whose tasks are told by their features."""
        self.lessons.append((" ".join(words), [(frozenset(task), belief) for task, belief in zip(tasks, beliefs, strict=True)]))

    def _alike(self, one: str, other: str) -> float:
        """The cosine of two sentences."""
        if self.embed is not None:
            a, b = self.embed(one), self.embed(other)
            return float(a @ b / max(float(np.linalg.norm(a) * np.linalg.norm(b)), 1e-9))
        documents = [_terms(said) for said, _ in self.lessons] + [_terms(one)]
        rarity = {term: math.log(1 + len(documents) / (1 + sum(term in document for document in documents))) for term in _terms(one) | _terms(other)}
        left, right = ({term: count * rarity[term] for term, count in _terms(said).items()} for said in (one, other))
        norm = math.sqrt(sum(x * x for x in left.values()) * sum(x * x for x in right.values()))
        return sum(x * right.get(term, 0.0) for term, x in left.items()) / norm if norm else 0.0


def _terms(said: str) -> Counter[str]:
    """The words and pairs of neighbours of a sentence."""
    words = said.split()
    return Counter([*words, *(f"{a} {b}" for a, b in zip(words, words[1:]))])


def embeddings(model: str) -> Callable[[str], NDArray[np.float32]] | None:
    """Embeds sentences, each once; None if sentence-transformers is not installed."""
    try:
        from sentence_transformers import SentenceTransformer
    except ImportError:
        print("sentence-transformers is not installed: sentences are compared by TF-IDF, which is a stand-in", file=sys.stderr)
        return None
    encoder: Any = SentenceTransformer(model)
    known: dict[str, NDArray[np.float32]] = {}

    def embed(said: str) -> NDArray[np.float32]:
        if said not in known:
            known[said] = np.asarray(encoder.encode(said), np.float32)
        return known[said]

    return embed


def serve(embed: Callable[[str], NDArray[np.float32]] | None) -> None:
    """Is the language of `goodbot study --program`: answers each `hear` on standard input."""
    language = Sentences(embed=embed)
    for line in sys.stdin:
        request = json.loads(line)
        if request["type"] == "begin":
            language = Sentences(embed=embed)
        elif request["type"] == "learn":
            language.learn_features(request["words"], request["tasks"], request["beliefs"])
        else:
            print(json.dumps(language.of_features(request["words"], request["tasks"])), flush=True)


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
    parser = argparse.ArgumentParser(description="Language models and a trainer of one's own, in the paper's course")
    parser.add_argument("--runs", type=int, default=20, help="how many seeds")
    parser.add_argument("--language", choices=["translation", "sentences"], default="translation", help="the language model")
    parser.add_argument("--model", default="all-MiniLM-L6-v2", help="the model of sentence-transformers")
    parser.add_argument("--serve", action="store_true", help="be the program of goodbot study --program, with sentences")
    options = parser.parse_args()
    if options.serve:
        serve(embeddings(options.model))
        return
    language: Callable[[int], Any] = Translation
    if options.language == "sentences":
        embed = embeddings(options.model)
        language = partial(Sentences, embed=embed)
    rows = goodbot.run_courses(range(1, options.runs + 1), trainer=Encouraging, language=language, layouts="random")
    tests = [row["right"] for row in rows if row["kind"] == "test"]
    steps = [row["steps"] for row in rows if row["kind"] == "lesson"]
    print(f"tests right: {sum(tests)} of {len(tests)}; steps of a lesson: {sum(steps) / len(steps):.1f}")


if __name__ == "__main__":
    main()
