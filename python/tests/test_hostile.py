"""Any bad input raises an exception with a text. The inputs are those that fuzzing has found."""

from __future__ import annotations

import random
import struct
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import goodbot

EXPECTED = (ValueError, RuntimeError)


def corpus(root: Path, name: str) -> list[bytes]:
    """The stored inputs of one fuzz target, and each of them damaged."""
    inputs = [path.read_bytes() for path in sorted((root / "tests/fuzz/corpus" / name).iterdir())]
    assert inputs
    chance = random.Random(name)
    for good in list(inputs):
        for _ in range(8):
            damaged = bytearray(good or b"x")
            for _ in range(chance.randint(1, 4)):
                damaged[chance.randrange(len(damaged))] = chance.randrange(256)
            inputs.append(bytes(damaged[: chance.randint(0, len(damaged))]))
    return inputs


class Liar:
    """A list of one item that says it has any number."""

    def __init__(self, item: object, length: int) -> None:
        self.item, self.length = item, length

    def __len__(self) -> int:
        return self.length

    def __getitem__(self, at: int) -> object:
        if at > 0:
            raise IndexError
        return self.item


def liar(item: object, length: int) -> Any:
    """A `Liar` in the place of any list: what a type checker refuses is what this test is about."""
    return Liar(item, length)


@pytest.mark.parametrize("length", [0, 10**12, 2**62])
def test_a_list_has_the_items_that_it_gives_and_not_those_that_it_claims(home: goodbot.Home, length: int) -> None:
    kind = liar("agentInRoom(?a,?r)", length)
    assert goodbot.Agent(kind).tasks == [] and len(home.tasks(kinds=kind)) > 0
    goodbot.Agent(strategies=liar((0.7, 0.7, 0.1, 1.0), length)).set_strategies(liar((0.7, 0.7, 0.1, 1.0), length))
    with pytest.raises(ValueError):
        home.holds("agentInRoom", liar("agent0", length), home.start)
    assert goodbot._native.Worlds(1, liar((home, liar(("go", home.tasks()[0]), length)), length)) is not None


def test_what_is_no_list_of_names_is_refused_at_once() -> None:
    wrongs: tuple[Any, ...] = (range(10**12), "agentInRoom(?a,?r)", {"agentInRoom(?a,?r)": 1}, b"agent", 7)
    for wrong in wrongs:
        with pytest.raises(TypeError):
            goodbot.Agent(wrong)
    with pytest.raises(ValueError, match="give fewer"):
        goodbot.Agent(["agentInRoom(?a,?r)"] * (2**20 + 1))


def test_environments(root: Path) -> None:
    for given in corpus(root, "environment"):
        text = given.decode("utf-8", "replace")
        for make in (goodbot.Home.from_json, goodbot.Home.from_map):
            try:
                home = make(text)
                home.map()
                home.tasks()
                goodbot.Agent(capacities="small").hear(home, home.start, "go")
            except EXPECTED as refused:
                assert str(refused) and not isinstance(refused, goodbot.InternalError)


def test_logs(root: Path) -> None:
    for given in corpus(root, "session"):
        try:
            for session in goodbot._native.parse_log(given):
                session.lines()
                session.teach(goodbot.Agent(capacities="small"))
        except EXPECTED as refused:
            assert str(refused) and not isinstance(refused, goodbot.InternalError)


def test_models(root: Path) -> None:
    inputs = corpus(root, "model")
    # With a right checksum they are read further.
    inputs += [given[:-4] + struct.pack("<I", zlib.crc32(given[:-4])) for given in inputs if len(given) > 4]
    for given in inputs:
        try:
            agent = goodbot.Agent.from_bytes(given)
            assert goodbot.Agent.from_bytes(agent.to_bytes()).to_bytes() == agent.to_bytes()
        except EXPECTED as refused:
            assert str(refused) and not isinstance(refused, goodbot.InternalError)


def test_commands(root: Path, home: goodbot.Home) -> None:
    agent = goodbot.Agent(capacities="small")
    for given in corpus(root, "tokenizer"):
        try:
            agent.hear(home, home.start, given.decode("utf-8", "replace"))
            agent.finish(home)
        except EXPECTED as refused:
            assert str(refused) and not isinstance(refused, goodbot.InternalError)


def test_calls_in_any_order(root: Path, home: goodbot.Home) -> None:
    other = goodbot.Home.random(9)
    for given in corpus(root, "calls"):
        agent, where, state = goodbot.Agent(capacities="small"), home, home.start
        for byte in given[:60]:
            argument = byte >> 4
            calls: list[Callable[[], object]] = [
                lambda: agent.hear(where, state, "go to the red room"),
                lambda: agent.hear_again(where, state),
                lambda: agent.plan(where, state, argument or None),
                lambda: agent.decide(where, state),
                lambda: agent.acted(where, state, [*where.actions, "noop", "fly"][argument % 6]),
                lambda: agent.feedback((["reward", "punish", "neutral"])[argument % 3]),  # type: ignore[arg-type]
                lambda: agent.demonstrated(where, state, where.actions[argument % 4]),
                lambda: agent.finish(where, learn=argument % 2 == 0),
                lambda: agent.learn(argument),
                lambda: agent.forget(),
                lambda: agent.explain(where, argument),
                lambda: agent.optimal_sets(where),
                lambda: agent.set_strategies([(0.1 * argument, 0.5, 0.1, 1.0)]),
                lambda: (agent.beliefs, agent.plans, agent.distances, agent.translations, agent.most_likely),
                lambda: agent.to_bytes(),
                lambda: None,
            ]
            try:
                came = calls[byte % 16]()
                if isinstance(came, goodbot.State):
                    state = came
            except EXPECTED as refused:
                assert str(refused) and not isinstance(refused, goodbot.InternalError)
            if byte == 0xFF:
                where, state = (other, other.start) if where is home else (home, home.start)


class Broken:
    """A robot whose methods fail in turn."""

    actions, state_count = ["on", "off"], 2
    propositions = {"lampOn": ("lamp",)}
    objects = {"lamp0": {"class": "lamp"}}

    def __init__(self, fault: str) -> None:
        self.fault = fault

    def fail(self, where: str) -> None:
        if self.fault == where:
            raise ZeroDivisionError(f"{where} is broken")

    def step(self, state: int, action: str) -> int:
        self.fail("step")
        return int(action == "on")

    def holds(self, proposition: str, objects: tuple[str, ...], state: int) -> bool:
        self.fail("holds")
        return state == 1

    def number(self, state: int) -> int:
        self.fail("number")
        return state


@pytest.mark.parametrize("fault", ["step", "holds", "number"])
def test_an_exception_in_a_robot_of_ones_own_arrives_and_the_agent_lives_on(fault: str) -> None:
    agent = goodbot.Agent(["lampOn(?l)"], domain=Broken(""))
    robot = Broken(fault)
    with pytest.raises(ZeroDivisionError, match=f"{fault} is broken"):
        agent.hear(robot, 0, "light")
        agent.plan(robot, 0)
    with pytest.raises((goodbot.SessionError, ZeroDivisionError)):
        agent.decide(robot, 0)
    robot.fault = ""
    agent.hear(robot, 0, "light")
    agent.plan(robot, 0)
    assert agent.decide(robot, 0).action == "on"


@pytest.mark.parametrize(
    ("change", "text"),
    [
        ({"actions": []}, "1 to 255 actions"),
        ({"actions": {"on": 0}}, "cost must be 1 to 255"),
        ({"actions": ["noop"]}, "noop is every robot's"),
        ({"propositions": {}}, "name at least one"),
        ({"propositions": {"lampOn": ()}}, "1 to 3 classes"),
        ({"objects": {"lamp0": {}}}, "no \"class\""),
        ({"objects": {"lamp0": {"class": "lamp", "weight": "1"}}}, "none of the attributes"),
        ({"state_count": 1}, "it must be more"),
    ],
)
def test_a_robot_that_is_described_wrongly_is_told_what_to_mend(change: dict[str, object], text: str) -> None:
    agent = goodbot.Agent(["lampOn(?l)"], domain=Broken(""))
    robot = type("Wrong", (Broken,), change)("")
    with pytest.raises(ValueError, match=text):
        agent.hear(robot, 1 if "state_count" in change else 0, "light")
