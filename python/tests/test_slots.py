"""A language model and a trainer of one's own, in a lesson and in the whole course."""

from __future__ import annotations

import runpy
import sys
import types
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import goodbot


class Counts:
    """A language model that counts which words were said of which features."""

    def __init__(self, seed: int = 0) -> None:
        self.counts: Counter[tuple[str, str]] = Counter()
        self.learned: list[tuple[list[str], NDArray[np.float32]]] = []

    def log_likelihood(self, words: Sequence[str], tasks: Sequence[goodbot.Task]) -> list[float]:
        return [sum(self.counts[word, feature] for word in words for feature in task.features) for task in tasks]

    def learn(self, words: Sequence[str], tasks: Sequence[goodbot.Task], beliefs: NDArray[np.float32]) -> None:
        self.learned.append((list(words), beliefs))
        for task, belief in zip(tasks, beliefs, strict=True):
            self.counts.update({(word, feature): belief for word in words for feature in task.features})


class Strict:
    """A trainer who judges every step, rightly."""

    def __init__(self, seed: int = 0) -> None:
        self.steps: list[goodbot.Step] = []

    def judge(self, step: goodbot.Step) -> Any:
        self.steps.append(step)
        return "reward" if step.correct else "punish"


def test_a_language_model_of_ones_own_understands_and_learns(home: goodbot.Home) -> None:
    agent, model, red = goodbot.Agent(seed=1), Counts(), "agentInRoom(agent0,room2)"
    taught = goodbot.teach(agent, home, home.start, "Go to RED!", red, trainer=Strict(), language=model)
    assert taught.ending == "goal" and agent.sessions == 0, "the agent's own model stays as it is"
    [(said, beliefs)] = model.learned
    assert said == ["go", "to", "red"] and beliefs.tolist() == taught.beliefs[-1].tolist()
    goodbot.hear(agent, home, home.start, "red", language=model)
    assert agent.most_likely == red and agent.beliefs[agent.tasks.index(red)] > 0.5


def test_a_trainer_of_ones_own_sees_each_step(home: goodbot.Home) -> None:
    trainer, task = Strict(), home.tasks()[0]
    taught = goodbot.teach(goodbot.Agent(seed=2), home, home.start, "go there", task, trainer=trainer)
    assert [step.number for step in trainer.steps] == list(range(len(taught.steps)))
    assert all(step.intended == task and home.step(step.state, step.action) in (step.next_state, None) for step in trainer.steps)
    assert [step.action for step in trainer.steps][-3:] == ["noop"] * 3 and trainer.steps[-1].at_goal and trainer.steps[-1].distance == 0
    assert taught.feedback == {"reward": sum(s.correct for s in trainer.steps), "punish": sum(not s.correct for s in trainer.steps), "neutral": 0}
    assert taught.session is not None and taught.session.intended == task


def test_a_lesson_can_be_replayed_to_the_same_beliefs(home: goodbot.Home) -> None:
    taught = goodbot.teach(goodbot.Agent(seed=3), home, home.start, "go there", home.tasks()[0], trainer=goodbot.Trainer(seed=3))
    assert taught.session is not None
    [posterior] = goodbot.posteriors([taught.session])
    assert posterior.tasks == taught.tasks and posterior.beliefs.tobytes() == taught.beliefs.tobytes()
    assert posterior.intended is not None and posterior.intended.shape == (len(taught.steps) + 1,)


@pytest.mark.parametrize(
    ("answer", "message"),
    [
        ([0.0], "log_likelihood gave 1 numbers for"),
        ([float("nan")] * 9, "log_likelihood gave nan for"),
        ([float("-inf")] * 9, "takes all tasks for impossible"),
    ],
)
def test_a_language_model_that_answers_wrongly_is_told_so(home: goodbot.Home, answer: list[float], message: str) -> None:
    class Wrong:
        def log_likelihood(self, words: Sequence[str], tasks: Sequence[goodbot.Task]) -> list[float]:
            return answer[: len(tasks)] if len(answer) > 1 else answer

    with pytest.raises(ValueError, match=message):
        goodbot.hear(goodbot.Agent(), home, home.start, "go", language=Wrong())


def test_a_trainer_who_says_what_is_no_word_is_told_so(home: goodbot.Home) -> None:
    class Wrong:
        def judge(self, step: goodbot.Step) -> Any:
            return "good"

    with pytest.raises(ValueError, match='"good" is no feedback'):
        goodbot.teach(goodbot.Agent(), home, home.start, "go", home.tasks()[0], trainer=Wrong())
    with pytest.raises(ValueError, match="is no task here; there are agentInRoom"):
        goodbot.teach(goodbot.Agent(), home, home.start, "go", "agentInRoom(agent0,moon)", trainer=Wrong())


def test_the_course_with_models_and_trainers_of_ones_own_repeats_itself() -> None:
    rows = goodbot.run_courses([1, 2], trainer=Strict, language=Counts, layouts="random", threads=2, progress=False)
    assert rows == goodbot.run_course(1, trainer=Strict, language=Counts, layouts="random") + goodbot.run_course(
        2, trainer=Strict, language=Counts, layouts="random"
    )
    assert [row["kind"] for row in rows[:12]] == ["lesson"] * 7 + ["test"] * 5
    assert set(rows[0]) == set(goodbot.run_course(1)[0]) and set(rows[-1]) == set(goodbot.run_course(1)[-1])


def test_worlds_and_robots_of_ones_own_have_features_too(root: Path) -> None:
    world = goodbot.World.load(root / "docs/examples/worlds/lamps.json")
    model = Counts()
    agent = goodbot.Agent(domain=world, seed=1)
    taught = goodbot.teach(agent, world, world.start, "the blue one on", "lampOn(lamp1)", trainer=Strict(), language=model)
    assert taught.ending == "goal" and taught.session is not None and taught.session.world == world
    assert ("blue", f"lampOn 0 color {world.objects['lamp1']['color']}") in model.counts


def test_the_example_learns_the_course(root: Path) -> None:
    example = runpy.run_path(str(root / "python/examples/own_model.py"))
    rows = goodbot.run_courses(range(1, 4), trainer=example["Encouraging"], language=example["Translation"], progress=False)
    right = [row["right"] for row in rows if row["kind"] == "test"]
    assert sum(right) >= 9, "chance is about one in eight"


def test_the_example_compares_sentences_by_embeddings_if_they_are_installed(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    example = runpy.run_path(str(root / "python/examples/own_model.py"))
    monkeypatch.setitem(sys.modules, "sentence_transformers", None)
    assert example["embeddings"]("any") is None
    rows = goodbot.run_courses(range(1, 4), trainer=example["Encouraging"], language=example["Sentences"], progress=False)
    assert sum(row["right"] for row in rows if row["kind"] == "test") >= 6

    class Encoder:
        def __init__(self, model: str) -> None:
            self.model = model

        def encode(self, said: str) -> list[float]:
            return [float("crimson" in said or "red" in said), float("green" in said)]

    installed = types.ModuleType("sentence_transformers")
    installed.SentenceTransformer = Encoder  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "sentence_transformers", installed)
    model = example["Sentences"](embed=example["embeddings"]("any"))
    model.learn_features(["go", "red"], [["room red"], ["room green"]], [1.0, 0.0])
    model.learn_features(["go", "green"], [["room red"], ["room green"]], [0.0, 1.0])
    red, green = model.of_features(["crimson"], [["room red"], ["room green"]])
    assert red > green, "a word that no lesson had"


def test_the_example_is_a_language_of_the_study(root: Path) -> None:
    program = f"{sys.executable} {root / 'python/examples/own_model.py'} --serve"
    found = goodbot.study(courses="paper", trainers="balanced", agents=["sabl+program"], runs=2, program=program)
    assert found.summary[0]["tests_right"]["mean"] >= 2
