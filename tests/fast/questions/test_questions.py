"""Questions about a student's own program: their keys name the lines that acted, and nothing is asked without a key."""

from __future__ import annotations

import ast
import csv
import io
import re
import sys
from dataclasses import replace

import pytest
from typer.testing import CliRunner

from audited import recorded
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.classroom.commands import questions as command
from autograder.classroom.questions import making
from autograder.classroom.questions.changes import Change, changes, executor_changes
from autograder.classroom.questions.making import Maker
from autograder.classroom.questions.moments import moments
from autograder.classroom.questions.pages import EXAMINER, TABLE, write_pages
from autograder.classroom.questions.question import Part, Question, Sheet, keep, kept
from autograder.classroom.questions.student_program import StudentProgram, UnreadableProgram, as_code
from autograder.classroom.questions.traced import traced
from autograder.engine.exercise import exercises_folder, load_exercise
from autograder.engine.judging import verdict_on
from autograder.engine.submission import Submission
from course_cli.app import app

SERVICE = """import rclpy
from rclpy.node import Node
from std_srvs.srv import Trigger
from humanoid_interfaces.msg import RobotState

class Server(Node):
    def __init__(self):
        super().__init__("server")
        self.state = None
        self.create_subscription(RobotState, "robot_state", self.on_state, 10)
        self.create_service(Trigger, "get_status", self.on_status)

    def on_state(self, message):
        self.state = message

    def on_status(self, request, response):
        if self.state is None:
            response.message = "nothing is known"
            return response
        response.success = True
        response.message = "known"
        return response

def main():
    rclpy.init()
    rclpy.spin(Server())
"""
MOVES = '''"""Stops at a cancel."""
from __future__ import annotations
from geometry_msgs.msg import Twist

def walk(handle, publisher, speed):
    command = Twist()
    command.linear.x = speed
    publisher.publish(command)
    if handle.is_cancel_requested:
        publisher.publish(Twist())
        publisher.publish(Twist())
        handle.canceled()
'''


def known(exercise: str, name: str) -> str:
    return (exercises_folder() / exercise / "known" / "correct" / f"{name}.py").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def walker() -> StudentProgram:
    return StudentProgram(known("cancellable_walk", "threads_and_sleep"))


@pytest.fixture(scope="module")
def made(walker) -> list[Change]:
    return list(changes(walker))


def line_of(program: StudentProgram, code: str, number: int = 0) -> int:
    """Return the line that holds this code, the first or a later one."""
    return [place for place, line in enumerate(program.lines, 1) if code in line][number]


def second_cancel(program: StudentProgram) -> ast.Attribute:
    """Return the place where a client calls cancel_goal_async for the second time."""
    line = line_of(program, "handle.cancel_goal_async()", 1)
    (node,) = [
        one for one in program.every(ast.Attribute) if one.lineno == line and one.attr.startswith("cancel")
    ]
    return node


def recorded_walk(name: str) -> Transcript:
    path = recorded.FOLDER / "cancellable_walk" / f"threads_and_sleep.{name}.jsonl.gz"
    return recorded.read(path, recorded.scenarios_of("cancellable_walk")[name])


def with_reports(run: Transcript, reports: list[tuple[float, str]]) -> Transcript:
    printed = [ev.NodeOutput(t=t, stream="stderr", text=f"@line {text}") for t, text in reports]
    return replace(run, events=sorted([*run.events, *printed], key=lambda event: event.t))


class Told:
    """A publisher and a goal handle that do nothing."""

    is_cancel_requested = False

    def publish(self, message):
        pass

    def canceled(self):
        pass


# -- the traced copy


def test_traced_copy_reports_the_lines_of_the_original_that_act(capfd):
    copy = {}
    exec(compile(traced(StudentProgram(MOVES)), "copy", "exec"), copy)
    handle = Told()
    copy["walk"](handle, handle, 0.3)
    assert capfd.readouterr().err == ""  # the robot moves, and no cancel is requested
    handle.is_cancel_requested = True
    copy["walk"](handle, handle, 0.3)
    assert capfd.readouterr().err.splitlines() == [
        "@line 9 cancel seen",
        "@line 10 stop",
        "@line 12 canceled",
    ]


def test_traced_copy_of_every_known_program_is_a_program():
    for path in exercises_folder().glob("*/known/correct/*.py"):
        compile(traced(StudentProgram(path.read_text(encoding="utf-8"))), str(path), "exec")


# -- moments


def of_a_cancel(run: Transcript, walker: StudentProgram) -> list[tuple[float, str]]:
    """Return the reports of the known server on the first cancel."""
    at = run.cancels[0].sent.t
    return [
        (at + 0.03, f"{line_of(walker, 'is_cancel_requested')} cancel seen"),
        (at + 0.03, f"{line_of(walker, 'publish(Twist())')} stop"),
        (at + 0.04, f"{line_of(walker, '.canceled()')} canceled"),
    ]


def test_key_of_a_cancel_names_the_lines_that_acted_and_the_wait_before_them(walker):
    run = recorded_walk("in_order-6")
    (question,) = moments(walker, with_reports(run, of_a_cancel(run, walker)))
    stop, seen, end = question.parts
    assert f"{run.cancels[0].sent.t:.1f} s to cancel its goal, while the robot moved" in question.situation
    assert (
        stop.key
        == f"line {line_of(walker, 'publish(Twist())')}, `self.cmd_vel.publish(Twist())`, 0.03 s after the request."
    )
    assert f"line {line_of(walker, 'is_cancel_requested')}, " in seen.key
    assert f"the loop waits in line {line_of(walker, 'time.sleep(')}, `time.sleep(PERIOD)`" in seen.key
    assert f"line {line_of(walker, '.canceled()')}, " in end.key


def test_no_question_if_two_lines_could_have_ended_the_goal(walker):
    run = recorded_walk("in_order-6")
    reports = of_a_cancel(run, walker)
    at = run.cancels[0].sent.t + 0.05
    other = StudentProgram("\n".join(walker.lines).replace("goal_handle.succeed()", "goal_handle.canceled()"))
    second = (at, f"{line_of(other, '.canceled()', 1)} canceled")
    assert moments(other, with_reports(run, reports))
    assert not moments(other, with_reports(run, [*reports, second]))


def test_a_report_that_the_copy_cannot_make_is_ignored(walker):
    run = recorded_walk("in_order-6")
    assert not moments(walker, with_reports(run, [(run.cancels[0].sent.t + 0.03, "99999 canceled")]))


def test_key_of_a_fall_names_the_condition_and_the_callback_that_stores_what_it_reads(walker):
    run = recorded_walk("in_order-2")
    (goal,) = run.goals
    ends = line_of(walker, "goal_handle.abort()", 1)
    (question,) = moments(walker, with_reports(run, [(goal.result.t - 0.02, f"{ends} abort")]))
    ended, condition, stored = (part.key for part in question.parts)
    assert ended.startswith(f"line {ends}, `goal_handle.abort()`")
    assert f"line {line_of(walker, 'RobotState.FALLEN')}, " in condition
    assert condition.endswith("it was true.")
    assert f"line {line_of(walker, 'self.state = message')}, " in stored
    assert "in on_state, which runs whenever a message of its topic arrives" in stored


def test_key_of_a_clients_request_to_cancel_names_the_line_that_sent_it_and_its_condition():
    program = StudentProgram(known("battery_guard", "one_loop"))
    path = recorded.FOLDER / "battery_guard" / "one_loop.in_order-11.jsonl.gz"
    run = recorded.read(path, recorded.scenarios_of("battery_guard")["in_order-11"])
    (cancel,) = run.all(ev.CancelReceived)
    sends = line_of(program, "handle.cancel_goal_async()")
    (question,) = moments(program, with_reports(run, [(cancel.t - 0.02, f"{sends} cancel_goal_async")]))
    assert "Ctrl-C was pressed at" in question.situation
    assert f"received a request at {cancel.t:.1f} s to cancel its goal" in question.situation
    sent, condition = (part.key for part in question.parts)
    assert sent.startswith(f"line {sends}, `handle.cancel_goal_async()`, at ")
    assert condition == f"line {line_of(program, 'if not is_heard:')}, `if not is_heard`: it was true."


@pytest.fixture(scope="module")
def server() -> StudentProgram:
    return StudentProgram(known("motor_services", "class_based"))


def answered(server: StudentProgram, scenario: str) -> Transcript:
    """Return a recorded run of the known services, with what their traced copy reports on each answer."""
    path = recorded.FOLDER / "motor_services" / f"class_based.{scenario}.jsonl.gz"
    run = recorded.read(path, recorded.scenarios_of("motor_services")[scenario])
    signs = {
        "Motors": ("success = True", 1),
        "power": ("success = True", 0),
        "the robot": ("success = False", 0),
    }
    reports = []
    for call in run.calls:
        code, number = next(place for sign, place in signs.items() if call.response.message.startswith(sign))
        line = line_of(server, code, number)
        reports += [(call.answered.t, f"{line} success"), (call.answered.t, f"{line + 1} message")]
    return with_reports(run, reports)


def test_same_requests_at_once_have_a_sure_key_and_the_guard_before_a_line_is_its_condition(server):
    refused, accepted = line_of(server, "success = False"), line_of(server, "success = True")
    asked = moments(server, answered(server, "in_order-5"))
    keys = {one.line: one.parts[1].key for one in asked}
    guard = f"line {line_of(server, 'if not request.data')}, `{server.lines[refused - 2].strip().removesuffix(':')}`"
    assert keys[refused] == f"{guard}: it was true."
    assert keys[accepted] == f"{guard}: it was false."
    assert {one.parts[0].asked for one in asked if one.line in (refused, refused + 1)} == {
        f"Which line of your program gave `{name}` its value in this answer?"
        for name in ("success", "message")
    }


def test_no_condition_is_named_if_an_earlier_one_that_is_nested_could_have_left():
    nested = SERVICE.replace(
        "            return response\n", "            if request:\n                return response\n"
    )
    for text, condition in ((SERVICE, "self.state is None"), (nested, None)):
        program = StudentProgram(text)
        line = line_of(program, "response.success = True")
        led, holds = program.condition(next(one for one in program.every(ast.Assign) if one.lineno == line))
        assert (ast.unparse(led.test) if led else None) == condition
        assert holds == (led is None)


def test_the_condition_of_a_function_without_one_is_that_of_its_only_call():
    program = StudentProgram(known("battery_guard", "one_loop"))
    led, holds = program.condition(second_cancel(program))
    assert led.lineno == line_of(program, "if not ended.done():")
    assert holds


def test_an_exception_that_led_to_a_line_is_asked():
    program = StudentProgram(known("walk_client", "spins_in_a_thread"))
    led, _ = program.condition(second_cancel(program))
    assert led.lineno == line_of(program, "except KeyboardInterrupt:")


def test_feedback_callback_of_a_client_sleeps_first():
    (change,) = executor_changes(StudentProgram(known("walk_client", "one_loop")))
    assert "time.sleep(2.5); self._last_heard = time.monotonic()" in change.text
    assert "while _on_feedback sleeps" in change.why


def test_a_line_reached_from_one_callback_runs_for_that_callback():
    program = StudentProgram(known("cancellable_walk", "abort_on_acceptance"))
    noticed = next(one for one in program.every(ast.Assign) if "canceling = " in ast.unparse(one))
    assert program.runs_for(noticed) == ("on_odom", "subscription")


def test_an_attribute_of_the_same_name_in_another_class_is_not_what_is_read():
    other = "\n\nclass Other:\n    def remember(self, state):\n        self.state = state\n"
    program = StudentProgram(SERVICE + other)
    (condition,) = program.every(ast.If)
    (stored,) = program.stores(condition.test, program.function(condition))
    assert program.function_name(stored) == "on_state"


# -- changes


def test_a_change_moves_no_line_and_is_the_operators_change(walker, made):
    assert {"misses_a_cancel", "leaves_a_line_out", "drops_a_guard"} <= {one.operator for one in made}
    for one in made:
        lines = one.text.split("\n")
        assert len(lines) == len(walker.lines)
        assert [place for place, line in enumerate(lines, 1) if line != walker.lines[place - 1]] == [one.line]


def test_a_line_left_out_is_called_missing(walker, made):
    gone = line_of(walker, "goal_handle.canceled()")
    (one,) = [each for each in made if each.line == gone and each.operator == "leaves_a_line_out"]
    assert one.supposed == f"line {gone}, `goal_handle.canceled()`, were missing"


@pytest.mark.parametrize("style", ["one_loop", "spins_in_a_thread"])
def test_changes_are_lines_that_a_person_writes_and_that_the_quote_shows(style):
    for one in changes(StudentProgram(known("walk_client", style))):
        old, _, new = one.supposed.partition(", were ")
        assert new not in old
        assert not re.search(r"'/' \+ '|not \(|\) and 0`|:`", new)


def test_quoted_code_ends_without_its_colon_and_cannot_end_the_quote():
    assert as_code("    if mode == FALLEN:\n") == "`if mode == FALLEN`"
    assert as_code('print("`x`")') == "`print(\"'x'\")`"


def test_executor_with_threads_is_reduced_to_one(walker):
    (change,) = executor_changes(walker)
    assert "MultiThreadedExecutor(num_threads=1)" in change.text
    assert f"line {line_of(walker, 'MultiThreadedExecutor()')}, " in change.first[0].key
    assert "`time.sleep(PERIOD)`" in change.why


def test_await_becomes_a_sleep_in_a_node_with_one_thread():
    program = StudentProgram(known("cancellable_walk", "async_and_timers"))
    change = next(one for one in executor_changes(program) if one.operator == "sleeps_instead")
    assert "import time; time.sleep(0.05)" in change.text
    assert "await gives the thread back" in change.first[0].key


def test_subscription_of_a_plain_service_sleeps_first():
    change, of_service = executor_changes(StudentProgram(SERVICE))
    assert "import time; time.sleep(2.5); response.success = True" in of_service.text
    assert "import time; time.sleep(2.5); self.state = message" in change.text
    assert "rclpy.spin" in change.why
    assert "on_status" in change.why


def test_a_function_that_makes_a_callback_is_no_callback():
    program = StudentProgram(known("cancellable_walk", "functions_and_rate"))
    assert "remember" not in [one.name for one in program.kinds]
    assert "execute" in [one.name for one in program.kinds]


def test_nothing_is_asked_about_an_executor_that_is_not_clear():
    two = SERVICE.replace("rclpy.spin(Server())", "SingleThreadedExecutor(); MultiThreadedExecutor()")
    assert not list(executor_changes(StudentProgram(two)))


@pytest.mark.parametrize(
    "text", ["def (", "from no_such_package.msg import Thing", "x = " + "(" * 5000, "x = 1\n" * 3000]
)
def test_a_program_that_cannot_be_read_is_said_so(text):
    with pytest.raises(UnreadableProgram):
        StudentProgram(text)


def test_a_students_import_imports_nothing_but_interfaces():
    with pytest.raises(UnreadableProgram, match="no package of interfaces 'antigravity'"):
        StudentProgram("from antigravity.msg import Thing")
    assert "antigravity" not in sys.modules


# -- the choice for a student


@pytest.fixture
def grader(monkeypatch):
    """Grade without arenas: a program with one of these texts fails the named check, and the copy reports nothing."""
    exercise = load_exercise("motor_services", hidden=False)
    fails: dict[str, str] = {}

    def grade(submission, exercise, options, watcher, *, stop=None):
        text = next(iter(submission.sources.values()))
        bad = {check for sign, check in fails.items() if sign in text}
        verdicts = [
            verdict_on(one, "failed", expected="an answer", observed="none", robot_time=3.14)
            if one.id in bad or "all" in bad
            else verdict_on(one, "passed", points=one.points)
            for one in exercise.checks
        ]
        for verdict in verdicts:
            watcher.on_verdict(verdict)

    def run(arena_run, stop=None):
        return Transcript("in_order", {}, [], [])

    monkeypatch.setattr(making, "grade", grade)
    monkeypatch.setattr(making, "run_in_arena", run)

    def sheet(student="anna", text=SERVICE):
        return Maker(exercise, Submission("motor_services", student, {"motor_services.py": text})).sheet()

    return fails, sheet


def test_only_changes_that_a_check_sees_are_asked(grader):
    fails, sheet = grader
    fails["time.sleep(2.5)"] = "follows_the_robot"
    (question,) = sheet().questions
    assert question.kind == "executor"
    key = question.parts[-1].key
    assert "clause" in key
    assert "expected an answer; observed none (at 3.1 s)" in key
    assert "1 of 3 questions" in sheet().note


def test_key_quotes_a_long_observation_in_part_and_its_steps_whole():
    verdict = verdict_on(
        load_exercise("motor_services", hidden=False).checks[0],
        "failed",
        expected="an answer",
        observed=f"{'9' * 400}; steps: 1 × get_status",
        robot_time=3.14,
    )
    key = making._seen(verdict)
    assert f"{'9' * 249}…; steps: 1 × get_status (at 3.1 s)." in key


def test_a_change_after_which_nothing_works_is_not_asked(grader):
    fails, sheet = grader
    fails["time.sleep(2.5)"] = "server_appears"
    assert not sheet().questions


def test_the_same_student_gets_the_same_questions_and_others_get_others(grader):
    fails, sheet = grader
    fails |= {"pass": "follows_the_robot", "if False": "powers_off", "time.sleep(2.5)": "powers_on"}
    assert sheet("anna") == sheet("anna")
    assert len({sheet(name).questions for name in ("anna", "ben", "cem", "dana")}) > 1


def test_no_questions_on_a_program_that_passes_nothing(grader):
    fails, sheet = grader
    fails["rclpy"] = "all"
    assert sheet().note == "no questions: the program passes no check"
    assert sheet(text="def (").note.startswith("no questions: the program cannot be read")


# -- pages and the command

ASKED = Question(
    "change", 2, "", (Part("Suppose line 2, `a < b`, were missing.", "clause 4: “It <answers> at once”"),)
)
SHEET = Sheet("+anna", "walk_to", "import rclpy\na < b\n", (ASKED,))


def test_students_page_has_the_program_and_no_key(tmp_path):
    write_pages(tmp_path, "walk_to", [SHEET, Sheet("ben", "walk_to", note="no questions: it is empty")])
    page = (tmp_path / "students" / "+anna.html").read_text()
    assert "<code>a &lt; b</code>" in page
    assert "   2  a &lt; b" in page
    assert "answers" not in page
    examiner = (tmp_path / EXAMINER).read_text()
    assert "clause 4: “It &lt;answers&gt; at once”" in examiner
    assert "no questions: it is empty" in examiner
    assert not (tmp_path / "students" / "ben.html").exists()
    (row,) = csv.DictReader(io.StringIO((tmp_path / TABLE).read_text(encoding="utf-8-sig")))
    assert row["student_id"] == "'+anna"  # no spreadsheet takes it for a formula
    assert row["key"] == "clause 4: “It <answers> at once”"


def test_finished_sheet_is_kept_until_what_it_depends_on_changes(tmp_path):
    path = tmp_path / "anna.json"
    keep(path, SHEET, "one")
    assert kept(path, "one") == SHEET
    assert kept(path, "other") is None
    path.write_text('{"made_for": "one", "sheet": {"questions": [3]}}')
    assert kept(path, "one") is None
    assert kept(tmp_path / "ben.json", "one") is None


@pytest.fixture
def submitted(tmp_path):
    for student in ("anna", "ben"):
        (tmp_path / "submitted" / student).mkdir(parents=True)
        (tmp_path / "submitted" / student / "motor_services.py").write_text(SERVICE)
    return tmp_path / "submitted"


def test_second_run_makes_only_what_is_missing(submitted, tmp_path, monkeypatch):
    made = []

    class FakeMaker:
        def __init__(self, exercise, submission, *_):
            self.student = submission.student

        def sheet(self):
            made.append(self.student)
            return replace(SHEET, student=self.student, exercise="motor_services")

    monkeypatch.setattr(command, "Maker", FakeMaker)
    words = ["motor_services", str(submitted), "--out", str(tmp_path / "out"), "--jobs", "1"]
    first = CliRunner().invoke(app("questions"), ["questions", *words, "--student", "ben"])
    assert first.exit_code == 0, first.output
    second = CliRunner().invoke(app("questions"), ["questions", *words])
    assert second.exit_code == 0, second.output
    assert made == ["ben", "anna"]
    assert "2 questions for 2 students" in second.output
    assert (tmp_path / "out" / "motor_services" / "students" / "anna.html").exists()


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["walk_to"], "has no submission of walk_to by anybody"),
        (["motor_services", "--student", "zoe"], "has no submission of motor_services by zoe"),
        (["patterns"], "has no lines to ask about"),
        (["interfaces"], "has no lines to ask about"),
        (["no_such_exercise"], "there is no exercise"),
    ],
)
def test_unusable_arguments_are_explained(submitted, words, message):
    result = CliRunner().invoke(app("questions"), ["questions", words[0], str(submitted), *words[1:]])
    assert result.exit_code == 2
    assert message in " ".join(result.output.split())
