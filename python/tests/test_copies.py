"""Copies by pickle and `copy.deepcopy` go on as the first one would, to the bit; and what is told as a label is learned."""

from __future__ import annotations

import copy
import pickle
from pathlib import Path
from typing import Any

import pytest

import goodbot

GO = "agentInRoom(agent0,room2)"


def lesson(agent: goodbot.Agent, trainer: goodbot.Trainer, home: goodbot.Home) -> tuple[Any, bytes]:
    return trainer.teach(agent, home, home.start, "now there please", GO).session, agent.to_bytes()


@pytest.mark.parametrize("copied", [lambda it: pickle.loads(pickle.dumps(it)), copy.deepcopy])
def test_copies_go_on_as_the_first_ones_would(home: goodbot.Home, copied: Any) -> None:
    agent, trainer = goodbot.Agent(seed=3), goodbot.Trainer("punish-only", seed=1)
    lesson(agent, trainer, home)
    others = copied((agent, trainer, home))
    assert lesson(agent, trainer, home) == lesson(*others)


@pytest.mark.parametrize("copied", [lambda it: pickle.loads(pickle.dumps(it)), copy.deepcopy])
def test_copies_are_equal_and_have_one_hash(home: goodbot.Home, root: Path, copied: Any) -> None:
    world = goodbot.World.load(root / "docs/examples/worlds/lamps.json")
    for one in (home, home.step(home.start, "east"), world):
        assert copied(one) == one and hash(copied(one)) == hash(one)
    session = goodbot.Session("go there", home, [("north", "reward"), ("noop", "neutral")])
    assert copied(session) == session and home != goodbot.Home.random(1)


def test_an_error_names_the_file_or_the_choices(home: goodbot.Home, tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError) as missing:
        goodbot.World.load(tmp_path / "missing.json")
    assert missing.value.filename == str(tmp_path / "missing.json")
    odd = tmp_path / "odd.goodbot"
    odd.write_text("odd")
    with pytest.raises(goodbot.ModelError, match="odd.goodbot: "):
        goodbot.Agent.load(odd)
    with pytest.raises(ValueError, match="there are agentInRoom"):
        goodbot.Agent().told(home, home.start, "go", "dance(agent0)")


def test_many_labels_cost_one_training(home: goodbot.Home) -> None:
    agent, other = goodbot.Agent(), goodbot.Agent()
    for words, room in (("off to the crimson one", 2), ("off to the verdant one", 1)):
        agent.told(home, home.start, words, f"agentInRoom(agent0,room{room})", learn=False)
        other.told(home, home.start, words, f"agentInRoom(agent0,room{room})")
    agent.learn()
    assert agent.to_bytes() == other.to_bytes()
    for words, room in (("crimson", 2), ("verdant", 1)):
        agent.hear(home, home.start, words)
        assert agent.most_likely == f"agentInRoom(agent0,room{room})"
