"""The examples in the docstrings run, and everything that is public has a docstring."""

from __future__ import annotations

import doctest
import inspect
import types
from collections.abc import Iterator

import pytest

import goodbot
import goodbot.domain
import goodbot.experiment
import goodbot.logs
import goodbot.minigrid
import goodbot.sklearn


def documented() -> Iterator[tuple[str, str]]:
    """Each public name of the package and of its classes, with its docstring."""
    yield "goodbot", goodbot.__doc__ or ""
    things = {name: getattr(goodbot, name) for name in goodbot.__all__}
    for module in (goodbot.minigrid, goodbot.sklearn):
        own = {name: thing for name, thing in vars(module).items() if getattr(thing, "__module__", None) == module.__name__}
        things |= {f"{module.__name__}.{name}": thing for name, thing in own.items() if not name.startswith("_")}
    for name, thing in things.items():
        if isinstance(thing, str):
            continue
        yield name, inspect.getdoc(thing) or ""
        if isinstance(thing, type):
            for member, value in vars(thing).items():
                if not member.startswith("_") and not isinstance(value, types.MemberDescriptorType):
                    yield f"{name}.{member}", inspect.getdoc(value) or ""


@pytest.mark.parametrize(("name", "text"), list(documented()))
def test_the_docstring_says_something_and_its_examples_run(name: str, text: str) -> None:
    assert text.strip(), f"{name} has no docstring"
    example = doctest.DocTestParser().get_doctest(text, {"goodbot": goodbot}, name, None, 0)
    results = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS).run(example)
    assert results.failed == 0


def test_there_are_examples() -> None:
    assert sum(">>>" in text for _, text in documented()) >= 15


def test_the_help_of_hear_names_the_call_that_learns_a_label() -> None:
    said = " ".join((goodbot.Agent.hear.__doc__ or "").split())
    assert "after a prior alone it learns nothing" in said and "call `told`" in said
