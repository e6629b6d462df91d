"""The self-check of an exercise's notebook: the visible checks of `course check`, and their verdicts one by one."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import Console
from rich.text import Text

from autograder.authoring.checks import Check
from autograder.engine.exercise import Exercise, file_names, load_exercise
from autograder.engine.grading import GradingOptions, Watcher, grade
from autograder.engine.submission import place_of_work, read_submission
from autograder.engine.submission_arenas import SubmissionArenas
from autograder.engine.verdict import CheckVerdict, Grade
from autograder.hand_in_notice import hidden_checks_notice, saved_work_notice
from autograder.isolation.availability import available_isolation
from autograder.recording.kept import Recordings, keep
from autograder.report.running import RunningLine
from autograder.report.table import grade_table, print_beginning, print_retry, print_verdict, summary
from ros_runtime.self_checks import store_check

if TYPE_CHECKING:
    from autograder.recording.recorder import Recorder
    from autograder.report.notebook_table import NotebookTable

# What JupyterLab's own button does, which then takes the focus; other editors ignore it.
_SAVE = """{
const focused = document.activeElement;
document.querySelector('.jp-NotebookPanel:not(.lm-mod-hidden) [data-command="docmanager:save"]')?.click();
setTimeout(() => focused.focus({preventScroll: true}));
}"""
NOTEBOOK_WIDTH = 104  # characters; fits into JupyterLab with its file browser on a screen of 1280 pixels


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

    def hidden(self, number: int) -> None:
        """Print that a hidden check is made only during grading."""
        print(f"Hidden check {number} is run when your work is graded.")


def self_check(exercise: str, file: str | Path | None = None) -> SelfCheck:
    """Check `file` (default: the file that the notebook wrote here) with the visible checks and print the verdicts.

    Raises `UnusableSubmission` when the file cannot be read.
    """
    console = _console()
    _save_notebook()
    path = Path(file) if file else place_of_work(exercise, Path()) or Path(file_names(exercise)[0])
    result = check_and_keep(console, path, exercise)
    for line in (
        Text(hidden_checks_notice(exercise)),
        Text() if file else saved_work_notice(exercise, result.program),
    ):
        if line:
            console.print(line)
    return SelfCheck(result)


def _save_notebook() -> None:
    """Have JupyterLab save the notebook that is shown, while its cell runs on."""
    if Console().is_jupyter:
        from IPython.display import Javascript, display  # not needed in a terminal

        shown = display(Javascript(_SAVE), display_id=True)
        if shown is not None:
            # the script must not stay in the notebook, because it would run again when the notebook is opened
            shown.update({"text/plain": ""}, raw=True)


def check_and_keep(
    console: Console,
    path: Path,
    exercise: str,
    *,
    jobs: int = 2,
    arenas: SubmissionArenas | None = None,
    recordings: Path | None = None,
) -> Grade:
    """Like `check_with_progress`; also store the number of passed checks for the progress page.

    Raises `UnusableSubmission` and `UnknownExercise`.
    """
    result = check_with_progress(console, path, exercise, jobs=jobs, arenas=arenas, recordings=recordings)
    if result.status == "graded":
        passed = sum(check.status == "passed" for check in result.checks)
        store_check(exercise, passed, len(result.checks), result.program)
    return result


def check_with_progress(
    console: Console,
    path: Path,
    exercise: str,
    *,
    jobs: int = 2,
    arenas: SubmissionArenas | None = None,
    recordings: Path | None = None,
) -> Grade:
    """Check a student's file with the visible checks; print each verdict as soon as it is known, then the table.

    `arenas` are those of this submission, if one was opened ahead; `recordings` is a folder for recordings of the
    scenarios, if they are wanted.

    Raises `UnusableSubmission` and `UnknownExercise`.
    """
    loaded = load_exercise(exercise, hidden=False)
    submission = read_submission(path, exercise)
    recorder = _recorder(loaded) if recordings else None
    print_beginning(console, path, loaded)
    if not (isolation := available_isolation()).trusted:
        said = (
            f"No isolation: {isolation.reason}. All visible checks are run; a grade made here is “untrusted”."
        )
        console.print(said, style="yellow", markup=False)
    table = _notebook_table(loaded) if Console().is_jupyter else None
    with RunningLine(console, in_notebook=table is not None) as line:

        def report(verdict: CheckVerdict) -> None:
            with line.aside():
                print_verdict(console, verdict)

        def on_retry(check: Check) -> None:
            with line.aside():
                print_retry(console, check)

        options = GradingOptions(jobs=jobs, first_alone=True, recorded=recorder is not None)
        watcher = Watcher(report, on_retry, on_running=line.show)
        if table:
            watcher = Watcher(table.add, on_evidence=table.draw, on_running=line.show)
        if recorder:
            watcher = replace(watcher, on_evidence=recorder.add)
        result = grade(submission, loaded, options, watcher, arenas=arenas)
    console.print()
    console.print(Text(summary(result), style="bold") if table else grade_table(result))
    if recordings and recorder:
        _keep_recordings(console, recordings, recorder.files(result))
    return result


def _notebook_table(exercise: Exercise) -> NotebookTable:
    # imported only if needed, so that a terminal shows the first verdict sooner
    from autograder.report.notebook_table import NotebookTable

    return NotebookTable(exercise.checks)


def _recorder(exercise: Exercise) -> Recorder:
    # imported only if needed, so that the first verdict comes sooner
    from autograder.recording.recorder import Recorder

    return Recorder(exercise, for_students=True)


def _keep_recordings(console: Console, folder: Path, recordings: Recordings) -> None:
    keep(folder, recordings)
    console.print(
        f"{len(recordings)} recordings in {folder}; look at one: ./course replay FILE", markup=False
    )
    for name in sorted(recordings):
        console.print(f"  {folder / name}", style="dim", markup=False)


def _console() -> Console:
    """A console with coloured text; rich's own HTML for notebooks would separate all lines and cut off long ones."""
    in_notebook = Console().is_jupyter
    return Console(
        highlight=False,
        force_jupyter=False,
        force_terminal=in_notebook or None,
        color_system="standard" if in_notebook else "auto",
        width=NOTEBOOK_WIDTH if in_notebook else None,
    )
