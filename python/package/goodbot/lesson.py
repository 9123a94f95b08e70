"""A trainer of your own, and the lesson that it gives."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, Protocol

import numpy as np
from numpy.typing import NDArray

from ._native import Agent, Home, Session, World
from .frames import of_beliefs
from .language import LanguageModel, hear, learn as _learn
from .names import Feedback

if TYPE_CHECKING:
    from .frames import Frame

# Rests in a row at the intended goal after which a lesson ends.
RESTS = 3


@dataclass(frozen=True)
class Step:
    """A step of an agent, as its trainer sees it."""

    number: int
    """How many steps of the lesson came before."""
    command: str
    """The command."""
    intended: str
    """The task that the trainer means; of several, a nearest one."""
    state: Any
    """The state before the action."""
    action: str
    """The name of the action, or `noop`."""
    next_state: Any
    """The state after the action."""
    correct: bool
    """Whether the action begins a shortest way to the intended goal, or to any of several. At a goal `noop` does."""
    at_goal: bool
    """Whether the intended goal was reached before the action."""
    distance: int
    """The cost of a shortest way to the intended goal before the action; -1 if none is known."""


class Judge(Protocol):
    """A trainer of your own: any class with this method. There is nothing to inherit; `goodbot.Trainer` is one.

    >>> class Impatient:
    ...     '''Says nothing for three steps, then blames what is wrong.'''
    ...     def judge(self, step):
    ...         return "punish" if step.number >= 3 and not step.correct else None
    >>> home = goodbot.Home.from_map("#########\\n#ggg#rrr#\\n##+###+##\\n#bb@bbbb#\\n#########")
    >>> taught = goodbot.teach(goodbot.Agent(seed=1), home, home.start, "go to the red room", "agentInRoom(agent0,room2)", trainer=Impatient())
    >>> taught.ending, taught.feedback["reward"]
    ('goal', 0)
    """

    def judge(self, step: Step) -> Feedback | None:
        """The trainer's feedback to a step: `reward`, `punish`, or `neutral`, which None means too."""


@dataclass(frozen=True)
class Taught:
    """The result of a lesson."""

    understood: bool
    """Whether the agent set out for the intended task on hearing the command, before any feedback."""
    ending: Literal["goal", "dead end", "too long"]
    """Why it ended."""
    steps: list[tuple[str, Feedback]]
    """The actions and their feedback, in order."""
    state: Any
    """The last state."""
    tasks: list[str]
    """The possible tasks."""
    beliefs: NDArray[np.float32]
    """How probable each task was: shape (steps + 1, tasks), the first row before any step."""
    session: Session | None
    """The lesson as a recorded session; None for a robot of your own class, which no log can describe."""

    @property
    def feedback(self) -> dict[str, int]:
        """How often the trainer gave each feedback: `reward`, `punish` and `neutral`."""
        said = [word for _, word in self.steps]
        return {word: said.count(word) for word in ("reward", "punish", "neutral")}

    def to_frame(self) -> Frame:
        """The beliefs as a frame of pandas: a row for each step, 0 before the first one, and a column for each task."""
        return of_beliefs(self.tasks, self.beliefs)

    def __repr__(self) -> str:
        return f"<goodbot.Taught: {len(self.steps)} steps, ended: {self.ending}>"


def teach(
    agent: Agent,
    domain: Any,
    state: Any,
    command: str,
    intended: str | Sequence[str],
    *,
    trainer: Judge,
    language: LanguageModel | None = None,
    learn: bool = True,
    most_steps: int = 300,
) -> Taught:
    """Gives a lesson: a trainer, perhaps of your own, says a command, judges each action, and the agent learns from it unless `learn=False`.

    `intended` is the task that is meant, or several of which each will do, as for "any block"; then the recorded session does not say what was
    meant. A language model of your own understands and learns in place of the agent's. The lesson ends after `noop` three times in a row at the goal,
    when the goal cannot be reached any more, or after `most_steps` steps.

    Raises `ValueError` if `intended` is no possible task or none, or if an answer of the trainer or the language model is invalid.

    >>> home = goodbot.Home.from_map("#########\\n#ggg#rrr#\\n##+###+##\\n#bb@bbbb#\\n#########")
    >>> agent = goodbot.Agent(seed=1)
    >>> taught = goodbot.teach(agent, home, home.start, "go to the red room", "agentInRoom(agent0,room2)", trainer=goodbot.Trainer(seed=1))
    >>> taught.ending, taught.beliefs.shape == (len(taught.steps) + 1, 2)
    ('goal', True)
    """
    hear(agent, domain, state, command, language=language)
    tasks = agent.tasks
    named = [intended] if isinstance(intended, str) else list(intended)
    strange = [task for task in named if task not in tasks]
    if strange or not named:
        agent.forget()
        raise ValueError(f"{strange[0]} is no task here; there are {', '.join(tasks)}" if strange else "no task is meant; name at least one")
    meant = [tasks.index(task) for task in named]
    start, actions = state, [*domain.actions, "noop"]
    beliefs, steps, rests, understood = [agent.beliefs], list[tuple[str, Feedback]](), 0, False
    while True:
        agent.plan(domain, state)
        plans, distances, sets = agent.plans, agent.distances, agent.optimal_sets(domain)
        # Of several tasks, one that cannot be reached counts only if none can; at the goal of one, it alone counts.
        able = [task for task in meant if distances[task] >= 0] or [task for task in meant if plans[task] != "dead end"] or meant
        nearest = min(able, key=lambda task: distances[task])
        plan = plans[nearest]
        right = np.any(sets[[nearest] if plan == "goal" else able], axis=0)
        if rests == RESTS or plan == "dead end" or len(steps) >= most_steps:
            break
        decision = agent.decide(domain, state)
        if not steps:
            understood = decision.task in meant
        at_goal, correct = plan == "goal", bool(right[actions.index(decision.action)])
        before, state = state, agent.acted(domain, state, decision.action)
        step = Step(
            len(steps), command, tasks[nearest], before, decision.action, state, correct, at_goal, int(distances[nearest])
        )
        word = trainer.judge(step) or "neutral"
        agent.feedback(word)
        steps.append((decision.action, word))
        beliefs.append(agent.beliefs)
        rests = rests + 1 if at_goal and decision.action == "noop" else 0
    session = None
    if isinstance(domain, (Home, World)):
        session = Session(command, domain, steps, state=start, intended=named[0] if len(named) == 1 else None, learn=learn)
    if learn:
        _learn(agent, domain, language=language)
    else:
        agent.forget()
    ending: Literal["goal", "dead end", "too long"] = "goal" if rests == RESTS else "dead end" if plan == "dead end" else "too long"
    return Taught(understood, ending, steps, state, tasks, np.array(beliefs), session)
