"""A robot of one's own: all that is true at once, and what is too much for it."""

from __future__ import annotations

from typing import Any

import pytest

import goodbot

State = tuple[bool, ...]


class Lamps:
    """Lamps, and a robot that switches each by its button."""

    propositions = {"lampOn": ("lamp",)}
    attributes = {"color": {"lamp": "lampIs"}}

    def __init__(self, colors: list[str]) -> None:
        self.actions = [f"press{number}" for number in range(len(colors))]
        self.objects = {f"lamp{number}": {"class": "lamp", "color": color} for number, color in enumerate(colors)}
        self.state_count = 2 ** len(colors)
        self.asked = 0

    def step(self, state: State, action: str) -> State:
        switched = list(state)
        switched[self.actions.index(action)] ^= True
        return tuple(switched)

    def holds(self, proposition: str, objects: tuple[str, ...], state: State) -> bool:
        self.asked += 1
        return state[int(objects[0][4:])]

    def number(self, state: State) -> int:
        return sum(on << position for position, on in enumerate(state))


class TellingLamps(Lamps):
    """The same, told at once."""

    def true(self, state: State) -> list[str]:
        self.asked += 1
        return [f"lampOn(lamp{position})" for position, on in enumerate(state) if on]

    def holds(self, proposition: str, objects: tuple[str, ...], state: State) -> bool:
        raise AssertionError("true() tells it")


COLORS = ["red", "green", "blue", "teal", "tan", "pink"]


def taught(lamps: Lamps) -> tuple[bytes, list[float], int]:
    agent, dark = goodbot.Agent(["lampOn(?l)"], domain=lamps, seed=3), (False,) * len(COLORS)
    trainer = goodbot.Trainer(seed=3)
    for number, color in enumerate(COLORS):
        trainer.teach(agent, lamps, dark, f"light the {color} lamp", f"lampOn(lamp{number})")
    agent.hear(lamps, dark, "the tan one")
    return agent.to_bytes(), agent.beliefs.tolist(), lamps.asked


def test_all_that_is_true_is_told_in_one_call_for_a_state() -> None:
    asked, told = taught(Lamps(COLORS)), taught(TellingLamps(COLORS))
    assert told[:2] == asked[:2], "the same robot"
    assert 0 < told[2] < asked[2] / 2


@pytest.mark.parametrize("text", ["lampOn(lamp9)", "lampOff(lamp1)", "lampOn", "lampOn(lamp1,lamp2)", "lampOn()", ""])
def test_what_is_no_proposition_is_told_so(text: str) -> None:
    class Wrong(TellingLamps):
        def true(self, state: State) -> list[str]:
            return [text]

    lamps = Wrong(COLORS)
    with pytest.raises(ValueError, match="which is no proposition of these objects"):
        goodbot.Agent(["lampOn(?l)"], domain=lamps).hear(lamps, (False,) * 6, "go")


def test_an_exception_in_true_reaches_the_caller() -> None:
    class Fails(TellingLamps):
        def true(self, state: State) -> list[str]:
            raise KeyError("mine")

    lamps = Fails(COLORS)
    with pytest.raises(KeyError, match="mine"):
        goodbot.Agent(["lampOn(?l)"], domain=lamps).hear(lamps, (False,) * 6, "go")


def test_a_robot_that_tells_nothing_is_refused() -> None:
    class Silent:
        actions, objects, propositions = ["go"], {"a": {"class": "lamp"}}, {"lampOn": ("lamp",)}

        def step(self, state: int, action: str) -> int:
            return state

        def number(self, state: int) -> int:
            return state

    silent = Silent()
    with pytest.raises(ValueError, match=r"needs a method holds\(proposition, objects, state\), or true\(state\)"):
        goodbot.Agent(["lampOn(?l)"], domain=silent).hear(silent, 0, "go")


def test_too_many_objects_and_tasks_are_refused_by_name() -> None:
    class Many:
        actions, propositions, state_count = ["go"], {"near": ("place", "place")}, 1

        def __init__(self, count: int) -> None:
            self.objects = {f"place{number}": {"class": "place"} for number in range(count)}

        def step(self, state: int, action: str) -> int:
            return state

        def true(self, state: int) -> tuple[()]:
            return ()

        def number(self, state: int) -> int:
            return state

    def heard(many: Any) -> goodbot.Agent:
        agent = goodbot.Agent(["near(?a,?b)"], domain=many)
        agent.hear(many, 0, "go")
        return agent

    assert len(heard(Many(16)).tasks) == 240
    with pytest.raises(goodbot.CapacityError, match="more than 256 cannot be told apart: give fewer objects") as refused:
        heard(Many(17))
    assert refused.value.capacity == "tasks"
    with pytest.raises(ValueError, match="a robot has at most 255 objects, and 256 are given"):
        heard(Many(256))
    with pytest.raises(ValueError, match="tasks: 257 is more than 256"):
        goodbot.Agent(capacities={"tasks": 257})


class Walker:
    """Goes from any place to any other in one step, by an action for each."""

    propositions = {"at": ("place",)}
    attributes = {"number": {"place": "placeIs"}}

    def __init__(self, places: int) -> None:
        self.actions = [f"go{place}" for place in range(places)]
        self.objects = {f"place{place}": {"class": "place", "number": f"n{place}"} for place in range(min(places, 255))}
        self.state_count = places

    def step(self, state: int, action: str) -> int:
        return int(action[2:])

    def true(self, state: int) -> list[str]:
        return [f"at(place{state})"]

    def number(self, state: int) -> int:
        return state


def test_a_robot_has_at_most_255_actions() -> None:
    walker = Walker(255)
    agent = goodbot.Agent(["at(?p)"], domain=walker)
    for meant in [1, 15, 16, 64, 254]:
        agent.hear(walker, 0, "there", prior={f"at(place{meant})": 1.0})
        agent.plan(walker, 0)
        decision = agent.decide(walker, 0)
        assert (decision.action, decision.plan) == (f"go{meant}", "toward")
        assert agent.acted(walker, 0, decision.action) == meant
        agent.plan(walker, meant)
        assert agent.decide(walker, meant).action == "noop"
    with pytest.raises(ValueError, match="a robot has 1 to 255 actions, and 256 are given; give several small ones one name"):
        goodbot.Agent(["at(?p)"], domain=Walker(256))


class Corridor:
    """Walks along places, of which the one under it and its neighbours have derived facts."""

    actions = ["on", "back"]
    propositions = {"at": ("place",), "swept": ("place",)}
    objects = {f"place{number}": {"class": "place"} for number in range(5)}
    state_count = 5

    def step(self, state: int, action: str) -> int:
        return min(max(state + (1 if action == "on" else -1), 0), 4)

    def true(self, state: int) -> list[str]:
        return [f"at(place{state})"]

    def number(self, state: int) -> int:
        return state

    def derived(self, state: int) -> dict[str, list[str]]:
        return {f"place{place}": [word] for place, word in [(state - 1, "behind"), (state + 1, "ahead")] if 0 <= place <= 4}


def test_words_mean_what_a_class_tells_of_a_state() -> None:
    corridor = Corridor()
    for seed in range(5):
        agent = goodbot.Agent(["at(?p)"], domain=corridor, seed=seed)
        for state in (1, 2, 3, 1):
            agent.told(corridor, state, "one further please", f"at(place{state + 1})")
            agent.told(corridor, state, "one back please", f"at(place{state - 1})")
        agent.hear(corridor, 0, "one further")
        assert agent.most_likely == "at(place1)"
        agent.hear(corridor, 4, "one back")
        assert agent.most_likely == "at(place3)"


@pytest.mark.parametrize(
    ("told", "message"),
    [
        ([], "must return a dict"),
        ({"place9": ["far"]}, "place9\", which is none of the objects"),
        ({"place1": [""]}, "a derived fact is a word of 1 to 46 bytes"),
        ({"place1": ["x" * 47]}, "a derived fact is a word of 1 to 46 bytes"),
    ],
)
def test_what_is_no_derived_fact_is_told_so(told: Any, message: str) -> None:
    class Wrong(Corridor):
        def derived(self, state: int) -> dict[str, list[str]]:
            checked: dict[str, list[str]] = told
            return checked

    wrong = Wrong()
    agent = goodbot.Agent(["at(?p)"], domain=wrong)
    with pytest.raises(ValueError, match=message):
        agent.hear(wrong, 0, "go")


def test_derived_facts_beside_four_attributes_are_refused() -> None:
    class Full(Corridor):
        attributes = {name: {"place": f"place{name}"} for name in "abcd"}

    full = Full()
    with pytest.raises(ValueError, match="no room beside 4 attributes"):
        goodbot.Agent(["at(?p)"], domain=full).hear(full, 0, "go")


class Toys:
    """Takes any thing, and rolls a ball."""

    parents = {"ball": "thing", "box": "thing"}
    actions = [f"{verb} {toy}" for verb in ("take", "roll") for toy in ("ball0", "box0", "ball1")]
    propositions = {"taken": ("thing",), "rolled": ("ball",)}
    attributes = {"color": {"thing": "is"}}
    objects = {
        "ball0": {"class": "ball", "color": "red"},
        "box0": {"class": "box", "color": "red"},
        "ball1": {"class": "ball", "color": "blue"},
    }
    state_count = 64

    def step(self, state: int, action: str) -> int | None:
        number = self.actions.index(action)
        return None if action == "roll box0" else state | 1 << number

    def holds(self, proposition: str, objects: tuple[str, ...], state: int) -> bool:
        assert proposition == "taken" or objects[0].startswith("ball"), "a box is no ball"
        return bool(state >> self.actions.index(("take " if proposition == "taken" else "roll ") + objects[0]) & 1)

    def number(self, state: int) -> int:
        return state


def test_an_object_is_of_the_classes_above_its_own_and_words_tell_which() -> None:
    toys = Toys()
    for seed in range(5):
        agent = goodbot.Agent(["taken(?x)", "rolled(?b)"], domain=toys, seed=seed)
        agent.told(toys, 0, "take the red ball", "taken(ball0)")
        assert agent.tasks == ["taken(ball0)", "taken(box0)", "taken(ball1)", "rolled(ball0)", "rolled(ball1)"]
        agent.told(toys, 0, "take the blue ball", "taken(ball1)")
        agent.told(toys, 0, "roll the blue ball", "rolled(ball1)")
        agent.told(toys, 0, "take the red box", "taken(box0)")
        agent.told(toys, 0, "take the red ball", "taken(ball0)")
        agent.hear(toys, 0, "the box please")
        assert agent.most_likely == "taken(box0)"
        agent.hear(toys, 0, "roll the red ball")
        assert agent.most_likely == "rolled(ball0)"


def test_classes_above_one_another_are_refused() -> None:
    class Round(Toys):
        parents = {"ball": "thing", "thing": "ball"}

    with pytest.raises(ValueError, match="parents has \"ball\" above \"thing\", which is itself, or above it"):
        goodbot.Agent(["taken(?x)"], domain=Round())
