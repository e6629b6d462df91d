"""The self-check of an exercise's notebook: the visible checks of `course check`, and their verdicts one by one."""

from __future__ import annotations

import logging
import os
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rich.console import Console
from rich.text import Text

from autograder.authoring.checks import Check
from autograder.authoring.diagnosis.missing_comma import with_comma
from autograder.authoring.diagnosis.service_callback import with_callback
from autograder.authoring.diagnosis.stack_location import with_code
from autograder.authoring.evidence.transcript import Transcript
from autograder.engine.exercise import Exercise, file_names, load_exercise, submission_names
from autograder.engine.grading import GradingOptions, Watcher, grade
from autograder.engine.starter import is_starter, what_is_to_be_written
from autograder.engine.submission import Submission, place_of_work, read_submission
from autograder.engine.submission_arenas import SubmissionArenas
from autograder.engine.verdict import CheckVerdict, Grade
from autograder.hand_in_notice import WARNING, hidden_checks_notice, next_step, saved_work_warning
from autograder.isolation.availability import available_isolation
from autograder.lab_hour import share, unshare
from autograder.recording.kept import Recordings, keep
from autograder.report.console import NOTICE, LineConsole
from autograder.report.running import RunningLine
from autograder.report.table import print_beginning, print_retry, print_verdict, summary
from ros_runtime.course_error import CourseError
from ros_runtime.self_checks import store_check, submitted_folders
from ros_runtime.terminal import as_typed
from ros_runtime.workarounds.jupyterlab_page import save_notebook

if TYPE_CHECKING:
    from autograder.recording.recorder import Recorder
    from autograder.report.notebook_table import NotebookTable
    from ros_runtime.cell_notice import CellNotice

OnEvidence = Callable[[CheckVerdict, Sequence[Transcript]], None]

EXTRA = (
    "An extra, which gives no points and changes no progress: these checks are made with the robot {robot}."
)
NOTEBOOK_WIDTH = 104  # characters; fits into JupyterLab with its file browser on a screen of 1280 pixels


class NoPage(CourseError):
    """The page to show cannot be written; the message says why."""


@dataclass(frozen=True, repr=False)
class SelfCheck:
    """The verdicts of one self-check."""

    grade: Grade

    def show(self, check_id: str) -> None:
        """Print the verdict of one check, with the reason and the next step when it did not pass."""
        verdict = next((verdict for verdict in self.grade.checks if verdict.id == check_id), None)
        if verdict is None:
            known = ", ".join(verdict.id for verdict in self.grade.checks)
            raise KeyError(
                f"there is no visible check {check_id!r} in {self.grade.exercise}; there are {known}"
            )
        print_verdict(_console(), verdict)

    def share(self, place: str = "") -> None:
        """Show the instructor's page where this check failed; `place` says where you sit. Raises `CannotShare`."""
        print(share(self.grade, place))

    def unshare(self) -> None:
        """Remove from the instructor's page what `share` has shown. Raises `CannotShare`."""
        print(unshare())

    def hidden(self, number: int) -> None:
        """Print that a hidden check is made only during grading."""
        print(f"Hidden check {number} is run when your work is graded.")


def self_check(exercise: str, file: str | Path | None = None, *, page: str | Path | None = None) -> SelfCheck:
    """Check `file` (default: the file that the notebook wrote here) with the visible checks and print the verdicts.

    With `page`, also write a page to show, such as walk_to.html: task, program, points, and a film of the robot.

    Raises `UnusableSubmission` when the file cannot be read, and `NoPage` when the page cannot be written.
    """
    console = _console()
    path = Path(file) if file else place_of_work(exercise, Path()) or Path(file_names(exercise)[0])
    with _notice_in_notebook() as notice:
        if notice:
            save_notebook()
        if not file:
            warning = saved_work_warning(exercise, read_submission(path, exercise).fingerprint)
            if warning:
                console.print(warning, style=WARNING, markup=False)  # before the verdicts, which may be long
        result = check_and_keep(console, path, exercise, page=Path(page) if page else None, notice=notice)
    warning = "" if file else saved_work_warning(exercise, result.program)
    print_next_step(console, result, path, warning, file=path if file else None)
    return SelfCheck(result)


def print_next_step(
    console: Console, grade: Grade, path: Path, warning: str = "", file: Path | None = None
) -> None:
    """Print which checks come later, and what to do next with the work at `path`; a warning replaces the next step.

    `file` is that path if it was named, so that it is submitted and no other.
    """
    if later := hidden_checks_notice(grade.exercise):
        console.print(later, markup=False)
    if warning:
        console.print(warning, style=WARNING, markup=False)
    elif grade.status == "graded":
        is_submitted = grade.exercise in submitted_folders()
        offers_it = not is_submitted and not is_starter(*_with_notebook(path, grade.exercise))
        console.print(next_step(grade, offers_it, file), markup=False)


def check_and_keep(console: Console, path: Path, exercise: str, **options: Any) -> Grade:
    """Like `check_with_progress`, with its options; also store the number of passed checks.

    The progress page shows them, unless the file has a name of its own, such as that of an experiment.
    """
    result = check_with_progress(console, path, exercise, **options)
    if result.status == "graded" and not options.get("robot"):
        passed = sum(check.status == "passed" for check in result.checks)
        is_own = path.is_dir() or path.name in submission_names(exercise)
        store_check(exercise, passed, len(result.checks), result.program, for_its_row=is_own)
    return result


def check_with_progress(
    console: Console,
    path: Path,
    exercise: str,
    *,
    jobs: int = 2,
    arenas: SubmissionArenas | None = None,
    recordings: Path | None = None,
    page: Path | None = None,
    robot: str | None = None,
    notice: CellNotice | None = None,
) -> Grade:
    """Check a student's file with the visible checks; print each verdict as soon as it is known, then the score.

    `arenas` are those of this submission, if one was opened ahead; `recordings` is a folder for recordings of the
    scenarios, if they are wanted, and `page` a file for a page to show. With another `robot` the checks have no points.
    In a notebook, `notice` is the notice of the running cell, and the verdicts are shown as a table.

    Raises `UnusableSubmission`, `UnknownExercise`, `NoPage`, and `CourseError` if the exercise is not for the robot.
    """
    if page:
        _require_place(page)
    loaded = load_exercise(exercise, hidden=False)
    if robot:
        # imported only if needed, because it loads MuJoCo
        from autograder.other_robot import with_robot

        loaded = with_robot(robot, loaded)
    submission, notebook = _with_notebook(path, exercise)
    if is_starter(submission, notebook):
        console.print(what_is_to_be_written(submission, notebook), style=NOTICE, markup=False)
    recorder = _recorder(loaded) if recordings or page else None
    if robot:
        console.print(EXTRA.format(robot=robot), style="bold", markup=False)
    print_beginning(console, path, loaded)
    if not (isolation := available_isolation()).trusted:
        said = (
            f"No isolation: {isolation.reason}. All visible checks are run; a grade made here is “untrusted”."
        )
        console.print(said, style=NOTICE, markup=False)
    table = _notebook_table(loaded) if notice else None
    with RunningLine(console, loaded.checks, notice) as line:

        def report(verdict: CheckVerdict) -> None:
            sources = submission.sources
            help = with_code(with_comma(with_callback(verdict.help, sources), sources), sources)
            verdict = _in_words_of(path, loaded, replace(verdict, help=help))
            line.note(verdict)
            if table:
                table.add(verdict)
                return
            print_verdict(console, verdict)

        def on_retry(check: Check) -> None:
            line.note_retry(check)
            if not table:
                print_retry(console, check)

        options = GradingOptions(jobs=jobs, first_alone=True, recorded=bool(recorder or table))
        watcher = Watcher(report, on_retry, on_running=line.show)
        if table:
            watcher = replace(watcher, on_evidence=table.draw)
        if recorder:
            watcher = replace(watcher, on_evidence=_both(watcher.on_evidence, recorder.add))
        result = grade(submission, loaded, options, watcher, arenas=arenas)
    console.print()
    console.print(Text(summary(result), style="bold"))
    if robot:
        passed = sum(verdict.status == "passed" for verdict in result.checks)
        said = (
            f"{passed} of {len(result.checks)} checks passed on the robot {robot}: an extra, without points."
        )
        console.print(said, style="bold", markup=False)
    if table and notice and table.evidence:
        _add_films(table, notice, loaded, result)
    if recordings and recorder:
        _keep_recordings(console, recordings, recorder.files(result))
    if page and recorder and result.status == "graded":
        _write_page(console, page, submission, result, recorder)
    return result


def _with_notebook(path: Path, exercise: str) -> tuple[Submission, Path]:
    """Return the work at a path, and the place of the notebook that may have written it."""
    folder = path if path.is_dir() else path.parent
    return read_submission(path, exercise), folder / f"{exercise}.ipynb"


def _in_words_of(path: Path, exercise: Exercise, verdict: CheckVerdict) -> CheckVerdict:
    """Return a verdict that names the checked file, which may run under another name."""
    if path.suffix != ".py" or path.name in exercise.file_names:
        return verdict
    name = exercise.file_names[0]
    texts = {field: getattr(verdict, field).replace(name, path.name) for field in ("observed", "help", "log")}
    return replace(verdict, **texts)


def _both(first: OnEvidence, second: OnEvidence) -> OnEvidence:
    def on_evidence(verdict: CheckVerdict, transcripts: Sequence[Transcript]) -> None:
        first(verdict, transcripts)
        second(verdict, transcripts)

    return on_evidence


def _notice_in_notebook() -> AbstractContextManager[CellNotice | None]:
    if not Console().is_jupyter:
        return nullcontext()
    # imported only if needed, because it loads IPython
    from ros_runtime.cell_notice import CellNotice

    return CellNotice("The check begins: the notebook is saved, and your program is started.", delay=0.0)


def _notebook_table(exercise: Exercise) -> NotebookTable:
    # imported only if needed, so that a terminal shows the first verdict sooner
    from autograder.report.notebook_table import NotebookTable

    return NotebookTable(exercise.checks)


def _add_films(table: NotebookTable, notice: CellNotice, exercise: Exercise, grade: Grade) -> None:
    """Film the seconds around the first failures, now that all verdicts are known; an interrupt ends only this."""
    # imported only if needed, because it loads MuJoCo
    from autograder.recording.replay.failure_film import FailureFilms

    films = FailureFilms(exercise, grade)
    filmed = [each for each in grade.checks if each.id in table.evidence and each.robot_time is not None]
    notice.show(
        "If the robot moved in a failed check, a film is drawn, which takes some seconds." if filmed else ""
    )
    for verdict in filmed:
        words, webp = "", b""
        try:
            words, webp = films.of(verdict, table.evidence[verdict.id])
        except KeyboardInterrupt:
            return
        except Exception:  # a failed film must not affect the self-check
            logging.getLogger(__name__).exception("no film of %s", verdict.id)
        finally:
            table.film(verdict.id, words, webp)


def _recorder(exercise: Exercise) -> Recorder:
    # imported only if needed, so that the first verdict comes sooner
    from autograder.recording.recorder import Recorder

    return Recorder(exercise, for_students=True)


def _require_place(page: Path) -> None:
    """Require, before the checks, which may take minutes, that a page can be written there."""
    if page.suffix.lower() != ".html":
        raise NoPage(f"{page} has the suffix {page.suffix or '“”'}; expected .html")
    if not page.parent.is_dir():
        raise NoPage(f"{page} cannot be written: there is no folder {page.parent}")
    if page.is_dir() or not os.access(page if page.exists() else page.parent, os.W_OK):
        raise NoPage(f"{page} cannot be written: it is a folder, or you have no permission")


def _write_page(
    console: Console, page: Path, submission: Submission, result: Grade, recorder: Recorder
) -> None:
    from autograder.work_page import write_work_page

    def announce_film() -> None:
        console.print(f"writing {page}; a film of the robot takes some seconds …", style="dim", markup=False)

    write_work_page(page, submission, result, recorder, announce_film)
    console.print(
        f"{page}: {page.stat().st_size / 1e3:,.0f} kB, to open in any browser or to send", markup=False
    )


def _keep_recordings(console: Console, folder: Path, recordings: Recordings) -> None:
    keep(folder, recordings)
    console.print(
        f"{len(recordings)} recordings in {folder}; look at one: {as_typed('replay FILE')}", markup=False
    )
    for name in sorted(recordings):
        console.print(f"  {folder / name}", style="dim", markup=False)


def _console() -> Console:
    """A console with coloured text; rich's own HTML for notebooks would separate all lines and cut off long ones."""
    in_notebook = Console().is_jupyter
    return LineConsole(
        force_jupyter=False,
        force_terminal=in_notebook or None,
        color_system="standard" if in_notebook else "auto",
        **({"width": NOTEBOOK_WIDTH} if in_notebook else {}),
    )
