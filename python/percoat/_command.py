"""The program ``percoat``."""

from __future__ import annotations

import sys


def main() -> int:
    """Run the command line; the exit code."""
    from percoat._core import main as run

    return run(["percoat", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
