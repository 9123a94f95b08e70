"""A model file keeps its kinds of tasks; of long commands the first words are read."""

from __future__ import annotations

from pathlib import Path

import pytest

import goodbot

BOTH = "agentInRoom(?a,?r1) & blockInRoom(?o,?r2)"
PAPER = ["agentInRoom(?a,?r)", "blockInRoom(?o,?r)"]


def kinds_heard(agent: goodbot.Agent, home: goodbot.Home) -> set[str]:
    agent.hear(home, home.start, "do something")
    names = set(agent.tasks)
    agent.forget()
    return names


@pytest.fixture
def home() -> goodbot.Home:
    return goodbot.Home.from_map("\n".join(("#########", "#ggg#rrr#", "##+###+##", "#bb@bBbb#", "#########", "B: yellow bag")))


def test_an_agent_has_the_kinds_of_tasks_that_its_file_keeps(home: goodbot.Home, tmp_path: Path) -> None:
    agent = goodbot.Agent([*PAPER, BOTH])
    agent.save(tmp_path / "both.goodbot")
    wanted = kinds_heard(agent, home)
    assert any(" & " in name for name in wanted)
    again = goodbot.Agent.load(tmp_path / "both.goodbot")
    assert kinds_heard(again, home) == wanted
    assert again.to_bytes() == agent.to_bytes()
    renamed = "agentInRoom(?me, ?to) & blockInRoom(?it, ?there)"
    assert kinds_heard(goodbot.Agent.from_bytes(agent.to_bytes(), [renamed, *PAPER]), home) == wanted


def test_other_kinds_than_those_of_the_file_are_refused_with_both() -> None:
    model = goodbot.Agent([*PAPER, BOTH]).to_bytes()
    with pytest.raises(ValueError, match=r"blockInRoom\(\?c,\?d\), and tasks= names agentInRoom\(\?a,\?r\); blockInRoom"):
        goodbot.Agent.from_bytes(model, PAPER)
    with pytest.raises(goodbot.ModelError, match="the kinds of task after the model are damaged"):
        goodbot.Agent.from_bytes(model[:-1] + bytes([model[-1] ^ 1]))


def test_a_file_without_kinds_takes_those_that_are_named(home: goodbot.Home) -> None:
    plain = goodbot.Agent().to_bytes()
    assert goodbot.Agent(PAPER).to_bytes() == plain
    agent = goodbot.Agent.from_bytes(plain, [*PAPER, BOTH])
    assert any(" & " in name for name in kinds_heard(agent, home))


def test_what_was_learned_from_a_log_keeps_its_kinds(root: Path) -> None:
    agent = goodbot.learn(root / "docs/examples/sessions.jsonl", tasks=[*PAPER, BOTH], learner="roles")
    assert goodbot.Agent.from_bytes(agent.to_bytes()).to_bytes() == agent.to_bytes()
    with pytest.raises(ValueError, match="was learned for the kinds of task"):
        goodbot.Agent.from_bytes(agent.to_bytes(), PAPER)


def test_the_first_words_of_a_long_command_are_heard_with_a_warning(home: goodbot.Home) -> None:
    agent = goodbot.Agent()
    with pytest.warns(UserWarning, match="the command has 70 words; its first 64 are read"):
        agent.hear(home, home.start, " ".join(["go"] * 70))
    assert len(agent.command.split()) == 64
    agent.forget()
    session = goodbot.Session("go " * 65, home, [("north", "reward"), ("noop", "neutral")])
    with pytest.warns(UserWarning, match="65 words"):
        session.teach(agent)
    assert agent.sessions == 1
    with pytest.warns(UserWarning, match="66 words"):
        assert goodbot.words("go " * 66) == ["go"] * 64
