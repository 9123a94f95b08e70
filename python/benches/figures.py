"""The figures of docs/python.md: what a call costs more than the same call in Rust, and how fast many homes step, compared with MiniGrid.

    python benches/figures.py

Both sides of each comparison are measured in turn in one run, and the medians are printed. MiniGrid is left out if it is not installed.
"""

from __future__ import annotations

import statistics
import time
import warnings
from collections.abc import Callable

import gymnasium
import numpy as np

import goodbot
from goodbot.gym import HomeVectorEnv

ROUNDS = 9


def seconds(work: Callable[[], object]) -> float:
    """The processor time that some work takes once: other programs on the machine are not counted."""
    begun = time.process_time()
    work()
    return time.process_time() - begun


def overhead(count: int = 20_000) -> None:
    """A round of plan, decide, acted and feedback in Python, compared with the same in Rust."""
    home = goodbot.Home.random(1)
    agent, state = goodbot.Agent(), home.start
    agent.hear(home, state, "go to the red room")
    agent.plan(home, state)

    def rounds() -> None:
        for _ in range(count):
            agent.plan(home, state)
            agent.acted(home, state, agent.decide(home, state).action)
            agent.feedback("neutral")

    ours, rusts = [], []
    for _ in range(ROUNDS):
        ours.append(seconds(rounds) / count)
        rusts.append(seconds(lambda: agent._rounds(home, state, count)) / count)
    python, rust = statistics.median(ours) * 1e6, statistics.median(rusts) * 1e6
    print(f"a round of plan, decide, acted and feedback: {python:.2f} us in Python, {rust:.2f} us in Rust, {python - rust:.2f} us more")


def courses(count: int = 200) -> None:
    """The paper's course, seven lessons and five tests: how many sessions a core does in a second, and how long 10^9 of them would take."""
    took = statistics.median(
        seconds(lambda: goodbot.run_courses(range(count), threads=1, progress=False)) / count for _ in range(ROUNDS)
    )
    sessions = 12 / took
    print(f"sessions of the course a second and core: {sessions:,.0f}; 10^9 of them: {1e9 / sessions / 3_600:,.0f} hours of a core")


def steps_a_second(step: Callable[[int], object], count: int) -> float:
    """Steps a second of a function that takes the number of steps."""
    return count / seconds(lambda: step(count))


def worlds(num_envs: int = 1024) -> None:
    """Many homes at once, compared with MiniGrid's environment without obstacles, both with random actions."""
    envs = HomeVectorEnv(num_envs)
    envs.reset(seed=1)
    actions = np.random.default_rng(1).integers(len(envs.actions), size=(64, num_envs))

    def ours(count: int) -> None:
        for at in range(count // num_envs):
            envs.step(actions[at % len(actions)])

    single = gymnasium.make("goodbot/Home-v0")
    single.reset(seed=1)

    def one(count: int) -> None:
        for at in range(count):
            _, _, terminated, truncated, _ = single.step(int(actions[at % 64, at % num_envs]))
            if terminated or truncated:
                single.reset()

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            import minigrid  # noqa: F401
    except ImportError:
        grid = None
        print("MiniGrid is not installed; install minigrid to measure beside it")
    else:
        grid = gymnasium.make("MiniGrid-Empty-8x8-v0")
        grid.reset(seed=1)

    def theirs(count: int) -> None:
        assert grid is not None
        for at in range(count):
            _, _, terminated, truncated, _ = grid.step(int(actions[at % 64, at % num_envs]) % 3)
            if terminated or truncated:
                grid.reset()

    speeds: dict[str, list[float]] = {"many": [], "one": [], "theirs": []}
    for _ in range(ROUNDS):
        speeds["many"].append(steps_a_second(ours, 200 * num_envs))
        speeds["one"].append(steps_a_second(one, 5_000))
        if grid is not None:
            speeds["theirs"].append(steps_a_second(theirs, 5_000))
    many, alone = statistics.median(speeds["many"]), statistics.median(speeds["one"])
    print(f"{num_envs} homes at once: {many:,.0f} steps a second; one home alone: {alone:,.0f}")
    if grid is not None:
        other = statistics.median(speeds["theirs"])
        print(f"MiniGrid-Empty-8x8-v0: {other:,.0f} steps a second; {many / other:,.0f} times as many at once, {alone / other:.1f} times alone")


def main() -> None:
    """All figures."""
    overhead()
    courses()
    worlds()


if __name__ == "__main__":
    main()
