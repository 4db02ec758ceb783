"""``python -m percoat``: the program."""

from __future__ import annotations

import sys

from percoat._command import main

if __name__ == "__main__":
    sys.exit(main())
