"""Warnings, and how they reach the line of the user."""

from __future__ import annotations

import os
import sys
import warnings
from pathlib import Path
from types import FrameType
from typing import Any, Iterable, Optional

HERE = str(Path(__file__).parent) + os.sep


class PercoatWarning(UserWarning):
    """What a reader should know before trusting the numbers."""


class NotConverged(PercoatWarning):
    """Something has not converged, or an accuracy was not reached; everything computed is there, and marked."""


def warn(messages: Iterable[str], category: type[Warning] = PercoatWarning) -> None:
    """Warn at the line that called this package."""
    level = 1
    frame: Optional[FrameType] = sys._getframe()
    while frame is not None and frame.f_code.co_filename.startswith(HERE):
        level, frame = level + 1, frame.f_back
    for message in messages:
        warnings.warn(message, category, stacklevel=level)


def warn_of(answer: Any, unsettled: str) -> None:
    """Warn of the doubts of an answer, and with ``unsettled`` where it has not converged."""
    warn(answer.warnings)
    if not answer.converged:
        warn([unsettled], NotConverged)
