"""Exit statuses of the commands, and how they end with an error message."""

from __future__ import annotations

import errno

import typer
from rich.console import Console

COULD_NOT = 1
UNUSABLE = 2
NOT_GRADED = 3  # something could not be graded, and no student is to blame
FULL_DISK = (
    "course: the disk is full. What was complete before is unharmed.\n"
    "Next: make room, then type the same command again; `course grade` goes on with --resume."
)


def ended(console: Console, reason: object, status: int) -> typer.Exit:
    """Print the reason in red and return what to raise."""
    console.print(str(reason), style="red", markup=False)
    return typer.Exit(status)


def batch_status(*, not_graded: int, complete: bool) -> int:
    """Return the exit status of a batch: what the machine failed to grade comes before anything else incomplete."""
    if not_graded:
        return NOT_GRADED
    return 0 if complete else COULD_NOT


def is_a_full_disk(error: BaseException | None) -> bool:
    """Return whether an error, or one that led to it, says that nothing more can be written: also SQLite's words."""
    while error is not None:
        if getattr(error, "errno", None) in (errno.ENOSPC, errno.EDQUOT) or "disk is full" in str(error):
            return True
        error = error.__cause__ or error.__context__
    return False
