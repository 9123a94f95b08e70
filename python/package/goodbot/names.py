"""The names of settings and answers, as types."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Literal, TypeAlias

from ._native import Session

# mu+, mu-, epsilon, and how probable the strategy is.
Strategy: TypeAlias = tuple[float, float, float, float]
# A trainer's name, or its mu+, mu- and epsilon.
Kind: TypeAlias = "Literal['balanced', 'punish-only', 'reward-only'] | tuple[float, float, float]"
Learner: TypeAlias = Literal["default", "roles", "paper", "smoothed"]
Weights: TypeAlias = Literal["paper", "belief", "evidence"]
Feedback: TypeAlias = Literal["reward", "punish", "neutral"]
Evidence: TypeAlias = Literal["used", "says nothing", "impossible"]
Plan: TypeAlias = Literal["goal", "toward", "dead end", "approximate", "unknown"]
# What words ask for.
Said: TypeAlias = Literal["command", "reward", "punish", "finish", "answer", "correction", "stop", "undo", "again", "nothing"]
# A preset of capacities, or sizes that differ from `standard`.
Sizes: TypeAlias = "str | Mapping[str, int]"
# A log: its file, its sessions, or the lines of a log of worlds.
Log: TypeAlias = "str | os.PathLike[str] | Iterable[Session] | Iterable[Mapping[str, Any]]"
# What sessions that stay together have in common.
Group: TypeAlias = Literal["worker", "environment", "task", "command", "logged"]
# The learners that `evaluate` compares.
Compared: TypeAlias = Literal["default", "roles", "paper"]
# Everyday sentences to begin with.
Starter: TypeAlias = Literal["de", "en", "es", "fr", "zh"]
# What a robot in MiniGrid can be asked to do.
Skill: TypeAlias = Literal["goto", "pickup", "open", "putnext", "reach"]
# The value of an option of the command line.
Option: TypeAlias = "bool | int | float | str | os.PathLike[str] | Sequence[str]"
