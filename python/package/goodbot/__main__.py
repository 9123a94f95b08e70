"""The command line: the program `goodbot`, or `python -m goodbot`."""

from __future__ import annotations

import signal
import sys

from ._native import run_command


def main() -> None:
    """Runs the command line, and ends with its exit code."""
    # Python's own handler would run only after the command.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    sys.exit(run_command(["goodbot", *sys.argv[1:]]))


if __name__ == "__main__":
    main()
