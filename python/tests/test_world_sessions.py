"""Lessons in worlds as recorded sessions: written, read, learned from and replayed."""

from __future__ import annotations

import copy
import json
import pickle
import subprocess
from pathlib import Path

import numpy as np
import pytest

import goodbot

ROOF = "liftAtFloor(lift0,floor3)"


@pytest.fixture
def lift(root: Path) -> goodbot.World:
    return goodbot.World.load(root / "docs/examples/worlds/lift.json")


@pytest.fixture
def sessions(lift: goodbot.World) -> list[goodbot.Session]:
    """A lesson for each floor, from where the lift was left."""
    agent, trainer, state, recorded = goodbot.Agent(domain=lift, seed=1), goodbot.Trainer(seed=1), lift.start, []
    for task in lift.tasks():
        lesson = trainer.teach(agent, lift, state, f"now to {task[-2]}, please", task)
        assert lesson.session is not None
        recorded.append(lesson.session)
        state = lesson.state
    return recorded


def test_a_lesson_in_a_world_is_a_session_that_teaches_the_same(lift: goodbot.World) -> None:
    taught, replayed, trainer = goodbot.Agent(domain=lift, seed=1), goodbot.Agent(domain=lift, seed=2), goodbot.Trainer(seed=1)
    for task in lift.tasks():
        lesson = trainer.teach(taught, lift, lift.start, f"to {task[-2]}", task)
        session = lesson.session
        assert session is not None and (session.world, session.state, session.intended) == (lift, lift.start, task)
        assert len(session.teach(replayed)) == lesson.steps
    assert replayed.to_bytes() == taught.to_bytes()
    own = goodbot.teach(taught, lift, lift.start, "up", ROOF, trainer=goodbot.Trainer(seed=2)).session
    assert own is not None and own.world == lift and own.intended == ROOF


def test_a_log_of_worlds_is_written_as_it_was_read(lift: goodbot.World, sessions: list[goodbot.Session], tmp_path: Path) -> None:
    log = tmp_path / "lift.jsonl"
    goodbot.write_log(log, sessions)
    assert log.read_text().count('"type":"world"') == 1
    assert goodbot.read_log(log) == copy.deepcopy(sessions) == pickle.loads(pickle.dumps(sessions)) == sessions
    goodbot.write_log(log, sessions, append=True)
    data = goodbot.datasets.load(log)
    assert len(data.sessions) == 6 and len(data.split(by="command", test=0.3).test) == 2
    with pytest.raises(ValueError, match="1 groups"):
        data.split(by="environment")


def test_the_log_that_the_terminal_writes_is_read_here(lift: goodbot.World, root: Path, tmp_path: Path, cli: str) -> None:
    said = "command up to the roof\nstep\ngood\nfinish\n"
    typed = [cli, "teach", "--lines", f"--model={tmp_path / 'a.goodbot'}", f"--log={tmp_path / 'a.jsonl'}", str(root / "docs/examples/worlds/lift.json")]
    subprocess.run(typed, input=said, check=True, capture_output=True, text=True)
    [session] = goodbot.read_log(tmp_path / "a.jsonl")
    assert (session.world, session.command, session.intended) == (lift, "up to the roof", None)
    [posterior] = goodbot.posteriors(tmp_path / "a.jsonl")
    assert posterior.tasks and np.allclose(posterior.beliefs.sum(axis=1), 1)


def test_beliefs_in_a_world_are_those_of_the_command_line(sessions: list[goodbot.Session], tmp_path: Path, cli: str) -> None:
    log = tmp_path / "lift.jsonl"
    goodbot.write_log(log, sessions)
    printed = subprocess.run([cli, "replay", "--json", log], check=True, capture_output=True, text=True).stdout
    said = [json.loads(line)["tasks"] for line in printed.splitlines()]
    mine = [dict(zip(one.tasks, row, strict=True)) for one in goodbot.posteriors(log) for row in one.beliefs]
    assert len(said) == len(mine) > 6
    assert all(np.array(list(one.values()), np.float32).tobytes() == np.array([other[task] for task in one]).tobytes() for one, other in zip(said, mine))


def test_an_agent_learns_from_sessions_in_a_world_and_is_asked_there(lift: goodbot.World, sessions: list[goodbot.Session], tmp_path: Path) -> None:
    agent = goodbot.learn(sessions)
    agent.hear(lift, lift.start, "now to 3, please")
    assert agent.most_likely == ROOF
    goodbot.write_log(tmp_path / "log.jsonl", sessions)
    agent = goodbot.learn(tmp_path / "log.jsonl", domain=lift)
    agent.hear(lift, lift.start, "now to 3, please")
    assert agent.most_likely == ROOF
    assert goodbot.evaluate(sessions, kfold=3).summary["asked"] == 3


def test_a_session_in_a_world_is_made_of_its_parts(lift: goodbot.World) -> None:
    state = lift.step(lift.start, "up")
    assert state is not None
    session = goodbot.Session("higher", lift, [("up", "reward"), ("noop", "reward")], state=state, intended=ROOF)
    assert (session.state, session.world) == (state, lift) and session.steps[0] == ("up", "reward")
    with pytest.raises(ValueError, match="in a world, not in a home"):
        _ = session.home
    for continues, intended in ((True, ROOF), (False, f"{ROOF} avoiding liftAtFloor(lift0,floor2)")):
        with pytest.raises(ValueError, match="belong to homes alone"):
            goodbot.Session("higher", lift, [("up", "reward")], continues=continues, intended=intended)
    home = goodbot.Session("go", goodbot.Home.random(1, "A"), [("noop", "neutral")])
    with pytest.raises(ValueError, match="and not both"):
        goodbot.write_log("never.jsonl", [session, home])
    with pytest.raises(ValueError, match="vocabulary"):
        session.teach(goodbot.Agent())


def test_a_log_of_commands_alone_is_no_log_of_sessions(lift: goodbot.World) -> None:
    command = json.dumps({"type": "command", "world": "lift", "command": "to the roof", "intended": [ROOF]})
    with pytest.raises(ValueError, match="log: line 2: a command of a log of worlds has no steps"):
        goodbot._native.parse_log(f"{lift.to_json()}\n{command}".encode(), file="log")
