"""`course hour`: a page to project in the lab, which shows at which checks students are stuck, and for how long."""

from __future__ import annotations

import time
from datetime import datetime
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from autograder.lab_hour import VARIABLE, groups
from autograder.report.rendering import write_html

PERIOD = 10  # s between two versions of the page, which loads itself again as often


def hour(
    folder: Annotated[
        Path,
        typer.Argument(
            help=f"the folder that {VARIABLE} names for the students", exists=True, file_okay=False
        ),
    ],
    out: Annotated[Path, typer.Option(help="the page", dir_okay=False)] = Path("lab_hour.html"),
    places: Annotated[
        bool,
        typer.Option("--places", help="show where students sit, if they wrote it; not for the projector"),
    ] = False,
    once: Annotated[bool, typer.Option("--once", help="write the page once")] = False,
) -> None:
    """Show at which checks students are stuck, from the self-checks that they share, until Ctrl-C."""
    console = Console(highlight=False)
    renewed = "" if once else f"; it is renewed every {PERIOD} s. Stop with Ctrl-C"
    console.print(f"open {out} in a browser{renewed}.", markup=False)
    try:
        while True:
            write_html(
                out,
                "hour.html",
                title="The lab now",
                groups=groups(folder, time.time()),
                places=places,
                period=PERIOD,
                at=f"{datetime.now():%H:%M:%S}",
            )
            if once:
                return
            time.sleep(PERIOD)
    except KeyboardInterrupt:
        out.unlink(missing_ok=True)  # nothing stays when the session ends
