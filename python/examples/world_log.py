"""Commands in a house without a robot: a model learns their meanings, and is tested on commands that it has not seen.

    python world_log.py

A log of worlds is a list of lines. Each command names those before it, so that "it" and "again" are learned too.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import goodbot

ROOMS = ("kitchen", "bath", "hall", "study")
HOUSE: dict[str, Any] = {
    "type": "world",
    "name": "house",
    "classes": ["lamp"],
    "attributes": {"room": ["lamp"]},
    "propositions": {"lampOn": ["lamp"], "lampOff": ["lamp"]},
    "objects": [{"name": f"lamp{number}", "class": "lamp", "attributes": {"room": room}} for number, room in enumerate(ROOMS)],
    "task_kinds": ["lampOn(?lamp)", "lampOff(?lamp)"],
}


def conversations() -> Iterator[dict[str, Any]]:
    """In each conversation a lamp is named, and "it" in the next command is that lamp."""
    for number, room in enumerate(ROOMS):
        for polite in ("", " please", " now"):
            group, before = f"{room}{polite}", list[str]()
            for words, task in ((f"light in the {room}", "lampOn"), ("put it out", "lampOff"), ("again", "lampOn")):
                line = {"type": "command", "world": "house", "id": f"{group} {task} {len(before)}", "group": group, "command": words + polite}
                yield line | {"intended": [f"{task}(lamp{number})"], "before": list(before)}
                before.append(line["id"])


def main() -> None:
    found = goodbot.evaluate([HOUSE, *conversations()])
    for answer in found.answers:
        print(f"{answer['command']:28} {answer['predicted']:16} {answer['probability_predicted']:.2f}  {'right' if answer['right'] else 'wrong'}")
    print(f"{found.summary['right']} of {found.summary['asked']} are right")


if __name__ == "__main__":
    main()
