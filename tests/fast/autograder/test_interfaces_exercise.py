"""The failure of an incomplete definition names the missing line, or the missing ---."""

import json
from dataclasses import asdict

import pytest

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import Failure
from autograder.engine.exercise import load_exercise
from ros_runtime.interface_build.definitions import InvalidDefinitions, read_definitions
from ros_runtime.interface_build.known_types import KnownTypes

CHECKS = {check.id: check for check in load_exercise("interfaces", hidden=True).checks}
GOAL = {"pose": "geometry_msgs/PoseStamped", "tolerance": "float32"}
RESULT = {"error_code": "uint16", "error_msg": "string", "distance_traveled": "float32"}
RESPONSE = {"available": "bool", "battery": "sensor_msgs/BatteryState", "message": "string"}


def part(fields, constants=None):
    return {"fields": fields, "constants": constants or {}}


def failure(check, file="NavigateToPose.action", **parts):
    """Return how a check fails on a build that reports these parts."""
    return failure_of(check, file, {"built": True, "types": {file: parts}})


def failure_of(check, file, report):
    printed = ev.NodeOutput(t=1.0, stream="stdout", text=json.dumps(report))
    with pytest.raises(Failure) as failed:
        CHECKS[check].run([Transcript.from_events("build", {"file": file}, [printed])])
    return failed.value


def test_a_field_in_another_part_asks_for_the_separator():
    told = failure("goal_has_its_fields", goal=part({}), result=part(GOAL), feedback=part({}))
    assert told.help == "`pose` is in the result: check whether a --- is missing or misplaced."
    without_tolerance = {name: GOAL[name] for name in ("pose",)}
    told = failure("goal_has_its_fields", goal=part(without_tolerance), result=part(GOAL), feedback=part({}))
    assert told.help == "`tolerance` is in the result: check whether a --- is missing or misplaced."


def test_a_constant_in_another_part_asks_for_the_separator_too():
    none = {"NONE": {"type": "uint16", "value": 0}}
    told = failure("error_codes_have_names", goal=part(GOAL), result=part(RESULT), feedback=part({}, none))
    assert told.help == "`NONE` is in the feedback: check whether a --- is missing or misplaced."


def test_a_missing_line_is_given():
    reported = failure("result_has_its_fields", goal=part(GOAL), result=part({"error_code": "uint16"}))
    assert reported.help == "Add the line “string error_msg” to the result."
    reported = failure("error_codes_have_names", goal=part(GOAL), result=part(RESULT))
    assert reported.help.startswith("Add the line “uint16 NONE=0” to the result")


def test_a_field_of_another_name_is_to_be_renamed():
    response = {"success": "bool", **{name: RESPONSE[name] for name in ("battery", "message")}}
    reported = failure(
        "response_has_its_fields", "GetBatteryStatus.srv", request=part({}), response=part(response)
    )
    assert reported.help.startswith("Rename `success` to `available`")


@pytest.mark.parametrize(
    ("fields", "reason"),
    [
        ({"pose": "geometry_msgs/Pose"}, "the frame of the numbers is unknown"),
        ({"tolerance": "float64"}, "float64 is a different type"),
    ],
)
def test_a_wrong_type_is_reported_with_the_right_one(fields, reason):
    reported = failure("goal_has_its_fields", goal=part(GOAL | fields))
    assert reason in reported.help
    assert reported.help.startswith("Write ")


def test_a_constant_of_another_value():
    one = {"NONE": {"type": "uint16", "value": 1}}
    assert "Write “uint16 NONE=0”" in failure("error_codes_have_names", result=part(RESULT, one)).help


def test_a_field_too_many_is_to_be_removed():
    told = failure("result_has_its_fields", result=part(RESULT | {"success": "bool"}))
    assert told.help.startswith("Remove the field `success`")


@pytest.mark.parametrize(
    ("line", "text", "expected", "next_step"),
    [
        (2, "float tolerance # m", "float64", "Change line 2 to “float32 tolerance”."),
        (2, "float depth", "float64", "Change line 2. Expected: float64."),
        (0, "", "at most 200", "Change the file. Expected: at most 200."),
        (
            0,
            "",
            "1: it is request --- response",
            "Put 1 of these lines into the file: it is request --- response.",
        ),
    ],
)
def test_a_line_that_the_build_refuses_is_corrected(line, text, expected, next_step):
    problem = {"line": line, "text": text, "wrong": "it is wrong", "expected": expected}
    report = {"built": False, "problems": [problem], "more": 0, "log": ""}
    assert failure_of("action_builds", "NavigateToPose.action", report).help == next_step


def test_a_file_that_was_not_handed_in(tmp_path):
    with pytest.raises(InvalidDefinitions) as nothing:
        read_definitions(tmp_path, "my_interfaces", KnownTypes({}))
    problems = [asdict(problem) for problem in nothing.value.problems]
    report = {"built": False, "problems": problems, "more": 0, "log": ""}
    reported = failure_of("action_builds", "NavigateToPose.action", report)
    assert reported.observed == "it was not handed in"
    assert "%%writefile NavigateToPose.action" in reported.help
