"""The homes as Gymnasium environments."""

from __future__ import annotations

import doctest
import itertools
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import goodbot
import goodbot.gym as gym
from goodbot.registration import IDS


@pytest.mark.parametrize("name", IDS)
@pytest.mark.parametrize("render_mode", ["rgb_array", "ansi"])
def test_gymnasium_finds_nothing_wrong(name: str, render_mode: str) -> None:
    env = gymnasium.make(name, render_mode=render_mode)
    check_env(env.unwrapped)
    env.close()


def walk(env: gymnasium.Env[gym.Observation, Any]) -> tuple[float, bool, bool, int]:
    """Follows the shortest way to the intended goal."""
    home_env = env.unwrapped
    assert isinstance(home_env, gym.HomeEnv)
    agent = goodbot.Agent()
    agent.hear(home_env.home, home_env.state, "go", prior={home_env.intended: 1.0})
    for steps in itertools.count(1):
        agent.plan(home_env.home, home_env.state)
        action = home_env.actions.index(agent.decide(home_env.home, home_env.state).action)
        _, reward, terminated, truncated, _ = env.step(action)
        if terminated or truncated:
            return float(reward), terminated, truncated, steps
    raise AssertionError


@pytest.mark.parametrize("name", IDS)
def test_the_reward_is_one_where_the_mission_is_done_and_the_episode_ends_there(name: str) -> None:
    env = gymnasium.make(name)
    for seed in range(5):
        observation, info = env.reset(seed=seed)
        assert observation["mission"].startswith(("go to the", "take the")) and info["intended"]
        assert walk(env)[:3] == (1.0, True, False)


def test_an_episode_that_leads_nowhere_is_cut_short() -> None:
    env = gymnasium.make("goodbot/Rooms-v0", max_episode_steps=7)
    env.reset(seed=1)
    ends = [env.step(4)[2:4] for _ in range(7)]
    assert ends == [(False, False)] * 6 + [(False, True)]


@pytest.mark.parametrize("name", IDS)
def test_what_is_registered_says_how_long_an_episode_is(name: str) -> None:
    env = gymnasium.make(name)
    envs = gymnasium.make_vec(name, num_envs=2, vectorization_mode="vector_entry_point")
    assert env.spec is not None and env.spec.max_episode_steps == 300
    noop = len(env.unwrapped.actions) - 1  # type: ignore[attr-defined]
    env.reset(seed=1)
    envs.reset(seed=1)
    alone = [env.step(noop)[2:4] for _ in range(300)]
    together = [tuple(part[0] for part in envs.step(np.full(2, noop))[2:4]) for _ in range(300)]
    assert alone == together == [(False, False)] * 299 + [(False, True)]
    longer = gymnasium.make(name, max_episode_steps=302)
    longer.reset(seed=1)
    assert [longer.step(noop)[3] for _ in range(302)] == [False] * 301 + [True]


def test_a_mission_that_is_done_in_the_last_step_ends_one_and_many_alike() -> None:
    home = goodbot.Home.from_map("#####\n#r@r#\n##+##\n#ggg#\n#####")
    env = gymnasium.make("goodbot/Rooms-v0", home=home, max_episode_steps=2)
    envs = gymnasium.make_vec("goodbot/Rooms-v0", num_envs=1, vectorization_mode="vector_entry_point", home=home, max_episode_steps=2)
    env.reset(seed=1)
    envs.reset(seed=1)
    for ends in ((False, False), (True, True)):
        assert env.step(1)[2:4] == ends
        assert tuple(bool(part[0]) for part in envs.step(np.array([1]))[2:4]) == ends


def test_the_same_seed_is_the_same_episode() -> None:
    def episode() -> tuple[str, bytes]:
        observation, _ = gymnasium.make("goodbot/Home-v0").reset(seed=12)
        return observation["mission"], observation["image"].tobytes()

    assert episode() == episode()


def test_a_mission_about_one_of_two_that_look_alike_says_which() -> None:
    home = goodbot.Home.from_map("#######\n#rrrrr#\n#rCrCr#\n#rrrrr#\n###+###\n#gg@gg#\n#######\nC: blue chair")
    commands = [command for command, _ in gym.missions(home)]
    assert "take the blue chair (block1) to the green room" in commands and len(set(commands)) == len(commands)


def test_a_picture_and_a_drawing_show_the_home() -> None:
    drawn, seen = (gymnasium.make("goodbot/Home-v0", render_mode=mode) for mode in ("ansi", "rgb_array"))
    drawn.reset(seed=2)
    seen.reset(seed=2)
    text, pixels = drawn.render(), seen.render()
    assert isinstance(text, str) and "@" in text
    assert isinstance(pixels, np.ndarray) and pixels.shape == (160, 160, 3) and len(np.unique(pixels.reshape(-1, 3), axis=0)) > 6


def test_missions_of_a_log_mean_what_the_log_says(root: Path, tmp_path: Path) -> None:
    home = goodbot.Home.random(4)
    task = home.tasks()[0]
    log = tmp_path / "missions.jsonl"
    goodbot.write_log(log, [goodbot.Session("over there, please", home, [], intended=task, kind="demonstration")])
    env = gymnasium.make("goodbot/Home-v0", log=log)
    observation, info = env.reset(seed=1)
    assert (observation["mission"], info["intended"]) == ("over there, please", task)
    assert walk(env)[0] == 1.0


def test_many_homes_go_as_one_does() -> None:
    home = goodbot.Home.random(3)
    one = gym.HomeEnv(home=home)
    many = gym.HomeVectorEnv(8, home=home, max_episode_steps=50)
    observations, _ = many.reset(seed=1)
    chance = np.random.default_rng(1)
    commands = list(many._worlds.commands())  # type: ignore[union-attr]
    intended = [many._worlds.intended(at) for at in range(8)]  # type: ignore[union-attr]
    at = 3
    first, _ = one.reset(seed=1, options={"command": commands[at], "intended": intended[at]})
    assert np.array_equal(first["image"], observations["image"][at]) and first["mission"] == observations["mission"][at]
    for _ in range(40):
        actions = chance.integers(5, size=8)
        observations, rewards, terminated, _, _ = many.step(actions)
        single, reward, done, _, _ = one.step(int(actions[at]))
        assert np.array_equal(single["image"], observations["image"][at])
        assert (reward, done) == (rewards[at], terminated[at])
        if done:
            break


def test_a_vector_begins_the_next_episode_at_the_next_step() -> None:
    envs = gymnasium.make_vec("goodbot/Rooms-v0", num_envs=4, vectorization_mode="vector_entry_point", max_episode_steps=3)
    observations, _ = envs.reset(seed=5)
    assert observations["image"].shape == (4, 10, 10, 4) and len(observations["mission"]) == 4
    assert envs.observation_space.contains(observations)
    noop = np.full(4, 4)
    cut = [list(envs.step(noop)[3]) for _ in range(8)]
    assert cut == [[False] * 4, [False] * 4, [True] * 4, [False] * 4, [False] * 4, [False] * 4, [True] * 4, [False] * 4]


def test_a_trainer_rewards_what_is_right_and_punishes_what_is_not() -> None:
    env = gym.HumanFeedback(gymnasium.make("goodbot/Home-v0"), (0.0, 0.0, 0.0), seed=1)
    env.reset(seed=1)
    words = [env.step(step % 5)[4] for step in range(40)]
    assert {info["feedback"] for info in words} == {"reward", "punish"}
    assert all((info["feedback"] == "reward") == info["correct"] for info in words)
    silent = gym.HumanFeedback(gymnasium.make("goodbot/Rooms-v0"), "punish-only", seed=1)
    silent.reset(seed=1)
    assert "reward" not in {silent.step(step % 4)[4]["feedback"] for step in range(40)}


def test_what_makes_no_sense_is_told() -> None:
    with pytest.raises(ValueError, match="rgb_array, ansi"):
        gym.HomeEnv(render_mode="human")
    with pytest.raises(gymnasium.error.ResetNeeded):
        gym.HomeEnv().step(0)
    with pytest.raises(ValueError, match="wrap one of goodbot"):
        gym.HumanFeedback(gymnasium.make("CartPole-v1"))


def test_the_examples_in_the_module_run() -> None:
    assert doctest.testmod(gym).failed == 0


def test_the_wrappers_of_minigrid_read_a_home() -> None:
    """Reads all that `minigrid.wrappers.FullyObsWrapper` reads."""
    env = gymnasium.make("goodbot/Block-v0")
    observation, _ = env.reset(seed=3)
    home = env.unwrapped
    assert isinstance(home, gym.HomeEnv)
    grid, (column, row) = home.grid.encode(), home.agent_pos
    assert grid.shape == (home.width, home.height, 3) and grid.dtype == np.uint8
    assert observation["image"][row, column, 2] == 1
    # MiniGrid's numbers: 2 is a wall, 3 a floor, 4 a door, 6 a ball, 7 a box; colours are red 0, green 1, blue 2, purple 3, yellow 4, grey 5.
    [block] = [thing for thing in home.home.objects.values() if thing["class"] == "block"]
    [[x, y]] = np.argwhere(np.isin(grid[..., 0], [6, 7]))
    assert grid[x, y].tolist() == [{"chair": 7, "bag": 6}[block["shape"]], {"blue": 2, "purple": 3, "yellow": 4}[block["color"]], 0]
    rooms = {"red": 0, "green": 1, "blue": 2, "yellow": 4}
    floors = set(grid[grid[..., 0] == 3][:, 1].tolist())
    assert floors == {rooms[thing["color"]] for thing in home.home.objects.values() if thing["class"] == "room"}
    assert (grid[0, :, 0] == 2).all(), "walls are around it"


def test_fully_obs_wrapper_of_minigrid_works() -> None:
    wrappers = pytest.importorskip("minigrid.wrappers")
    env = wrappers.FullyObsWrapper(gymnasium.make("goodbot/Home-v0"))
    observation, _ = env.reset(seed=1)
    assert env.observation_space.contains(observation) and (observation["image"][..., 0] == 10).sum() == 1
    observation, *_ = env.step(0)
    assert env.observation_space.contains(observation)


@pytest.fixture
def lamps(root: Path) -> goodbot.World:
    return goodbot.World.load(root / "docs/examples/worlds/lamps.json")


def test_a_world_is_an_environment_whose_trainer_leads_to_its_missions(lamps: goodbot.World) -> None:
    check_env(gymnasium.make("goodbot/World-v0", world=lamps, render_mode="ansi").unwrapped)
    env = gym.HumanFeedback(gymnasium.make("goodbot/World-v0", world=lamps, max_episode_steps=5), "balanced", seed=1)
    inner = env.unwrapped
    assert isinstance(inner, gym.WorldEnv) and len(inner.places) == 4
    for seed in range(8):
        _, info = env.reset(seed=seed)
        right = []
        for action in range(len(inner.actions)):
            env.reset(seed=seed)
            _, reward, terminated, _, told = env.step(action)
            assert (reward == 1.0) == terminated == bool(told["correct"])
            right += [inner.actions[action]] if told["correct"] else []
        assert len(right) == 1 and right[0].split("(")[1] == info["intended"].split("(")[1]
    env.reset(seed=0)
    assert [env.step(len(inner.actions) - 1)[3] for _ in range(5)] == [False] * 4 + [True]


def test_missions_of_a_log_of_a_world_begin_where_they_were_said(lamps: goodbot.World, root: Path, tmp_path: Path) -> None:
    state = lamps.step(lamps.start, "light(lamp0)")
    assert state is not None
    log = tmp_path / "lamps.jsonl"
    said = goodbot.Session("out with it", lamps, [], state=state, intended="lampOff(lamp0)", kind="demonstration")
    goodbot.write_log(log, [said])
    env = gymnasium.make("goodbot/World-v0", log=log)
    observation, info = env.reset(seed=1)
    assert (observation["mission"], info["intended"], env.unwrapped.state) == ("out with it", "lampOff(lamp0)", state)  # type: ignore[attr-defined]
    assert env.step(lamps.actions.index("dim(lamp0)"))[1:3] == (1.0, True)
    with pytest.raises(ValueError, match="make goodbot/World-v0"):
        gymnasium.make("goodbot/Home-v0", log=log)
    with pytest.raises(ValueError, match="take logs of one world"):
        gym.WorldEnv(world=goodbot.World.load(root / "docs/examples/worlds/lift.json"), log=log)
    unsaid = tmp_path / "unsaid.jsonl"
    goodbot.write_log(unsaid, [goodbot.Session("out", lamps, [], kind="demonstration")])
    with pytest.raises(ValueError, match="says what was meant"):
        gym.WorldEnv(log=unsaid)
