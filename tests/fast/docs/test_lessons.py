"""A failure points to the lesson that shows its fault, and that lesson exists."""

from __future__ import annotations

import re

import pytest

from autograder.authoring import lesson
from autograder.authoring.checks import Scenario, check
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import Failure
from autograder.engine.exercise import exercise_names, exercises_folder, load_exercise
from autograder.engine.judging import judge
from ros_runtime.project import PROJECT

WHOLE = [ev.NodeStarted(t=0.0), ev.NodeReady(t=0.1, waited=0.1), ev.ScenarioEnded(t=3.0)]


def lessons_of(exercise: str) -> list[str]:
    """The lessons to which the exercise's checks and the failures in its modules point."""
    modules = (exercises_folder() / exercise).glob("*.py")
    named = [see for module in modules for see in re.findall(r'see="([^"]+)"', module.read_text())]
    return [*named, *(one.see for one in load_exercise(exercise, hidden=True).checks if one.see)]


@pytest.mark.parametrize("exercise", exercise_names())
def test_every_lesson_that_an_exercise_points_to_is_there(exercise: str) -> None:
    assert lessons_of(exercise)
    assert [see for see in lessons_of(exercise) if not lesson.is_there(see)] == []


def test_every_lesson_that_the_engine_itself_points_to_is_there() -> None:
    modules = (PROJECT / "autograder").rglob("*.py")
    named = {see for module in modules for see in re.findall(r'"(\d\d\w?_\w+#[\w-]+)"', module.read_text())}
    assert len(named) > 5
    assert [see for see in sorted(named) if not lesson.is_there(see)] == []


@pytest.mark.parametrize("see", ["02_services#no-such-cell", "99_nothing#title", "02_services"])
def test_a_missing_lesson_is_detected(see: str) -> None:
    assert not lesson.is_there(see)


def test_a_cell_is_found_by_the_heading_it_stands_under() -> None:
    assert lesson.in_words("02_services#m9-why") == (
        "chapters/02_services.ipynb, “Break it: ask before there is an answer”"
    )
    assert lesson.in_words("https://docs.ros.org/x#y") == "https://docs.ros.org/x#y"
    assert lesson.in_words("99_of_another_course#cell") == "chapters/99_of_another_course.ipynb"


@pytest.mark.parametrize(
    ("own", "told"),
    [("", "“Break it: ask before there is an answer”"), ("02_services#m4-why", "“Pitfall: calling")],
)
def test_the_next_step_names_the_lesson_of_the_failure_or_of_the_check(own: str, told: str) -> None:
    @check(points=1, on=Scenario("any", robot=None), see="02_services#m9-why")
    def fails(run):
        """It fails"""
        raise Failure(expected="a", observed="b", help="Do this.", see=own)

    help = judge(fails, [Transcript.from_events("any", {}, WHOLE)]).help
    assert help.startswith("Do this. Read chapters/02_services.ipynb, ")
    assert told in help


@pytest.mark.parametrize("exercise", exercise_names())
def test_every_check_points_to_a_lesson(exercise: str) -> None:
    assert [check.id for check in load_exercise(exercise, hidden=True).checks if not check.see] == []
