"""The bridge of docs/teach.md, a program that teaches by the protocol, works as it is written."""

from __future__ import annotations

import os
import re
from pathlib import Path

import pytest


def test_the_bridge_teaches_its_task(
    root: Path, cli: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (bridge,) = re.findall(r"```python\n(.*?)```", (root / "docs/teach.md").read_text(encoding="utf-8"), re.DOTALL)
    monkeypatch.setenv("PATH", str(Path(cli).parent), prepend=os.pathsep)
    # Whoever runs the tests keeps the robot of their own.
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    exec(bridge, {})
    *steps, finished = capsys.readouterr().out.splitlines()
    assert any(" for go to the red room" in step for step in steps)
    assert "'learned': True" in finished
