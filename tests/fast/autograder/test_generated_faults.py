"""The mutation operators, the mutants' names, and the selection of mutants to grade."""

import ast
from collections import Counter
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest
from typer.testing import CliRunner

from autograder.classroom.audit.generated import first_look as first_look_module
from autograder.classroom.audit.generated import mutant as mutant_module
from autograder.classroom.audit.generated import run as run_module
from autograder.classroom.audit.generated.first_look import Judged, as_fault, first_look
from autograder.classroom.audit.generated.mistakes import OPERATORS
from autograder.classroom.audit.generated.pattern import filled, match, parsed
from autograder.classroom.audit.generated.run import equivalents, figures, is_one_of, selected, survivors
from autograder.classroom.audit.run import AuditedRun
from autograder.engine.exercise import load_exercise
from autograder.engine.judging import verdict_on
from autograder.engine.verdict import CheckVerdict, Grade
from course_cli.app import app
from ros_runtime.course_error import CourseError

mutants_of_exercise = cache(mutant_module.mutants_of_exercise)

SERVICE = """
import math
import sys
import time
import rclpy
from humanoid_interfaces.msg import RobotState
from humanoid_interfaces.srv import ComputeIK, GetBatteryStatus, GetJointPositions
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import BatteryState, JointState

PATIENCE = 5.0

class Server(Node):
    def __init__(self):
        super().__init__("server")
        self.last = None
        self.busy = False
        self.create_subscription(BatteryState, "battery_state", self.on_battery, qos_profile_sensor_data)
        self.create_service(GetBatteryStatus, "get_battery_status", self.on_request)
        self.create_service(GetJointPositions, "get_joint_positions", self.on_names)
        self.create_service(ComputeIK, "compute_ik", self.on_ik)

    def on_battery(self, message):
        self.last = message

    def on_request(self, request, response):
        response.available = self.last is not None
        response.battery = self.last
        response.battery.percentage = level
        self.busy = False
        return response

    def on_names(self, request, response):
        for name in request.names:
            response.joint_state.name.append(name)
        return response

    def on_ik(self, request, response):
        if math.isfinite(request.target.point.x) and math.hypot(x, y) < 0.5:
            return ComputeIK.Response(error_code=ComputeIK.Response.SUCCESS, shoulder=wrap(angle))
        try:
            print("out of reach")
        finally:
            self.lock.release()
        return response

def main():
    return 1

if __name__ == "__main__":
    sys.exit(main())
"""

ACTION = """
import time
from action_msgs.msg import GoalStatus
from geometry_msgs.msg import Twist
from humanoid_interfaces.action import WalkTo
from humanoid_interfaces.msg import RobotState
from rclpy.action import ActionServer, CancelResponse

class Walker:
    def __init__(self, node):
        self.server = ActionServer(node, WalkTo, "walk_to", self.execute, cancel_callback=self.on_cancel)

    def on_cancel(self, goal_handle):
        return CancelResponse.ACCEPT

    def execute(self, goal_handle):
        first_step = self.state.steps
        deadline = time.monotonic() + 30.0
        calm = 0
        while time.monotonic() < deadline:
            if goal_handle.is_cancel_requested:
                goal_handle.canceled()
                return WalkTo.Result()
            if self.state.mode in (RobotState.FALLEN, RobotState.OFF):
                calm = 0
            if not all(math.isfinite(number) for number in numbers):
                break
        if status == GoalStatus.STATUS_SUCCEEDED:
            turn = math.cos(a) * x + y
        result = WalkTo.Result(total_steps=self.state.steps - first_step)
        result.final_pose = self.pose()
        return result
"""

EXAMPLES = [
    ("leaves_a_field_out", SERVICE, "pass instead of response.available = self.last is not None"),
    ("copies_some_fields", SERVICE, "response.battery.present = type(response.battery)().present"),
    ("collapses_duplicates", SERVICE, "list(dict.fromkeys(request.names)) instead of request.names"),
    ("answers_with_the_goal", ACTION, "goal_handle.request.target_pose instead of self.pose()"),
    ("rounds_a_number", SERVICE, "round(level, 2) instead of level"),
    ("takes_another_unit", SERVICE, "100 * (level) instead of level"),
    ("turns_the_sign_of_a_number", SERVICE, "-(wrap(angle)) instead of wrap(angle)"),
    ("turns_the_sign", ACTION, "math.cos(a) * x - y instead of math.cos(a) * x + y"),
    ("leaves_an_angle_unwrapped", SERVICE, "angle instead of wrap(angle)"),
    ("limits_each_axis", SERVICE, "max(abs(x), abs(y)) instead of math.hypot(x, y)"),
    ("counts_from_the_start", ACTION, "self.state.steps instead of self.state.steps - first_step"),
    ("takes_another_constant", ACTION, "RobotState.WALKING instead of RobotState.FALLEN"),
    ("takes_another_constant", SERVICE, "instead of ComputeIK.Response.SUCCESS"),
    ("forgets_one_of_several", ACTION, "self.state.mode == RobotState.FALLEN instead of self.state.mode in"),
    ("forgets_one_of_several", SERVICE, "math.isfinite(request.target.point.x) instead of math.isfinite("),
    ("drops_a_guard", ACTION, "False instead of self.state.mode in"),
    ("drops_a_guard", ACTION, "not (not all("),
    ("looks_at_the_first_only", ACTION, "for number in list(numbers)[:1])"),
    ("lets_nan_through", SERVICE, "True instead of math.isfinite(request.target.point.x)"),
    ("forgets_a_reset", SERVICE, "pass instead of self.busy = False"),
    ("forgets_a_reset", ACTION, "pass instead of calm = 0"),
    ("keeps_the_first_message", SERVICE, "return; globals()['came'] = True is added"),
    ("forgets_what_is_old", SERVICE, "> 5.0:; self.last = None is added"),
    ("waits_in_a_callback", SERVICE, "__import__('time').sleep(2.5) is added"),
    ("halves_or_doubles", SERVICE, "2.5 instead of 5.0"),
    ("restarts_the_deadline", ACTION, "deadline = time.monotonic() + 30.0 is added"),
    ("misses_a_cancel", ACTION, "False instead of goal_handle.is_cancel_requested"),
    ("ends_otherwise", ACTION, "goal_handle.abort instead of goal_handle.canceled"),
    ("answers_otherwise", ACTION, "CancelResponse.REJECT instead of CancelResponse.ACCEPT"),
    ("takes_the_code_for_the_status", ACTION, "result.error_code == 0 instead of status =="),
    ("loses_the_exit_status", SERVICE, "(1) and 0 instead of 1"),
    ("prints_to_the_other_stream", SERVICE, "print('out of reach', file=__import__('sys').stderr)"),
    ("drops_the_finally", SERVICE, "pass instead of self.lock.release()"),
    ("makes_a_name_absolute", ACTION, "'/' + 'walk_to'"),
    ("takes_the_usual_qos", SERVICE, "10 instead of qos_profile_sensor_data"),
]


def mutants(tmp_path, source, operator=None):
    base = tmp_path / "base.py"
    base.write_text(source)
    return [
        mutant for mutant in mutant_module.mutants_of_program(base) if operator in (None, mutant.operator)
    ]


@pytest.mark.parametrize(("operator", "source", "words"), EXAMPLES)
def test_operator_makes_the_mistake_that_its_sentence_names(tmp_path, operator, source, words):
    assert [one for one in mutants(tmp_path, source, operator) if words in one.sentence]


def test_every_operator_has_an_example(tmp_path):
    assert {operator for operator, _, _ in EXAMPLES} == set(OPERATORS)


@pytest.mark.parametrize(
    ("pattern", "source", "replacement", "expected"),
    [
        ("hypot(X, Y)", "math.hypot(a.x, 2)", "max(X, Y)", "max(a.x, 2)"),
        ("f(X, *R, **K)", "node.f(1, 2, 3, k=4)", "g(X, *R, **K)", "g(1, 2, 3, k=4)"),
        ("X <= Y <= X", "a <= b <= a", "Y", "b"),
        ("X <= Y <= X", "a <= b <= c", "Y", None),
        ("hypot(X, Y)", "math.hypot(*both)", "X", None),
        ("print(*R)", "print(1, end='')", "R", None),
        ("f(True)", "f(1)", "1", None),
    ],
)
def test_pattern_finds_what_its_letters_stand_for(pattern, source, replacement, expected):
    bound = match(parsed(pattern), parsed(source))
    assert (None if bound is None else filled(replacement, bound)) == expected


def test_mutants_compile_and_are_unique(tmp_path):
    for source in (SERVICE, ACTION):
        programs = [mutant.source for mutant in mutants(tmp_path, source)]
        for program in programs:
            compile(program, "mutant", "exec")
        assert len({*programs, ast.unparse(ast.parse(source))}) == len(programs) + 1


def test_names_do_not_change_when_other_lines_are_edited(tmp_path):
    before = {mutant.name for mutant in mutants(tmp_path, SERVICE)}
    edited = SERVICE.replace("import math\n", "import math\nimport os\n").replace(
        "        return response\n",
        "        self.get_logger().info('answered')\n        return response\n",
        1,
    )
    assert before <= {mutant.name for mutant in mutants(tmp_path, edited)}


def test_selection_takes_operators_and_bases_in_turn():
    made = mutants_of_exercise("joint_query")
    first = selected(made, 30)
    bases = Counter(mutant.base for mutant in first)
    assert {mutant.operator for mutant in first} == {mutant.operator for mutant in made}
    assert max(bases.values()) - min(bases.values()) <= 4
    assert selected(made, 30) == first != selected(made, 30, seed=1)


def test_selection_by_name():
    chosen = selected(mutants_of_exercise("joint_query"), 60, only="rounds_a_number*class_based")
    assert {mutant.operator for mutant in chosen} == {"rounds_a_number"}


def test_equivalent_needs_a_reason(tmp_path, monkeypatch):
    known = tmp_path / "walk_to" / "known"
    known.mkdir(parents=True)
    monkeypatch.setattr(run_module, "exercises_folder", lambda: tmp_path)
    assert equivalents("walk_to") == {}
    (known / "equivalent.txt").write_text("# judged by hand\nmisses_a_cancel.* * # never reached\n")
    assert equivalents("walk_to") == {"misses_a_cancel.* *": "never reached"}
    for line in ("misses_a_cancel.* *", "misses_a_cancel.* # never reached"):
        (known / "equivalent.txt").write_text(f"{line}\n")
        with pytest.raises(CourseError, match=r"line 1: expected .* why"):
            equivalents("walk_to")


def test_equivalents_are_found_by_name_and_sentence(tmp_path):
    (mutant,) = mutants(tmp_path, ACTION, "misses_a_cancel")
    assert is_one_of("misses_a_cancel.execute.*.base * instead of goal_handle.is_cancel_requested", mutant)
    assert not is_one_of("misses_a_cancel.* * instead of something", mutant)


def fault_of_joint_query():
    exercise = load_exercise("joint_query", hidden=True)
    return as_fault(mutants_of_exercise("joint_query")[0], exercise), exercise


def verdict(kind, status):
    return CheckVerdict(f"{kind} check", "", status, float(status == "passed"), 1, hidden=kind == "hidden")


def judged(**statuses):
    """Return a mutant of joint_query with the verdicts of a hidden and a visible check."""
    fault, _ = fault_of_joint_query()
    checks = [verdict(kind, status) for kind, status in statuses.items()]
    grade = Grade("joint_query", fault.name, "namespaces", checks, seed=0)
    return Judged(fault.mutant, AuditedRun(fault, 0, grade, 1.0))


def test_figures_count_visible_and_hidden_checks_separately():
    noticed = judged(hidden="not run", visible="failed")
    by_hidden = judged(visible="passed", hidden="failed")
    kept, broken = judged(hidden="passed", visible="passed"), judged(hidden="error")
    assert figures([noticed, by_hidden, kept, broken]) == [
        "2 of 3 lost points: 67 % (goal 98 %)",
        "1 by visible checks: 33 % (goal 75 %)",
        "1 could not be graded",
    ]
    assert survivors("joint_query", [noticed, by_hidden]) == []
    lines = survivors("joint_query", [kept])
    assert f"{kept.mutant.name} kept full marks" in lines
    assert f"    {kept.mutant.sentence}" in lines
    assert "solutions/joint_query/known/equivalent.txt" in lines[-2]


@pytest.mark.parametrize(
    ("verdicts", "looked_at"),
    [
        (["passed", "failed", "passed", "passed"], 2),
        (["passed", "passed", "failed", "passed"], 3),
        (["passed", "passed", "passed", "passed"], 4),
    ],
)
def test_failure_of_a_visible_check_or_else_of_a_hidden_one_ends_a_grading(monkeypatch, verdicts, looked_at):
    fault, exercise = fault_of_joint_query()
    hidden = [check for check in exercise.checks if check.hidden]
    few = replace(exercise, checks=[*exercise.checks[:2], *hidden[:2]])
    looked = []

    def grade(submission, exercise, options, watcher, **rest):
        for check, status in zip(exercise.checks, verdicts, strict=True):
            looked.append(verdict_on(check, status))
            watcher.on_verdict(looked[-1])
        return Grade(exercise.name, fault.name, "namespaces", looked, seed=0)

    monkeypatch.setattr(first_look_module, "grade", grade)
    statuses = [check.status for check in first_look(fault, few).grade.checks]
    assert statuses == verdicts[:looked_at] + ["not run"] * (4 - looked_at)


def test_fault_is_the_file_that_students_write():
    fault, _ = fault_of_joint_query()
    assert dict(fault.read().sources) == {"joint_query.py": fault.mutant.source}
    assert fault.kind == "faulty"  # and so it shares arenas


def test_show_prints_the_diff():
    (mutant, *_) = mutants_of_exercise("joint_query")
    shown = CliRunner().invoke(app("audit"), ["audit", "joint_query", "--generated", "--show", mutant.name])
    assert shown.output.splitlines()[:2] == [mutant.sentence, f"--- correct/{Path(mutant.base).name}"]
    unknown = CliRunner().invoke(app("audit"), ["audit", "joint_query", "--generated", "--show", "no_such"])
    assert unknown.exit_code == 2
    assert "there is no mutant no_such" in unknown.output
