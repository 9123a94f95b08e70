"""Session logs and model files, which all programs of goodbot share."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import numpy as np
import pytest

import goodbot


def test_a_log_is_written_as_it_was_read(root: Path, tmp_path: Path) -> None:
    source = root / "docs/examples/sessions.jsonl"
    sessions = goodbot.read_log(source)
    assert [session.kind for session in sessions]
    file = tmp_path / "again.jsonl"
    goodbot.write_log(file, sessions)
    assert goodbot.read_log(file) == sessions
    with pytest.raises(FileExistsError):
        goodbot.write_log(file, sessions)
    goodbot.write_log(file, sessions, append=True)
    assert len(goodbot.read_log(file)) == 2 * len(sessions)


def test_a_session_begins_on_a_line_of_its_own_though_the_log_was_left_in_the_middle_of_one(root: Path, tmp_path: Path) -> None:
    source = root / "docs/examples/sessions.jsonl"
    sessions = goodbot.read_log(source)
    file = tmp_path / "cut.jsonl"
    file.write_text(source.read_text().rstrip())
    goodbot.write_log(file, sessions, append=True)
    assert len(goodbot.read_log(file)) == 2 * len(sessions)


def test_a_fault_in_a_log_names_file_line_and_field(root: Path, tmp_path: Path) -> None:
    lines = (root / "docs/examples/sessions.jsonl").read_text().splitlines()
    file = tmp_path / "faulty.jsonl"
    file.write_text("\n".join([lines[0], '{"type":"step","action":"north","feedback":"good"}']))
    with pytest.raises(goodbot.FormatError, match='"good" is not known; write reward, punish or neutral') as raised:
        goodbot.read_log(file)
    assert (raised.value.line, raised.value.field) == (2, "feedback")
    assert str(file) in str(raised.value)


def test_a_lesson_is_a_session_that_teaches_the_same(home: goodbot.Home) -> None:
    taught, replayed = goodbot.Agent(seed=1), goodbot.Agent(seed=2)
    for seed in range(3):
        task = home.tasks()[seed % 2]
        lesson = goodbot.Trainer(seed=seed).teach(taught, home, home.start, "go to room number " + "one two three".split()[seed], task)
        assert lesson.session is not None and lesson.session.intended == task
        lesson.session.teach(replayed)
    assert taught.to_bytes() == replayed.to_bytes()


def test_the_command_line_and_this_package_read_each_others_models(root: Path, tmp_path: Path, cli: str) -> None:
    log = root / "docs/examples/sessions.jsonl"
    theirs = tmp_path / "theirs.goodbot"
    subprocess.run([cli, "learn", str(log), "--out", str(theirs)], check=True, capture_output=True)
    agent = goodbot.Agent.load(theirs)
    assert agent.to_bytes() == theirs.read_bytes(), "what is loaded is saved again bit for bit"

    mine = tmp_path / "mine.goodbot"
    agent.save(mine)
    home = goodbot.Home.from_json((root / "docs/examples/home.json").read_text())
    command = "take the yellow bag to the blue room"
    agent.listen(home, home.start, command)
    for model in (theirs, mine):
        ask = [cli, "ask", "--with", str(model), "--environment", str(root / "docs/examples/home.json"), "--json", command]
        answer = json.loads(subprocess.run(ask, check=True, capture_output=True, text=True).stdout.splitlines()[0])
        beliefs = {task["task"]: task["probability"] for task in answer["tasks"]} if isinstance(answer["tasks"], list) else answer["tasks"]
        assert beliefs == {task: pytest.approx(float(p), abs=1e-6) for task, p in zip(agent.tasks, agent.beliefs)}


def test_a_life_by_lines_and_a_life_in_python_come_to_the_same_file(root: Path, tmp_path: Path, cli: str) -> None:
    """The model that `goodbot teach` writes after a session is, bit for bit, the one that the same session makes here."""
    home = goodbot.Home.from_json((root / "docs/examples/home.json").read_text())
    lesson = goodbot.Trainer(seed=3).teach(goodbot.Agent(seed=3), home, home.start, "go to the blue room", home.tasks()[0])
    assert lesson.session is not None
    log = tmp_path / "one.jsonl"
    goodbot.write_log(log, [lesson.session])
    agent = goodbot.Agent()
    lesson.session.teach(agent)
    beliefs = subprocess.run([cli, "replay", str(log), "--json"], check=True, capture_output=True, text=True).stdout
    last = json.loads([line for line in beliefs.splitlines() if '"step"' in line][-1])
    assert set(last["tasks"]) == set(agent.tasks)
    assert last["tasks"] == {task: float(str(p)) for task, p in zip(agent.tasks, agent.beliefs)}


def test_the_course_of_a_seed_is_the_command_lines(cli: str) -> None:
    ran = subprocess.run([cli, "paper", "--seed", "5", "--json"], check=True, capture_output=True, text=True).stdout
    said = json.loads(ran.splitlines()[0])
    rows = goodbot.run_course(5)
    assert isinstance(said, dict) and len(rows) == 12
    steps = [row["steps"] for row in rows if row["kind"] == "lesson"]
    assert str(steps[0]) in json.dumps(said)


# The paper's two kinds of tasks, and each with the ways of `goodbot replay --routes`.
ROUTES = ["agentInRoom(?a,?r)", "blockInRoom(?b,?r)"] + [
    goal + way
    for goal in ("agentInRoom(?a,?r)", "blockInRoom(?b,?r)")
    for way in (
        " through agentInRoom(?a,?v)",
        " avoiding agentInRoom(?a,?v)",
        " through agentInRoom(?a,?v) or agentInRoom(?a,?w)",
    )
]


def test_a_log_with_all_that_logs_may_say_is_believed_as_in_every_other_shell(root: Path) -> None:
    """A prior, strategies with lags, answers, ways, a demonstration, a session that goes on: to the bit as `goodbot replay`."""
    fixtures = root / "tests/fixtures"
    recorded = [json.loads(line) for line in (fixtures / "lesson-beliefs.jsonl").read_text().splitlines()]
    ends = [one for one, after in zip(recorded, recorded[1:] + [{"step": 0}]) if after["step"] == 0]
    sessions = goodbot.read_log(fixtures / "lesson.jsonl")
    agent = goodbot.Agent(tasks=ROUTES)
    for session, end in zip(sessions, ends, strict=True):
        session.teach(agent)
        assert agent.tasks == list(end["tasks"])
        assert agent.beliefs.tobytes() == np.array(list(end["tasks"].values()), np.float32).tobytes()
