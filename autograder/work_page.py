"""One page about a checked program, for others to read: the task, the points, a film and the program, in one file."""

from __future__ import annotations

import base64
import io
import platform
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import datetime
from importlib.metadata import distributions
from pathlib import Path

import numpy as np
from markdown_it import MarkdownIt
from markupsafe import Markup
from PIL import Image
from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import PythonLexer, TextLexer

from autograder.engine.exercise import exercises_folder
from autograder.engine.notebook import text_of_cell
from autograder.engine.submission import Submission
from autograder.engine.verdict import Grade
from autograder.recording.recorder import Recorder
from autograder.recording.replay.film import film
from autograder.recording.replay.recording import Recording, Span, recordings_in
from autograder.recording.replay.text import time_line
from autograder.report.rendering import write_html
from autograder.report.sequence import transcript_svg
from ros_runtime.project import COURSE
from ros_runtime.workarounds.gl_backend import NoOpenGLError

FILM_DURATION = 20.0  # s; a longer run is played faster, so that the page stays small
STANDING = 0.05  # rad: no joint of a standing robot moves further; a step moves some by 0.4
PACKAGES = {"humanoid-course": "course", "ros-jazzy-rclpy": "rclpy", "mujoco": "MuJoCo"}
LIGHT, DARK = "xcode", "github-dark"  # Pygments' styles with enough contrast on the page's two backgrounds


@dataclass(frozen=True)
class Shown:
    """What is shown of the checked runs: a film, or, with the reason in `no_film`, a drawing of the messages.

    Attributes:
        scenario: the run's scenario; "" if there was no run.
        film, still: the film and one of its pictures, as data URLs.
        speed: how much faster than the robot's clock the film is played.
        lines: what happens in the film, with times.
        drawing: sequence diagram.
    """

    scenario: str = ""
    film: str = ""
    still: str = ""
    speed: int = 1
    lines: Sequence[str] = ()
    no_film: str = ""
    drawing: str = ""  # markup


def write_work_page(
    page: Path,
    submission: Submission,
    grade: Grade,
    recorder: Recorder,
    before_film: Callable[[], None] = lambda: None,
) -> None:
    """Write the page of a graded program, whose runs the recorder has received.

    `before_film` is called if a film, which takes some seconds, is about to be made.
    """
    name = f"{grade.exercise}/{grade.exercise}.ipynb"
    notebook = exercises_folder() / name
    if not notebook.exists():  # in the students' archive, which has only the checks there
        notebook = COURSE / "exercises" / name
    title = text_of_cell(notebook, "title") or grade.exercise
    # Links and pictures stay text, because the page has no other files.
    markdown = (
        MarkdownIt("commonmark", {"html": False}).enable("table").disable(["link", "image", "autolink"])
    )
    write_html(
        page,
        "work.html",
        title=title.splitlines()[0].lstrip("# "),
        task=Markup(markdown.render(text_of_cell(notebook, "task"))),
        grade=grade,
        shown=_shown(grade, recorder, before_film),
        programs={name: _highlighted(name, text) for name, text in submission.sources.items()},
        facts=_facts(grade),
        light=Markup(HtmlFormatter(style=LIGHT).get_style_defs(".program")),
        dark=Markup(HtmlFormatter(style=DARK).get_style_defs(".program")),
    )


def _shown(grade: Grade, recorder: Recorder, before_film: Callable[[], None]) -> Shown:
    """Show the run in which the robot moves most."""
    most = max(recordings_in(recorder.files(grade)), key=_motion, default=None)
    if most is None or _motion(most) == 0:
        return _drawn(recorder, "No robot moves in these checks")
    speed = max(1, int(np.ceil(most.end / FILM_DURATION)))
    webp, still = io.BytesIO(), io.BytesIO()
    before_film()
    try:
        film(most, Span(0.0, most.end), webp, speed=speed)
    except NoOpenGLError:
        return _drawn(recorder, "This page was made on a machine without OpenGL")
    with Image.open(webp) as frames:
        frames.seek(frames.n_frames // 2)
        frames.save(still, "WEBP")
    lines = [line.plain for line in time_line(most)]
    return Shown(most.about["scenario"], _data_url(webp), _data_url(still), speed, lines)


def _motion(recording: Recording) -> float:
    """Return how far all joints together moved, in rad (fingers: m); 0 without a robot, and for one that stands."""
    postures = np.array([posture.joints for posture in recording.postures])
    if len(postures) < 2 or np.ptp(postures, axis=0).max() < STANDING:
        return 0.0
    return float(np.abs(np.diff(postures, axis=0)).sum())


def _drawn(recorder: Recorder, no_film: str) -> Shown:
    """Show the messages of the run with the most events."""
    run = max(recorder.runs, key=lambda run: len(run.events), default=None)
    if run is None:
        return Shown(no_film=no_film)
    try:
        drawing = Markup(transcript_svg(run, run.scenario.replace("_", " ")))
    except ValueError:  # the run has no messages
        drawing = Markup("")
    return Shown(run.scenario, no_film=no_film, drawing=drawing)


def _data_url(webp: io.BytesIO) -> str:
    return f"data:image/webp;base64,{base64.b64encode(webp.getvalue()).decode()}"


def _highlighted(name: str, text: str) -> Markup:
    lexer = PythonLexer() if name.endswith(".py") else TextLexer()
    return Markup(highlight(text, lexer, HtmlFormatter(nowrap=True)))


def _facts(grade: Grade) -> dict[str, str]:
    """Return how the checks were run, by labels."""
    installed = {one.metadata["Name"]: one.version for one in distributions()}
    versions = [f"{called} {installed[name]}" for name, called in PACKAGES.items() if name in installed]
    return {
        "Exercise": grade.exercise,
        "Checked": f"{datetime.now():%Y-%m-%d %H:%M}",
        "Program": f"fingerprint {grade.program}, as ./course submit prints it",
        "Seed of the inputs": str(grade.seed),
        "Isolation": grade.isolation,
        "Versions": ", ".join([f"Python {platform.python_version()}", *versions]),
    }
