"""The built interfaces have exactly the fields and constants that other people's code relies on."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest

from humanoid_interfaces import action, msg, srv

ROOT = Path(__file__).resolve().parents[3]
SOURCE = ROOT / "humanoid_interfaces"

POSE = "geometry_msgs/PoseStamped"
DURATION = "builtin_interfaces/Duration"
OUTCOME = {"error_code": "uint16", "error_msg": "string"}

FIELDS = [
    (
        msg.RobotState,
        {"header": "std_msgs/Header", "mode": "uint8", "motors_enabled": "boolean", "steps": "uint32"},
    ),
    (msg.BalanceGains, dict.fromkeys(("kp_pitch", "kd_pitch", "kp_roll", "kd_roll", "max_torque"), "double")),
    (
        msg.JointLimits,
        {"names": "sequence<string>", **dict.fromkeys(("lower", "upper", "velocity"), "sequence<double>")},
    ),
    (srv.AddTwoInts.Request, {"a": "int64", "b": "int64"}),
    (srv.AddTwoInts.Response, {"sum": "int64"}),
    (srv.GetBatteryStatus.Request, {}),
    (
        srv.GetBatteryStatus.Response,
        {"available": "boolean", "battery": "sensor_msgs/BatteryState", "message": "string"},
    ),
    (srv.GetJointPositions.Request, {"names": "sequence<string>"}),
    (
        srv.GetJointPositions.Response,
        {"success": "boolean", "message": "string", "joint_state": "sensor_msgs/JointState"},
    ),
    (srv.SetFloat64.Request, {"data": "double"}),
    (srv.SetFloat64.Response, {"success": "boolean", "message": "string"}),
    (srv.ComputeIK.Request, {"target": "geometry_msgs/PointStamped", "elbow_up": "boolean"}),
    (
        srv.ComputeIK.Response,
        {"error_code": "int32", "message": "string", "shoulder": "double", "elbow": "double"},
    ),
    (srv.ComputeArmIK.Request, {"arm": "string", "hand_pose": POSE, "with_waist": "boolean"}),
    (
        srv.ComputeArmIK.Response,
        {"error_code": "int32", "message": "string", "joint_state": "sensor_msgs/JointState"},
    ),
    (srv.NavigateToPose.Request, {"target_pose": "geometry_msgs/Pose", "navigation_mode": "string"}),
    (srv.NavigateToPose.Response, {"success": "boolean", "message": "string", "execution_time": "double"}),
    (action.WalkTo.Goal, {"target_pose": POSE, "max_velocity": "double"}),
    (action.WalkTo.Result, {**OUTCOME, "final_pose": POSE, "total_steps": "uint32"}),
    (
        action.WalkTo.Feedback,
        {
            "current_pose": POSE,
            "distance_remaining": "double",
            "steps_taken": "uint32",
            "estimated_time_remaining": DURATION,
        },
    ),
    (action.NavigateToPose.Goal, {"pose": POSE, "tolerance": "float"}),
    (action.NavigateToPose.Result, {**OUTCOME, "distance_traveled": "float"}),
    (
        action.NavigateToPose.Feedback,
        {
            "status": "string",
            "current_pose": POSE,
            "navigation_time": DURATION,
            "estimated_time_remaining": DURATION,
            "number_of_recoveries": "int16",
            "distance_remaining": "float",
            "progress_percentage": "float",
        },
    ),
    (
        action.MoveArm.Goal,
        {"arm": "string", "trajectory": "trajectory_msgs/JointTrajectory", "goal_tolerance": "double"},
    ),
    (action.MoveArm.Result, OUTCOME),
    (action.MoveArm.Feedback, {"waypoint": "uint32", "max_error": "double", "progress_percentage": "float"}),
    (action.PickAndPlace.Goal, {"object_id": "string", "place_pose": POSE, "grasp_force": "double"}),
    (action.PickAndPlace.Result, {**OUTCOME, "final_object_pose": POSE, "max_grasp_force": "double"}),
    (
        action.PickAndPlace.Feedback,
        {
            "stage": "string",
            "percent_complete": "float",
            "hand_pose": POSE,
            "distance_to_object": "double",
            "grasp_force": "double",
        },
    ),
    (action.StandUp.Goal, {}),
    (action.StandUp.Result, OUTCOME),
    (action.StandUp.Feedback, {"phase": "string", "percent_complete": "float"}),
]

WALK_CODES = {"NONE": 0, "FELL": 1, "PREEMPTED": 2, "TIMEOUT": 3}
CONSTANTS = {
    msg.RobotState: {"OFF": 0, "STANDING": 1, "WALKING": 2, "FALLEN": 3},
    srv.ComputeArmIK.Response: {
        "SUCCESS": 1,
        "NO_IK_SOLUTION": -31,
        "FRAME_TRANSFORM_FAILURE": -21,
        "INVALID_GROUP_NAME": -15,
    },
    srv.ComputeIK.Response: {"SUCCESS": 1, "NO_IK_SOLUTION": -31, "FRAME_TRANSFORM_FAILURE": -21},
    action.WalkTo.Result: WALK_CODES,
    action.NavigateToPose.Result: WALK_CODES,
    action.MoveArm.Result: {
        "NONE": 0,
        "INVALID_JOINTS": 1,
        "PATH_TOLERANCE_VIOLATED": 2,
        "GOAL_TOLERANCE_VIOLATED": 3,
        "PREEMPTED": 4,
    },
    action.PickAndPlace.Result: {
        "NONE": 0,
        "UNKNOWN_OBJECT": 1,
        "UNREACHABLE": 2,
        "GRASP_FAILED": 3,
        "DROPPED": 4,
        "FELL": 5,
        "PREEMPTED": 6,
    },
    action.PickAndPlace.Feedback: {
        stage.upper(): stage
        for stage in ("approaching", "grasping", "lifting", "moving", "placing", "retreating")
    },
    action.StandUp.Result: {"NONE": 0, "FELL": 1, "ALREADY_STANDING": 2},
}


def declared_constants(message_type: type) -> dict[str, object]:
    """The constants of a generated class: the upper-case names of its metaclass."""
    metaclass = type(message_type)
    return {
        name: getattr(message_type, name) for name in vars(metaclass) if name.isupper() and name[0] != "_"
    }


@pytest.mark.parametrize(("message_type", "fields"), FIELDS, ids=lambda value: getattr(value, "__name__", ""))
def test_fields_and_their_order(message_type: type, fields: dict[str, str]) -> None:
    assert list(message_type.get_fields_and_field_types().items()) == list(fields.items())


@pytest.mark.parametrize("message_type", [entry[0] for entry in FIELDS], ids=lambda value: value.__name__)
def test_constants(message_type: type) -> None:
    assert declared_constants(message_type) == CONSTANTS.get(message_type, {})


def test_every_source_file_is_tested_and_in_the_cmake_list() -> None:
    sources = {
        str(path.relative_to(SOURCE))
        for kind in ("msg", "srv", "action")
        for path in SOURCE.glob(f"{kind}/*")
    }
    tested = {f"{kind}/{name}" for kind, name in (_interface_of(entry[0]) for entry in FIELDS)}
    cmake = (SOURCE / "CMakeLists.txt").read_text(encoding="utf-8")

    assert {source.rpartition(".")[0] for source in sources} == tested
    assert [source for source in sources if f'"{source}"' not in cmake] == []


def _interface_of(message_type: type) -> tuple[str, str]:
    """("srv", "ComputeIK") for the class ComputeIK_Response."""
    kind = message_type.__module__.split(".")[1]
    return kind, message_type.__name__.partition("_")[0]


def test_the_folder_is_a_stock_ros_package() -> None:
    package = ElementTree.parse(SOURCE / "package.xml").getroot()

    assert package.get("format") == "3"
    assert package.findtext("name") == "humanoid_interfaces"
    assert package.findtext("member_of_group") == "rosidl_interface_packages"
    assert package.findtext("export/build_type") == "ament_cmake"


def test_the_source_folder_does_not_hide_the_built_package() -> None:
    command = [sys.executable, "-c", "import humanoid_interfaces.msg as m; print(m.__file__)"]
    printed = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout

    assert SOURCE not in Path(printed.strip()).parents
