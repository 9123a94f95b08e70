"""Registers the environments with Gymnasium, if that is installed. Their code is loaded when one is made."""

from __future__ import annotations

# Steps after which an episode is cut short, unless another number is asked for.
MOST_STEPS = 300
# A world from a file or a log of worlds.
WORLD = "goodbot/World-v0"
# The other ids, each with its home of the course.
IDS = {"goodbot/Home-v0": "Test", "goodbot/Rooms-v0": "A", "goodbot/Block-v0": "D"}


def register() -> None:
    """Registers the ids."""
    try:
        import gymnasium
    except ImportError:
        return
    if WORLD not in gymnasium.registry:
        gymnasium.register(WORLD, entry_point="goodbot.gym:WorldEnv", max_episode_steps=MOST_STEPS)
    for name, home in IDS.items():
        if name not in gymnasium.registry:
            gymnasium.register(
                name,
                entry_point="goodbot.gym:HomeEnv",
                vector_entry_point="goodbot.gym:HomeVectorEnv",
                max_episode_steps=MOST_STEPS,
                kwargs={"name": home},
            )
