"""Homes, from their texts and back."""

from __future__ import annotations

import pickle
from pathlib import Path

import pytest

import goodbot


def test_a_home_is_the_same_as_json_and_as_a_drawing(root: Path) -> None:
    text = (root / "docs/examples/home.json").read_text()
    home = goodbot.Home.from_json(text)
    again = goodbot.Home.from_json(home.to_json())
    assert again.start == home.start and hash(again.start) == hash(home.start)
    assert again.map() == home.map()


def test_a_drawing_is_drawn_again(home: goodbot.Home) -> None:
    drawing = home.map()
    assert drawing.splitlines()[0] == "#########" and "C" in drawing and "@" in drawing


def test_steps_push_blocks_and_bump_into_walls(home: goodbot.Home) -> None:
    assert home.cells(home.start) == {"agent0": (3, 2), "block0": (2, 2)}
    pushed = home.step(home.start, "west")
    assert pushed is not None and home.cells(pushed) == {"agent0": (2, 2), "block0": (1, 2)}
    assert home.step(pushed, "west") == pushed
    assert home.step(home.start, "noop") == home.start
    with pytest.raises(ValueError, match="no action here; there are north"):
        home.step(home.start, "jump")


def test_states_are_numbered_without_gaps(home: goodbot.Home) -> None:
    number = home.number(home.start)
    assert home.numbered(number) == home.start
    assert 0 <= number < home.state_count
    with pytest.raises(ValueError, match="there is no state"):
        home.numbered(home.state_count)


def test_a_robot_that_senses_says_where_things_are(home: goodbot.Home) -> None:
    moved = home.placed(home.start, {"agent0": (1, 1), "block0": (3, 3)})
    assert home.cells(moved) == {"agent0": (1, 1), "block0": (3, 3)}
    with pytest.raises(ValueError, match="this cannot be"):
        home.placed(home.start, {"agent0": (0, 0)})


def test_tasks_are_those_that_do_not_hold_yet(home: goodbot.Home) -> None:
    assert len(home.tasks()) == 4
    both = home.tasks(kinds=["agentInRoom(?a,?r) & blockInRoom(?o,?r)"])
    assert both[0].count("&") == 1


def test_random_homes_come_from_their_seed() -> None:
    assert goodbot.Home.random(7).to_json() == goodbot.Home.random(7).to_json()
    assert len({goodbot.Home.random(seed).to_json() for seed in range(10)}) == 10


def test_homes_go_to_other_processes(home: goodbot.Home) -> None:
    assert pickle.loads(pickle.dumps(home)).start == home.start
    large = goodbot.Home.from_map("\n".join(["#" * 40, *["#" + "r" * 38 + "#"] * 34, "#@" + "r" * 37 + "#", "#" * 40]), capacities={"cells": 2_000})
    assert pickle.loads(pickle.dumps(large)).map() == large.map()


@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        ('{"version":1,"things":[]}', 1, "is not known here"),
        ('{"version":1,\n"objects":[{"class":"agent","name":"a","x":1,"y":1}]}', 1, "there is no room"),
        ('{"version":1,"objects":[\n{"class":"room","name":"r","left":0,"bottom":0,"right":1,"top":4,"color":"red"}]}', 2, "no cell inside"),
        ("not json", 1, "expected"),
        ("", 1, "there is nothing here"),
    ],
)
def test_what_is_wrong_with_a_home_is_told_with_its_line(text: str, line: int, message: str) -> None:
    with pytest.raises(goodbot.FormatError, match=message) as raised:
        goodbot.Home.from_json(text)
    assert raised.value.line == line


def test_what_is_wrong_with_a_drawing_is_told_with_its_line() -> None:
    with pytest.raises(goodbot.FormatError, match="C: yellow chair") as raised:
        goodbot.Home.from_map("#####\n#rCr#\n#####")
    assert raised.value.line == 2


def test_a_home_that_is_too_large_names_the_table() -> None:
    with pytest.raises(goodbot.CapacityError) as raised:
        goodbot.Home.from_map("#####\n#r@r#\n#####", capacities={"cells": 2})
    assert raised.value.capacity == "cells"
