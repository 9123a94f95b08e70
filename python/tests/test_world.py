"""Worlds with a robot of any kind, from files."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import goodbot

VACUUM = [
    ("go to the kitchen", "vacuumIn(vacuum0,room1)"),
    ("go to the bedroom", "vacuumIn(vacuum0,room2)"),
    ("clean the kitchen", "roomClean(room1)"),
    ("clean the hall", "roomClean(room0)"),
    ("clean the kitchen now", "roomClean(room1)"),
]


def example(root: Path, name: str) -> Path:
    """One of the four example worlds."""
    return root / "docs" / "examples" / "worlds" / f"{name}.json"


def test_a_robot_of_a_file_is_taught_and_understands(root: Path) -> None:
    world = goodbot.World.load(example(root, "vacuum"))
    assert "docked(vacuum0)" in world.tasks()
    agent, trainer = goodbot.Agent(domain=world), goodbot.Trainer(seed=1)
    for command, meant in VACUUM * 3:
        trainer.teach(agent, world, world.start, command, meant)
    agent.hear(world, world.start, "clean the bedroom")
    assert agent.most_likely == "roomClean(room2)"


def test_a_session_goes_step_by_step(root: Path) -> None:
    world = goodbot.World.load(example(root, "lift"))
    agent = goodbot.Agent(domain=world)
    state = world.start
    agent.hear(world, state, "to the roof")
    while not world.holds("liftAtFloor(lift0,floor3)", state):
        agent.plan(world, state)
        action = agent.decide(world, state).action
        before, state = state, agent.acted(world, state, action)
        assert world.step(before, action) == state
        agent.feedback("reward" if action == "up" else "punish")
    assert agent.most_likely == "liftAtFloor(lift0,floor3)"
    agent.finish(world)
    assert agent.sessions == 1
    assert world.plan("liftAtFloor(lift0,floor3)") == ["up", "up"]


def test_a_dict_a_text_and_a_file_are_one_world_and_facts_are_a_state(root: Path) -> None:
    text = example(root, "lamps").read_text()
    world = goodbot.World(json.loads(text))
    again = goodbot.World.from_json(world.to_json())
    assert world.to_json() == again.to_json() == goodbot.World.load(example(root, "lamps")).to_json()
    lit = world.step(world.start, "light(lamp1)")
    assert lit is not None
    assert world.state(world.facts(lit)) == lit != world.start
    assert world.step(lit, "light(lamp1)") is None
    assert world.state_count == 256 and len(world.actions) == 8


def test_what_is_wrong_is_told_with_its_place(root: Path) -> None:
    text = example(root, "lift").read_text()
    with pytest.raises(goodbot.FormatError) as refused:
        goodbot.World.from_json(text.replace("doorOpen(lift0)\"]}", "lit(lift0)\"]}"))
    assert refused.value.field == "actions[2].effects[0]" and "no proposition" in str(refused.value)
    world = goodbot.World.from_json(text)
    with pytest.raises(ValueError):
        world.step(99, "up")
    with pytest.raises(ValueError):
        world.step(0, "fly")
    with pytest.raises(ValueError):
        world.state(["liftAtFloor(lift0,roof)"])
    with pytest.raises(ValueError):
        world.facts(-1)
    with pytest.raises(ValueError, match="add actions"):
        goodbot.World({**json.loads(text), "actions": []})
