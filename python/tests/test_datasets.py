"""Logs with checksums, split so that nothing is on both sides; beliefs in them, and learning from them."""

from __future__ import annotations

import doctest
import json
import runpy
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import goodbot
from goodbot import datasets


@pytest.fixture
def log(root: Path) -> Path:
    return root / "tests/fixtures/lesson.jsonl"


@pytest.fixture
def data(tmp_path: Path) -> datasets.Dataset:
    """Twelve sessions of four people with six commands in three homes."""
    homes = [goodbot.Home.random(seed, "A") for seed in range(3)]
    sessions = [
        goodbot.Session(f"Go to {number % 6}", homes[number % 3], [("noop", "neutral")], id=f"{'abcd'[number % 4]}.{number}", intended=homes[number % 3].tasks()[0])
        for number in range(12)
    ]
    goodbot.write_log(tmp_path / "data.jsonl", sessions)
    return datasets.load(tmp_path / "data.jsonl")


def test_its_own_examples_run() -> None:
    assert doctest.testmod(datasets, optionflags=doctest.ELLIPSIS).failed == 0


def test_the_datasets_are_there_once_goodbot_is_imported() -> None:
    subprocess.run([sys.executable, "-c", "import goodbot; goodbot.datasets.load"], check=True)


def test_a_file_that_was_changed_is_refused_with_both_checksums(log: Path, tmp_path: Path) -> None:
    expected = datasets.checksum(log)
    assert datasets.load(log, sha256=expected.upper()).sha256 == {log.name: expected}
    changed = tmp_path / log.name
    changed.write_bytes(log.read_bytes() + b"\n")
    with pytest.raises(ValueError, match=f"its SHA-256 is {datasets.checksum(changed)}, not {expected}; fetch it anew"):
        datasets.load(changed, sha256=expected)
    with pytest.raises(ValueError, match="has no checksum among those given"):
        datasets.load(log, sha256={"other.jsonl": expected})
    with pytest.raises(ValueError, match="two files are called"):
        datasets.load(log, changed)


@pytest.mark.parametrize(("by", "key"), [("command", "command"), ("worker", "id"), ("environment", "home")])
def test_nothing_is_on_both_sides_of_a_split(data: datasets.Dataset, by: datasets.Group, key: str) -> None:
    def of(sessions: list[goodbot.Session]) -> set[str]:
        values = (getattr(session, key) for session in sessions)
        return {value.to_json() if key == "home" else value.split(".")[0] for value in values}

    for split in [data.split(by=by, test=0.3, seed=1), *data.folds(3, by=by)]:
        assert split.train and split.test and not of(split.train) & of(split.test)
    asked = [session.id for split in data.folds(3, by=by) for session in split.test]
    assert sorted(map(str, asked)) == sorted(str(session.id) for session in data.sessions)


def test_a_split_does_not_depend_on_the_order_of_sessions(data: datasets.Dataset) -> None:
    turned = datasets.Dataset(data.sessions[::-1], data.sha256)
    first, second = data.split(by="worker", seed=3), turned.split(by="worker", seed=3)
    assert {session.id for session in first.test} == {session.id for session in second.test}


def test_a_split_tells_how_many_commands_were_heard_before(data: datasets.Dataset) -> None:
    assert data.split(by="command").heard_before == 0.0
    assert 0.0 < data.split(by="session", test=0.5).heard_before <= 1.0


def test_what_cannot_be_split_is_refused(data: datasets.Dataset) -> None:
    one = datasets.Dataset(data.sessions[:1], {})
    with pytest.raises(ValueError, match="there are 1 groups by command"):
        one.split()
    with pytest.raises(ValueError, match="99 folds of 4 groups; give 2 to 4"):
        data.folds(99, by="worker")
    with pytest.raises(ValueError, match="test is 1.5"):
        data.split(test=1.5)


def test_posteriors_of_a_log_are_those_of_replay(root: Path, cli: str) -> None:
    file = root / "docs/examples/sessions.jsonl"
    lines = subprocess.run([cli, "replay", str(file), "--json"], check=True, capture_output=True, text=True).stdout.splitlines()
    told = [json.loads(line) for line in lines if '"step"' in line]
    rows = [dict(zip(one.tasks, row)) for one in goodbot.posteriors(file) for row in one.beliefs]
    assert [{task: float(str(p)) for task, p in row.items()} for row in rows] == [line["tasks"] for line in told]
    assert all(np.isclose(one.beliefs.sum(axis=1), 1.0, atol=1e-5).all() for one in goodbot.posteriors(file))


def test_what_is_learned_from_a_log_is_what_the_command_line_learns(log: Path, root: Path, tmp_path: Path, cli: str) -> None:
    file = root / "docs/examples/sessions.jsonl"
    subprocess.run([cli, "learn", str(file), "--learner", "roles", "--out", str(tmp_path / "a")], check=True, capture_output=True)
    agent = goodbot.learn(file, learner="roles")
    assert agent.to_bytes() == (tmp_path / "a").read_bytes()
    with pytest.raises(ValueError, match="invalid value 'clever' for '--learner"):
        goodbot.learn(file, learner="clever")  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="routes"):
        goodbot.learn(file, routes=True)  # type: ignore[call-arg]


def test_the_preregistered_analysis_runs_on_simulated_people(root: Path, tmp_path: Path) -> None:
    example = runpy.run_path(str(root / "python/examples/preregistered_analysis.py"))
    example["simulate"](6, tmp_path)
    found = example["people"](tmp_path)
    assert [person.condition for person in found] == ["paper"] * 3 + ["roles"] * 3
    assert all(person.lessons == 7 and 0.0 <= person.understood <= 1.0 for person in found)
    result = example["compared"](found)
    assert result["people"] + result["left_out"] == 6 and result["low"] <= result["difference"] <= result["high"] and 0.0 < result["p"] <= 1.0
    assert result == example["compared"](found), "the same data give the same numbers"
    with pytest.raises(ValueError, match="has no logs and no tables; the analysis compares paper and roles"):
        example["people"](tmp_path / "paper")


def test_the_preregistered_analysis_reads_the_tables_of_the_page(root: Path, tmp_path: Path) -> None:
    example = runpy.run_path(str(root / "python/examples/preregistered_analysis.py"))
    head = "session,kind,command,home,meant,heard,understood,right,guess,step,action,feedback,robot"
    lesson = '1,lesson,"go, robot",A,task0,0.3,,,,{},east,{},Ada'
    test = "{},test,go,Test,task0,{},{},{},,,,,Ada"
    lines = [head, lesson.format(1, "reward"), lesson.format(2, "punish"), lesson.format(3, "neutral")]
    # The intended task is the most probable one in two of three tests, even where the page does not count it.
    lines += [test.format(2, 0.9, "task0", "yes"), test.format(3, 0.4, "task0", "no"), test.format(4, 0.2, "task1", "no")]
    for condition, separator in (("paper", ","), ("roles", ";")):
        (tmp_path / condition).mkdir()
        text = "\r\n".join(lines).replace('"go, robot"', "go").replace(",", separator) + "\r\n"
        (tmp_path / condition / "Ada.csv").write_bytes(b"\xef\xbb\xbf" + text.encode())
    for person in example["people"](tmp_path):
        assert (person.name, person.lessons, person.words, person.understood) == ("Ada", 1, 2, 2 / 3)
    (tmp_path / "paper/Bea.csv").write_text(head + "\n" + lesson.format(1, "reward") + "\n")
    with pytest.raises(ValueError, match="Bea.csv has no tests"):
        example["people"](tmp_path)
    (tmp_path / "paper/Bea.csv").write_text("a,b\n1,2\n")
    with pytest.raises(ValueError, match="Bea.csv is no table of the page"):
        example["people"](tmp_path)
    (tmp_path / "paper/Bea.csv").rename(tmp_path / "paper/Ada.jsonl")
    with pytest.raises(ValueError, match="Ada has both a log and a table"):
        example["people"](tmp_path)
