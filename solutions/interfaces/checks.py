"""The checks that students can see and run themselves."""

from __future__ import annotations

from autograder.authoring import Transcript, check, program

from .judging import require_built, require_fields

SERVICE = program("build", {"file": "GetBatteryStatus.srv"}, timed=False)
ACTION = program("build", {"file": "NavigateToPose.action"}, timed=False)

RESPONSE = {"available": "bool", "battery": "sensor_msgs/BatteryState", "message": "string"}
GOAL = {"pose": "geometry_msgs/PoseStamped", "tolerance": "float32"}
RESULT = {"error_code": "uint16", "error_msg": "string", "distance_traveled": "float32"}
FEEDBACK = {
    "status": "string",
    "current_pose": "geometry_msgs/PoseStamped",
    "navigation_time": "builtin_interfaces/Duration",
    "estimated_time_remaining": "builtin_interfaces/Duration",
    "number_of_recoveries": "int16",
    "distance_remaining": "float32",
    "progress_percentage": "float32",
}


@check(on=SERVICE, see="04_your_own_interfaces#draft-why")
def service_builds(run: Transcript) -> None:
    """GetBatteryStatus.srv builds"""
    require_built(run, RESPONSE)


@check(points=2, on=SERVICE, needs=service_builds, see="04_your_own_interfaces#anatomy", clauses=[2, 11])
def response_has_its_fields(run: Transcript) -> None:
    """Its response has available, battery and message"""
    require_fields(run, "response", RESPONSE)


@check(on=ACTION, see="04_your_own_interfaces#draft-why")
def action_builds(run: Transcript) -> None:
    """NavigateToPose.action builds"""
    require_built(run, GOAL | RESULT | FEEDBACK)


@check(points=2, on=ACTION, needs=action_builds, see="04_your_own_interfaces#anatomy", clauses=[3, 4, 11])
def goal_has_its_fields(run: Transcript) -> None:
    """Its goal has the fields pose and tolerance"""
    require_fields(run, "goal", GOAL)


@check(points=2, on=ACTION, needs=action_builds, see="04_your_own_interfaces#anatomy", clauses=[5, 11])
def result_has_its_fields(run: Transcript) -> None:
    """Its result has error_code, error_msg and distance_traveled"""
    require_fields(run, "result", RESULT)


@check(
    points=2, on=ACTION, needs=action_builds, see="04_your_own_interfaces#anatomy", clauses=[7, 8, 9, 10, 11]
)
def feedback_has_its_fields(run: Transcript) -> None:
    """Its feedback has the seven fields of the task"""
    require_fields(run, "feedback", FEEDBACK)
