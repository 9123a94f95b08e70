"""The analysis of a study with people, written before the data: see docs/appendix/preregistration.md.

    python preregistered_analysis.py --simulate 40 data      simulated people, to try the analysis
    python preregistered_analysis.py data                    the analysis
    python preregistered_analysis.py --power 40              how often a difference such as the simulated one would be found

`data` has a folder for each of two conditions, and there a file for each person: a session log, `data/paper/p01.jsonl`, in which sessions that
are not to be learned are tests, or the table that the page saves, `data/paper/p01.csv`, which has lessons and tests. The page's log has no tests.
"""

from __future__ import annotations

import argparse
import csv
import json
import random
import tempfile
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Literal, get_args

import numpy as np

import goodbot

Condition = Literal["paper", "roles"]
CONDITIONS: tuple[Condition, ...] = get_args(Condition)
# A person who gave fewer lessons, or said fewer words, is left out.
LEAST_LESSONS, LEAST_WORDS = 5, 1
DRAWS, ALPHA, SEED = 10_000, 0.05, 20_260


@dataclass(frozen=True)
class Person:
    """The measures of a person."""

    condition: str
    name: str
    lessons: int
    words: int
    """How often the person said good bot or bad bot."""
    understood: float
    """The primary measure: the share of the tests whose intended task is the most probable before any action."""

    @property
    def is_left_out(self) -> bool:
        """Whether the rules of exclusion hold."""
        return self.lessons < LEAST_LESSONS or self.words < LEAST_WORDS


def measured(log: Path, condition: Condition) -> Person:
    """Replays the log of a person with the robot of the condition."""
    posteriors = goodbot.posteriors(log, goodbot.Agent(learner=condition))
    lessons = [one.session for one in posteriors if one.session.learn]
    tests = [one for one in posteriors if not one.session.learn]
    if not tests:
        raise ValueError(f"{log} has no tests: sessions with an intended task that are not to be learned from; the page has them in its table")
    words = sum(word in ("reward", "punish") for session in lessons for _, word in session.steps)
    right = [one.tasks[int(one.beliefs[0].argmax())] == one.session.intended for one in tests]
    return Person(condition, log.stem, len(lessons), words, sum(right) / len(right))


def tabled(table: Path, condition: Condition) -> Person:
    """Reads the table of a person: a row for each step of a lesson, and one for each test, with the most probable task before any action."""
    with table.open(encoding="utf-8-sig", newline="") as file:
        # Programs for tables write semicolons where the comma is for decimals.
        separator = ";" if ";" in file.readline() else ","
        file.seek(0)
        reader = csv.DictReader(file, delimiter=separator)
        if not {"session", "kind", "meant", "understood", "feedback"} <= set(reader.fieldnames or []):
            raise ValueError(f"{table} is no table of the page")
        rows = list(reader)
    tests = [row for row in rows if row["kind"] == "test"]
    if not tests:
        raise ValueError(f"{table} has no tests")
    lessons = {row["session"] for row in rows if row["kind"] == "lesson"}
    words = sum(row["feedback"] in ("reward", "punish") for row in rows)
    right = [row["understood"] == row["meant"] for row in tests]
    return Person(condition, table.stem, len(lessons), words, sum(right) / len(right))


def people(data: Path) -> list[Person]:
    """All people, in the order of their names."""
    found: list[Person] = []
    for condition in CONDITIONS:
        files = sorted(file for file in (data / condition).glob("*") if file.suffix in (".csv", ".jsonl"))
        for one, next_one in zip(files, files[1:], strict=False):
            if one.stem == next_one.stem:
                raise ValueError(f"{one.stem} has both a log and a table; keep one of them in {data / condition}")
        found += [tabled(file, condition) if file.suffix == ".csv" else measured(file, condition) for file in files]
    for condition in CONDITIONS:
        if not any(person.condition == condition for person in found):
            raise ValueError(f"{data / condition} has no logs and no tables; the analysis compares {' and '.join(CONDITIONS)}")
    return found


def compared(found: Sequence[Person]) -> dict[str, float | int]:
    """The difference of the conditions' means, its 95 % interval (bootstrap over people), and the p of a two-sided permutation test."""
    taken = [person for person in found if not person.is_left_out]
    first, second = (np.array([person.understood for person in taken if person.condition == condition]) for condition in CONDITIONS)
    if not len(first) or not len(second):
        raise ValueError("all people of a condition are left out")
    draw = np.random.default_rng(SEED)
    difference = float(second.mean() - first.mean())
    both = np.concatenate([first, second])
    shuffled = np.array([draw.permutation(both) for _ in range(DRAWS)])
    permuted = shuffled[:, len(first) :].mean(axis=1) - shuffled[:, : len(first)].mean(axis=1)
    means = [draw.choice(group, (DRAWS, len(group))).mean(axis=1) for group in (first, second)]
    low, high = np.quantile(means[1] - means[0], [0.025, 0.975])
    return {
        CONDITIONS[0]: float(first.mean()),
        CONDITIONS[1]: float(second.mean()),
        "people": len(taken),
        "left_out": len(found) - len(taken),
        "difference": difference,
        "low": float(low),
        "high": float(high),
        "p": float((1 + np.sum(abs(permuted) >= abs(difference) - 1e-12)) / (DRAWS + 1)),
    }


def simulate(count: int, data: Path, seed: int = 1) -> None:
    """Writes the logs of simulated people: half of them in each condition, each silent and mistaken to a different degree."""
    for number in range(count):
        draw, condition = random.Random(seed * 1_000_003 + number), CONDITIONS[number % len(CONDITIONS)]
        kind = (draw.uniform(0.9, 1.0), draw.uniform(0.9, 1.0), draw.uniform(0.1, 0.4))
        agent, trainer = goodbot.Agent(learner=condition, seed=number), goodbot.Trainer(kind, seed=draw.randrange(1 << 30))
        sessions: list[goodbot.Session] = []
        for at, exercise in enumerate(goodbot.exercises(draw.randrange(1 << 30))):
            home, command, intended, name = exercise["home"], exercise["command"], exercise["intended"], f"p{number:03}.{at}"
            learn = exercise["kind"] == "lesson"
            # A test is measured before any action.
            steps: list[tuple[str, str | None]] = [] if learn else [("noop", "neutral")]
            if learn:
                steps += goodbot.teach(agent, home, home.start, command, intended, trainer=trainer).steps
            sessions.append(goodbot.Session(command, home, steps, learn=learn, id=name, intended=intended))
        (data / condition).mkdir(parents=True, exist_ok=True)
        goodbot.write_log(data / condition / f"p{number:03}.jsonl", sessions)


def power(count: int, studies: int) -> float:
    """The share of simulated studies of this many people in which p is below alpha."""
    found = 0
    for study in range(studies):
        with tempfile.TemporaryDirectory() as folder:
            simulate(count, Path(folder), seed=study + 2)
            found += compared(people(Path(folder)))["p"] < ALPHA
    return found / studies


def main() -> None:
    """Simulates people, or analyses a study."""
    parser = argparse.ArgumentParser(description="The analysis of a study with people, written before the data")
    parser.add_argument("--simulate", type=int, metavar="PEOPLE", help="write logs of simulated people")
    parser.add_argument("--power", type=int, metavar="PEOPLE", help="how often a difference such as the simulated one would be found")
    parser.add_argument("--studies", type=int, default=50, help="how many studies are simulated for --power")
    parser.add_argument("data", nargs="?", type=Path, help="the folder of the logs")
    options = parser.parse_args()
    if options.power:
        print(f"p < {ALPHA} in {power(options.power, options.studies):.0%} of {options.studies} studies of {options.power} people")
        return
    if options.data is None:
        parser.error("name the folder of the logs")
    if options.simulate:
        simulate(options.simulate, options.data)
        return
    try:
        found = people(options.data)
        result = compared(found)
    except ValueError as fault:
        parser.error(str(fault))
    for person in found:
        print(json.dumps({**asdict(person), "left_out": person.is_left_out}))
    print(json.dumps(result))


if __name__ == "__main__":
    main()
