"""nbgrader's configuration for a course folder, the same for `course grade` and for a person who opens formgrader."""

from __future__ import annotations

import json
import os
import re
import sys
import warnings
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from nbgrader.apps.api import NbGraderAPI
from nbgrader.converters import Autograde, GenerateAssignment
from nbgrader.preprocessors import SaveCells
from traitlets.config import Config

from autograder.atomic_file import write_atomically
from ros_runtime.course_error import CourseError

CONFIG_FILE = "nbgrader_config.py"
RELEASE = "release"  # folder of the release notebooks
RECORDS = "records"  # folder with one JSON file per student, which VerdictOutputs reads

_BRIDGE = "autograder.classroom.nbgrader_bridge"
# Stock nbgrader begins with Execute, which runs the student's cells with the grader's rights. Nothing here runs a cell.
AUTOGRADE_PREPROCESSORS = [
    f"{_BRIDGE}.cell_points.VerdictOutputs",
    f"{_BRIDGE}.cell_points.EssayPictures",
    "nbconvert.preprocessors.ClearMetadataPreprocessor",
    "nbgrader.preprocessors.LimitOutput",
    "nbgrader.preprocessors.SaveAutoGrades",
    f"{_BRIDGE}.cell_points.UnjudgedCells",
    "nbgrader.preprocessors.AssignLatePenalties",
    "nbgrader.preprocessors.CheckCellMetadata",
]
FEEDBACK_PREPROCESSORS = [
    "nbgrader.preprocessors.GetGrades",
    f"{_BRIDGE}.feedback_page.WithoutKeys",
    "nbconvert.preprocessors.CSSHTMLHeaderPreprocessor",
    "nbconvert.preprocessors.sanitize.SanitizeHTML",
]
_OPTIONS: dict[str, Any] = {
    "CourseDirectory.source_directory": "source",
    "CourseDirectory.release_directory": RELEASE,
    # The stub in place of nbgrader's NotImplementedError, so that the starter code runs and checks can report on it.
    "ClearSolutions.code_stub": {"python": "# YOUR CODE HERE"},
    "Autograde.autograde_preprocessors": AUTOGRADE_PREPROCESSORS,
    "GenerateFeedback.preprocessors": FEEDBACK_PREPROCESSORS,
    "GenerateFeedback.exporter_class": f"{_BRIDGE}.feedback_page.FeedbackPage",
    "SanitizeHTML.enabled": True,
    "ExportApp.plugin_class": f"{_BRIDGE}.class_export.ClassExport",
}


class NbgraderError(CourseError):
    """A call to nbgrader failed; the message is the last error in nbgrader's log, and `log` is the whole log."""

    def __init__(self, message: str, log: str) -> None:
        super().__init__(message)
        self.log = log


class StudentCodeWouldRun(Exception):
    """nbgrader is configured to execute submissions, so it is not used."""


def open_course(folder: Path, *, gradebook: bool = True) -> NbGraderAPI:
    """Return nbgrader's API for a course folder; it ignores the configuration files of the machine and the user.

    Without a gradebook it can only generate releases.

    Raises `StudentCodeWouldRun` unless nbgrader autogrades with exactly AUTOGRADE_PREPROCESSORS.
    """
    root = folder.resolve()
    options: dict[str, Any] = {
        "CourseDirectory.root": str(root),
        "VerdictOutputs.records": str(root / RECORDS),
        # The exchange of a multi-user server is not used; a folder that does not exist turns it off.
        "Exchange.root": str(root / "exchange"),
    }
    if not gradebook:
        options |= {
            "GenerateAssignment.no_database": True,
            "GenerateAssignment.preprocessors": _without_saving(),
        }
    config = Config()
    for name, value in (_OPTIONS | options).items():
        section, _, trait = name.partition(".")
        config[section][trait] = value
    _let_nbgrader_find_alembic()
    api = NbGraderAPI(config=config)
    api.log.propagate = False  # each call reports its own failure
    _require_no_execution(api)
    return api


def call(action: Callable[..., dict[str, Any]], *names: str) -> None:
    """Call a method of nbgrader's API; raises `NbgraderError` when it reports a failure."""
    with warnings.catch_warnings():
        # SQLAlchemy warns about how nbgrader adds a new submission, but the submission is stored.
        warnings.filterwarnings("ignore", "Object of type .* not in session")
        outcome = action(*names, force=True)
    if not outcome["success"]:
        error, log = outcome.get("error", "").strip(), outcome.get("log", "")
        if error.endswith("KeyboardInterrupt"):  # nbgrader reports Ctrl-C as a failure
            raise KeyboardInterrupt
        raise NbgraderError(
            f"nbgrader's {action.__name__}: {_last_error(log) or _last_error(error)}", f"{error}\n{log}"
        )


def write_config_file(folder: Path) -> None:
    """Write a configuration file that makes `nbgrader` and its JupyterLab extension behave like this package's calls.

    The file assigns plain values only: nbgrader ignores a configuration file that raises, and would then execute
    submissions.
    """
    options = _OPTIONS | {"VerdictOutputs.records": RECORDS}
    lines = [f"c.{name} = {_python(value)}" for name, value in options.items()]
    text = "\n".join(
        [
            "# Written by `course grade`. Start `jupyter lab` in this folder and open nbgrader's Formgrader.",
            "# Autograding from there enters the verdicts in records/ again; it never runs a student's code.",
            "c = get_config()  # noqa: F821",
            *lines,
        ]
    )
    write_atomically(folder / CONFIG_FILE, text + "\n")


def _last_error(text: str) -> str:
    """Return the last line that names an exception."""
    lines = [line.strip() for line in text.splitlines() if re.match(r"\s*[\w.]*(Error|Exception)\b.*:", line)]
    return lines[-1] if lines else ""


def _python(value: Any) -> str:
    return repr(value) if isinstance(value, bool) else json.dumps(value)


def _without_saving() -> list[Any]:
    stages: Sequence[Any] = GenerateAssignment().preprocessors
    return [stage for stage in stages if stage is not SaveCells]


def _let_nbgrader_find_alembic() -> None:
    """Add the environment's programs to PATH, because nbgrader runs alembic to make a new gradebook."""
    programs = str(Path(sys.executable).parent)
    folders = os.environ.get("PATH", os.defpath).split(os.pathsep)
    if programs not in folders:
        os.environ["PATH"] = os.pathsep.join([programs, *folders])


def _require_no_execution(api: NbGraderAPI) -> None:
    listed: Sequence[Any] = Autograde(coursedir=api.coursedir, parent=api).autograde_preprocessors
    if list(listed) != AUTOGRADE_PREPROCESSORS:
        raise StudentCodeWouldRun(
            f"nbgrader would autograde with {listed}; expected {AUTOGRADE_PREPROCESSORS}"
        )
