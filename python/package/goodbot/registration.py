"""Registers the environments with Gymnasium, if that is installed. Their code is loaded when one is made."""

from __future__ import annotations

# The ids, each with its home of the course.
IDS = {"goodbot/Home-v0": "Test", "goodbot/Rooms-v0": "A", "goodbot/Block-v0": "D"}


def register() -> None:
    """Registers the ids."""
    try:
        import gymnasium
    except ImportError:
        return
    for name, home in IDS.items():
        if name not in gymnasium.registry:
            # The environments count their own steps, so that one and many are truncated in the same way.
            gymnasium.register(
                name,
                entry_point="goodbot.gym:HomeEnv",
                vector_entry_point="goodbot.gym:HomeVectorEnv",
                kwargs={"name": home},
            )
