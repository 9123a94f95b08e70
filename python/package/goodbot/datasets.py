"""Logs that you fetched, with their checksums, split so that nothing is on both sides.

The package brings no data, and fetches none. Keep the checksums of the fetched files beside your results, so that others know that they
have the same files.

>>> import goodbot, tempfile
>>> from goodbot import datasets
>>> home = goodbot.Home.random(1, "A")
>>> log = tempfile.mkdtemp() + "/log.jsonl"
>>> goodbot.write_log(log, [goodbot.Session(f"go {where}", home, [("noop", "neutral")], id=f"ann.{where}") for where in "abcde"])
>>> data = datasets.load(log, sha256=datasets.checksum(log))
>>> split = data.split(by="command", test=0.4, seed=1)
>>> len(split.train), len(split.test)
(3, 2)
>>> datasets.load(log, sha256="0" * 64)
Traceback (most recent call last):
    ...
ValueError: ...
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, TypeAlias

from ._native import Session, parse_log, words

Group: TypeAlias = Literal["session", "command", "worker", "environment", "task"]


def _worker(session: Session) -> str:
    if session.id is None:
        raise ValueError(f"a session ({session.command!r}) has no id, so its worker is not known; split by another group")
    return session.id.split(".")[0]


def _environment(session: Session) -> str:
    world = session.world
    return session.home.to_json() if world is None else world.to_json()


# The key that the sessions of a group share, as in `goodbot evaluate --group`.
_KEYS: dict[str, Callable[[Session], str]] = {
    "command": lambda session: " ".join(words(session.command)),
    "worker": _worker,
    "environment": _environment,
    "task": lambda session: f"{_environment(session)} {session.intended}",
}


@dataclass(frozen=True)
class Split:
    """Sessions to train on, and others to test on."""

    train: list[Session]
    """To train on."""
    test: list[Session]
    """To test on."""

    @property
    def heard_before(self) -> float:
        """The share of the test sessions whose command, word by word, is also in the training sessions."""
        known = {_KEYS["command"](session) for session in self.train}
        return sum(_KEYS["command"](session) in known for session in self.test) / max(len(self.test), 1)

    def __repr__(self) -> str:
        return f"<goodbot.datasets.Split: {len(self.train)} sessions to train on, {len(self.test)} to test on>"


@dataclass(frozen=True)
class Dataset:
    """The sessions of some logs."""

    sessions: list[Session]
    """All sessions, in the order of the files."""
    sha256: dict[str, str]
    """The checksum of each file, by its name."""

    def split(self, *, by: Group = "command", test: float = 0.2, seed: int = 0) -> Split:
        """Sessions to train on and to test on. No command, worker, environment or task (`by`) is on both sides.

        `test` is the share of the groups to test on, at least one. The choice depends on `seed` and the groups alone, not on the order of the
        sessions. Raises `ValueError` if there are fewer than two groups.
        """
        if not 0.0 < test < 1.0:
            raise ValueError(f"test is {test}; give a share between 0 and 1")
        groups = self._groups(by, seed)
        count = min(max(round(test * len(groups)), 1), len(groups) - 1)
        return self._part(groups, range(count))

    def folds(self, count: int, *, by: Group = "command", seed: int = 0) -> Iterator[Split]:
        """Splits for cross-validation: each group is tested in one of them. Raises `ValueError` if there are fewer groups than folds."""
        groups = self._groups(by, seed)
        if not 2 <= count <= len(groups):
            raise ValueError(f"{count} folds of {len(groups)} groups; give 2 to {len(groups)}")
        return (self._part(groups, range(fold, len(groups), count)) for fold in range(count))

    def _groups(self, by: Group, seed: int) -> list[list[int]]:
        if by != "session" and by not in _KEYS:
            raise ValueError(f"no group is called {by!r}; give {', '.join(['session', *_KEYS])}")
        groups: dict[str, list[int]] = {}
        for position, session in enumerate(self.sessions):
            key = "\n".join(session.lines()) + f" {position}" if by == "session" else _KEYS[by](session)
            groups.setdefault(key, []).append(position)
        if len(groups) < 2:
            raise ValueError(f"there are {len(groups)} groups by {by}, and nothing to train on beside; split by another group")
        drawn = sorted(groups, key=lambda key: hashlib.sha256(f"{seed}\n{key}".encode()).digest())
        return [groups[key] for key in drawn]

    def _part(self, groups: list[list[int]], asked: range) -> Split:
        test = {position for group in asked for position in groups[group]}
        return Split(
            [session for position, session in enumerate(self.sessions) if position not in test],
            [session for position, session in enumerate(self.sessions) if position in test],
        )

    def __repr__(self) -> str:
        return f"<goodbot.datasets.Dataset: {len(self.sessions)} sessions of {', '.join(self.sha256)}>"


def checksum(path: str | os.PathLike[str]) -> str:
    """The SHA-256 of a file, in hexadecimal, as `sha256sum` prints it."""
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


def load(*paths: str | os.PathLike[str], sha256: str | Mapping[str, str] | None = None) -> Dataset:
    """Reads logs. `sha256` is the expected checksum of one file, or of several by their names without folders.

    Raises `ValueError` if a file is another than expected or is not named, `FormatError` if it is no log, and `OSError`.
    """
    if isinstance(sha256, str):
        if len(paths) != 1:
            raise ValueError(f"one checksum is given for {len(paths)} files; give a dict of their names and checksums")
        sha256 = {Path(paths[0]).name: sha256}
    sessions: list[Session] = []
    found: dict[str, str] = {}
    for path in paths:
        data, name = Path(path).read_bytes(), Path(path).name
        if name in found:
            raise ValueError(f"two files are called {name}; give them other names, so that their checksums are told apart")
        found[name] = hashlib.sha256(data).hexdigest()
        expected = found[name] if sha256 is None else sha256.get(name)
        if expected is None:
            raise ValueError(f"{name} has no checksum among those given; add {found[name]}, or leave the file out")
        if expected.lower() != found[name]:
            raise ValueError(f"{os.fspath(path)} is another file than expected: its SHA-256 is {found[name]}, not {expected}; fetch it anew")
        sessions += parse_log(data, file=os.fspath(path))
    return Dataset(sessions, found)
