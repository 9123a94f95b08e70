"""Agents compared with simulated trainers: `goodbot study`, from Python."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from .command import arguments, run
from .frames import frame, of_lines

if TYPE_CHECKING:
    from .frames import Frame


@dataclass(frozen=True)
class Study:
    """The result of `study`."""

    about: dict[str, Any]
    """What was compared: courses, agents with their settings, trainers, seeds."""
    runs: list[dict[str, Any]] = field(repr=False)
    """A course of one agent with one trainer each, with the same fields as `goodbot study --json`."""
    summary: list[dict[str, Any]] = field(repr=False)
    """Means with their 95 % intervals, for each course, trainer and agent."""

    def to_frame(self) -> Frame:
        """The summary as a frame: a row for each course, trainer and agent; `tests_right.mean`, `tests_right.low`, `tests_right.high`."""
        return of_lines(self.summary)

    def runs_to_frame(self) -> Frame:
        """The runs as a frame: a row for each. The columns `tests_right`, `steps`, `words` and `answers` are sums."""
        sums = {"tests": "tests_right", "steps": "steps", "words": "words", "answers": "answers"}
        names = ("seed", "course", "trainer", "agent")
        return frame([{name: row[name] for name in names} | {sums[of]: sum(row[of]) for of in sums} for row in self.runs])

    def __repr__(self) -> str:
        names = ", ".join(agent["name"] for agent in self.about["agents"])
        return f"<goodbot.Study: {len(self.runs)} runs of {names}>"


def study(
    *,
    courses: Sequence[str] | None = None,
    agents: Sequence[str] | None = None,
    trainers: Sequence[str] | None = None,
    runs: int = 100,
    seed: int = 1,
    program: str | os.PathLike[str] | None = None,
    program_runs: int | None = None,
) -> Study:
    """Compares agents that learn from simulated trainers, in courses, with the same seeds for all.

    Without names, all courses, agents and trainers: `goodbot study --help` lists them. `program` is a language model of yours as a program.

    Raises `ValueError` with the command line's message if a name is unknown, and `RuntimeError` if the command fails.

    >>> import goodbot
    >>> found = goodbot.study(courses=["paper"], agents=["goodbot", "paper"], trainers=["balanced"], runs=1)
    >>> [(row["agent"], row["tests_right"]["mean"]) for row in found.summary]
    [('goodbot', 5.0), ('paper', 5.0)]
    """
    named = {"courses": courses, "agents": agents, "trainers": trainers}
    lists = {name: ",".join([names] if isinstance(names, str) else names) for name, names in named.items() if names is not None}
    options = {**lists, "runs": runs, "seed": seed, "program": program, "program_runs": program_runs}
    about, *lines = map(json.loads, run("study", "--json", "--quiet", *arguments(options)).splitlines())
    return Study(about, [line for line in lines if line["type"] == "run"], [line for line in lines if line["type"] == "summary"])
