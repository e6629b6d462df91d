"""The option `--jobs` of the commands that open arenas."""

from __future__ import annotations

from typing import Annotated

import typer

JobsOption = Annotated[
    int, typer.Option(min=1, help="number of arenas that run in parallel; each needs a processor core")
]
