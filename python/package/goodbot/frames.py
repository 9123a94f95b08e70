"""Results as data frames of pandas (`pip install 'goodbot[pandas]'`)."""

# mypy: disable-error-code="import-untyped"

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

# A pandas.DataFrame, which comes without types.
Frame: TypeAlias = Any


def frame(rows: Sequence[Mapping[str, Any]] | NDArray[np.float32], **settings: Any) -> Frame:
    """A frame of rows, or of an array."""
    try:
        import pandas
    except ImportError:
        raise ImportError("a data frame needs pandas: pip install 'goodbot[pandas]'") from None
    return pandas.DataFrame(rows, **settings)


def of_lines(lines: Sequence[Mapping[str, Any]]) -> Frame:
    """Lines of the command line's output: a row for each."""
    return frame([{name: value for name, value in flat(line).items() if name != "type"} for line in lines])


def flat(row: Mapping[str, Any], before: str = "") -> dict[str, Any]:
    """A row whose dicts are columns of their own, such as `tests_right.mean`, and whose intervals are two."""
    columns: dict[str, Any] = {}
    for name, value in row.items():
        if isinstance(value, Mapping):
            columns |= flat(value, f"{before}{name}.")
        elif name == "interval" and isinstance(value, list) and len(value) == 2:
            columns |= {f"{before}low": value[0], f"{before}high": value[1]}
        else:
            columns[before + name] = value
    return columns


def of_beliefs(tasks: Sequence[str], beliefs: NDArray[np.float32]) -> Frame:
    """Beliefs: a row for each step, 0 before the first one, and a column for each task."""
    made = frame(beliefs, columns=list(tasks))
    made.index.name = "step"
    made.columns.name = "task"
    return made
