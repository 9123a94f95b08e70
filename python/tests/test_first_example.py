"""The first examples of docs/python.md understand sentences that were never taught, whatever the seed."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

import goodbot

SEEDS = range(20)


@pytest.fixture(scope="module")
def examples(root: Path) -> list[str]:
    """The examples in Python, in their order."""
    return re.findall(r"```python\n(.*?)```", (root / "docs/python.md").read_text(encoding="utf-8"), re.DOTALL)


def run(examples: list[str], words: str, seed: int, **names: Any) -> dict[str, Any]:
    """Runs the example that has these words, with another seed, and returns its variables."""
    [example] = [example for example in examples if words in example]
    exec(example.replace("seed=1", f"seed={seed}"), names)
    return names


def asked(example: str) -> set[str]:
    """The sentences that an example asks without having taught them."""
    said = re.findall(r'(?:teach|told)\(.*?"(.*?)"', example)
    heard = set(re.findall(r'hear\(.*?"(.*?)"', example))
    return {sentence for sentence in heard if not any(sentence in taught for taught in said)}


@pytest.mark.parametrize("seed", SEEDS)
def test_the_first_example(examples: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, seed: int) -> None:
    monkeypatch.chdir(tmp_path)
    names = run(examples, "Home.from_map", seed)
    assert asked(examples[0]) == {"the red one please"}
    assert names["agent"].most_likely == "agentInRoom(agent0,room2)"
    assert Path("words.goodbot").exists()


@pytest.mark.parametrize("seed", SEEDS)
def test_the_example_of_a_world(examples: list[str], root: Path, monkeypatch: pytest.MonkeyPatch, seed: int) -> None:
    monkeypatch.chdir(root)
    names = run(examples, "World.load", seed, goodbot=goodbot)
    assert names["agent"].most_likely == "lampOn(lamp2)"
    assert names["world"].plan("lampOn(lamp2)") == ["light(lamp2)"]


@pytest.mark.parametrize("seed", SEEDS)
def test_the_example_of_what_follows_from_the_state(examples: list[str], root: Path, monkeypatch: pytest.MonkeyPatch, seed: int) -> None:
    monkeypatch.chdir(root)
    names = run(examples, '"derived"', seed, goodbot=goodbot)
    assert names["agent"].most_likely == "roomClean(room2)"
    assert names["world"].derived(names["bedroom"]) == {"room2": ["here"]}


def test_the_example_of_a_classifier(examples: list[str]) -> None:
    model = run(examples, "CommandClassifier", 1)["model"]
    assert model.predict(["the lamp please", "warmer"]).tolist() == ["light", "heat"]


def test_the_example_of_a_model_of_ones_own(examples: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    names = run(examples, "class Praises", 1, **run(examples, "Home.from_map", 1))
    assert names["taught"].ending == "goal" and names["taught"].understood, "it knows colours from the start"
    assert len(names["rows"]) == 20 * 12


def test_the_example_of_minigrid(examples: list[str]) -> None:
    gymnasium = pytest.importorskip("gymnasium")
    names = run(examples, "goodbot.minigrid", 1, gymnasium=gymnasium)
    names["env"].reset(seed=1000)
    assert names["robot"].obey(names["env"])
