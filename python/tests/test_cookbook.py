"""The recipe of docs/cookbook.md for Python."""

from __future__ import annotations

import re
from pathlib import Path

import pytest


def test_the_recipe_works_as_it_is_written(root: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (courses,) = re.findall(r"```python\n(.*?)```", (root / "docs/cookbook.md").read_text(encoding="utf-8"), re.DOTALL)
    exec(courses, {})
    right, of = re.findall(r"(\d+) of (\d+) tests right", capsys.readouterr().out)[-1]
    assert int(of) == 1000 and int(right) > 990
