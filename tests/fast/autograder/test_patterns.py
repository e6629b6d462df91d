"""Each situation is marked separately, and a missing answer gets no points."""

import pytest

from autograder.authoring.diagnosis.exit_diagnosis import ran_to_its_end
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.engine.exercise import load_exercise
from autograder.engine.judging import judge

CHECKS = load_exercise("patterns", hidden=True).checks
PATTERNS = {"t": "topic", "s": "service", "a": "action"}
RIGHT = ["ta", "sb", "ac", "ta", "sb", "aa", "tb", "sc", "ab", "tc", "sa", "ac"]
LINES = [f"{number} {PATTERNS[pattern]} {reason}" for number, (pattern, reason) in enumerate(RIGHT, start=1)]


def verdicts(*lines):
    """Return the verdict on each check of a program that prints these lines."""
    printed = [ev.NodeOutput(t=2.0, stream="stdout", text=line) for line in lines]
    begin = [ev.NodeStarted(t=0.0), ev.NodeReady(t=1.0, waited=1.0)]
    end = [ev.NodeExited(t=3.0, returncode=0), ev.ScenarioEnded(t=3.1)]
    run = Transcript.from_events("print_answers", {}, [*begin, *printed, *end])
    return {check.id: judge(check, [run]) for check in CHECKS}


def points(*lines):
    return sum(verdict.points for verdict in verdicts(*lines).values())


def test_all_answers_right_gives_all_points():
    assert points(*LINES) == 13


def test_no_answers_give_no_points():
    assert points() == 0


@pytest.mark.parametrize("answered", [1, 6, 11])
def test_each_right_answer_is_a_point_whatever_else_is_missing(answered):
    assert points(*LINES[:answered]) == answered
    assert points(*LINES[-answered:]) == answered


def test_what_is_not_answered_is_named():
    seen = verdicts(*LINES[:3])
    assert "no line for 4, 5" in seen["answers_everything"].observed
    assert "Add a line 4:" in seen["answers_everything"].help
    assert (seen["situation_7"].observed, seen["situation_7"].points) == ("no answer", 0)


def test_no_output_and_a_wrong_format_are_distinguished():
    assert "Nothing was printed" in verdicts()["answers_everything"].help
    assert "ANSWERS has no entry for situation 3" in verdicts()["situation_3"].help
    told = verdicts("1) I say: topic, because of a")["situation_1"]
    assert "is not in the right form" in told.help


def test_an_answer_in_a_wrong_format_does_not_affect_others():
    seen = verdicts(*LINES[:-1], "12 parameter a")
    assert sum(verdict.points for verdict in seen.values()) == 11
    assert seen["situation_12"].observed == "parameter a"


def test_a_wrong_answer_fails_with_the_reason_against_it():
    seen = verdicts(*LINES[:8], "9 action c", "10 topic c", "11 service c", "12 action c")
    assert (
        "Which part moves does not matter. What matters is that the step can be cancelled."
        in seen["situation_9"].help
    )
    assert "What matters is whether it is accepted" in seen["situation_11"].help


def test_a_number_of_thousands_of_digits_is_not_read_as_a_situation():
    seen = verdicts(*LINES, "9" * 5000 + " topic a")
    assert all(verdict.status == "passed" for verdict in seen.values())


def run_with_status_1(*lines):
    """Return the run of a program that prints these lines on stderr."""
    printed = [ev.NodeOutput(t=2.0, stream="stderr", text=line) for line in lines]
    begin = [ev.NodeStarted(t=0.0), ev.NodeReady(t=1.0, waited=1.0)]
    end = [ev.NodeExited(t=3.0, returncode=1), ev.ScenarioEnded(t=3.1)]
    return Transcript.from_events("print_answers", {}, [*begin, *printed, *end])


def test_a_syntax_error_is_reported_once_and_the_situations_are_not_run():
    run = run_with_status_1('  File "/tmp/work/patterns.py", line 5', "SyntaxError: '{' was never closed")
    first, *situations = [judge(check, [run]) for check in CHECKS]
    assert first.status == "failed"
    assert first.observed.endswith("SyntaxError: '{' was never closed")
    assert "missing comma, bracket" in first.help
    assert "It was raised in line 5 of patterns.py." in first.help
    assert {verdict.status for verdict in situations} == {"not run"}
    assert {verdict.help for verdict in situations} == {f"Needs a check that did not pass: “{first.title}”."}


def test_a_missing_comma_is_named_and_the_log_shows_the_students_own_file():
    traceback = ["Traceback (most recent call last):", '  File "/tmp/work/patterns.py", line 9, in <module>']
    traceback += ["    main()", "ValueError: too many values to unpack (expected 2)"]
    verdict = judge(CHECKS[0], [run_with_status_1(*traceback)])
    assert "Look for a missing comma" in verdict.help
    assert '  File "patterns.py", line 9, in <module>' in verdict.log
    assert "/tmp/work" not in verdict.log


@pytest.mark.parametrize(
    ("last_line", "is_fixed"), [("ValueError: too many values to unpack", True), ("MemoryError", False)]
)
def test_a_program_without_deadlines_is_run_again_only_if_the_machine_may_have_ended_it(last_line, is_fixed):
    assert ran_to_its_end(run_with_status_1("Traceback (most recent call last):", last_line)) is is_fixed
