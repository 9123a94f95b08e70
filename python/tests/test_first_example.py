"""The first example of docs/python.md understands words in an order that was never taught."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest


@pytest.mark.parametrize("seed", range(5))
def test_the_first_example_understands_a_new_sentence(
    root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, seed: int
) -> None:
    monkeypatch.chdir(tmp_path)
    example = re.findall(r"```python\n(.*?)```", (root / "docs/python.md").read_text(encoding="utf-8"), re.DOTALL)[0]
    names: dict[str, Any] = {}
    exec(example.replace("seed=1", f"seed={seed}"), names)
    assert names["agent"].most_likely == "agentInRoom(agent0,room2)"
    assert Path("words.goodbot").exists()
