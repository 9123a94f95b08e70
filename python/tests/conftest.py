"""Fixtures of several tests: the repository's folder, and the command line that was built."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

import goodbot

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def root() -> Path:
    """The repository's top folder."""
    return ROOT


@pytest.fixture(scope="session")
def cli() -> str:
    """The command line `goodbot`, which `cargo xtask test` builds and names."""
    program = os.environ.get("GOODBOT_CLI")
    if not program:
        pytest.skip("the variable GOODBOT_CLI names no command line to compare with")
    return program


@pytest.fixture
def home() -> goodbot.Home:
    """Three rooms and a blue chair."""
    return goodbot.Home.from_map(
        """
#########
#ggg#rrr#
#ggg#rrr#
#ggg#rrr#
##+###+##
#bbbbbbb#
#bC@bbbb#
#bbbbbbb#
#########
C: blue chair
"""
    )
