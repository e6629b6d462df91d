"""`course book`: makes one static site of chapters, exercises and docs."""

from __future__ import annotations

import time
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Annotated

import typer
from nbformat import NotebookNode
from rich.console import Console

from autograder.classroom.book.chapter_run import KeptRuns, missing_parts
from autograder.classroom.book.chapter_run import execute as execute_chapter
from autograder.classroom.book.site import make_site
from ros_runtime.course_error import CommandFailed
from ros_runtime.project import PROJECT

WORK = PROJECT / "build" / "book"


def book(
    output: Annotated[Path, typer.Option(help="folder of the site", file_okay=False)] = WORK / "site",
    execute: Annotated[
        bool,
        typer.Option("--execute/--no-execute", help="run the changed chapters, each with its own robot"),
    ] = True,
) -> None:
    """Make the chapters with their outputs, the exercises and the docs into one static site.

    A chapter takes minutes to run. Its outputs are kept until the chapter or the code that it runs changes. The site
    needs no server and no network: open its index.html.
    """
    console = Console(highlight=False)
    try:
        first_page = make_site(output, WORK, _runs(console) if execute else {})
    except KeyboardInterrupt:
        raise CommandFailed(
            "Interrupted. The outputs of finished chapters are kept: type the same command again to continue."
        ) from None
    console.print(f"The book: {first_page}", markup=False, soft_wrap=True)


def _runs(console: Console) -> dict[str, NotebookNode | None]:
    """Return the executed chapters, run now or read from the cache."""
    kept = KeptRuns(WORK / "runs", PROJECT)
    chapters = sorted((PROJECT / "chapters").glob("*.ipynb"))
    for number, chapter in enumerate(chapters, start=1):
        title = f"{number}/{len(chapters)} {chapter.stem}"
        if kept.of(chapter):
            console.print(f"{title}: unchanged, has the outputs of an earlier run", markup=False)
        elif why := missing_parts(chapter):
            console.print(f"{title}: not run, so it has no outputs: {why}", markup=False)
        else:
            seconds = _run(chapter, title, kept, console)
            console.print(f"{title}: ran in {seconds:.0f} s", markup=False)
    return {chapter.stem: kept.of(chapter) for chapter in chapters}


def _run(chapter: Path, title: str, kept: KeptRuns, console: Console) -> float:
    """Execute a chapter and keep its run; return how many seconds it took."""
    began = time.monotonic()
    with console.status(title) as status, TemporaryDirectory() as folder:

        def on_cell(cell: int, of: int) -> None:
            status.update(f"{title}: cell {cell} of {of}")

        kept.keep(chapter, execute_chapter(chapter, Path(folder), on_cell=on_cell).notebook)
    return time.monotonic() - began
