"""Exit statuses of the commands, and their error messages."""

from __future__ import annotations

import errno

import typer
from rich.console import Console

from ros_runtime.course_error import COMMAND_FAILED, UNUSABLE

__all__ = ["COMMAND_FAILED", "NOT_GRADED", "UNUSABLE", "batch_status", "error_exit", "user_message"]

NOT_GRADED = 3  # the grader could not judge a submission
FULL_DISK = (
    "course: the disk is full. Files that were complete before are intact.\n"
    "Next: make room, then type the same command again; `course grade` continues with --resume."
)
NO_PERMISSION = (
    "course: no permission for {path}.\n"
    "Next: give a folder that you can write to with --out, or change into one, then type the same command again."
)


def error_exit(console: Console, reason: object, status: int) -> typer.Exit:
    """Print the reason in red, and return the exception to raise."""
    console.print(str(reason), style="red", markup=False, soft_wrap=True)
    return typer.Exit(status)


def batch_status(*, not_graded: int, complete: bool) -> int:
    """Return a batch's exit status: 3 if a submission is not graded, else 1 if the batch is incomplete, else 0."""
    if not_graded:
        return NOT_GRADED
    return 0 if complete else COMMAND_FAILED


def user_message(error: BaseException) -> str:
    """Return the message if the error or one of its causes is a full disk or a missing permission; else ""."""
    causes = [error]
    while (cause := causes[-1].__cause__ or causes[-1].__context__) is not None:
        causes.append(cause)
    if any(map(_is_a_full_disk, causes)):
        return FULL_DISK
    denied = next((each for each in causes if isinstance(each, PermissionError) and each.filename), None)
    return NO_PERMISSION.format(path=denied.filename) if denied else ""


def _is_a_full_disk(error: BaseException) -> bool:
    """Return whether an error, which may be SQLite's, means that the disk or the quota is full."""
    return getattr(error, "errno", None) in (errno.ENOSPC, errno.EDQUOT) or "disk is full" in str(error)
