"""The command line of the package, and evaluation by it."""

from __future__ import annotations

import inspect
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import goodbot


def typed(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-m", "goodbot", *arguments], capture_output=True, text=True, check=False)


def test_the_package_is_the_command_line_too() -> None:
    said = typed("--version")
    assert (said.returncode, said.stdout) == (0, f"goodbot {goodbot.__version__}\n")
    assert typed("no-such-command").returncode == 2
    script = Path(sys.executable).with_name("goodbot")
    assert subprocess.run([script, "example", "home"], capture_output=True, check=True).stdout


def test_an_evaluation_is_the_command_lines_to_the_digit(root: Path) -> None:
    log = root / "docs/examples/sessions.jsonl"
    found = goodbot.evaluate(log, leave_one_out=True, learner="roles")
    printed = subprocess.run(
        [os.environ["GOODBOT_CLI"], "evaluate", "--json", "--leave-one-out", "--learner", "roles", log],
        capture_output=True,
        text=True,
        check=True,
    )
    assert [*found.answers, found.summary] == [json.loads(line) for line in printed.stdout.splitlines()]
    assert goodbot.evaluate(goodbot.read_log(log), leave_one_out=True, learner="roles") == found


def test_one_log_is_learned_from_and_another_is_asked(root: Path) -> None:
    log = root / "docs/examples/sessions.jsonl"
    found = goodbot.evaluate(log, test=log, learner="roles")
    assert len(found.answers) == 4
    assert goodbot.evaluate(log, test=goodbot.read_log(log), learner="roles") == found


def test_what_is_wrong_with_an_evaluation_is_told_in_the_command_lines_words(root: Path, tmp_path: Path) -> None:
    log = root / "docs/examples/sessions.jsonl"
    with pytest.raises(ValueError, match="from 2 to 65535"):
        goodbot.evaluate(log, k_fold=1)
    with pytest.raises(ValueError, match="missing.jsonl"):
        goodbot.evaluate(tmp_path / "missing.jsonl")
    with pytest.raises(TypeError, match="no_such_option"):
        goodbot.evaluate(log, no_such_option=1)  # type: ignore[call-arg]
    with pytest.raises(ValueError, match="are one option"):
        goodbot.evaluate(log, k_fold=2, kfold=2)


def options_of(command: str) -> set[str]:
    """The long options of a command, as Python writes them."""
    return {flag.replace("-", "_") for flag in re.findall(r"--([a-z][a-z-]+)(?: <| *\n)", typed(command, "--help").stdout)}


def test_each_option_of_the_command_line_is_a_parameter() -> None:
    shown = {"quiet", "color", "json", "help", "keep_going"}
    given = set(inspect.signature(goodbot.evaluate).parameters)
    # A table, which is for people.
    assert options_of("evaluate") - shown - {"ablation", "with"} == given - {"train", "kfold", "keep_going", "with_"}
    given = set(inspect.signature(goodbot.learn).parameters)
    # An agent must know its kinds of tasks, too: `tasks` names them.
    assert options_of("learn") - shown - {"task", "routes", "only_these_tasks"} == given - {"log", "tasks", "domain", "seed", "keep_going"}


def test_k_fold_has_two_spellings(root: Path) -> None:
    log = root / "docs/examples/sessions.jsonl"
    assert goodbot.evaluate(log, kfold=2, learner="roles") == goodbot.evaluate(log, k_fold=2, learner="roles")
