"""`goodbot.sklearn.CommandClassifier` beside TF-IDF with logistic regression, on the commands and intended tasks of session logs.

    python benches/classifier.py LOG...

The label of a command is its whole task. Both are asked in ten parts (stratified, seed 1), each part of a model that never saw it. The logistic
regression chooses words or words and pairs, and its C, in five parts of the training data.
"""

from __future__ import annotations

import json
import sys
import time
import warnings
from typing import Any

import numpy as np
from sklearn.exceptions import ConvergenceWarning
from sklearn.feature_extraction.text import TfidfVectorizer
from sklearn.linear_model import LogisticRegression
from sklearn.metrics import log_loss
from sklearn.model_selection import GridSearchCV, StratifiedKFold, cross_val_predict
from sklearn.pipeline import make_pipeline

from goodbot.sklearn import CommandClassifier


def labelled(path: str) -> tuple[list[str], list[str]]:
    """The commands of a log, and their tasks as labels."""
    with open(path, encoding="utf-8") as file:
        sessions = [line for line in map(json.loads, file) if line["type"] == "session"]
    return [line["command"] for line in sessions], [" & ".join(line["intended"]) for line in sessions]


def models() -> dict[str, Any]:
    """The models to compare, by name."""
    chosen = {"tfidfvectorizer__ngram_range": [(1, 1), (1, 2)], "logisticregression__C": [1, 10, 100, 1000]}
    regression = make_pipeline(TfidfVectorizer(), LogisticRegression(max_iter=1000))
    return {
        "CommandClassifier": CommandClassifier(),
        "CommandClassifier(learner='roles')": CommandClassifier(learner="roles"),
        "TF-IDF, logistic regression": GridSearchCV(regression, chosen, cv=StratifiedKFold(5, shuffle=True, random_state=1)),
    }


def main(paths: list[str]) -> None:
    # Expert has a task with fewer commands than there are parts.
    warnings.filterwarnings("ignore", message="The least populated class", category=UserWarning)
    warnings.filterwarnings("ignore", category=ConvergenceWarning)
    for path in paths:
        sentences, tasks = labelled(path)
        labels, codes = np.unique(tasks, return_inverse=True)
        print(f"{path}: {len(sentences)} commands, {len(labels)} labels, {np.bincount(codes).max() / len(codes):.1%} have the most frequent one")
        for name, model in models().items():
            began = time.perf_counter()
            parts = StratifiedKFold(10, shuffle=True, random_state=1)
            beliefs = cross_val_predict(model, sentences, codes, cv=parts, method="predict_proba")
            right = float((beliefs.argmax(axis=1) == codes).mean())
            spread = 1.96 * (right * (1 - right) / len(codes)) ** 0.5
            took = time.perf_counter() - began
            print(f"  {name:36} {right:.1%} ± {spread:.1%} right, log loss {log_loss(codes, beliefs):.3f}, {took:.0f} s")


if __name__ == "__main__":
    main(sys.argv[1:])
