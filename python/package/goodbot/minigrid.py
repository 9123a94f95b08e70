"""MiniGrid and BabyAI: a robot hears an environment's mission, plans, acts, and learns what its words mean (`pip install 'goodbot[minigrid]'`).

    python -m goodbot.minigrid GoToLocal PickupLoc --robots 5 --tests 50

teaches robots in BabyAI's levels, and prints how many unseen missions they fulfil after some lessons. The robot sees the whole grid and knows what its
actions do, so its lessons cannot be compared with the episodes of learners from pixels: it learns the words alone.
"""

# gymnasium and minigrid may be without types.
# mypy: disable-error-code="import-untyped"

from __future__ import annotations

import argparse
import contextlib
import io
import random
import re
import statistics
import sys
from collections import deque
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias, cast

import numpy as np

try:
    import gymnasium
    import minigrid  # noqa: F401
    from minigrid.core.constants import DIR_TO_VEC
    from minigrid.envs.babyai.core import verifier
except ImportError:
    raise ImportError("goodbot.minigrid needs MiniGrid: pip install 'goodbot[minigrid]'") from None

from ._native import Agent, Trainer
from .lesson import RESTS
from .names import Feedback, Kind, Learner, Skill

# A cell that can be walked on, a heading (0 is east, as in MiniGrid), and what was handled last, by its position among `Grid.handled`.
Position: TypeAlias = tuple[int, int, int]

TASKS: dict[Skill, tuple[str, ...]] = {
    "goto": ("facing(?thing)", "facingDoor(?door)"),
    "pickup": ("carrying(?thing)",),
    "open": ("opened(?door)",),
    "putnext": ("nextTo(?thing,?other)", "nextToDoor(?thing,?door)"),
    "reach": ("at(?goal)",),
}
TURNS = ("left", "right", "forward")
HANDS: dict[Skill, tuple[str, ...]] = {"pickup": ("pickup", "drop"), "putnext": ("pickup", "drop"), "open": ("toggle",)}
# The levels of the table, and what their missions ask for.
LEVELS: dict[str, tuple[Skill, ...]] = {
    "GoToRedBallGrey": ("goto",),
    "GoToLocal": ("goto",),
    "PickupLoc": ("pickup",),
    "OpenDoorLoc": ("open",),
    "PutNextLocal": ("putnext",),
    "GoTo": ("goto",),
}


class Vocabulary:
    """What can be said of any grid: the actions and propositions of some skills."""

    propositions = {
        "facing": ("thing",),
        "facingDoor": ("door",),
        "carrying": ("thing",),
        "opened": ("door",),
        "nextTo": ("thing", "thing"),
        "nextToDoor": ("thing", "door"),
        "at": ("goal",),
    }
    attributes = {name: {kind: name for kind in ("thing", "door", "goal")} for name in ("color", "type", "side", "depth")}

    def __init__(self, skills: Iterable[Skill]) -> None:
        self.skills = tuple(skills)
        hands = [action for skill in self.skills for action in HANDS.get(skill, ())]
        self.actions = [*TURNS, *dict.fromkeys(hands)]
        self.tasks = [task for skill in self.skills for task in TASKS[skill]]
        self.objects: dict[str, dict[str, str]] = {}

    def step(self, state: Position, action: str) -> Position | None:
        """Where an action leads: nowhere, without a grid."""
        return None

    def true(self, state: Position) -> list[str]:
        """What holds: nothing, without a grid."""
        return []

    def number(self, state: Position) -> int:
        """The number of a state."""
        return 0

    def __repr__(self) -> str:
        return f"<goodbot.minigrid.Vocabulary: {', '.join(self.skills)}>"


class Grid(Vocabulary):
    """The grid of an environment as it is now, as a world that `goodbot.Agent` hears commands in: a `goodbot.Domain`.

    At most one thing is out of its place at a time: a thing can be put only beside others, and is picked up again before the robot goes on. It takes
    nothing along that is of no use elsewhere. So there are few states. A closed door is opened by walking through it, or by `toggle` if doors are to be
    opened: then the last one stays open. A locked door is opened by `toggle` with its key, so `skills` need both `open` and `pickup`; for others it stays
    shut. `side` and `depth` tell where a thing of the robot's room is as the robot stands now (BabyAI's rule).

    >>> import gymnasium
    >>> from goodbot.minigrid import Grid
    >>> env = gymnasium.make("BabyAI-GoToRedBallGrey-v0")
    >>> _ = env.reset(seed=1)
    >>> grid = Grid(env, ["goto"])
    >>> len(grid.objects), grid.meanings()
    (8, ['facing(thing2)'])
    """

    def __init__(self, env: gymnasium.Env[Any, Any], skills: Iterable[Skill]) -> None:
        super().__init__(skills)
        self.env = env
        self.base = cast(Any, env.unwrapped)
        self.places: list[tuple[int, int]] = []
        # The things, doors and goals of the environment by their names.
        self.cells: dict[str, Any] = {}
        # Where each of them is at first; None if the robot carries it.
        self.home: dict[str, int | None] = {}
        grid, walls = self.base.grid, ("wall", "lava")
        for x in range(grid.width):
            for y in range(grid.height):
                cell = grid.get(x, y)
                if cell is not None and cell.type in walls:
                    continue
                self.places.append((x, y))
                if cell is not None and cell.type != "floor":
                    self._add(cell, len(self.places) - 1)
        if self.base.carrying is not None:
            self._add(self.base.carrying, None)
        position = {place: number for number, place in enumerate(self.places)}
        self.ahead = [[position.get((x + int(dx), y + int(dy))) for dx, dy in DIR_TO_VEC] for x, y in self.places]
        of = {kind: [name for name in self.cells if name.startswith(kind)] for kind in ("thing", "door", "goal")}
        self.at_home = {place: name for name, place in self.home.items() if place is not None}
        self.handled: list[tuple[str, ...]] = [()]
        if "pickup" in self.actions:
            self.handled += [("carry", thing) for thing in of["thing"]]
        if "putnext" in self.skills:
            self.handled += [("put", thing, str(place)) for thing in of["thing"] for place in self._spots(of["thing"] + of["door"])]
        self.locked = {name for name, cell in self.cells.items() if getattr(cell, "is_locked", False)}
        keys = [thing for thing in of["thing"] if any(self._fits(thing, door) for door in self.locked)] if "open" in self.skills else []
        if "open" in self.skills:
            self.handled += [("open", door) for door in of["door"]]
        if "pickup" in self.actions:
            self.handled += [("open", door, key) for door in of["door"] for key in keys]
        # What the robot may walk with, because it can do something with it elsewhere.
        self.taken = set(of["thing"] if "putnext" in self.skills else [*keys, *(thing for thing in of["thing"] if self.home[thing] is None)])
        self.ajar = {name for name, cell in self.cells.items() if getattr(cell, "is_open", False)}
        self.index = {what: number for number, what in enumerate(self.handled)}
        self.state_count = len(self.handled) * len(self.places) * 4
        x, y = (int(number) for number in self.base.agent_pos)
        carried = [name for name, place in self.home.items() if place is None]
        self.start: Position = (position[x, y], int(self.base.agent_dir), self.index.get(("carry", *carried), 0) if carried else 0)

    def _add(self, cell: Any, place: int | None) -> None:
        kind = cell.type if cell.type in ("door", "goal") else "thing"
        name = f"{kind}{sum(other.startswith(kind) for other in self.cells)}"
        self.cells[name], self.home[name] = cell, place
        self.objects[name] = {"class": kind, "color": cell.color, "type": cell.type} | self._seen(place)

    def _seen(self, place: int | None) -> dict[str, str]:
        """On which side of the robot a place of its room is, and whether before or behind it."""
        if place is None or not hasattr(self.base, "room_from_pos"):
            return {}
        x, y = self.places[place]
        if not self.base.room_from_pos(*self.base.agent_pos).pos_inside(x, y):
            return {}
        away, front = np.subtract((x, y), self.base.agent_pos), np.asarray(DIR_TO_VEC[self.base.agent_dir])
        before, right = int(away @ front), int(away @ (-front[1], front[0]))
        seen = {"side": "right" if right > 0 else "left"} if right else {}
        return seen | ({"depth": "front" if before > 0 else "behind"} if before else {})

    def _spots(self, names: Iterable[str]) -> list[int]:
        """The free places beside these."""
        beside = {near for name in names if (place := self.home[name]) is not None for near in self.ahead[place] if near is not None}
        return sorted(place for place in beside if self.at_home.get(place) not in self.cells or self.at_home[place].startswith("thing"))

    def _in(self, place: int | None, handled: tuple[str, ...]) -> str | None:
        """The thing, door or goal in a place."""
        if place is None:
            return None
        if handled[:1] == ("put",) and int(handled[2]) == place:
            return handled[1]
        name = self.at_home.get(place)
        return None if name in self._moved(handled) else name

    @staticmethod
    def _moved(handled: tuple[str, ...]) -> tuple[str, ...]:
        """The thing that is not in its place."""
        return handled[2:] if handled[:1] == ("open",) else handled[1:2]

    def _fits(self, thing: str, door: str) -> bool:
        """Whether a thing is the key of a locked door."""
        return bool(self.cells[thing].type == "key" and self.cells[thing].color == self.cells[door].color)

    def step(self, state: Position, action: str) -> Position | None:
        """The state that an action leads to, or None if it cannot be done or would leave the few states."""
        place, heading, number = state
        handled, ahead = self.handled[number], self.ahead[place][heading]
        is_stuck = handled[:1] == ("put",) or (handled[:1] == ("carry",) and handled[1] not in self.taken)
        if is_stuck and action not in ("pickup", "drop"):
            return None
        if action in ("left", "right"):
            return place, (heading + (1 if action == "right" else -1)) % 4, number
        name = self._in(ahead, handled)
        if action == "forward":
            if ahead is None or (name is not None and name.startswith("thing")):
                return state
            return None if self._is_shut(name, handled) else (ahead, heading, number)
        kept: tuple[str, ...] | None = None
        if action == "toggle" and name is not None and name.startswith("door"):
            carried = self._moved(handled)
            if name not in self.locked or any(self._fits(thing, name) for thing in carried):
                kept = ("open", name, *carried)
        elif action == "pickup" and name is not None and name.startswith("thing") and (not self._moved(handled) or handled[:2] == ("put", name)):
            kept = ("carry", name)
        elif action == "drop" and handled[:1] == ("carry",) and ahead is not None and name is None:
            kept = () if self.home[handled[1]] == ahead else ("put", handled[1], str(ahead))
        return None if kept is None or kept not in self.index else (place, heading, self.index[kept])

    def _is_shut(self, name: str | None, handled: tuple[str, ...]) -> bool:
        """Whether this is a shut door, where doors are to be opened."""
        if name is None or not name.startswith("door") or handled[:2] == ("open", name):
            return False
        return name in self.locked or ("open" in self.skills and name not in self.ajar)

    def true(self, state: Position) -> list[str]:
        """All that holds in a state."""
        place, heading, number = state
        handled = self.handled[number]
        name, here = self._in(self.ahead[place][heading], handled), self._in(place, handled)
        holds = [] if name is None or name.startswith("goal") else [f"facing{'Door' if name.startswith('door') else ''}({name})"]
        if here is not None and here.startswith("goal"):
            holds.append(f"at({here})")
        match handled:
            case ("carry", thing):
                holds.append(f"carrying({thing})")
            case ("open", door, *carried):
                holds += [f"opened({door})", *(f"carrying({thing})" for thing in carried)]
            case ("put", thing, spot):
                near = {self._in(beside, handled) for beside in self.ahead[int(spot)]} - {None, thing}
                holds += [f"nextTo{'Door' if str(other).startswith('door') else ''}({thing},{other})" for other in near if "goal" not in str(other)]
        return holds

    def number(self, state: Position) -> int:
        """The number of a state."""
        place, heading, handled = state
        return (handled * len(self.places) + place) * 4 + heading

    def plan(self, task: str) -> list[str] | None:
        """The actions of a shortest way to a task's goal, or None if there is none."""
        ways: dict[Position, list[str]] = {self.start: []}
        waiting = deque([self.start])
        while waiting:
            state = waiting.popleft()
            if task in self.true(state):
                return ways[state]
            for action in self.actions:
                after = self.step(state, action)
                if after is not None and after not in ways:
                    ways[after] = [*ways[state], action]
                    waiting.append(after)
        return None

    def meanings(self) -> list[str]:
        """The tasks of which each fulfils the mission of a BabyAI level. Raises `ValueError` if it has several parts, or is none of BabyAI's."""
        asked = getattr(self.base, "instrs", None)

        def named(described: Any) -> list[str]:
            return [name for name, cell in self.cells.items() if any(cell is one for one in described.obj_set)]

        if isinstance(asked, verifier.PutNextInstr):
            pairs = [(one, other) for one in named(asked.desc_move) for other in named(asked.desc_fixed) if one != other]
            return [f"nextTo{'Door' if other.startswith('door') else ''}({one},{other})" for one, other in pairs]
        words: dict[type, str] = {verifier.GoToInstr: "facing", verifier.PickupInstr: "carrying", verifier.OpenInstr: "opened"}
        word = words.get(type(asked))
        if asked is None or word is None:
            raise ValueError(f"the mission {self.base.mission!r} is none that BabyAI gives in one part; tell its meanings yourself")
        return [f"{word}{'Door' if word == 'facing' and name.startswith('door') else ''}({name})" for name in named(asked.desc)]

    def act(self, action: str) -> tuple[float, bool]:
        """Acts in the environment. Returns the reward, and whether the episode is over."""
        actions, door = self.base.actions, self.base.grid.get(*self.base.front_pos)
        shut = door is not None and door.type == "door" and not door.is_open
        # A door in the way is opened, and one that is open is closed before it is opened.
        first = (action == "forward" and shut) or (action == "toggle" and door is not None and door.type == "door" and not shut)
        codes = [actions.toggle] if first else []
        for code in [*codes, actions.done if action == "noop" else actions[action]]:
            _, reward, terminated, truncated, _ = self.env.step(code)
            if terminated or truncated:
                return float(reward), True
        return 0.0, False

    def __repr__(self) -> str:
        return f"<goodbot.minigrid.Grid: {_mission(self.env)!r}, {len(self.objects)} objects, {self.state_count} states>"


@dataclass(frozen=True)
class Lesson:
    """A lesson in an environment."""

    command: str
    """What was said."""
    meanings: list[str]
    """The tasks that were meant; each will do."""
    understood: bool
    """Whether the robot set out for one of them on hearing the command."""
    ending: Literal["goal", "dead end", "too long", "done before"]
    """Why it ended. A mission that was fulfilled before the first step teaches nothing."""
    steps: list[tuple[str, Feedback]]
    """The actions and their feedback."""

    def __repr__(self) -> str:
        return f"<goodbot.minigrid.Lesson: {self.command!r}, {len(self.steps)} steps, ended: {self.ending}>"


class Robot:
    """A robot that hears the missions of MiniGrid's environments, and learns their words from feedback.

    `skills` are what it may be asked: `goto`, `pickup`, `open`, `putnext`, and `reach` a goal; the fewer, the sooner it understands.

    >>> import gymnasium
    >>> from goodbot.minigrid import Robot
    >>> env, robot = gymnasium.make("BabyAI-GoToLocal-v0"), Robot(["goto"], seed=1)
    >>> for seed in range(10, 30):
    ...     _ = env.reset(seed=seed)
    ...     lesson = robot.teach(env)
    >>> _ = env.reset(seed=1000)        # a mission in a room that it never saw
    >>> robot.obey(env)
    True
    """

    def __init__(self, skills: Iterable[Skill], *, trainer: Kind = "balanced", learner: Learner = "default", seed: int = 0) -> None:
        vocabulary = Vocabulary(skills)
        self.skills = vocabulary.skills
        self.trainer = Trainer(trainer, seed=seed)
        self.agent = Agent(vocabulary.tasks, domain=vocabulary, learner=learner, seed=seed)

    def teach(self, env: gymnasium.Env[Any, Any], *, command: str | None = None, meanings: Sequence[str] | None = None, most_steps: int = 100) -> Lesson:
        """Gives a lesson in an environment that was just reset: the robot hears the mission, acts, and the trainer judges each action.

        `command` and `meanings` replace the mission and its meanings. After the episode's end the lesson goes on in the robot's model of the grid.
        """
        grid, agent = Grid(env, self.skills), self.agent
        said, meant = self._said(env, command), list(grid.meanings() if meanings is None else meanings)
        state, over, rests, steps, understood = grid.start, False, 0, list[tuple[str, Feedback]](), False
        if set(grid.true(state)) & set(meant):
            return Lesson(said, meant, False, "done before", steps)
        agent.hear(grid, state, said)
        ending: Literal["goal", "dead end", "too long"] = "too long"
        tasks, actions = agent.tasks, [*grid.actions, "noop"]
        known = [tasks.index(task) for task in meant if task in tasks]
        while len(steps) < most_steps:
            agent.plan(grid, state)
            right, at_goal = self._right(grid, known)
            if rests == RESTS or right is None:
                ending = "goal" if rests == RESTS else "dead end"
                break
            decision = agent.decide(grid, state)
            understood |= not steps and decision.task in known
            if not over and decision.action != "noop":
                _, over = grid.act(decision.action)
            state = agent.acted(grid, state, decision.action)
            word = self.trainer.feedback(bool(right[actions.index(decision.action)]))
            agent.feedback(word)
            steps.append((decision.action, word))
            rests = rests + 1 if at_goal and decision.action == "noop" else 0
        agent.finish(grid)
        return Lesson(said, meant, understood, ending, steps)

    def _right(self, grid: Grid, meant: list[int]) -> tuple[Any, bool]:
        """Which actions are right for the nearest of the tasks that are meant, None if none can be reached, and whether one is reached."""
        plans, distances, sets = self.agent.plans, self.agent.distances, self.agent.optimal_sets(grid)
        able = [task for task in meant if plans[task] in ("goal", "toward")]
        if not able:
            return None, False
        near = min(distances[task] for task in able)
        return np.any([sets[task] for task in able if distances[task] == near], axis=0), near == 0

    def obey(self, env: gymnasium.Env[Any, Any], *, command: str | None = None) -> bool:
        """Follows the mission of an environment that was just reset, as it understands it. Returns whether the environment rewards it.

        It learns nothing.
        """
        grid, agent = Grid(env, self.skills), self.agent
        agent.hear(grid, grid.start, self._said(env, command))
        task = agent.most_likely
        agent.forget()
        for action in [*(grid.plan(task or "") or []), "noop"]:
            reward, over = grid.act(action)
            if over:
                return reward > 0
        return False

    def __repr__(self) -> str:
        return f"<goodbot.minigrid.Robot: {', '.join(self.skills)}; {self.agent.sessions} sessions, {len(self.agent.words)} words>"

    @staticmethod
    def _said(env: gymnasium.Env[Any, Any], command: str | None) -> str:
        return _mission(env) if command is None else command


def _mission(env: gymnasium.Env[Any, Any]) -> str:
    """The mission of an environment."""
    return str(cast(Any, env.unwrapped).mission)


def exchanged(command: str) -> str:
    """A mission with each colour, kind, side and verb in the place of another one."""
    rings = (("red", "green", "blue", "purple", "yellow", "grey"), ("ball", "box", "key"), ("left", "right"), ("front of", "behind"))
    after = {word: ring[(number + 1) % len(ring)] for ring in rings for number, word in enumerate(ring)}
    return re.sub("|".join(after), lambda found: after[found.group()], command)


def nonsense(command: str, draw: random.Random) -> str:
    """As many words as in a mission, of no language."""
    return " ".join("".join(draw.choices("bdfgklmnprstvz", k=1) + draw.choices("aeiou", k=1)[:1]) * 2 + draw.choice("lmnrst") for _ in command.split())


@dataclass(frozen=True)
class Row:
    """The robots' success after some lessons."""

    level: str
    """The level of BabyAI."""
    lessons: int
    """How many lessons each robot had."""
    control: str
    """`none`, or what was done to the words: `nonsense words`, `exchanged words`, `random meanings`."""
    success: list[float]
    """The share of unseen missions that each robot fulfilled."""

    @property
    def mean(self) -> float:
        """The mean of the robots."""
        return statistics.fmean(self.success)

    @property
    def half(self) -> float:
        """Half of the 95 % interval of the mean, from the spread between the robots."""
        # Student's factors for 2 to 10 robots; above it is at most 2.2.
        factors = {1: 12.71, 2: 4.30, 3: 3.18, 4: 2.78, 5: 2.57, 6: 2.45, 7: 2.36, 8: 2.31, 9: 2.26}
        count = len(self.success)
        return float("nan") if count < 2 else factors.get(count - 1, 2.2) * statistics.stdev(self.success) / count**0.5


def study(
    level: str,
    lessons: Sequence[int] = (0, 5, 10, 20, 50),
    *,
    robots: int = 5,
    tests: int = 50,
    seed: int = 1,
    skills: Sequence[Skill] | None = None,
    trainer: Kind = "balanced",
    learner: Learner = "default",
) -> list[Row]:
    """Teaches robots in a level of BabyAI, and asks each of them missions of other seeds after so many lessons, and at the end with controls.

    Missions that are fulfilled before the first step are passed over.
    """
    skills = LEVELS.get(level) if skills is None else skills
    if skills is None:
        raise ValueError(f"name the skills of {level}, such as goto; those of {', '.join(LEVELS)} are known")
    env = gymnasium.make(f"BabyAI-{level}-v0", disable_env_checker=True)
    rows: dict[tuple[int, str], list[float]] = {}
    for number in range(robots):
        # Seeds of lessons and of tests are apart.
        first = 1_000_000 * seed + 10_000 * number
        draw = random.Random(first)
        robot, confused = (Robot(skills, trainer=trainer, learner=learner, seed=first + other) for other in (0, 1))
        given, at = 0, first
        for wanted in sorted(lessons):
            while given < wanted:
                at = _next(env, skills, at)
                given += 1
                robot.teach(env)
                _next(env, skills, at - 1)
                grid = Grid(env, skills)
                confused.agent.hear(grid, grid.start, _mission(env))
                tasks = confused.agent.tasks
                confused.agent.forget()
                confused.teach(env, meanings=[draw.choice(tasks)])
            last = wanted == max(lessons)
            for control in ("none", "nonsense words", "exchanged words", "random meanings") if last else ("none",):
                asked, right = first + 5_000, 0
                for _ in range(tests):
                    asked = _next(env, skills, asked)
                    mission = _mission(env)
                    said = {"nonsense words": nonsense(mission, draw), "exchanged words": exchanged(mission)}.get(control)
                    right += (confused if control == "random meanings" else robot).obey(env, command=said)
                rows.setdefault((wanted, control), []).append(right / tests)
    return [Row(level, count, control, success) for (count, control), success in rows.items()]


def _next(env: gymnasium.Env[Any, Any], skills: Sequence[Skill], seed: int) -> int:
    """Begins an episode of the next seed whose mission is not fulfilled yet, and returns the seed."""
    while True:
        seed += 1
        # BabyAI prints the missions that it draws in vain.
        with contextlib.redirect_stdout(io.StringIO()):
            env.reset(seed=seed)
        grid = Grid(env, skills)
        if not set(grid.true(grid.start)) & set(grid.meanings()):
            return seed


def main(typed: Sequence[str] | None = None) -> None:
    """The command `python -m goodbot.minigrid`."""
    parser = argparse.ArgumentParser(prog="python -m goodbot.minigrid", description="Teach robots in levels of BabyAI, and test them on unseen missions")
    parser.add_argument("levels", nargs="*", default=list(LEVELS), metavar="LEVEL", help=f"such as {', '.join(LEVELS)} (the default)")
    parser.add_argument("--lessons", type=int, nargs="+", default=[0, 5, 10, 20, 50], help="test after so many lessons")
    parser.add_argument("--robots", type=int, default=5, help="how many robots learn each level, from seeds of their own")
    parser.add_argument("--tests", type=int, default=50, help="how many missions each robot is asked, each time")
    parser.add_argument("--seed", type=int, default=1, help="another seed has other lessons, missions and trainers")
    parser.add_argument("--skills", nargs="+", choices=list(TASKS), help="what a mission may ask, for other levels")
    given = parser.parse_args(typed)
    if min(given.lessons) < 0 or given.robots < 1 or not 1 <= given.tests <= 4000 or max(given.lessons) > 4000:
        parser.error("lessons are 0 to 4000, robots 1 or more, tests 1 to 4000")
    print("level,lessons,control,robots,tests,success,half of the 95 % interval")
    for level in given.levels:
        try:
            rows = study(level, given.lessons, robots=given.robots, tests=given.tests, seed=given.seed, skills=given.skills)
        except (ValueError, gymnasium.error.Error) as error:
            parser.error(str(error))
        for row in rows:
            print(f"{level},{row.lessons},{row.control},{given.robots},{given.tests},{row.mean:.3f},{row.half:.3f}", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
