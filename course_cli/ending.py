"""Exit statuses of the commands, and how they end with an error message."""

from __future__ import annotations

import typer
from rich.console import Console

COULD_NOT = 1
UNUSABLE = 2


def ended(console: Console, reason: object, status: int) -> typer.Exit:
    """Print the reason in red and return what to raise."""
    console.print(str(reason), style="red", markup=False)
    return typer.Exit(status)
