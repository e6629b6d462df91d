"""`course replay`: shows a recorded arena."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from autograder.recording.replay.film import film, format_of
from autograder.recording.replay.recording import Recording, Span, require_postures, span_of
from autograder.recording.replay.text import line, time_line, title
from autograder.report.console import LineConsole
from ros_runtime.course_error import CommandFailed, CourseError
from ros_runtime.workarounds.gl_backend import NoOpenGLError


def replay(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="an .mcap file that `--record` wrote")],
    film_file: Annotated[
        Path | None,
        typer.Option("--film", metavar="OUT", help="write a film, .webp or .gif, and show nothing"),
    ] = None,
    text: Annotated[bool, typer.Option("--text", help="print the events with their times")] = False,
    around: Annotated[
        str | None,
        typer.Option(
            metavar="CHECK",
            help="show the seconds around this check's verdict (default: the first failed check, else everything)",
        ),
    ] = None,
    seconds: Annotated[
        float | None, typer.Option(help="number of seconds to show (default: 6 around a verdict)")
    ] = None,
    camera: Annotated[
        str, typer.Option(metavar="NAME", help="the film's camera: track, side or front")
    ] = "track",
    port: Annotated[
        int,
        typer.Option(
            show_default=False, help="the browser view's port (default: the first free from 8080 on)"
        ),
    ] = 0,
) -> None:
    """Show a recording of a check: in a browser, as a film, or as text."""
    console = LineConsole()
    try:
        kind = format_of(film_file) if film_file else "WEBP"
        recording = Recording.read(file)
        span = span_of(recording, around, seconds)
        console.print(title(recording), markup=False)
        if text:
            for each in time_line(recording):
                console.print(each)
            return
        require_postures(recording)
        console.print(f"from {span.start:.1f} to {span.end:.1f} s", style="dim")
        if film_file:
            frames = film(recording, span, film_file, kind, camera=camera)
            console.print(f"{film_file}: {frames} frames", markup=False)
            return
        _in_the_browser(console, recording, span, port)
    except ValueError as error:
        raise CourseError(str(error)) from error
    except (NoOpenGLError, OSError) as error:
        raise CommandFailed(str(error)) from error


def _in_the_browser(console: Console, recording: Recording, span: Span, port: int) -> None:
    from autograder.recording.replay.web import play

    try:
        play(
            recording,
            span,
            port,
            on_ready=lambda url: console.print(f"view: {url}   (stop with Ctrl-C)", markup=False),
            on_moment=lambda moment: console.print(line(moment)),
        )
    except ImportError as error:
        raise CommandFailed(
            "the web view needs MuJoCo 4, which needs Python 3.11 or newer; use --film or --text"
        ) from error
    except KeyboardInterrupt:
        return
