"""The interface of a class that describes a robot of your own and its world."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Protocol


class Domain(Protocol):
    """A robot of your own, and its world: any class with these attributes and methods. There is nothing to inherit.

    A domain is deterministic, and does not change while a session lasts: the answers of its methods are cached. States may be any objects.
    The two attributes `attributes` and `state_count` may be left out. Beside the methods below it has one that tells what is so in a state:

    - `holds(proposition, objects, state)`: whether a proposition holds of a tuple of objects; or
    - `true(state)`: all propositions that hold, as texts such as `lampOn(lamp1)`. It is faster: a plan asks it once for each state.

    It may have `derived(state)` too: a dict from objects to words for what follows from the state, such as `{"lamp1": ["nearest"]}`. Words of commands
    come to mean them, as they mean values of attributes. With four attributes there is no room for them.

    It may have `parents` too, a dict from classes to those above them, such as `{"ball": "thing"}`: a ball then serves where a thing is wanted, and "ball"
    can mean it.

    >>> class Lamps:
    ...     '''Two lamps, and a robot that switches each by its button.'''
    ...     actions = ["left", "right"]
    ...     propositions = {"lampOn": ("lamp",)}
    ...     attributes = {"color": {"lamp": "lampIs"}}
    ...     objects = {"lamp0": {"class": "lamp", "color": "red"}, "lamp1": {"class": "lamp", "color": "green"}}
    ...     state_count = 4
    ...     def step(self, state, action):
    ...         switched = list(state)
    ...         switched[self.actions.index(action)] ^= True
    ...         return tuple(switched)
    ...     def holds(self, proposition, objects, state):
    ...         return state[int(objects[0][-1])]
    ...     def number(self, state):
    ...         return state[0] + 2 * state[1]
    >>> import goodbot
    >>> lamps, dark = Lamps(), (False, False)
    >>> agent = goodbot.Agent(["lampOn(?l)"], domain=lamps)
    >>> lesson = goodbot.Trainer(seed=3).teach(agent, lamps, dark, "light the green lamp", "lampOn(lamp1)")
    >>> lesson.ending, lesson.state
    ('goal', (False, True))
    """

    @property
    def actions(self) -> Sequence[str] | Mapping[str, int]:
        """The names of at most 255 actions, each of cost 1; or a dict from names to costs, 1 to 255. `noop` is every robot's."""

    @property
    def objects(self) -> Mapping[str, Mapping[str, str]]:
        """The objects by their names: for each its `class`, and the values of its attributes. At most 255."""

    @property
    def propositions(self) -> Mapping[str, Sequence[str]]:
        """The propositional functions by their names: for each the classes of its 1 to 3 arguments."""

    def step(self, state: Any, action: str) -> Any:
        """The state that an action leads to, or None if it cannot be done. Bumping into a wall can be done and changes nothing."""

    def number(self, state: Any) -> int:
        """The number of a state, from 0. Different states have different numbers; there should be few gaps."""
