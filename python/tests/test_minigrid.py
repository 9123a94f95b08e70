"""A robot learns the words of BabyAI's missions in the real environments; its grid is the environment's."""

from __future__ import annotations

import copy
import random
import subprocess
import sys
from typing import Any

import gymnasium
import pytest

from goodbot.minigrid import LEVELS, TURNS, Grid, Robot, Vocabulary, exchanged, nonsense, study
from goodbot.names import Skill


def made(level: str, seed: int) -> Any:
    env = gymnasium.make(f"BabyAI-{level}-v0", disable_env_checker=True)
    env.reset(seed=seed)
    return env


def test_robots_learn_the_words_and_nothing_else() -> None:
    for level in ("GoToRedBallGrey", "GoToLocal"):
        success = {(row.lessons, row.control): row.mean for row in study(level, [0, 15], robots=2, tests=12, seed=3)}
        assert success[15, "none"] > 0.9 and success[0, "none"] < 0.6
        assert all(success[15, control] < 0.7 for control in ("nonsense words", "exchanged words", "random meanings"))


# Levels of the table, and some with locked doors.
SKILLS: dict[str, tuple[Skill, ...]] = {
    **LEVELS,
    "GoToDoor": ("goto",),
    "Unlock": ("open", "pickup"),
    "GoToImpUnlock": ("goto", "open", "pickup"),
}


@pytest.mark.parametrize("level", ["GoToLocal", "PickupLoc", "OpenDoorLoc", "PutNextLocal", "GoTo", "GoToDoor", "Unlock", "GoToImpUnlock"])
def test_the_grid_foretells_the_environment(level: str) -> None:
    draw = random.Random(1)
    for seed in range(3):
        env = made(level, seed)
        grid = Grid(env, SKILLS[level])
        state, base = grid.start, env.unwrapped
        for _ in range(120):
            action = draw.choice([action for action in grid.actions if grid.step(state, action) is not None])
            after = grid.step(state, action)
            assert after is not None and grid.number(after) < grid.state_count
            state = after
            _, over = grid.act(action)
            place, heading, handled = state
            assert (grid.places[place], heading) == (tuple(base.agent_pos), base.agent_dir)
            carried = [] if grid.handled[handled][:1] == ("put",) else [grid.cells[name] for name in grid._moved(grid.handled[handled])]
            assert base.carrying is (carried[0] if carried else None)
            if over:
                # The environment's own word for it.
                assert bool(set(grid.meanings()) & set(grid.true(state))) or base.step_count >= base.max_steps
                break
            assert not set(grid.meanings()) & set(grid.true(state))


@pytest.mark.parametrize("level", list(SKILLS))
def test_a_plan_fulfils_the_mission_in_the_environment(level: str) -> None:
    for seed in range(4):
        env = made(level, seed)
        grid = Grid(env, SKILLS[level])
        plans = [plan for task in grid.meanings() if (plan := grid.plan(task)) is not None]
        assert plans
        reward, over = 0.0, False
        for action in [*min(plans, key=len), "noop"]:
            reward, over = grid.act(action)
            if over:
                break
        assert over and reward > 0
        assert grid.plan("carrying(thing99)") is None


def test_a_thing_is_taken_along_only_where_it_can_be_put() -> None:
    for level, is_taken in (("Pickup", False), ("PutNextLocal", True)):
        grid = Grid(made(level, 1), ["putnext"] if is_taken else ["pickup"])
        state, thing = grid.start, next(iter(grid.objects))
        for action in grid.plan(f"carrying({thing})") or []:
            state = grid.step(state, action) or state
        assert f"carrying({thing})" in grid.true(state) and grid.step(state, "drop") is not None
        assert [grid.step(state, turn) is not None for turn in TURNS[:2]] == [is_taken] * 2


def test_a_lesson_is_in_the_environment_and_its_meanings_are_all_right() -> None:
    env, robot = made("GoToLocal", 5), Robot(["goto"], seed=1)
    lesson = robot.teach(env)
    assert lesson.command == env.unwrapped.mission and lesson.ending == "goal" and lesson.steps
    assert [action for action, _ in lesson.steps][-3:] == ["noop"] * 3 and env.unwrapped.step_count > 0
    assert robot.agent.sessions == 1
    other = copy.deepcopy(robot)
    assert other.agent.to_bytes() == robot.agent.to_bytes()


def test_a_mission_of_ones_own_may_have_several_meanings() -> None:
    env, robot = made("GoToLocal", 5), Robot(["goto"], seed=1)
    grid = Grid(env, ["goto"])
    balls = [f"facing({name})" for name, thing in grid.objects.items() if thing["type"] == "ball"]
    assert len(balls) > 1
    lesson = robot.teach(env, command="walk up to any ball", meanings=balls)
    assert lesson.ending == "goal" and lesson.meanings == balls and "walk" in robot.agent.words


def test_a_goal_is_reached_in_an_environment_that_is_no_level_of_babyai() -> None:
    env = gymnasium.make("MiniGrid-Empty-6x6-v0", disable_env_checker=True)
    robot = Robot(["reach"], seed=1)
    env.reset(seed=1)
    with pytest.raises(ValueError, match="tell its meanings yourself"):
        robot.teach(env)
    robot.teach(env, meanings=["at(goal0)"])
    env.reset(seed=2)
    assert robot.obey(env)


def test_missions_of_several_parts_and_unknown_skills_are_refused() -> None:
    with pytest.raises(ValueError, match="in one part; tell its meanings yourself"):
        Grid(made("OpenTwoDoors", 1), ["open"]).meanings()
    with pytest.raises(KeyError):
        skills: list[Any] = ["fly"]
        Robot(skills)
    with pytest.raises(ValueError, match="name the skills of GoToObj, such as goto"):
        study("GoToObj")


def test_the_controls_change_the_words_alone() -> None:
    assert exchanged("put the red ball next to the box on your left") == "put the green box next to the key on your right"
    drawn = nonsense("go to the red ball", random.Random(1)).split()
    assert len(drawn) == 5 and not {"go", "to", "the", "red", "ball"} & set(drawn)


def test_the_command_prints_a_table() -> None:
    typed = [sys.executable, "-m", "goodbot.minigrid", "GoToRedBallGrey", "--lessons", "0", "3", "--robots", "1", "--tests", "3"]
    printed = subprocess.run(typed, capture_output=True, text=True, check=True).stdout.splitlines()
    assert printed[0].startswith("level,lessons,control") and len(printed) == 1 + 2 + 3
    assert subprocess.run([*typed[:3], "NoSuchLevel"], capture_output=True).returncode == 2


def test_labels_alone_teach_as_much() -> None:
    robot = Robot(["goto"], seed=1)
    for seed in range(100, 120):
        env = made("GoToLocal", seed)
        grid = Grid(env, ["goto"])
        # Each of several things will do; one that is faced already is no task.
        robot.agent.hear(grid, grid.start, env.unwrapped.mission)
        meant = [task for task in grid.meanings() if task in robot.agent.tasks]
        robot.agent.forget()
        if meant:
            robot.agent.told(grid, grid.start, env.unwrapped.mission, meant, learn=False)
    robot.agent.learn()
    assert sum(robot.obey(made("GoToLocal", seed)) for seed in range(1000, 1020)) >= 18


def test_a_repr_is_one_useful_line() -> None:
    env = made("GoToLocal", 3)
    robot = Robot(["goto"], seed=1)
    lesson = robot.teach(env)
    env.reset(seed=4)
    said = [repr(it) for it in (robot, Grid(env, ["goto"]), Vocabulary(["goto", "open"]), lesson)]
    assert all("\n" not in text and " at 0x" not in text and len(text) < 120 for text in said)
    assert said[0].startswith("<goodbot.minigrid.Robot: goto; 1 sessions, ") and "go to" in said[1]
    assert said[2] == "<goodbot.minigrid.Vocabulary: goto, open>" and f"{len(lesson.steps)} steps" in said[3]
