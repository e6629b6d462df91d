"""The console on which students read: it leaves the wrapping of lines to the terminal or the page."""

from __future__ import annotations

import os
import sys
from typing import Any

from rich.console import Console
from rich.text import Text

FILE_WIDTH = 200  # characters, of tables that go to a file or a pipe; it breaks no path


class LineConsole(Console):
    """A console that breaks no line of text; tables have the width of the terminal, or FILE_WIDTH without one."""

    def __init__(self, **settings: Any) -> None:
        is_file = not sys.stdout.isatty() and "COLUMNS" not in os.environ
        super().__init__(**{"highlight": False, "width": FILE_WIDTH if is_file else None, **settings})

    def print(self, *objects: Any, **settings: Any) -> None:
        """Print texts without breaking them, and other objects at the console's width."""
        is_text = all(isinstance(each, str | Text) for each in objects)
        super().print(*objects, **{"soft_wrap": is_text, **settings})
