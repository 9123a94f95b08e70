"""A progress bar for long work, if `tqdm` is installed."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TypeVar

Item = TypeVar("Item")


def progressing(items: Sequence[Item], what: str, *, shown: bool) -> Iterable[Item]:
    """The items, with a bar while they are iterated."""
    if not shown or len(items) < 2:
        return items
    try:
        from tqdm.auto import tqdm  # type: ignore[import-untyped, unused-ignore]
    except ImportError:
        return items
    bar: Iterable[Item] = tqdm(items, desc=what, leave=False)
    return bar
