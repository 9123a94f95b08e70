"""goodbot as a classifier of scikit-learn: sentences and labels alone, without a world. It needs scikit-learn (`pip install 'goodbot[sklearn]'`)."""

# scikit-learn comes without types.
# mypy: disable-error-code="import-untyped"

from __future__ import annotations

import threading
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

try:
    from sklearn.base import BaseEstimator, ClassifierMixin
    from sklearn.utils.multiclass import check_classification_targets
    from sklearn.utils.validation import check_is_fitted, column_or_1d
except ImportError:
    raise ImportError("goodbot.sklearn needs scikit-learn: pip install 'goodbot[sklearn]'") from None

from ._native import Agent, CapacityError, words
from .names import Learner

# The most labels: each is an object of a world.
MOST_LABELS = 255
# One thread at a time uses an agent, and scikit-learn may predict in several.
_HEARING = threading.Lock()


class Labels:
    """A world with nothing but labels in it: a command means one of them, and nothing happens there."""

    actions = ("choose",)
    propositions = {"meant": ("label",)}
    attributes = {"name": {"label": "label"}}
    state_count = 1

    def __init__(self, count: int) -> None:
        self.objects = {f"label{number}": {"class": "label", "name": f"value{number}"} for number in range(count)}

    def step(self, state: int, action: str) -> int:
        """Nothing happens."""
        return state

    def holds(self, proposition: str, objects: tuple[str, ...], state: int) -> bool:
        """No label is meant yet."""
        return False

    def number(self, state: int) -> int:
        """The only state."""
        return state


class CommandClassifier(ClassifierMixin, BaseEstimator):
    """Says which label a sentence has, as learned from sentences with labels. What goodbot knows of words is all that it uses.

    `learner` is that of `goodbot.Agent`: `default` is the best one, `roles` is faster. There may be 255 labels of any type, and a sentence of more
    than 64 words is read up to there, with a `UserWarning`. A sentence without words gets each label's share in the training data. For a robot
    that acts, or labels that are made of parts, `Agent.told` learns more from the same sentences.

    It passes `check_estimator`, which only asks of a classifier of texts that it can be cloned. The checks for tables of numbers do not apply; they
    pass, but for those of other libraries' arrays, if each row is written as a sentence.

    >>> from goodbot.sklearn import CommandClassifier
    >>> said = ["lights on please", "turn on the lamp", "make it warmer", "heat the room", "lamp on", "warmer in the room"]
    >>> model = CommandClassifier().fit(said, ["light", "light", "heat", "heat", "light", "heat"])
    >>> model.predict(["the lamp please", "a bit warmer"]).tolist()
    ['light', 'heat']
    >>> model.predict_proba(["the lamp please"]).shape
    (1, 2)
    """

    classes_: NDArray[Any]
    """The labels, sorted: the columns of `predict_proba`."""
    class_prior_: NDArray[np.float64]
    """Each label's share in the training data."""
    agent_: Agent
    """The robot's mind that learned them; its tasks are `meant(label0)` and so on, in the order of `classes_`."""

    def __init__(self, *, learner: Learner = "default") -> None:
        self.learner = learner

    def __sklearn_tags__(self) -> Any:
        tags = super().__sklearn_tags__()
        tags.input_tags.string, tags.input_tags.two_d_array = True, False
        return tags

    def fit(self, X: Iterable[str], y: Iterable[Any]) -> CommandClassifier:
        """Learns from the sentences `X` and their labels `y`, anew each time.

        Raises `ValueError` for anything but as many labels as sentences, and for sentences without any word.
        """
        if y is None:
            raise ValueError("requires y to be passed, but the target y is None")
        sentences = _sentences(X)
        labels = column_or_1d(y, warn=True)
        check_classification_targets(labels)
        if len(sentences) != len(labels):
            raise ValueError(f"Found input variables with inconsistent numbers of samples: [{len(sentences)}, {len(labels)}]")
        self.classes_, codes = np.unique(labels, return_inverse=True)
        if len(self.classes_) > MOST_LABELS:
            raise ValueError(f"there are {len(self.classes_)} labels; CommandClassifier can tell {MOST_LABELS} apart")
        told = [(sentence, int(code)) for sentence, code in zip(sentences, codes, strict=True) if words(sentence)]
        if not told:
            raise ValueError("no sentence has a word")
        self.class_prior_ = np.bincount(codes) / len(codes)
        self._world = Labels(len(self.classes_))
        self.agent_ = self._taught(told)
        return self

    def _taught(self, told: list[tuple[str, int]]) -> Agent:
        """An agent with room for all that is told."""
        sizes = {"tasks": len(self.classes_), "sessions": len(told)}
        while True:
            agent = Agent(["meant(?label)"], domain=self._world, learner=self.learner, capacities=sizes)
            try:
                for sentence, code in told:
                    agent.told(self._world, 0, sentence, code, learn=False)
                agent.learn()
            except CapacityError as full:
                sizes[full.capacity] = max(2 * full.limit, full.given)
            else:
                return agent

    def predict_proba(self, X: Iterable[str]) -> NDArray[np.float64]:
        """How probable each label is: shape (sentences, labels), each row of sum 1, the columns in the order of `classes_`."""
        check_is_fitted(self)
        sentences = _sentences(X)
        probable = np.empty((len(sentences), len(self.classes_)))
        for row, sentence in zip(probable, sentences, strict=True):
            if not words(sentence):
                row[:] = self.class_prior_
                continue
            with _HEARING:
                self.agent_.hear(self._world, 0, sentence)
                row[:] = self.agent_.beliefs
                self.agent_.forget()
        # In single precision the sums are not quite 1.
        probable /= probable.sum(axis=1, keepdims=True)
        return probable

    def predict(self, X: Iterable[str]) -> NDArray[Any]:
        """The most probable label of each sentence."""
        probable = self.predict_proba(X)
        chosen: NDArray[Any] = self.classes_[probable.argmax(axis=1)]
        return chosen


def _sentences(given: Iterable[str]) -> list[str]:
    """The sentences, each a text."""
    if isinstance(given, (str, bytes)):
        raise ValueError("sentences are wanted, such as a list of texts, and not a single text")
    sentences = list(given)
    if not sentences:
        raise ValueError("Found array with 0 sample(s): no sentence is given")
    for sentence in sentences:
        if not isinstance(sentence, str):
            raise ValueError(f"a sentence must be a text, and not {type(sentence).__name__}")
    return [str(sentence) for sentence in sentences]
