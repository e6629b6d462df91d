"""The page to show: everything about a checked program in one file, whatever the program contains."""

from __future__ import annotations

import base64
import io
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from PIL import Image
from typer.testing import CliRunner

from autograder import work_page
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.engine.submission import Submission
from autograder.engine.verdict import Grade
from autograder.recording.recorder import Recorder
from autograder.recording.replay import film as film_module
from autograder.work_page import write_work_page
from course_cli.app import app
from falls import FALL, accepts, exercise, judged, simulated, stays_up, walk
from ros_runtime.course_error import UNUSABLE
from ros_runtime.workarounds.gl_backend import NoOpenGLError

PROGRAM = "import rclpy  # </pre><script>document.title = 'run'</script>\n"
LOADED = re.compile(r"""(?:src|srcset|href)=["'](?!#|data:)|url\(|@import""")


def page_of(folder: Path, run: Transcript | None, before_film: Callable[[], None] = lambda: None) -> str:
    """The page of a program that was judged on this run of a walk."""
    recorder = Recorder(exercise(), for_students=True)
    verdicts = [judged(one, run or walk()) for one in (accepts, stays_up)]
    for verdict in verdicts if run else []:
        recorder.add(verdict, [run])
    grade = Grade("walk_to", "you", "namespaces", verdicts, seed=4, program="3f2a91c06b1d")
    page = folder / "walk_to.html"
    write_work_page(page, Submission("walk_to", "you", {"walk_to.py": PROGRAM}), grade, recorder, before_film)
    return page.read_text(encoding="utf-8")


def film_in(html: str) -> Image.Image:
    (film,) = re.findall(r'<img src="data:image/webp;base64,([^"]+)"', html)
    return Image.open(io.BytesIO(base64.b64decode(film)))


def test_one_file_has_task_program_film_points_versions_and_seed(tmp_path: Path) -> None:
    html = page_of(tmp_path, walk(postures=simulated()[0]))
    assert "<h1>Walk to a pose</h1>" in html
    assert "<li>It rejects a <code>max_velocity</code> that is negative" in html
    assert "<strong>1 of 3 points</strong>" in html
    assert "observed</dt><dd>a fall (at 1.5 s)" in html
    assert film_in(html).n_frames == 26
    assert 'media="(prefers-reduced-motion: reduce)"' in html
    assert "0.20 s  " in html  # the same in words
    for fact in ("3f2a91c06b1d", "MuJoCo ", '<td class="words">4</td>'):
        assert fact in html
    assert "<script" not in html
    assert "script&gt;" in html
    assert not LOADED.findall(html)


def test_a_long_run_is_played_faster(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(work_page, "FILM_DURATION", 0.8)
    html = page_of(tmp_path, walk(postures=simulated()[0]))
    assert "3 times as fast" in html
    assert film_in(html).n_frames == pytest.approx(2.0 / 3 * film_module.FRAME_RATE, abs=2)


@pytest.mark.parametrize(("moves", "announced"), [(True, 1), (False, 0)])
def test_a_film_is_announced_only_if_one_is_made(tmp_path: Path, moves: bool, announced: int) -> None:
    told: list[None] = []
    page_of(tmp_path, walk(postures=simulated()[0] if moves else ()), lambda: told.append(None))
    assert len(told) == announced


@pytest.mark.parametrize("seconds", [0.0, FALL])
def test_where_no_robot_moves_the_messages_are_drawn(seconds: float, tmp_path: Path) -> None:
    html = page_of(tmp_path, walk(postures=simulated(seconds=seconds)[0] if seconds else ()))
    assert "No robot moves in these checks, so there is no film." in html
    assert "<svg" in html
    assert "<img" not in html


def test_a_machine_that_cannot_draw_the_robot_still_makes_the_page(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def view(*arguments: Any, **options: Any) -> None:
        raise NoOpenGLError("no OpenGL")

    monkeypatch.setattr(film_module, "View", view)
    html = page_of(tmp_path, walk(postures=simulated()[0]))
    assert "a machine without OpenGL, so there is no film." in html
    assert "<svg" in html


@pytest.mark.parametrize("run", [None, Transcript.from_events("walk", {}, [ev.ScenarioEnded(t=1.0)])])
def test_without_messages_it_says_so(run: Transcript | None, tmp_path: Path) -> None:
    html = page_of(tmp_path, run)
    assert "so there is no film." in html
    assert "<svg" not in html


@pytest.mark.parametrize(
    ("page", "said"),
    [
        ("page.pdf", "page.pdf has the suffix .pdf; expected .html"),
        ("nowhere/page.html", "there is no folder nowhere"),
        ("folder.html", "it is a folder"),
    ],
)
def test_a_place_where_no_page_can_be_is_refused_before_the_checks(
    page: str, said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("folder.html").mkdir()
    Path("patterns.py").write_text("ANSWERS = {}\n")
    ran = CliRunner().invoke(app("check"), ["check", "patterns", "patterns.py", "--page", page])
    assert ran.exit_code == UNUSABLE
    assert said in " ".join(ran.output.split())
    assert "checks, each shown" not in ran.output


def test_an_essay_has_no_page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    ran = CliRunner().invoke(app("check"), ["check", "arm_architecture", "essay.md", "--page", "page.html"])
    assert ran.exit_code == UNUSABLE
    assert "a person marks it" in " ".join(ran.output.split())
