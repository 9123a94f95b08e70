"""goodbot as scikit-learn's classifier: its checks as far as they are about text, and what an intent classifier is asked to do."""

from __future__ import annotations

import copy
import pickle
from typing import Any

import joblib
import numpy as np
import pandas
import pytest
from sklearn.base import clone
from sklearn.exceptions import NotFittedError
from sklearn.model_selection import GridSearchCV, cross_val_score
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import FunctionTransformer
from sklearn.utils.estimator_checks import check_estimator
from sklearn.utils.validation import check_is_fitted, validate_data

from goodbot.sklearn import CommandClassifier

WAYS = ["{}", "please {}", "{} now", "could you {}", "robot, {}!"]
SAID = {
    "light": ["turn on the lamp", "lamp on", "make it bright", "light the lamp"],
    "heat": ["heat the room", "make it warm", "warmer please", "turn on the heating"],
    "music": ["play a song", "some music", "sing a song", "music on"],
}
SENTENCES = [way.format(words) for said in SAID.values() for words in said for way in WAYS]
LABELS = [label for label, said in SAID.items() for _ in said for _ in WAYS]


class OfNumbers(CommandClassifier):
    """For the checks of scikit-learn, which tell numbers: a row is a sentence of one word for each column, such as "amoremore bless"."""

    def __sklearn_tags__(self) -> Any:
        tags = super().__sklearn_tags__()
        tags.input_tags.string, tags.input_tags.two_d_array = False, True
        return tags

    def fit(self, X: Any, y: Any) -> Any:
        if y is not None:
            X, y = validate_data(self, X, y)
            X = self.sentences(X)
        return super().fit(X, y)

    def predict_proba(self, X: Any) -> Any:
        check_is_fitted(self)
        return super().predict_proba(self.sentences(validate_data(self, X, reset=False)))

    @staticmethod
    def sentences(rows: Any) -> list[str]:
        def word(column: int, number: float) -> str:
            return chr(ord("a") + column % 26) + ("less" if number < 0 else "more") * (1 + min(int(abs(number) * 2), 4))

        return [" ".join(word(*cell) for cell in enumerate(row)) for row in rows]


@pytest.mark.filterwarnings("ignore")
def test_the_checks_of_scikit_learn_pass() -> None:
    check_estimator(CommandClassifier())
    checked = check_estimator(OfNumbers(), on_fail=None, on_skip=None)
    assert [it["check_name"] for it in checked if it["status"] == "failed"] == []
    # One that asks for arrays of other libraries.
    assert [it["check_name"] for it in checked if it["status"] == "skipped"] in ([], ["check_array_api_input"])
    assert len(checked) > 40


def test_new_sentences_get_their_labels() -> None:
    model = CommandClassifier().fit(SENTENCES, LABELS)
    assert model.classes_.tolist() == ["heat", "light", "music"]
    assert model.predict(["would you sing", "the lamp", "warm"]).tolist() == ["music", "light", "heat"]
    beliefs = model.predict_proba(["would you sing", "quux"])
    assert beliefs.shape == (2, 3) and beliefs[0, 2] > 0.8 and np.allclose(beliefs.sum(axis=1), 1)
    assert model.score(SENTENCES, LABELS) > 0.95


def test_words_alone_count_and_nonsense_is_chance() -> None:
    random = np.random.default_rng(1)
    nonsense = ["".join(random.choice(list("abcdefgh"), 8)) + " " + "".join(random.choice(list("abcdefgh"), 8)) for _ in LABELS]
    assert cross_val_score(CommandClassifier(learner="roles"), nonsense, LABELS, cv=5).mean() < 0.5
    assert cross_val_score(CommandClassifier(learner="roles"), SENTENCES, random.permutation(LABELS), cv=5).mean() < 0.6
    assert cross_val_score(CommandClassifier(learner="roles"), SENTENCES, LABELS, cv=5).mean() > 0.9


def test_a_sentence_without_words_gets_the_shares_of_the_labels() -> None:
    model = CommandClassifier().fit(["go", "go now", "stop", "..."], ["a", "a", "b", "a"])
    assert model.predict_proba(["", "?!"]).tolist() == [[0.75, 0.25]] * 2
    with pytest.raises(ValueError, match="no sentence has a word"):
        CommandClassifier().fit(["", "..."], [0, 1])


@pytest.mark.parametrize(
    "labels", [[0, 1, 1, 0], [True, False, False, True], np.array(["x", "y", "y", "x"], dtype=object), pandas.Series(["x", "y", "y", "x"])]
)
def test_labels_and_sentences_of_any_type(labels: Any) -> None:
    said = ["go there", "stay here", "stay", "go"]
    for sentences in (said, tuple(said), np.array(said), np.array(said, dtype=object), pandas.Series(said)):
        assert CommandClassifier().fit(sentences, labels).predict(sentences).tolist() == list(labels)


# scikit-learn wonders at as many labels as sentences.
ONE_EACH = pytest.mark.filterwarnings("ignore:The number of unique classes")


@ONE_EACH
@pytest.mark.parametrize(
    ("sentences", "labels", "message"),
    [
        ("go there", ["a"], "not a single text"),
        ([], [], "no sentence is given"),
        ([["go"], ["stay"]], ["a", "b"], "must be a text, and not list"),
        (["go", None], ["a", "b"], "must be a text, and not NoneType"),
        (["go", "stay"], ["a"], "inconsistent numbers of samples"),
        (["go", "stay"], [0.5, 1.5], "Unknown label type"),
        (["go", "stay"] * 128, range(256), "can tell 255 apart"),
    ],
)
def test_what_cannot_be_learned_is_refused(sentences: Any, labels: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        CommandClassifier().fit(sentences, labels)


@ONE_EACH
def test_one_label_and_many() -> None:
    assert CommandClassifier().fit(["go"], ["a"]).predict(["stay"]).tolist() == ["a"]
    # Words that are neither slips nor forms of one another.
    many = [first + second for first in ("ba", "ke", "di", "fo", "gu") for second in ("lam", "ner", "tis", "vok", "zup")]
    assert CommandClassifier(learner="roles").fit(many, range(25)).predict(many).tolist() == list(range(25))


def test_it_goes_through_pipelines_grids_copies_and_processes() -> None:
    with pytest.raises(NotFittedError):
        CommandClassifier().predict(["go"])
    with pytest.raises(ValueError, match="no learner is called"):
        clone(CommandClassifier(learner="best")).fit(["go"], ["a"])  # type: ignore[arg-type]
    pipeline = make_pipeline(FunctionTransformer(lambda said: [words.lower() for words in said]), CommandClassifier()).fit(SENTENCES, LABELS)
    assert pipeline.score(SENTENCES, LABELS) > 0.95
    found = GridSearchCV(CommandClassifier(), {"learner": ["default", "roles"]}, cv=3, n_jobs=2).fit(SENTENCES, LABELS)
    assert found.best_score_ > 0.7
    model = found.best_estimator_
    beliefs = model.predict_proba(SENTENCES).tobytes()
    for other in (pickle.loads(pickle.dumps(model)), copy.deepcopy(model), clone(model).fit(SENTENCES, LABELS)):
        assert other.predict_proba(SENTENCES).tobytes() == beliefs
    halves = joblib.Parallel(2, prefer="threads")(joblib.delayed(model.predict_proba)(SENTENCES) for _ in range(4))
    assert all(half.tobytes() == beliefs for half in halves)
