"""Worlds with a robot of any kind, from files."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

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


def house(lamps: int) -> dict[str, Any]:
    """A house with four lamps to a room, all off but two, and an action for each lamp to light it, and one to dim it."""
    colors, rooms = ["red", "blue", "green", "white"], ["kitchen", "bedroom", "hall", "bath", "attic", "cellar", "study", "garage", "porch", "loft"]
    on = {1, lamps - 2}
    return {
        "type": "world", "name": "house", "classes": ["lamp"], "attributes": {"color": ["lamp"], "room": ["lamp"]},
        "propositions": {"lampOn": ["lamp"], "lampOff": ["lamp"]}, "task_kinds": ["lampOn(?l)", "lampOff(?l)"],
        "objects": [
            {"name": f"lamp{lamp}", "class": "lamp", "attributes": {"color": colors[lamp % 4], "room": rooms[lamp // 4]}} for lamp in range(lamps)
        ],
        "facts": [f"lamp{'On' if lamp in on else 'Off'}(lamp{lamp})" for lamp in range(lamps)],
        "actions": [
            {"name": "light", "parameters": {"?l": "lamp"}, "conditions": ["lampOff(?l)"], "effects": ["lampOn(?l)", "!lampOff(?l)"]},
            {"name": "dim", "parameters": {"?l": "lamp"}, "conditions": ["lampOn(?l)"], "effects": ["lampOff(?l)", "!lampOn(?l)"]},
        ],
    }


@pytest.mark.parametrize("lamps", [8, 40])
def test_a_house_of_sixteen_actions_and_one_of_eighty_are_taught_and_obey(lamps: int) -> None:
    world = goodbot.World(house(lamps))
    assert len(world.actions) == 2 * lamps
    agent, trainer = goodbot.Agent(domain=world, seed=1), goodbot.Trainer(seed=1)
    for command, meant in [
        ("light the red one in the kitchen", "lampOn(lamp0)"),
        ("light the blue one in the bedroom", "lampOn(lamp5)"),
        ("light the green one in the kitchen", "lampOn(lamp2)"),
        ("light the white one in the bedroom", "lampOn(lamp7)"),
        ("put out the blue one in the kitchen", "lampOff(lamp1)"),
    ] * 2:
        assert trainer.teach(agent, world, world.start, command, meant).ending == "goal"
    agent.hear(world, world.start, "light the red one in the bedroom")
    assert agent.most_likely == "lampOn(lamp4)"
    agent.plan(world, world.start)
    assert agent.decide(world, world.start).action == "light(lamp4)"
    sets = agent.optimal_sets(world)
    assert sets.shape == (lamps, 2 * lamps + 1)
    assert sets[agent.tasks.index("lampOn(lamp4)")].nonzero()[0].tolist() == [world.actions.index("light(lamp4)")]


def test_256_actions_are_refused_and_told_how_to_become_fewer() -> None:
    swap = {"name": "swap", "parameters": {"?a": "lamp", "?b": "lamp"}, "effects": ["lampOn(?a)", "!lampOn(?b)"]}
    light = {"name": "light", "parameters": {"?l": "lamp"}, "effects": ["lampOn(?l)"]}
    with pytest.raises(ValueError, match="256 actions with their objects, and 255 are the most; give them fewer parameters"):
        goodbot.World({**house(16), "actions": [swap, light]})


def test_actions_of_one_name_are_cases_of_one_action() -> None:
    of = house(4)
    world = goodbot.World({**of, "actions": [{**action, "name": "press"} for action in of["actions"]]})
    assert world.actions == ("press(lamp0)", "press(lamp1)", "press(lamp2)", "press(lamp3)")
    pressed = world.step(world.start, "press(lamp1)")
    assert pressed is not None and not world.holds("lampOn(lamp1)", pressed)
    assert world.step(pressed, "press(lamp1)") == world.start


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
