"""The robot's mind, from a command to what it has learned."""

from __future__ import annotations

import threading
import time
from pathlib import Path

import numpy as np
import pytest

import goodbot

def rooms(home: goodbot.Home) -> dict[str, str]:
    """The rooms' names by their colours."""
    return {str(of["color"]): name for name, of in home.objects.items() if of["class"] == "room"}


def task(home: goodbot.Home, color: str) -> str:
    return f"agentInRoom(agent0,{rooms(home)[color]})"


def teach_by_hand(agent: goodbot.Agent, home: goodbot.Home, command: str, meant: str) -> goodbot.State:
    """A trainer who always says whether an action was right."""
    agent.hear(home, home.start, command)
    state = home.start
    for _ in range(30):
        agent.plan(home, state)
        sets = agent.optimal_sets(home)[agent.tasks.index(meant)]
        names = [*home.actions, "noop"]
        decision = agent.decide(home, state)
        right = bool(sets[names.index(decision.action)])
        state = agent.acted(home, state, decision.action)
        agent.feedback("reward" if right else "punish")
        if decision.action == "noop" and right:
            break
    agent.finish(home)
    return state


def test_a_robot_that_is_judged_ends_where_it_was_told_to_go_and_knows_the_word_afterwards(home: goodbot.Home) -> None:
    agent = goodbot.Agent(seed=1)
    meant = task(home, "red")
    end = teach_by_hand(agent, home, "go to the red room", meant)
    assert home.holds("agentInRoom", ["agent0", rooms(home)["red"]], end)
    agent.hear(home, home.start, "go to the red room")
    assert agent.most_likely == meant
    assert agent.sessions == 1
    assert "red" in agent.words


def test_beliefs_and_sets_are_arrays_of_the_tasks(home: goodbot.Home) -> None:
    agent = goodbot.Agent()
    agent.hear(home, home.start, "go to the red room")
    assert agent.plan(home, home.start)
    count = len(agent.tasks)
    assert agent.beliefs.shape == (count,) and agent.beliefs.dtype == np.float32
    assert float(agent.beliefs.sum()) == pytest.approx(1.0)
    assert agent.optimal_sets(home).shape == (count, len(home.actions) + 1)
    assert agent.distances.shape == (count,) and agent.distances.min() > 0
    assert set(agent.plans) == {"toward"}
    with pytest.raises(ValueError):
        agent.beliefs[0] = 1.0


def test_a_model_file_says_whether_the_layer_learned_too(home: goodbot.Home, tmp_path: Path) -> None:
    for learner, format_ in (("default", 3), ("roles", 2), ("paper", 2)):
        agent = goodbot.Agent(learner=learner)  # type: ignore[arg-type]
        file = tmp_path / f"{learner}.goodbot"
        agent.save(file)
        assert file.read_bytes()[8] == format_
        again = goodbot.Agent.load(file)
        again.save(file, force=True)
        assert file.read_bytes()[8] == format_


def test_a_call_out_of_its_turn_is_told_what_to_do_first(home: goodbot.Home) -> None:
    agent = goodbot.Agent()
    with pytest.raises(goodbot.SessionError, match="give a command first"):
        agent.plan(home, home.start)
    agent.hear(home, home.start, "go")
    with pytest.raises(goodbot.SessionError, match="plan on until it is"):
        agent.decide(home, home.start)
    with pytest.raises(goodbot.SessionError, match="act first"):
        agent.feedback("reward")


@pytest.mark.parametrize(
    ("call", "text"),
    [
        (lambda agent, home: agent.hear(home, home.start, "..."), "no word"),
        (lambda agent, home: agent.feedback("good"), "reward, punish or neutral"),
        (lambda agent, home: agent.set_strategies([(2.0, 0.5, 0.1, 1.0)]), "must be a number from 0 to 1"),
        (lambda agent, home: agent.hear(home, home.start, "go", prior={"agentInRoom(agent0,attic)": 1.0}), "prior"),
        (lambda agent, home: goodbot.Agent(["lampOn(?l)"]), "no propositional function"),
        (lambda agent, home: goodbot.Agent(learner="best"),  # type: ignore[arg-type]
         "default, roles, paper or smoothed"),
        (lambda agent, home: goodbot.Agent(capacities="huge"), "tiny, small or standard"),
        (lambda agent, home: goodbot.Agent(capacities={"brains": 3}), "brains"),
    ],
)
def test_what_cannot_be_is_a_value_error_that_says_what_to_do(home: goodbot.Home, call: object, text: str) -> None:
    with pytest.raises(ValueError, match=text):
        call(goodbot.Agent(), home)  # type: ignore[operator]


def test_a_full_table_is_named_with_its_limit(home: goodbot.Home) -> None:
    agent = goodbot.Agent(capacities={"tasks": 2})
    with pytest.raises(goodbot.CapacityError, match="Capacities::tasks is 2") as raised:
        agent.hear(home, home.start, "go to the red room")
    assert (raised.value.capacity, raised.value.limit, raised.value.given) == ("tasks", 2, 4)
    assert isinstance(raised.value, ValueError)


def test_a_state_of_another_home_is_refused(home: goodbot.Home) -> None:
    other = goodbot.Home.random(3)
    with pytest.raises(ValueError, match="another home"):
        goodbot.Agent().hear(home, other.start, "go")


def test_the_same_seed_gives_the_same_life(home: goodbot.Home) -> None:
    def life() -> bytes:
        agent, trainer = goodbot.Agent(seed=4), goodbot.Trainer(seed=5)
        for color in ("red", "green", "red"):
            trainer.teach(agent, home, home.start, f"go to the {color} room", task(home, color))
        return agent.to_bytes()

    assert life() == life()


def test_a_model_goes_through_a_file_bit_for_bit(home: goodbot.Home, tmp_path: Path) -> None:
    agent, trainer = goodbot.Agent(seed=1), goodbot.Trainer(seed=1)
    for command in ("go to the red room", "please walk over to that red one now", "red", "to the red room, if you like"):
        trainer.teach(agent, home, home.start, command, task(home, "red"))
    file = tmp_path / "mine.goodbot"
    agent.save(file)
    again = goodbot.Agent.load(file)
    assert again.to_bytes() == agent.to_bytes() == file.read_bytes()
    for robot in (agent, again):
        robot.hear(home, home.start, "to the red one")
    assert agent.beliefs.tobytes() == again.beliefs.tobytes()


def test_a_file_that_is_no_model_is_not_replaced(tmp_path: Path) -> None:
    file = tmp_path / "thesis.txt"
    file.write_text("all my work")
    with pytest.raises(FileExistsError, match="no model"):
        goodbot.Agent().save(file)
    assert file.read_text() == "all my work"
    goodbot.Agent().save(file, force=True)
    goodbot.Agent().save(file)


def test_a_model_is_written_as_the_command_line_writes_it(tmp_path: Path) -> None:
    model, link, empty = tmp_path / "mine.goodbot", tmp_path / "link", tmp_path / "empty"
    goodbot.Agent().save(model)
    model.chmod(0o600)
    link.symlink_to(model)
    empty.touch()
    goodbot.Agent().save(link)
    assert link.is_symlink() and model.stat().st_mode & 0o777 == 0o600
    goodbot.Agent().save(empty)
    goodbot.Agent().save(Path("/dev/null"))
    assert not Path("/dev/null").is_file()


def test_damaged_models_are_model_errors() -> None:
    good = goodbot.Agent().to_bytes()
    damaged = bytearray(good)
    damaged[len(good) // 2] ^= 1
    for wrong in (b"", b"goodbot", good[:-1], bytes(damaged)):
        with pytest.raises(goodbot.ModelError):
            goodbot.Agent.from_bytes(wrong)


def test_words_are_explained_by_what_they_were_taken_for(home: goodbot.Home) -> None:
    agent, trainer = goodbot.Agent(seed=1), goodbot.Trainer(seed=1)
    for color in ("red", "green", "red", "green"):
        trainer.teach(agent, home, home.start, f"go to the {color} room", task(home, color))
    agent.hear(home, home.start, "go to the red room")
    explained = agent.explain(home, task(home, "red"))
    assert [word for word, _ in explained] == ["go", "to", "the", "red", "room"]
    red = dict(explained)["red"]
    assert sum(red.values()) == pytest.approx(1.0, abs=1e-3)
    assert max(red, key=lambda meaning: red[meaning])== "goal colorRed"
    assert agent.translations.shape == (len(agent.tokens), len(agent.words))


def test_a_synonym_that_was_learned_stands_for_a_word_that_was_not(home: goodbot.Home) -> None:
    agent, words = goodbot.Agent(seed=1), "red crimson scarlet  # colours\nbring take"
    assert agent.in_known_words("go to the Crimson room!", words) == "go to the crimson room"
    teach_by_hand(agent, home, "go to the red room", task(home, "red"))
    assert agent.in_known_words("go to the Crimson room!", words) == "go to the red room"
    with pytest.raises(ValueError, match='"red" is in line 1 and in line 2'):
        agent.in_known_words("go", "red\nred")
    with pytest.raises(goodbot.CapacityError):
        agent.in_known_words("go " * 1000, words)


def test_an_agent_used_from_two_threads_says_so() -> None:
    home = goodbot.Home.random(1)

    class Slow:
        """A robot whose every step takes a while, so that two calls meet."""

        actions, state_count = ["on"], 2
        propositions = {"lampOn": ("lamp",)}
        objects = {"lamp0": {"class": "lamp"}}

        def step(self, state: int, action: str) -> int:
            time.sleep(0.3)
            return 1

        def holds(self, proposition: str, objects: tuple[str, ...], state: int) -> bool:
            return state == 1

        def number(self, state: int) -> int:
            return state

    robot = Slow()
    agent = goodbot.Agent(["lampOn(?l)"], domain=robot)
    agent.hear(robot, 0, "light")
    thread = threading.Thread(target=agent.plan, args=(robot, 0))
    thread.start()
    time.sleep(0.1)
    with pytest.raises(goodbot.InUseError, match="each thread an agent of its own"):
        agent.forget()
    thread.join()
    assert agent.decide(robot, 0).action == "on"
    assert home.actions == ("north", "south", "east", "west")


def test_demonstrations_teach_too(home: goodbot.Home) -> None:
    agent, state = goodbot.Agent(), home.start
    agent.hear(home, state, "up you go")
    for action in ("west", "north", "north", "north"):
        agent.plan(home, state)
        agent.demonstrated(home, state, action)
        state = home.step(state, action) or state
    assert agent.finish(home) == 0
    assert agent.sessions == 1


def test_a_question_is_answered_and_tells_what_was_meant(home: goodbot.Home) -> None:
    agent = goodbot.Agent()
    agent.hear(home, home.start, "over there")
    agent.plan(home, home.start)
    assert agent.ask(home, home.start, kappa=float("inf")) is None
    question = agent.ask(home, home.start, kappa=0.5)
    assert question is not None and question["bits"] > 0
    with pytest.raises(ValueError):
        agent.answer("perhaps")
    before = dict(zip(agent.tasks, agent.beliefs, strict=True))
    chosen = question["choices"][0]
    assert agent.answer(0 if question["about"] == "which" else "yes") == "used"
    assert all(agent.beliefs[agent.tasks.index(task)] > before[task] for task in chosen)
    with pytest.raises(goodbot.SessionError):
        agent.answer("yes")


def test_tasks_with_a_way_are_told_with_it(home: goodbot.Home) -> None:
    kinds = ["agentInRoom(?a, ?goal)", "agentInRoom(?a, ?goal) avoiding agentInRoom(?a, ?not)"]
    agent = goodbot.Agent(kinds)
    agent.hear(home, home.start, "go to the red room but avoid the blue room")
    assert len(set(agent.tasks)) == len(agent.tasks)
    around = [name for name in agent.tasks if " avoiding " in name]
    assert around and all(name.startswith("agentInRoom(agent0,") for name in around)
    agent.hear(home, home.start, "go", prior={around[0]: 1.0})
    assert agent.most_likely == around[0]
    assert set(home.tasks(kinds=kinds)) == set(agent.tasks)


@pytest.fixture(scope="module")
def taught() -> tuple[goodbot.Agent, goodbot.Home, str, str]:
    """An agent after 24 lessons, its home, and its two tasks."""
    home = goodbot.Home.from_map(
        """
        #########
        #ggg#rrr#
        ##+###+##
        #bb@bbbb#
        #########
        """
    )
    agent = goodbot.Agent(seed=1)
    red, green = "agentInRoom(agent0,room2)", "agentInRoom(agent0,room1)"
    for lesson in range(24):
        color, task = [("red", red), ("green", green)][lesson % 2]
        goodbot.Trainer(seed=lesson).teach(agent, home, home.start, f"go to the {color} room", task)
    return agent, home, red, green


def test_words_that_are_no_command_are_told_apart(taught: tuple[goodbot.Agent, goodbot.Home, str, str]) -> None:
    agent, home, red, green = taught
    heard = agent.listen(home, home.start, "go to the red room please")
    assert (heard["verdict"], heard["tasks"], heard["rest"]) == ("sure", [red], None)
    assert agent.listen(home, home.start, "hello")["verdict"] == "none"
    heard = agent.listen(home, home.start, "don't go to the red room")
    assert (heard["taken_for"], heard["tasks"]) == ("a prohibition", ["!" + red])
    heard = agent.listen(home, home.start, "go to the red room and then to the green room")
    assert (heard["tasks"], heard["rest"]) == ([red], "to the green room")


def test_a_conversation_goes_on_from_what_was_done(taught: tuple[goodbot.Agent, goodbot.Home, str, str]) -> None:
    agent, home, red, green = taught
    agent.converse_anew()
    said = "go to the red room and then to the green room"
    first = agent.listen(home, home.start, said)
    agent.remember(home, first["tasks"][0])
    there = home.start
    while agent.plan(home, there) and (action := agent.decide(home, there).action) != "noop":
        there = agent.acted(home, there, action)
    second = agent.listen(home, there, first["rest"], goes_on=True)
    assert (second["verdict"], second["tasks"]) == ("sure", [green])
    assert agent.listen(home, there, "go there")["tasks"] == [red]
    agent.converse_anew()
    assert agent.listen(home, home.start, "go there")["verdict"] in ("none", "unsure")


def test_the_trainer_s_words_ask_for_something_and_correct_the_robot(taught: tuple[goodbot.Agent, goodbot.Home, str, str]) -> None:
    agent, home, red, green = taught
    agent.forget()
    assert agent.said(home, home.start, "go to the red room") == ("command", None)
    agent.listen(home, home.start, "go to the red room")
    assert agent.said(home, home.start, "stop") == ("stop", None)
    agent.plan(home, home.start)
    state = agent.acted(home, home.start, agent.decide(home, home.start).action)
    assert agent.said(home, state, "well done") == ("reward", None)
    assert agent.said(home, state, "flub") != ("reward", None)
    agent.learn_voice("flub", "reward")
    assert agent.said(home, state, "flub") == ("reward", None)
    assert agent.said(home, state, "no, the green one") == ("correction", None)
    agent.correct(home, "no, the green one")
    assert agent.most_likely == green
    agent.forget()
    with pytest.raises(goodbot.SessionError):
        agent.correct(home, "no")


def test_a_table_of_closed_words_takes_the_place_of_the_one_that_is_built_in(taught: tuple[goodbot.Agent, goodbot.Home, str, str]) -> None:
    agent, home, red, _ = taught
    assert agent.listen(home, home.start, "nix go to the red room", closed_words="negation: nix")["tasks"] == ["!" + red]
    assert agent.said(home, home.start, "stop", closed_words="stop: halt") == ("command", None)
    with pytest.raises(ValueError, match='closed_words: line 1: "colour" is no class of words'):
        agent.listen(home, home.start, "go", closed_words="colour: red")


def test_a_task_has_words_in_a_home_in_a_world_and_with_a_robot_of_ones_own(home: goodbot.Home, root: Path) -> None:
    agent = goodbot.Agent()
    agent.hear(home, home.start, "over there")
    assert agent.words_of(home, "blockInRoom(block0,room1)") == "take the blue chair to the green room"
    agent.listen(home, home.start, "do not go to the red room")
    assert {agent.words_of(home, task) for task in agent.tasks if task.startswith("!agent")} <= {"stay out of the red room", "stay out of the green room"}
    with pytest.raises(ValueError, match="no task of this session"):
        agent.words_of(home, "dance(agent0)")
    world = goodbot.World.load(root / "docs/examples/worlds/lamps.json")
    agent = goodbot.Agent(domain=world)
    agent.hear(world, world.start, "light it")
    assert [agent.words_of(world, task) for task in ("lampOn(lamp1)", 3)] == ["lamp on: blue kitchen lamp", "lamp off: green hall lamp"]

    class Door:
        actions, objects, propositions, state_count = ["push"], {"door0": {"class": "door"}}, {"isOpen": ("door",)}, 2

        def step(self, state: int, action: str) -> int:
            return 1 - state

        def true(self, state: int) -> list[str]:
            return ["isOpen(door0)"] if state else []

        def number(self, state: int) -> int:
            return state

    door = Door()
    agent = goodbot.Agent(["isOpen(?d)"], domain=door)
    agent.hear(door, 0, "open it")
    assert agent.words_of(door, 0) == "is open: door0"
