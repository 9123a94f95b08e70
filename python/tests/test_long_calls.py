"""Long calls let other threads run, and stop on ctrl-C."""

from __future__ import annotations

import _thread
import threading
import time

import pytest

import goodbot

# One large hall and another, with three blocks: a search that does not end soon.
ROWS = [
    "#" * 21,
    *["#" + "r" * 19 + "#"] * 9,
    "#" * 10 + "+" + "#" * 10,
    *["#" + "g" * 19 + "#"] * 4,
    "#ggg@ggBgggBgggggggg#",
    *["#" + "g" * 19 + "#"] * 2,
    "#gggggggBggggggggggg#",
    "#" + "g" * 19 + "#",
    "#" * 21,
]
LARGE = {"hashed_states": 1 << 21}


@pytest.fixture
def hall() -> goodbot.Home:
    return goodbot.Home.from_map("\n".join(ROWS) + "\nB: blue bag\n")


def heard(hall: goodbot.Home) -> goodbot.Agent:
    agent = goodbot.Agent(["blockInRoom(?o,?r)"], capacities=LARGE)
    agent.hear(hall, hall.start, "take them all")
    return agent


def test_another_thread_runs_while_a_robot_plans(hall: goodbot.Home) -> None:
    agent, ticks, done = heard(hall), [0], threading.Event()

    def tick() -> None:
        while not done.is_set():
            ticks[0] += 1
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    before = ticks[0]
    agent.plan(hall, hall.start)
    during = ticks[0] - before
    done.set()
    thread.join()
    assert during > 3


def test_planning_stops_on_ctrl_c_and_goes_on_when_asked_to(hall: goodbot.Home) -> None:
    whole = time.perf_counter()
    heard(hall).plan(hall, hall.start)
    whole = time.perf_counter() - whole

    agent = heard(hall)
    begun = time.perf_counter()
    threading.Timer(whole / 20, _thread.interrupt_main).start()
    with pytest.raises(KeyboardInterrupt):
        agent.plan(hall, hall.start)
    assert time.perf_counter() - begun < whole * 0.8
    assert agent.plan(hall, hall.start)
    assert agent.decide(hall, hall.start).action in hall.actions
