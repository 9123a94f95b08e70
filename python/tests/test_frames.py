"""Results as data frames of pandas."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

import goodbot


def test_an_evaluation_is_a_frame_of_answers(root: Path) -> None:
    found = goodbot.evaluate(root / "docs/examples/sessions.jsonl", kfold=2, learner="roles")
    answers = found.to_frame()
    assert len(answers) == len(found.answers) == found.summary["asked"] and "type" not in answers
    assert answers["right"].mean() == found.summary["accuracy"] and answers["predicted"].tolist() == [it["predicted"] for it in found.answers]
    assert repr(found).startswith(f"<goodbot.Evaluation: {found.summary['right']} of 4 are right, ")


def test_beliefs_are_a_frame_with_a_column_for_each_task(root: Path, home: goodbot.Home) -> None:
    taught = goodbot.teach(goodbot.Agent(seed=3), home, home.start, "go there", home.tasks()[0], trainer=goodbot.Trainer(seed=3))
    assert taught.session is not None
    [posterior] = goodbot.posteriors([taught.session])
    for one in (taught, posterior):
        beliefs = one.to_frame()
        assert list(beliefs.columns) == one.tasks and beliefs.index.name == "step"
        assert beliefs.to_numpy().dtype == np.float32 and beliefs.to_numpy().tobytes() == one.beliefs.tobytes()


def test_a_study_is_a_frame_of_means_and_one_of_runs() -> None:
    found = goodbot.study(courses=["paper"], agents=["goodbot", "paper"], trainers="balanced", runs=3)
    means, runs = found.to_frame(), found.runs_to_frame()
    assert len(means) == 2 and len(runs) == len(found.runs) == 6
    for _, row in means.iterrows():
        assert runs[runs["agent"] == row["agent"]]["tests_right"].mean() == pytest.approx(row["tests_right.mean"])
        assert row["words.low"] <= row["words.mean"] <= row["words.high"]
    assert repr(found) == "<goodbot.Study: 6 runs of goodbot, paper>"
    with pytest.raises(ValueError, match="nobody"):
        goodbot.study(agents=["nobody"], runs=1)


def test_without_pandas_it_is_told_how_to_get_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ImportError, match=r"pip install 'goodbot\[pandas\]'"):
        goodbot.Evaluation([], {}).to_frame()
