"""goodbot's homes and worlds as Gymnasium environments: after `import goodbot`, `gymnasium.make("goodbot/Home-v0")` knows them.

| id | home |
|---|---|
| `goodbot/Home-v0` | four rooms, two blocks |
| `goodbot/Rooms-v0` | three rooms, no block |
| `goodbot/Block-v0` | three rooms, one block |

Each episode has a home at random and a mission in words, such as "take the blue bag to the red room". The reward is 1 when the mission is
done, which ends the episode, and 0 otherwise. After 300 steps it is cut short, or after as many as `max_episode_steps=` says. With `home=` the
home is always that one; with `log=` homes, missions and their meanings are those of a session log. `goodbot/World-v0` is a world of any kind, with
`world=` or the `log=` of sessions in it.
"""

from __future__ import annotations

import string
from collections.abc import Sequence
from os import PathLike
from typing import Any, SupportsFloat

import gymnasium
import numpy as np
from gymnasium import spaces
from gymnasium.vector import AutoresetMode, VectorEnv
from numpy.typing import NDArray

from ._native import Agent, Home, State, Trainer, World, Worlds
from .logs import read_log
from .names import Kind
from .registration import MOST_STEPS

Image = NDArray[np.uint8]
Observation = dict[str, Any]
Place = tuple[Home, Sequence[tuple[str, str]]]

CHANNELS = 4
# The kinds of tasks that worlds know: the paper's two, and both at once.
KINDS = ["agentInRoom(?a,?r)", "blockInRoom(?o,?r)", "agentInRoom(?a,?r1) & blockInRoom(?o,?r2)"]
MOST_LETTERS = 128
# The letters of missions: a space of texts cannot have the letters of all scripts.
LETTERS = string.ascii_letters + string.digits + string.punctuation + " "
# The cells of a home of the course, with its walls.
COURSE_SIZE = 10
# Gymnasium's own wrapper cuts the episodes of a single home short.
ENDLESS = 2**32 - 1


def missions(home: Home | World) -> list[tuple[str, str]]:
    """The commands that can be given and obeyed in a home or a world, each with the name of the task that it means.

    >>> import goodbot
    >>> from goodbot.gym import missions
    >>> missions(goodbot.Home.from_map("#####\\n#r@r#\\n##+##\\n#ggg#\\n#####"))
    [('go to the green room', 'agentInRoom(agent0,room0)')]
    """
    asked = Agent(capacities={"states": 1 << 14}) if isinstance(home, Home) else Agent(domain=home)
    if not home.tasks():
        return []
    asked.hear(home, home.start, "go")
    asked.plan(home, home.start)
    return [
        (asked.words_of(home, task), task) for task, distance in zip(asked.tasks, asked.distances, strict=True) if distance > 0
    ]


def _logged(path: str | PathLike[str]) -> list[Place]:
    """The homes of a log, with the commands whose meaning is known. Tasks with a way, which depend on more than the last state, are left out."""
    sessions = read_log(path)
    if any(session.world is not None for session in sessions):
        raise ValueError("the log is of a world, not of homes; make goodbot/World-v0")
    places = ((session.home, session.command, session.intended) for session in sessions if session.intended)
    return [(home, [(command, meant)]) for home, command, meant in places if meant in home.tasks(kinds=KINDS)]


class _Drawn:
    """The homes and spaces of an environment, for one and for many."""

    def __init__(self, name: str, home: Home | None, log: str | PathLike[str] | None) -> None:
        self.name = name
        self.places: list[Place] | None = None
        if home is not None:
            self.places = [(home, missions(home))]
        elif log is not None:
            self.places = _logged(log)
            if not self.places:
                raise ValueError("no session of the log says what was meant (intended); there is nothing to reward")
        homes = [place[0] for place in self.places or []]
        self.actions = [*(homes[0].actions if homes else Home.random(0, name).actions), "noop"]
        if any(len(home.actions) != len(homes[0].actions) for home in homes):
            raise ValueError("some homes of the log have pull and some have not; take one kind")
        sides = [max(right - left, top - bottom) + 1 for left, bottom, right, top in (home.bounds for home in homes)]
        self.size = max(sides, default=COURSE_SIZE)
        self.action_space = spaces.Discrete(len(self.actions))
        self.space = spaces.Dict(
            {
                "image": spaces.Box(0, 255, (self.size, self.size, CHANNELS), np.uint8),
                "mission": spaces.Text(MOST_LETTERS, charset=LETTERS),
            }
        )

    def at_random(self, seed: int) -> Place:
        """A home of a seed, with its missions."""
        home = Home.random(seed, self.name)
        return home, missions(home)


class HomeEnv(gymnasium.Env[Observation, Any]):
    """One home with a mission.

    Observations are dicts: `image`, uint8 of shape (size, size, 4), as `goodbot.Worlds` describes it, and `mission`, the command. Actions are
    the positions in `env.unwrapped.actions`, the last of which is `noop`. `info["intended"]` is the name of the intended task. Made by
    `gymnasium.make`, an episode is cut short after `max_episode_steps` steps; made by this class, never.

    >>> import gymnasium
    >>> env = gymnasium.make("goodbot/Rooms-v0")
    >>> observation, info = env.reset(seed=1)
    >>> observation["image"].shape, observation["mission"]
    ((10, 10, 4), 'go to the green room')
    >>> env.unwrapped.actions
    ['north', 'south', 'east', 'west', 'noop']
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array", "ansi"], "render_fps": 8}

    def __init__(
        self,
        name: str = "Test",
        *,
        home: Home | None = None,
        log: str | PathLike[str] | None = None,
        render_mode: str | None = None,
    ) -> None:
        if render_mode not in (None, *self.metadata["render_modes"]):
            raise ValueError(f"render_mode is {render_mode!r}; give rgb_array, ansi or None")
        self._drawn = _Drawn(name, home, log)
        self._worlds: Worlds | None = None
        self.render_mode = render_mode
        self.actions = self._drawn.actions
        self.action_space = self._drawn.action_space
        self.observation_space = self._drawn.space

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Observation, dict[str, Any]]:
        """Begins an episode. `options={"command": ..., "intended": ...}` sets the mission, in a home that is given."""
        super().reset(seed=seed)
        drawn = int(self.np_random.integers(1 << 32))
        places = self._drawn.places or [self._drawn.at_random(drawn)]
        if options:
            places = [(home, [(options["command"], options["intended"])]) for home, _ in places]
        self._worlds = Worlds(1, places, max_steps=ENDLESS, seed=drawn, size=self._drawn.size)
        return self._observed(self._worlds.image()), {"intended": self.intended}

    def step(self, action: int) -> tuple[Observation, SupportsFloat, bool, bool, dict[str, Any]]:
        """Does an action; the reward is 1 when the mission is done."""
        image, rewards, terminated, truncated = self._begun.step(bytes([int(action)]))
        reward = float(np.frombuffer(rewards, np.float32)[0])
        return self._observed(image), reward, bool(terminated[0]), bool(truncated[0]), {"intended": self.intended}

    @property
    def _begun(self) -> Worlds:
        if self._worlds is None:
            raise gymnasium.error.ResetNeeded("no episode has begun; call reset first")
        return self._worlds

    def _observed(self, image: bytes) -> Observation:
        size = self._drawn.size
        return {"image": np.frombuffer(image, np.uint8).reshape(size, size, CHANNELS).copy(), "mission": self.command}

    @property
    def command(self) -> str:
        """The mission."""
        return self._begun.command(0)

    @property
    def intended(self) -> str:
        """The name of the task that the mission means."""
        return self._begun.intended(0)

    @property
    def home(self) -> Home:
        """The home."""
        return self._begun.home(0)

    @property
    def state(self) -> State:
        """The current state."""
        return self._begun.state(0)

    @property
    def width(self) -> int:
        """The cells of a side, as MiniGrid's environments have it."""
        return self._drawn.size

    @property
    def height(self) -> int:
        """The same as `width`."""
        return self._drawn.size

    @property
    def grid(self) -> MiniGrid:
        """The home as MiniGrid's wrappers read it, such as `minigrid.wrappers.FullyObsWrapper`."""
        size = self._drawn.size
        return MiniGrid(np.frombuffer(self._begun.image(), np.uint8).reshape(size, size, CHANNELS))

    @property
    def agent_pos(self) -> tuple[int, int]:
        """Where the agent is: column and row of an image."""
        return self.grid.agent_pos

    @property
    def agent_dir(self) -> int:
        """0: goodbot's agents have no direction."""
        return 0

    def render(self) -> Any:
        """The home as it is: a picture, uint8 of shape (height, width, 3), or a drawing as text."""
        if self.render_mode == "ansi":
            return self.home.map(self.state)
        if self.render_mode == "rgb_array":
            size = self._drawn.size
            return picture(np.frombuffer(self._begun.image(), np.uint8).reshape(size, size, CHANNELS))
        gymnasium.logger.warn("render() does nothing without a render_mode; make the environment with rgb_array or ansi")
        return None


# MiniGrid's numbers of objects and colours. Those that it does not have follow its own.
_MINIGRID_WALL, _MINIGRID_FLOOR, _MINIGRID_DOOR = 2, 3, 4
_MINIGRID_THINGS = np.array([0, 10, 7, 6, 5, 11], np.uint8)  # agent; chair: box, bag: ball, backpack: key, basket
_MINIGRID_COLORS = np.array([5, 0, 1, 2, 4, 3, 6, 7, 8, 9, 10, 5], np.uint8)  # red, green, blue, yellow, purple, orange ...


class MiniGrid:
    """A home in MiniGrid's numbers."""

    def __init__(self, image: Image) -> None:
        self._image = image

    @property
    def agent_pos(self) -> tuple[int, int]:
        """Column and row of the agent."""
        row, column = np.argwhere(self._image[..., 2] == 1)[0]
        return int(column), int(row)

    def encode(self) -> Image:
        """The object in each cell, uint8 of shape (columns, rows, 3): its number, its colour's, and 0. The agent is left out, as in MiniGrid.

        A cell with a thing on the floor has the thing. Cells outside of the home are wall.
        """
        kinds, colors, things, of = (self._image[..., channel] for channel in range(CHANNELS))
        kind = np.where(kinds == 2, _MINIGRID_FLOOR, np.where(kinds == 3, _MINIGRID_DOOR, _MINIGRID_WALL))
        encoded = np.stack([kind, _MINIGRID_COLORS[np.minimum(np.where(kinds == 2, colors, 0), 11)], np.zeros_like(kinds)], -1).astype(np.uint8)
        blocks = things > 1
        encoded[blocks, 0] = _MINIGRID_THINGS[np.minimum(things[blocks], 5)]
        encoded[blocks, 1] = _MINIGRID_COLORS[np.minimum(of[blocks], 11)]
        cells: Image = encoded.transpose(1, 0, 2).copy()
        return cells

    def __repr__(self) -> str:
        return f"<goodbot.gym.MiniGrid: {len(self._image)} cells a side, agent at {self.agent_pos}>"


class HomeVectorEnv(VectorEnv[dict[str, Any], NDArray[np.int64], NDArray[Any]]):
    """Many homes, stepped together in Rust: `gymnasium.make_vec("goodbot/Home-v0", num_envs=1024)`.

    Homes come from a pool of `homes` random ones, drawn at the first reset and after each reset with a seed. An environment whose episode
    ended begins the next one at the next step, as Gymnasium's `AutoresetMode.NEXT_STEP` says. After `max_episode_steps` steps it is cut short.
    """

    metadata: dict[str, Any] = {"render_modes": [], "autoreset_mode": AutoresetMode.NEXT_STEP}

    def __init__(
        self,
        num_envs: int = 1,
        name: str = "Test",
        *,
        home: Home | None = None,
        log: str | PathLike[str] | None = None,
        max_episode_steps: int = MOST_STEPS,
        homes: int = 64,
        render_mode: str | None = None,
    ) -> None:
        if render_mode is not None:
            raise ValueError("many homes at once are not drawn; render a single environment")
        self._drawn, self._most_steps = _Drawn(name, home, log), max_episode_steps
        self._homes = homes
        self._worlds: Worlds | None = None
        self._missions: tuple[str, ...] = ()
        self.num_envs = num_envs
        self.actions = self._drawn.actions
        self.single_action_space = self._drawn.action_space
        self.single_observation_space = self._drawn.space
        self.action_space = gymnasium.vector.utils.batch_space(self.single_action_space, num_envs)
        self.observation_space = gymnasium.vector.utils.batch_space(self.single_observation_space, num_envs)
        self._ended = False

    def reset(
        self, *, seed: int | list[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, Any], dict[str, Any]]:
        """Begins an episode in each."""
        if isinstance(seed, list):
            seed = seed[0]
        super().reset(seed=seed)
        if self._worlds is None or seed is not None:
            drawn = [int(number) for number in self.np_random.integers(1 << 32, size=self._homes + 1)]
            places = self._drawn.places or [self._drawn.at_random(number) for number in drawn[1:]]
            self._worlds = Worlds(self.num_envs, places, max_steps=self._most_steps, seed=drawn[0], size=self._drawn.size)
            image = self._worlds.image()
        else:
            image = self._worlds.reset()
        self._missions = tuple(self._worlds.commands())
        return self._observed(image), {}

    def step(
        self, actions: NDArray[np.int64]
    ) -> tuple[dict[str, Any], NDArray[Any], NDArray[Any], NDArray[Any], dict[str, Any]]:
        """Does an action in each."""
        if self._worlds is None:
            raise gymnasium.error.ResetNeeded("no episode has begun; call reset first")
        image, rewards, terminated, truncated = self._worlds.step(np.asarray(actions, np.uint8).tobytes())
        if self._ended:
            # Some began anew just now.
            self._missions = tuple(self._worlds.commands())
        self._ended = b"\1" in terminated or b"\1" in truncated
        return (
            self._observed(image),
            np.frombuffer(rewards, np.float32),
            np.frombuffer(terminated, np.bool_),
            np.frombuffer(truncated, np.bool_),
            {},
        )

    def _observed(self, image: bytes) -> dict[str, Any]:
        size = self._drawn.size
        return {"image": np.frombuffer(image, np.uint8).reshape(self.num_envs, size, size, CHANNELS), "mission": self._missions}


class WorldEnv(gymnasium.Env[Observation, Any]):
    """One world of any kind with a mission: `gymnasium.make("goodbot/World-v0", world=world)`.

    Observations are dicts: `facts`, int8 of shape (propositions,), 1 where the proposition in `World.propositions` holds, and `mission`, the
    command. Actions are the positions in `env.unwrapped.actions`, the last of which is `noop`; one that cannot be done changes nothing. Missions
    are the tasks that can be reached from the start. With `log=` they are the commands of a session log whose meaning is known, from the states
    where they were said, and `world` may be left out. Reward, end and `info` are as in a home.

    >>> import gymnasium, goodbot
    >>> world = goodbot.World({"type": "world", "name": "hall", "classes": ["lamp"], "attributes": {"color": ["lamp"]}, "propositions": {"on": ["lamp"]},
    ...     "objects": [{"name": "a", "class": "lamp", "attributes": {"color": "red"}}], "task_kinds": ["on(?l)"],
    ...     "actions": [{"name": "light", "parameters": {"?l": "lamp"}, "effects": ["on(?l)"]}]})
    >>> env = gymnasium.make("goodbot/World-v0", world=world)
    >>> observation, info = env.reset(seed=1)
    >>> observation["facts"].tolist(), observation["mission"], env.unwrapped.actions
    ([0], 'on: red lamp', ['light(a)', 'noop'])
    >>> env.step(0)[1:4]
    (1.0, True, False)
    """

    metadata: dict[str, Any] = {"render_modes": ["ansi"], "render_fps": 8}

    def __init__(self, *, world: World | None = None, log: str | PathLike[str] | None = None, render_mode: str | None = None) -> None:
        if render_mode not in (None, "ansi"):
            raise ValueError(f"render_mode is {render_mode!r}; give ansi or None")
        sessions = [] if log is None else [(session, session.world) for session in read_log(log)]
        if world is None:
            world = next((known for _, known in sessions if known is not None), None)
        if world is None:
            raise ValueError("no world is given; give world=, or the log= of sessions in one")
        self.world = world
        self.places = [(world.start, *mission) for mission in missions(world)] if log is None else []
        for session, known in sessions:
            if known != world:
                raise ValueError(f"the session {session.command!r} is in another place than {world!r}; take logs of one world")
            if session.intended in world.tasks(state := int(session.state)):
                self.places.append((state, session.command, session.intended))
        if not self.places:
            lacks = "the world has no task that can be reached" if log is None else "no session of the log says what was meant (intended)"
            raise ValueError(f"{lacks}; there is nothing to reward")
        self.render_mode = render_mode
        self.actions = [*world.actions, "noop"]
        self._position = {proposition: number for number, proposition in enumerate(world.propositions)}
        self.action_space = spaces.Discrete(len(self.actions))
        self.observation_space = spaces.Dict(
            {"facts": spaces.MultiBinary(len(self._position)), "mission": spaces.Text(MOST_LETTERS, charset=LETTERS)}
        )
        self.state, self.command, self.intended = self.places[0]
        self._has_begun = False

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Observation, dict[str, Any]]:
        """Begins an episode. `options={"command": ..., "intended": ...}` sets the mission, and `"state"` where it begins."""
        super().reset(seed=seed)
        self.state, self.command, self.intended = self.places[int(self.np_random.integers(len(self.places)))]
        if options:
            self.state, self.command, self.intended = options.get("state", self.world.start), options["command"], options["intended"]
        self._has_begun = True
        return self._observed(), {"intended": self.intended}

    def step(self, action: int) -> tuple[Observation, SupportsFloat, bool, bool, dict[str, Any]]:
        """Does an action; the reward is 1 when the mission is done."""
        if not self._has_begun:
            raise gymnasium.error.ResetNeeded("no episode has begun; call reset first")
        after = self.world.step(self.state, self.actions[int(action)])
        self.state = self.state if after is None else after
        done = all(self.world.holds(part, self.state) for part in self.intended.split(" & "))
        return self._observed(), float(done), done, False, {"intended": self.intended}

    def _observed(self) -> Observation:
        facts = np.zeros(len(self._position), np.int8)
        facts[[self._position[fact] for fact in self.world.facts(self.state) if fact in self._position]] = 1
        return {"facts": facts, "mission": self.command}

    def render(self) -> Any:
        """What holds, a proposition on each line."""
        if self.render_mode == "ansi":
            return "\n".join(self.world.facts(self.state))
        gymnasium.logger.warn("render() does nothing without a render_mode; make the environment with ansi")
        return None


class HumanFeedback(gymnasium.Wrapper[Observation, Any, Observation, Any]):
    """Adds a simulated trainer to the environment: `info["feedback"]` is its feedback to each action, `reward`, `punish` or `neutral`,
    and `info["correct"]` whether the action was right; the trainer itself may be mistaken.

    >>> import gymnasium
    >>> from goodbot.gym import HumanFeedback
    >>> env = HumanFeedback(gymnasium.make("goodbot/Rooms-v0"), "balanced", seed=1)
    >>> _ = env.reset(seed=1)
    >>> sorted(env.step(0)[4])
    ['correct', 'feedback', 'intended']
    """

    def __init__(self, env: gymnasium.Env[Observation, Any], trainer: Kind = "balanced", *, seed: int = 0) -> None:
        super().__init__(env)
        if not isinstance(env.unwrapped, (HomeEnv, WorldEnv)):
            raise ValueError("a trainer needs a home or a world: wrap one of goodbot's environments")
        self._own: HomeEnv | WorldEnv = env.unwrapped
        self._trainer = Trainer(trainer, seed=seed)
        self._seer = Agent() if isinstance(self._own, HomeEnv) else Agent(domain=self._own.world)

    @property
    def _place(self) -> Home | World:
        return self._own.home if isinstance(self._own, HomeEnv) else self._own.world

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Observation, dict[str, Any]]:
        """Begins an episode."""
        observation, info = self.env.reset(seed=seed, options=options)
        # The trainer knows the intended task: it plans as an agent whose prior is that task alone.
        self._seer.hear(self._place, self._own.state, "go", prior={self._own.intended: 1.0})
        return observation, info

    def step(self, action: int) -> tuple[Observation, SupportsFloat, bool, bool, dict[str, Any]]:
        """Does an action, and adds the trainer's feedback."""
        place = self._place
        self._seer.plan(place, self._own.state)
        right = self._seer.optimal_sets(place)[self._seer.tasks.index(self._own.intended)]
        # The agent's own columns: those of the home, which may have fewer than the space.
        correct = bool(right[min(int(action), len(right) - 1)])
        observation, reward, terminated, truncated, info = self.env.step(action)
        return observation, reward, terminated, truncated, {**info, "correct": correct, "feedback": self._trainer.feedback(correct)}


# Colours of cells and things, by their numbers in an image.
_COLORS = np.array(
    [
        (128, 128, 128),
        (214, 69, 65),
        (63, 160, 77),
        (66, 112, 204),
        (224, 190, 57),
        (140, 82, 176),
        (224, 135, 50),
        (200, 173, 127),
        (54, 155, 155),
        (200, 70, 150),
        (230, 230, 120),
        (150, 150, 150),
    ],
    np.uint8,
)
_KINDS = np.array([(255, 255, 255), (60, 60, 64), (235, 235, 235), (200, 190, 180)], np.uint8)
TILE = 16


def picture(image: Image) -> Image:
    """An image as a picture: uint8, shape (16 size, 16 size, 3). Rooms are pale, blocks strong in their colours, the agent is dark and round.

    >>> import numpy as np
    >>> from goodbot.gym import picture
    >>> picture(np.zeros((5, 5, 4), np.uint8)).shape
    (80, 80, 3)
    """
    kinds, colors, things, of = (image[..., channel] for channel in range(CHANNELS))
    floor = np.where((kinds == 2)[..., None], _COLORS[np.minimum(colors, 11)] // 3 + 165, _KINDS[np.minimum(kinds, 3)])
    pixels = np.repeat(np.repeat(floor.astype(np.uint8), TILE, 0), TILE, 1)
    y, x = np.mgrid[0:TILE, 0:TILE] - (TILE - 1) / 2
    disc, square = x**2 + y**2 < (TILE * 0.36) ** 2, np.maximum(abs(x), abs(y)) < TILE * 0.32
    bag = square & (abs(x) + y > -TILE * 0.3)
    for row, column in np.argwhere(things > 0):
        tile = pixels[row * TILE : (row + 1) * TILE, column * TILE : (column + 1) * TILE]
        thing = things[row, column]
        shape = disc if thing == 1 else square if thing == 2 else bag
        tile[shape] = (40, 40, 48) if thing == 1 else _COLORS[min(int(of[row, column]), 11)]
    return pixels
