"""Copies by pickle and `copy.deepcopy` go on as the first one would, to the bit; and what is told as a label is learned."""

from __future__ import annotations

import copy
import multiprocessing
import pickle
from pathlib import Path
from typing import Any

import joblib
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


def go_on(agent: goodbot.Agent, trainer: goodbot.Trainer, home: goodbot.Home) -> tuple[goodbot.Lesson, bytes]:
    return trainer.teach(agent, home, home.start, "now there please", GO), agent.to_bytes()


def same(one: goodbot.Lesson, other: goodbot.Lesson) -> bool:
    parts = ("understood", "ending", "steps", "feedback", "state", "gave_way", "session")
    return all(getattr(one, part) == getattr(other, part) for part in parts)


def test_other_processes_teach_as_this_one(home: goodbot.Home, tmp_path: Path) -> None:
    agent, trainer = goodbot.Agent(seed=3), goodbot.Trainer("punish-only", seed=1)
    lesson(agent, trainer, home)
    joblib.dump((agent, trainer, home), tmp_path / "all.joblib")
    given = [(agent, trainer, home), joblib.load(tmp_path / "all.joblib")]
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        others = pool.starmap(go_on, given)
    parallel: Any = joblib.Parallel(n_jobs=2)
    others += parallel(joblib.delayed(go_on)(*one) for one in given)
    here, model = go_on(agent, trainer, home)
    assert len(others) == 4 and all(same(other, here) and theirs == model for other, theirs in others)


@pytest.mark.filterwarnings("ignore")
def test_workers_of_dask_teach_as_this_one(home: goodbot.Home, tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed")
    agent, trainer = goodbot.Agent(seed=3), goodbot.Trainer("punish-only", seed=1)
    lesson(agent, trainer, home)
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=":0", local_directory=str(tmp_path)) as cluster,
        distributed.Client(cluster) as client,
    ):
        first = client.submit(go_on, agent, trainer, home, pure=False)
        scattered = client.scatter((agent, trainer, home))
        others = client.gather([first, client.submit(go_on, *scattered, pure=False)])
    here, model = go_on(agent, trainer, home)
    assert all(same(other, here) and theirs == model for other, theirs in others)


def test_lessons_and_decisions_are_copied(home: goodbot.Home) -> None:
    agent = goodbot.Agent(seed=3)
    taught = goodbot.Trainer(seed=1).teach(agent, home, home.start, "now there please", GO)
    agent.hear(home, home.start, "now there please")
    agent.plan(home, home.start)
    decision = agent.decide(home, home.start)
    copies: tuple[Any, Any] = copy.deepcopy((taught, decision)), pickle.loads(pickle.dumps((taught, decision)))
    for other, decided in copies:
        assert same(other, taught) and repr(decided) == repr(decision)
    with pytest.raises(ValueError, match="no ending of a lesson"):
        goodbot.Lesson._restored(True, "never", 1, [0, 0, 0], None, 0, None)


class Switch:
    """A robot of one's own, which a process can import."""

    actions, objects = ["press"], {"lamp0": {"class": "lamp"}}
    propositions, state_count = {"lampOn": ("lamp",), "lampOff": ("lamp",)}, 2

    def step(self, state: int, action: str) -> int:
        return 1 - state

    def true(self, state: int) -> list[str]:
        return ["lampOn(lamp0)" if state else "lampOff(lamp0)"]

    def number(self, state: int) -> int:
        return state


def test_agents_of_a_robot_of_ones_own_are_copied() -> None:
    switch = Switch()
    agent = goodbot.Agent(["lampOn(?l)", "lampOff(?l)"], domain=switch, seed=1)
    goodbot.Trainer(seed=1).teach(agent, switch, 0, "light please", "lampOn(lamp0)")
    for other in (copy.deepcopy(agent), pickle.loads(pickle.dumps(agent))):
        other.hear(switch, 0, "light")
        assert other.to_bytes() == agent.to_bytes() and other.most_likely == "lampOn(lamp0)"


def test_a_repr_is_one_useful_line(home: goodbot.Home, root: Path) -> None:
    world = goodbot.World.load(root / "docs/examples/worlds/lamps.json")
    worlds = goodbot.Worlds(2, [(home, [("go", GO)])])
    said = [repr(it) for it in (home, home.start, world, goodbot.Agent(), goodbot.Trainer(), worlds)]
    assert all("\n" not in text and " at 0x" not in text for text in said)
    assert "lamps" in said[2] and "0 sessions" in said[3] and "balanced" in said[4] and "2 worlds" in said[5]


def test_a_repr_of_many_numbers_or_sessions_is_one_line_too(home: goodbot.Home, tmp_path: Path) -> None:
    taught = goodbot.teach(goodbot.Agent(seed=1), home, home.start, "now there please", GO, trainer=goodbot.Trainer(seed=1))
    sessions = [goodbot.Session(f"go {where}", home, [("noop", "neutral")]) for where in "abcde"]
    goodbot.write_log(tmp_path / "log.jsonl", sessions)
    data = goodbot.datasets.load(tmp_path / "log.jsonl")
    [posterior, *_] = goodbot.posteriors(sessions)
    assert repr(taught) == f"<goodbot.Taught: {len(taught.steps)} steps, ended: goal>"
    assert repr(posterior) == "<goodbot.Posterior: 'go a', 1 steps, 4 tasks>"
    assert repr(data) == "<goodbot.datasets.Dataset: 5 sessions of log.jsonl>"
    assert repr(data.split(test=0.4)) == "<goodbot.datasets.Split: 3 sessions to train on, 2 to test on>"


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
