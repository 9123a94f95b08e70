"""Logs of worlds, whose commands mean something where no robot acts."""

from __future__ import annotations

import re
import runpy
from pathlib import Path
from typing import Any

import pytest

import goodbot


@pytest.fixture
def example(root: Path) -> dict[str, Any]:
    return runpy.run_path(str(root / "python/examples/world_log.py"))


def test_the_example_understands_it_and_again_from_the_commands_before(example: dict[str, Any], capsys: pytest.CaptureFixture[str]) -> None:
    example["main"]()
    told = capsys.readouterr().out
    assert re.search(r"put it out +lampOff\(lamp\d\)", told)
    right, asked = map(int, re.findall(r"(\d+) of (\d+) are right", told)[0])
    alone = [{key: value for key, value in line.items() if key != "before"} for line in example["conversations"]()]
    without = goodbot.evaluate([example["HOUSE"], *alone]).summary
    assert asked == without["asked"] == 36 and right == 36
    assert without["right"] < 24, "who does not know what was said before has to guess"


def test_a_model_of_a_log_of_worlds_is_learned_kept_and_asked(example: dict[str, Any], tmp_path: Path) -> None:
    log = [example["HOUSE"], *example["conversations"]()]
    model = tmp_path / "house.goodbot"
    assert "again" in goodbot.learn(log, out=model).words
    assert goodbot.evaluate(test=log, with_=model).summary["accuracy"] == 1


def test_what_is_wrong_with_a_line_is_told_by_its_field(example: dict[str, Any]) -> None:
    command = {"type": "command", "world": "house", "id": "1", "command": "again", "intended": ["lampOn(lamp0)"]}
    with pytest.raises(ValueError, match='2: field "before": "0" is no command of a line before'):
        goodbot.evaluate([example["HOUSE"], command | {"before": ["0"]}])
    session = goodbot.Session("go there", goodbot.Home.random(1, "A"), [("noop", "neutral")])
    mixed: list[Any] = [example["HOUSE"], session]
    with pytest.raises(ValueError, match="and not both"):
        goodbot.learn(mixed)
