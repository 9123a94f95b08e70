"""Lessons whose command means any of several tasks, such as "any ball"."""

from __future__ import annotations

import copy
from typing import Any

import pytest

import goodbot

GO = "agentInRoom(agent0,room2)"
# The trainer is never silent and never wrong.
FRANK = (0.0, 0.0, 0.0)


def lessons(agent: goodbot.Agent, home: goodbot.Home, intended: Any) -> list[tuple[dict[str, int], bool, str, goodbot.Session | None]]:
    """The lesson of the package's own trainer, and that of a trainer like any other."""
    other = copy.deepcopy(agent)
    first = goodbot.Trainer(FRANK, seed=1).teach(agent, home, home.start, "go to a room", intended)
    second = goodbot.teach(other, home, home.start, "go to a room", intended, trainer=goodbot.Trainer(FRANK, seed=1))
    return [(lesson.feedback, lesson.understood, lesson.ending, lesson.session) for lesson in (first, second)]


def test_a_command_may_mean_any_of_several_tasks() -> None:
    # Two rooms as near as each other.
    home = goodbot.Home.from_map("###########\n#ggg+b+rrr#\n#ggg#b#rrr#\n#####@#####\n###########")
    both = [task for task in home.tasks() if task.startswith("agentInRoom")]
    for seed in range(4):
        for feedback, understood, ending, session in lessons(goodbot.Agent(seed=seed), home, both):
            assert feedback["punish"] == 0 and understood and ending == "goal"
            assert session is not None and session.intended is None
        for _, _, ending, session in lessons(goodbot.Agent(seed=seed), home, both[:1]):
            assert ending == "goal" and session is not None and session.intended == both[0]


def test_a_way_to_the_farther_one_is_right_and_so_is_to_stay_there() -> None:
    home = goodbot.Home.from_map("###########\n#g+b@bb+rr#\n###########")
    near, far = (task for task in home.tasks() if task.startswith("agentInRoom"))
    agent = goodbot.Agent(seed=1)
    for _ in range(3):
        agent.told(home, home.start, "go to a room", far)
    for feedback, understood, ending, session in lessons(agent, home, [far, near]):
        assert session is not None and session.steps[0] == ("east", "reward")
        assert feedback["punish"] == 0 and understood and ending == "goal"


def test_a_lesson_that_means_nothing_is_refused(home: goodbot.Home) -> None:
    agent = goodbot.Agent()
    with pytest.raises(ValueError, match="no task is meant"):
        goodbot.Trainer().teach(agent, home, home.start, "go", [])
    with pytest.raises(ValueError, match="no task is meant"):
        goodbot.teach(agent, home, home.start, "go", [], trainer=goodbot.Trainer())
    with pytest.raises(ValueError, match="dance"):
        goodbot.teach(agent, home, home.start, "go", [GO, "dance(agent0)"], trainer=goodbot.Trainer())
