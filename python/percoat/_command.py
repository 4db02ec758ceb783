"""The program ``percoat``."""

from __future__ import annotations

import signal
import sys


def main() -> int:
    """Run the command line; the exit code. Once a process: it ends by itself on Ctrl-C, and keeps its threads."""
    from percoat._core import main as run

    # Python would note Ctrl-C and go on until the command is done; what is ignored, as under nohup, stays so.
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    return run(["percoat", *sys.argv[1:]])
