"""The console on which students read: it breaks lines between words, in colours for a light and a dark terminal."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Iterator
from typing import Any

from rich.cells import cell_len
from rich.console import Console
from rich.text import Text

from ros_runtime.terminal import is_terminal

FILE_WIDTH = 200  # characters, of tables that go to a file or a pipe; it breaks no path
# Legible on a white and on a black background; each style repeats what a word or a mark says.
GOOD, BAD, NOTICE, OTHER = "green", "bold red", "bold", "bold blue"


class LineConsole(Console):
    """A console whose lines are broken between words in a terminal, and nowhere in a file, a pipe or a notebook.

    Tables have the width of the terminal, or FILE_WIDTH without one.
    """

    def __init__(self, **settings: Any) -> None:
        stream = sys.stderr if settings.get("stderr") else sys.stdout
        is_file = not stream.isatty() and "COLUMNS" not in os.environ
        super().__init__(**{"highlight": False, "width": FILE_WIDTH if is_file else None, **settings})

    def print(self, *objects: Any, **settings: Any) -> None:
        """Print texts, whose lines are broken between words, and other objects at the console's width.

        In a file, the lines of other objects have no blanks at their ends.
        """
        is_text = all(isinstance(each, str | Text) for each in objects)
        if objects and is_text and is_terminal(self.file):
            markup = settings.pop("markup", None)
            texts = [
                self.render_str(each, markup=markup) if isinstance(each, str) else each for each in objects
            ]
            objects = (wrapped(Text(" ").join(texts), self.width),)
        if is_text or self.is_terminal:
            super().print(*objects, **{"soft_wrap": is_text, **settings})
            return
        with self.capture() as captured:
            super().print(*objects, **settings)
        print(re.sub(r" +$", "", captured.get(), flags=re.MULTILINE), end="", file=self.file)


def wrapped(text: Text, width: int) -> Text:
    """Return a text whose lines are broken between words at a width (characters); each part has the line's indent.

    A word that is longer than that, such as a path, stays whole.
    """
    return Text("\n").join(part for line in text.split(allow_blank=True) for part in _parts(line, width))


def _parts(line: Text, width: int) -> Iterator[Text]:
    breaks: list[int] = []
    indent = " " * (len(line.plain) - len(line.plain.lstrip(" ")))
    used = 0
    for word in re.finditer(r"\s*(\S+)", line.plain):
        if used and used + cell_len(word[0]) > width:
            breaks.append(word.start(1))
            used = len(indent) + cell_len(word[1])
        else:
            used += cell_len(word[0])
    for start, part in zip([0, *breaks], line.divide(breaks), strict=True):
        part.rstrip()
        yield Text(indent) + part if start else part
