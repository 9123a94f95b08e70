"""A language model of your own: the methods that its class needs, and the tasks that it is given."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from ._native import Agent, words
from .domain import Domain

# A proposition with its arguments, such as `blockInRoom(block0,room2)`; `!` before it negates it.
_ATOM = re.compile(r"(!?\w+)\(([^)]*)\)")


@dataclass(frozen=True)
class Task:
    """A task that a command may mean, as a language model gets it.

    >>> task = goodbot.Task.of("agentInRoom(agent0,room2)", {"agent0": {"class": "agent"}, "room2": {"class": "room", "color": "red"}})
    >>> task.objects
    ('agent0', 'room2')
    >>> task.features
    ('agentInRoom', 'agentInRoom 1 color red')
    """

    name: str
    """As `Agent.tasks` has it: `agentInRoom(agent0,room2)`."""
    objects: tuple[str, ...]
    """The objects that it is about, in the order of its name."""
    features: tuple[str, ...]
    """Each of its propositions, and each value of their arguments: proposition, position of the argument, attribute and value."""

    @staticmethod
    def of(name: str, objects: Mapping[str, Mapping[str, Any]]) -> Task:
        """A task by its name, among objects with their attributes, such as `Home.objects`."""
        named: list[str] = []
        features: list[str] = []
        for proposition, arguments in _ATOM.findall(name):
            features.append(proposition)
            for position, argument in enumerate(arguments.split(",")):
                named.append(argument)
                values = objects.get(argument, {}).items()
                features += [f"{proposition} {position} {attribute} {value}" for attribute, value in values if _is_value(attribute, value)]
        return Task(name, tuple(named), tuple(features))


def _is_value(attribute: str, value: object) -> bool:
    """Whether this is a value that words can name; a class and a box are none."""
    return isinstance(value, str) and attribute not in ("class", "name")


class LanguageModel(Protocol):
    """A language model of your own: any class with this method. There is nothing to inherit.

    >>> class Colors:
    ...     '''Understands the colours of rooms, and nothing else.'''
    ...     def log_likelihood(self, words, tasks):
    ...         return [0.0 if any(task.features[-1].endswith(word) for word in words) else -5.0 for task in tasks]
    >>> home = goodbot.Home.from_map("#########\\n#ggg#rrr#\\n##+###+##\\n#bb@bbbb#\\n#########")
    >>> agent = goodbot.Agent()
    >>> goodbot.hear(agent, home, home.start, "to the red one", language=Colors())
    >>> agent.most_likely
    'agentInRoom(agent0,room2)'
    """

    def log_likelihood(self, words: Sequence[str], tasks: Sequence[Task]) -> Sequence[float]:
        """The natural log likelihood of these words for each task, up to a constant: a number for each task. `-inf` is impossible."""


@runtime_checkable
class LearningLanguageModel(LanguageModel, Protocol):
    """A language model that learns too: it gets the belief at the end of each session."""

    def learn(self, words: Sequence[str], tasks: Sequence[Task], beliefs: NDArray[np.float32]) -> None:
        """Learns from a session: its words, its tasks, and how probable each task was at the end, float32 of shape (tasks,), sum 1."""


def objects_of(domain: Any) -> Mapping[str, Mapping[str, Any]]:
    """The objects of a home, a world or a robot of one's own, with their attributes."""
    objects: Mapping[str, Mapping[str, Any]] = domain.objects
    return objects


def hear(agent: Agent, domain: Any, state: Any, command: str, *, language: LanguageModel | None = None) -> None:
    """Lets an agent hear a command in a state, as `Agent.hear` does, with a language model of your own.

    Each task's prior is proportional to its likelihood. Raises `ValueError` if the model does not return a number for each task.
    """
    if language is None:
        agent.hear(domain, state, command)
        return
    # The tasks are known only after the command was heard once.
    agent.hear(domain, state, command)
    names = agent.tasks
    agent.hear(domain, state, command, prior=dict(zip(names, _prior(language, command, _tasks(agent, domain)), strict=True)))


def learn(agent: Agent, domain: Any, *, language: LanguageModel | None = None) -> int:
    """Ends a session and learns from it, as `Agent.finish` does; returns how many older sessions were forgotten.

    A language model of your own learns, if it can, in place of the agent's.
    """
    if language is None:
        return agent.finish(domain)
    if isinstance(language, LearningLanguageModel):
        language.learn(words(agent.command), _tasks(agent, domain), agent.beliefs)
    agent.forget()
    return 0


def _tasks(agent: Agent, domain: Any) -> list[Task]:
    objects = objects_of(domain)
    return [Task.of(name, objects) for name in agent.tasks]


def _prior(language: LanguageModel, command: str, tasks: Sequence[Task]) -> list[float]:
    logs = [float(number) for number in language.log_likelihood(words(command), tasks)]
    if len(logs) != len(tasks):
        raise ValueError(f"log_likelihood gave {len(logs)} numbers for {len(tasks)} tasks; give one for each")
    for task, number in zip(tasks, logs):
        if math.isnan(number) or number == math.inf:
            raise ValueError(f"log_likelihood gave {number} for {task.name}; give a logarithm, or -inf for what is impossible")
    most = max(logs, default=0.0)
    if most == -math.inf:
        raise ValueError(f"log_likelihood takes all tasks for impossible at {command!r}; give at least one a number")
    # No task that is possible becomes impossible because another is much more probable.
    return [0.0 if number == -math.inf else math.exp(max(number - most, -80.0)) for number in logs]
