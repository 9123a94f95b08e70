"""The command line: the program `goodbot`, or `python -m goodbot`."""

from __future__ import annotations

import signal
import sys

from ._native import run_command


def main() -> None:
    """Does what was typed, and ends with its exit code."""
    # Python would only hear of ctrl-C when the command is done.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    sys.exit(run_command(["goodbot", *sys.argv[1:]]))


if __name__ == "__main__":
    main()
