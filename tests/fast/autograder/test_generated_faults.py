"""The operators that make mistakes in correct submissions, the mutants' names, and which of them are graded."""

import ast
from collections import Counter
from functools import cache
from pathlib import Path

import pytest
from typer.testing import CliRunner

from autograder.audit.generated import mutant as mutant_module
from autograder.audit.generated import selection
from autograder.audit.generated.fault import Judged, as_faults
from autograder.audit.generated.mistakes import OPERATORS
from autograder.audit.generated.selection import equivalents, selected
from autograder.audit.generated.table import figures, survivors
from autograder.audit.known_submission import HeaderError
from autograder.audit.run import AuditedRun
from autograder.engine.exercise import exercise_names, load_exercise
from autograder.engine.verdict import CheckVerdict, Grade
from course_cli.app import app

mutants_of_exercise = cache(mutant_module.mutants_of_exercise)

SERVICE = """
import math
import sys
import time
import rclpy
from humanoid_interfaces.msg import RobotState
from humanoid_interfaces.srv import ComputeIK, GetBatteryStatus, GetJointPositions
from rclpy.node import Node
from sensor_msgs.msg import BatteryState, JointState

PATIENCE = 5.0

class Server(Node):
    def __init__(self):
        super().__init__("server")
        self.last = None
        self.busy = False
        self.create_subscription(BatteryState, "battery_state", self.on_battery, LATCHED)
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
from geometry_msgs.msg import Twist
from humanoid_interfaces.action import WalkTo
from humanoid_interfaces.msg import RobotState
from rclpy.action import ActionServer, CancelResponse

CANCEL = CancelResponse.ACCEPT

class Walker:
    def __init__(self, node):
        self.server = ActionServer(node, WalkTo, "walk_to", self.execute, cancel_callback=lambda _: CANCEL)

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
            turn = 0.0
        result = WalkTo.Result(total_steps=self.state.steps - first_step)
        result.final_pose = self.pose()
        return result
"""


def mutants(tmp_path, source, operator=None):
    base = tmp_path / "base.py"
    base.write_text(source)
    return [
        mutant for mutant in mutant_module.mutants_of_program(base) if operator in (None, mutant.operator)
    ]


@pytest.mark.parametrize(
    ("operator", "source", "sentence", "changed"),
    [
        (
            "leaves_a_field_out",
            SERVICE,
            "response.available is left as it was, in line 27",
            ["+        pass"],
        ),
        ("copies_some_fields", SERVICE, "response.battery is copied field by field, without present,", None),
        (
            "collapses_duplicates",
            SERVICE,
            "duplicates in request.names are lost",
            ["+        for name in list(dict.fromkeys(request.names)):"],
        ),
        (
            "answers_with_the_goal",
            ACTION,
            "result.final_pose is goal_handle.request.target_pose instead",
            ["+        result.final_pose = goal_handle.request.target_pose"],
        ),
        (
            "rounds_a_number",
            SERVICE,
            "round(…, 2) around response.battery.percentage",
            ["+        response.battery.percentage = round(level, 2)"],
        ),
        (
            "takes_another_unit",
            SERVICE,
            "response.battery.percentage in percent of 100",
            ["+        response.battery.percentage = 100 * (level)"],
        ),
        (
            "turns_the_sign",
            SERVICE,
            "the sign of ComputeIK.Response.shoulder is turned",
            [
                "+            return ComputeIK.Response(error_code=ComputeIK.Response.SUCCESS, shoulder=-(wrap(angle)))"
            ],
        ),
        (
            "leaves_an_angle_unwrapped",
            SERVICE,
            "angle is not wrapped",
            ["+            return ComputeIK.Response(error_code=ComputeIK.Response.SUCCESS, shoulder=angle)"],
        ),
        (
            "limits_each_axis",
            SERVICE,
            "max(abs(x), abs(y)) instead of math.hypot(x, y)",
            ["+        if math.isfinite(request.target.point.x) and max(abs(x), abs(y)) < 0.5:"],
        ),
        (
            "counts_from_the_start",
            ACTION,
            "self.state.steps counts since the robot's start",
            ["+        result = WalkTo.Result(total_steps=self.state.steps)"],
        ),
        (
            "tests_for_another_state",
            ACTION,
            "RobotState.OFF is forgotten among several",
            ["+            if self.state.mode in (RobotState.FALLEN,):"],
        ),
        (
            "tests_for_another_state",
            ACTION,
            "WALKING instead of FALLEN",
            ["+            if self.state.mode in (RobotState.WALKING, RobotState.OFF):"],
        ),
        (
            "drops_a_condition",
            SERVICE,
            "the condition math.hypot(x, y) < 0.5 is forgotten",
            ["+        if math.isfinite(request.target.point.x):"],
        ),
        (
            "drops_a_guard",
            ACTION,
            "the guard not all(math.isfinite(number) for number in numbers) is turned round",
            ["+            if not (not all(math.isfinite(number) for number in numbers)):"],
        ),
        (
            "checks_the_first_only",
            ACTION,
            "only the first of numbers is looked at",
            ["+            if not all(math.isfinite(number) for number in list(numbers)[:1]):"],
        ),
        (
            "lets_nan_through",
            SERVICE,
            "math.isfinite(request.target.point.x) is not asked",
            ["+        if True and math.hypot(x, y) < 0.5:"],
        ),
        ("forgets_a_reset", SERVICE, "self.busy is not reset to False", ["+        pass"]),
        ("forgets_a_reset", ACTION, "calm is not reset to 0", ["+                pass"]),
        (
            "keeps_the_first_message",
            SERVICE,
            "the subscription callback on_battery keeps the first message: self.last = message",
            ["+        if self.last is None: self.last = message"],
        ),
        ("forgets_what_is_old", SERVICE, "takes self.last for unknown when it is older than 5 s", None),
        (
            "waits_in_a_callback",
            SERVICE,
            "time.sleep(2.5) at the start of the service callback on_names",
            ['+        __import__("time").sleep(2.5)'],
        ),
        ("waits_in_a_callback", ACTION, "time.sleep(0.7) at the start of the cancel callback lambda", None),
        ("halves_or_doubles", SERVICE, "2.5 instead of 5.0 in PATIENCE = 5.0", ["+PATIENCE = 2.5"]),
        (
            "restarts_the_deadline",
            ACTION,
            "deadline begins anew in every round of the loop",
            ["+            deadline = time.monotonic() + 30.0"],
        ),
        ("misses_a_cancel", ACTION, "a cancel is not seen in execute", ["+            if False:"]),
        ("swaps_the_status", ACTION, "abort instead of canceled", ["+                goal_handle.abort()"]),
        ("swaps_the_status", SERVICE, "instead of SUCCESS", None),
        (
            "takes_the_code_for_the_status",
            ACTION,
            "result.error_code == 0 instead of status == GoalStatus.STATUS_SUCCEEDED",
            ["+        if result.error_code == 0:"],
        ),
        ("loses_the_exit_status", SERVICE, "main() without exit", ["+    main()"]),
        (
            "prints_to_the_other_stream",
            SERVICE,
            "on stderr",
            ['+            print("out of reach", file=__import__("sys").stderr)'],
        ),
        ("drops_the_finally", SERVICE, "the finally of on_ik is left out", ["+            pass"]),
        ("makes_a_name_absolute", ACTION, 'the absolute name "/walk_to"', None),
        ("takes_the_usual_qos", SERVICE, '10 instead of LATCHED for "battery_state"', None),
    ],
)
def test_operator_makes_what_its_sentence_says(tmp_path, operator, source, sentence, changed):
    (mutant, *_) = [one for one in mutants(tmp_path, source, operator) if sentence in one.sentence]
    assert changed is None or [line for line in mutant.changed_lines() if line[0] == "+"] == changed


def test_every_operator_has_an_example(tmp_path):
    made = {mutant.operator for source in (SERVICE, ACTION) for mutant in mutants(tmp_path, source)}
    assert made == set(OPERATORS)


def test_copy_leaves_out_the_field_that_its_sentence_names(tmp_path):
    (mutant,) = [
        one
        for one in mutants(tmp_path, SERVICE, "copies_some_fields")
        if one.sentence.startswith("response.battery is copied field by field, without voltage,")
    ]
    (line,) = [line for line in mutant.changed_lines() if "type(whole)" in line]
    assert "current=whole.current" in line
    assert "voltage=whole.voltage" not in line


def test_mutants_compile_and_none_is_there_twice(tmp_path):
    for source in (SERVICE, ACTION):
        meanings = [ast.dump(ast.parse(mutant.source)) for mutant in mutants(tmp_path, source)]
        assert len({*meanings, ast.dump(ast.parse(source))}) == len(meanings) + 1


def test_names_outlast_edits_of_other_lines(tmp_path):
    before = {mutant.name for mutant in mutants(tmp_path, SERVICE)}
    edited = SERVICE.replace("import math\n", "import math\nimport os\n").replace(
        "        return response\n",
        "        self.get_logger().info('answered')\n        return response\n",
        1,
    )
    assert before <= {mutant.name for mutant in mutants(tmp_path, edited)}


def test_places_in_a_program_with_accents_are_found(tmp_path):
    source = "LÄNGE, PATIENCE = 'é', 5.0  # …\n"
    assert mutants(tmp_path, source, "halves_or_doubles")[0].source == "LÄNGE, PATIENCE = 'é', 2.5  # …\n"


FEW = {"interfaces": 0, "patterns": 20}  # definitions are no programs; answers are mostly words


@pytest.mark.parametrize("name", exercise_names())
def test_every_exercise_yields_enough_mutants_with_names_of_their_own(name):
    made = mutants_of_exercise(name)
    assert len(made) >= FEW.get(name, 60)
    assert len({mutant.name for mutant in made}) == len(made)
    assert len(selected(made, 60)) == min(60, len(made))


@pytest.mark.parametrize("name", exercise_names())
def test_equivalents_are_still_made(name):
    assert set(equivalents(name)) <= {mutant.name for mutant in mutants_of_exercise(name)}


def test_selection_takes_operators_and_bases_in_turn():
    made = mutants_of_exercise("joint_query")
    first = selected(made, 30)
    operators = Counter(mutant.operator for mutant in first)
    bases = Counter(mutant.base for mutant in first)
    assert set(operators) == {mutant.operator for mutant in made}
    assert max(bases.values()) - min(bases.values()) <= 4
    assert selected(made, 30) == first != selected(made, 30, seed=1)


def test_selection_by_name():
    chosen = selected(mutants_of_exercise("joint_query"), 60, only="rounds_a_number*class_based")
    assert chosen
    assert all(mutant.operator == "rounds_a_number" for mutant in chosen)


def test_equivalent_needs_a_reason(tmp_path, monkeypatch):
    known = tmp_path / "walk_to" / "known"
    known.mkdir(parents=True)
    monkeypatch.setattr(selection, "exercises_folder", lambda: tmp_path)
    assert equivalents("walk_to") == {}
    (known / "equivalent.txt").write_text(
        "# judged by hand\nmisses_a_cancel.execute.123456.base: never reached\n"
    )
    assert equivalents("walk_to") == {"misses_a_cancel.execute.123456.base": "never reached"}
    (known / "equivalent.txt").write_text("misses_a_cancel.execute.123456.base\n")
    with pytest.raises(HeaderError, match=r"line 1: expected .* why"):
        equivalents("walk_to")


def judged(statuses):
    """Return a mutant of joint_query with the verdicts of a hidden and a visible check."""
    exercise = load_exercise("joint_query", hidden=True)
    fault = as_faults(mutants_of_exercise("joint_query")[:1], exercise)[0]
    checks = [
        CheckVerdict(f"{kind} check", "", status, float(status == "passed"), 1, hidden=kind == "hidden")
        for kind, status in statuses.items()
    ]
    grade = Grade("joint_query", fault.name, "namespaces", checks, seed=0)
    return Judged(fault.mutant, AuditedRun(fault, 0, grade, 1.0))


def test_figures_tell_visible_from_hidden_checks():
    noticed = judged({"hidden": "not run", "visible": "failed"})
    by_hidden = judged({"hidden": "failed", "visible": "passed"})
    kept, broken = judged({"hidden": "passed", "visible": "passed"}), judged({"hidden": "error"})
    lines = figures([noticed, by_hidden, kept, broken])
    assert lines == [
        "2 of 3 lost points (67 %), 1 by visible checks alone (33 %)",
        "not graded: 1",
    ]
    assert survivors([noticed, by_hidden]) == []
    assert f"{kept.mutant.name} kept full marks" in survivors([kept])
    assert f"    {kept.mutant.sentence}" in survivors([kept])


def test_fault_is_the_file_that_students_write():
    exercise = load_exercise("joint_query", hidden=True)
    (fault,) = as_faults(mutants_of_exercise("joint_query")[:1], exercise)
    assert dict(fault.read().sources) == {"joint_query.py": fault.mutant.source}
    assert fault.kind == "faulty"  # and so it shares arenas


def test_show_prints_the_diff():
    (mutant, *_) = mutants_of_exercise("joint_query")
    shown = CliRunner().invoke(app("audit"), ["audit", "joint_query", "--generated", "--show", mutant.name])
    assert shown.output.splitlines()[:2] == [mutant.sentence, f"--- correct/{Path(mutant.base).name}"]
    unknown = CliRunner().invoke(app("audit"), ["audit", "joint_query", "--generated", "--show", "no_such"])
    assert unknown.exit_code == 2
    assert "there is no mutant no_such" in unknown.output
