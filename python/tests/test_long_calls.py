"""Long calls let other threads run, and stop on ctrl-C."""

from __future__ import annotations

import _thread
import signal
import sys
import threading
import time
from collections.abc import Iterator

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


@pytest.fixture
def undisturbed() -> Iterator[None]:
    """Python itself switches threads only after a minute: until then another thread runs only if a call lets it."""
    before = sys.getswitchinterval()
    sys.setswitchinterval(60)
    yield
    sys.setswitchinterval(before)


@pytest.mark.usefixtures("undisturbed")
def test_another_thread_runs_while_a_robot_plans(hall: goodbot.Home) -> None:
    agent, planning, ran, done = heard(hall), False, threading.Event(), threading.Event()

    def other() -> None:
        while not done.wait(0.0001):
            if planning:
                ran.set()

    thread = threading.Thread(target=other)
    thread.start()
    # A plan may be done before the other thread wakes.
    for _ in range(1000):
        planning = True
        agent.plan(hall, hall.start)
        planning = False
        if ran.is_set():
            break
        agent = heard(hall)
    done.set()
    thread.join()
    assert ran.is_set()


def interrupted(agent: goodbot.Agent, hall: goodbot.Home, after: float) -> bool:
    """Plans, is interrupted after this many seconds, and returns whether the plan was unfinished then."""
    timer = threading.Timer(after, _thread.interrupt_main)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        agent.plan(hall, hall.start)
        timer.join()
        time.sleep(1)
    try:
        agent.decide(hall, hall.start)
    except goodbot.SessionError:
        return True
    return False


@pytest.fixture
def interruptible() -> Iterator[None]:
    """A shell makes its background jobs ignore ctrl-C; here it is handled."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("interruptible")
def test_planning_stops_on_ctrl_c_and_goes_on_when_asked_to(hall: goodbot.Home) -> None:
    # The interruption may come after the plan is done.
    tried = ((heard(hall), delay) for delay in (0.01, 0.003, 0.001, 0.0003) for _ in range(20))
    agent = next(agent for agent, delay in tried if interrupted(agent, hall, delay))
    assert agent.plan(hall, hall.start)
    assert agent.decide(hall, hall.start).action in hall.actions
