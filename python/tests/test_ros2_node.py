"""The ROS 2 node, against a stand-in for the part of rclpy that it uses: rclpy itself is in no package registry of Python."""

from __future__ import annotations

import importlib.util
import json
import sys
import types
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import goodbot


class Node:
    """A stand-in for rclpy's node, with messages delivered at once."""

    parameters: dict[str, Any] = {}

    def __init__(self, name: str) -> None:
        self.name = name
        self.topics: dict[str, Callable[[Any], None]] = {}
        self.services: dict[str, Callable[[Any, Any], Any]] = {}
        self.timers: list[tuple[float, Callable[[], None]]] = []
        self.published: list[tuple[str, Any]] = []
        self.warnings: list[str] = []

    def declare_parameter(self, name: str, default: Any) -> Any:
        return types.SimpleNamespace(value=self.parameters.get(name, default))

    def create_publisher(self, _type: type, topic: str, _depth: int) -> Any:
        return types.SimpleNamespace(publish=lambda message: self.published.append((topic, message.data)))

    def create_subscription(self, _type: type, topic: str, callback: Callable[[Any], None], _depth: int) -> None:
        self.topics[topic] = callback

    def create_service(self, _type: type, name: str, callback: Callable[[Any, Any], Any]) -> None:
        self.services[name] = callback

    def create_timer(self, period: float, callback: Callable[[], None]) -> None:
        self.timers.append((period, callback))

    def get_logger(self) -> Any:
        return types.SimpleNamespace(warning=self.warnings.append)


class Message(types.SimpleNamespace):
    """A message or a response: fields by name."""


def module(name: str, **contents: Any) -> types.ModuleType:
    made = types.ModuleType(name)
    vars(made).update(contents)
    return made


@pytest.fixture
def node(monkeypatch: pytest.MonkeyPatch, root: Path, tmp_path: Path) -> Any:
    stand_ins = [
        module("rclpy"),
        module("rclpy.node", Node=Node),
        module("std_msgs"),
        module("std_msgs.msg", Empty=Message, Int8=Message, String=Message),
        module("geometry_msgs"),
        module("geometry_msgs.msg", Point=Message),
        module("std_srvs"),
        module("std_srvs.srv", Trigger=Message),
    ]
    for stand_in in stand_ins:
        monkeypatch.setitem(sys.modules, stand_in.__name__, stand_in)
    monkeypatch.setattr(Node, "parameters", {"home": str(root / "docs/examples/home.json"), "model": str(tmp_path / "words.goodbot")})
    spec = importlib.util.spec_from_file_location("ros2_node", root / "python/examples/ros2_node.py")
    assert spec is not None and spec.loader is not None
    loaded = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(loaded)
    return loaded.GoodbotNode()


def test_a_robot_is_told_judged_asked_and_saved(node: Any, tmp_path: Path) -> None:
    (period, tick), = node.timers
    assert period == 1.0
    tick()
    assert node.published == [], "nobody has said anything yet"
    node.topics["command"](Message(data="go to the blue room"))
    for _ in range(3):
        tick()
        node.topics["feedback"](Message(data=1))
    assert [topic for topic, _ in node.published] == ["action"] * 3
    response = node.services["believed"](Message(), Message(success=None, message=None))
    told = json.loads(response.message)
    assert response.success and told["command"] == "go to the blue room"
    assert sum(told["tasks"].values()) == pytest.approx(1.0, abs=1e-5)
    node.topics["done"](Message())
    saved = node.services["save"](Message(), Message(success=None, message=None))
    assert saved.success and saved.message.startswith("1 sessions")
    assert goodbot.Agent.load(tmp_path / "words.goodbot").sessions == 1


def test_a_robot_that_senses_another_cell_goes_on_from_there(node: Any) -> None:
    before = node.state
    x, y = next(cell for name, cell in node.home.cells(before).items() if name.startswith("agent"))
    for dx, dy in ((1, 0), (-1, 0), (0, 1), (0, -1)):
        node.topics["pose"](Message(x=float(x + dx), y=float(y + dy)))
    assert node.state != before
    node.topics["pose"](Message(x=-200.0, y=0.0))
    assert "this cannot be" in node.warnings[-1]


def test_what_makes_no_sense_is_told_and_the_node_lives_on(node: Any) -> None:
    node.topics["command"](Message(data="..."))
    node.topics["feedback"](Message(data=1))
    assert len(node.warnings) == 2 and "no word" in node.warnings[0]
    node.topics["command"](Message(data="go to the blue room"))
    node.timers[0][1]()
    assert len(node.published) == 1


def test_the_node_stays_short(root: Path) -> None:
    assert len((root / "python/examples/ros2_node.py").read_text().splitlines()) < 150
