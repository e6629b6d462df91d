"""The cells of chapter 4 show what its text says."""

from __future__ import annotations

import re

from execution import Executed, in_order
from gap_trials import GapTrials, Trial

CHAPTER = "04_your_own_interfaces"
ACTION = "my_interfaces/action/WalkAhead.action"


def test_half_of_the_types_that_textbooks_name_do_not_exist(chapter: Executed) -> None:
    exists = dict(line.split() for line in chapter.text("types").splitlines())
    assert [name for name, found in exists.items() if found == "True"] == [
        "std_srvs/srv/SetBool",
        "sensor_msgs/msg/BatteryState",
        "geometry_msgs/msg/PointStamped",
        "nav_msgs/srv/GetPlan",
    ]
    assert len(exists) == 8


def test_the_draft_is_refused_line_by_line(chapter: Executed) -> None:
    printed = chapter.text("draft-build")
    assert in_order(
        printed,
        "my_interfaces was not built",
        "line 1: float x",
        "expected: float64",
        "line 2: float y",
        "line 3: --",
        "not a separator",
        "line 5: string Message",
        "string message",
    )
    assert "line 4" not in printed
    assert "line 6" not in printed


def test_the_interfaces_are_built_and_imported(chapter: Executed) -> None:
    assert in_order(
        chapter.text("build"),
        "my_interfaces/action/WalkAhead, my_interfaces/srv/CanReach: built",
        "{'error_code': 'int32', 'message': 'string', 'distance': 'double'}",
        "{'error_code': 'uint16', 'error_msg': 'string', 'distance_walked': 'double'}",
    )


def test_the_package_is_shown_as_colcon_builds_it(chapter: Executed) -> None:
    assert in_order(
        chapter.text("package"),
        "ros2_ws/src/my_interfaces/CMakeLists.txt",
        "ros2_ws/src/my_interfaces/srv/CanReach.srv",
        "<name>my_interfaces</name>",
        "<depend>geometry_msgs</depend>",
        "rosidl_interface_packages",
    )
    assert in_order(
        chapter.text("package-cmake"), "rosidl_generate_interfaces", "WalkAhead.action", "CanReach.srv"
    )


def test_the_ros2_commands_know_standard_and_own_types(chapter: Executed) -> None:
    assert in_order(chapter.text("types-cli"), "nav_msgs/srv/GetPlan", "std_srvs/srv/SetBool")
    assert in_order(chapter.text("anatomy-code"), "int32 NO_IK_SOLUTION=-31", "is -31")
    assert in_order(
        chapter.text("package-show"),
        "    my_interfaces/srv/CanReach",
        "    my_interfaces/action/WalkAhead",
        "float64 distance_walked",
        "float64 distance_remaining",
    )
    assert in_order(chapter.text("server-cli"), "CanReach_Response(error_code=1", "distance=0.5)")


def test_the_server_answers_reach_and_frame_with_codes(chapter: Executed) -> None:
    lines = chapter.text("server-run").splitlines()
    assert [line.split()[:2] for line in lines] == [["1", "0.50"], ["-31", "0.60"], ["-21", "nan"]]
    assert "frame 'odom'" in lines[2]
    assert "can_reach server to notebook: error_code -21" in chapter.html("server-draw")


def test_both_elbows_hit_the_target_and_degrees_do_not(chapter: Executed) -> None:
    below, above, degrees = re.findall(r"\((-?[\d.]+), (-?[\d.]+)\)", chapter.text("fk"))
    assert below == above == ("0.4", "0.3")
    assert float(degrees[0]) < 0.05
    assert float(degrees[1]) > 0.45


def test_out_of_reach_has_no_cosine(chapter: Executed) -> None:
    printed = chapter.text("cosine")
    assert re.findall(r"q2 = (-?[\d.]+)", printed) == ["0.65", "1.38", "-1.01"]
    assert "acos: " in printed


def test_a_parameter_is_overridden_set_and_refused(chapter: Executed) -> None:
    assert "0.05 m to 0.65 m" in chapter.text("parameters-start")
    assert in_order(
        chapter.text("parameters-set"),
        "Set parameter successful",
        "0.10 m to 0.50 m",
        "Setting parameter failed",
        "Wrong parameter type",
        "Double value is: 0.2",
    )
    assert in_order(chapter.text("parameters-int"), "InvalidParameterTypeException", "INTEGER", "DOUBLE")


def test_one_request_for_all_blames_the_last(chapter: Executed) -> None:
    answers = ["0.1", "0.3", "0.6"]
    for cell, questions in (("reuse-run", ["0.6"] * 3), ("reuse-fix", answers)):
        printed = re.findall(r"x = ([\d.]+): distance ([\d.]+) m", chapter.text(cell))
        assert printed == list(zip(questions, answers, strict=True))


def test_a_walk_as_a_service_goes_on_without_its_client(chapter: Executed) -> None:
    printed = chapter.text("walk-run")
    assert in_order(printed, "client: no answer within two seconds", "robot:  WALKING at x")
    walked_on = re.search(r"another ([\d.]+) m since then", printed)
    assert walked_on
    assert float(walked_on[1]) > 0.5


def test_the_walk_as_an_action_is_watched_cancelled_and_rejected(chapter: Executed) -> None:
    printed = chapter.text("ahead-run")
    assert in_order(printed, "m to go", "cancel: accepted", "end:    CANCELED (error_code 0", "STANDING")
    walked = re.search(r"distance_walked ([\d.]+)\)", printed)
    assert walked
    assert 0.1 < float(walked[1]) < 1.9
    assert in_order(chapter.html("ahead-draw"), "goal accepted", "feedback", "cancel_goal", "CANCELED")
    assert chapter.text("ahead-reject").count("accepted: False") == 2


def test_a_forgotten_build_is_reported(chapter: Executed) -> None:
    assert chapter.text("battery-forgot") == (
        "AttributeError: 'BatteryLevel' object has no attribute 'percentage'\n"
    )


def test_an_old_version_is_misread_in_silence_until_both_are_started_again(chapter: Executed) -> None:
    misread = re.search(r"^percentage ([\d.]+): go on$", chapter.text("battery-stale"), re.MULTILINE)
    assert misread
    assert 5 < float(misread[1]) <= 15  # of a hundred; the battery drains while the package is built
    hashes = dict(re.findall(r"^(\w+) +(RIHS01_\w+)…$", chapter.text("battery-hash"), re.MULTILINE))
    assert hashes.keys() == {"level", "guard"}
    assert len(set(hashes.values())) == 2
    fixed = re.match(r"percentage (0\.\d\d): walk home\none version: True\n", chapter.text("battery-fixed"))
    assert fixed
    assert 0.05 < float(fixed[1]) <= 0.15


def test_the_gaps_say_what_is_wrong(gaps: GapTrials, trial: Trial) -> None:
    gaps.require_reply(trial)


def test_the_gap_of_the_refusal_asks_for_a_build_and_says_what_is_wrong(gaps: GapTrials) -> None:
    def reply(*lines: str) -> str:
        return gaps.reply("can_reach.py", "\n".join(lines))

    code = "response.error_code = CanReach.Response.FRAME_TRANSFORM_FAILURE"
    sentence, distance = "response.message = f'not in {frame}'", "response.distance = math.nan"
    gaps.accept(
        ACTION,
        "uint16 NONE=0\nuint16 FELL=1\nuint16 error_code\nstring error_msg\nfloat64 distance_walked  # m",
    )
    assert "run the cell with lab.build_interfaces first" in reply(
        code, sentence, distance, "return response"
    )
    gaps.run("lab.build_interfaces('my_interfaces')", 300)
    assert "distance 0.0" in reply(code, sentence, "return response")
    assert "return response inside the `if`" in reply(code, sentence, distance)
    assert "End every branch with `return response`" in reply(code, sentence, distance, "return")
    assert "names the frame odom" in reply(code, distance, "response.message = 'no'", "return response")
    assert "error_code 0" in reply(sentence, distance, "return response")
    assert "error_code -31" in reply(
        "response.error_code = CanReach.Response.NO_IK_SOLUTION", sentence, distance, "return response"
    )
    assert "CanReach.srv has error_code" in reply("response.code = -21", "return response")
    sound = [sentence, "response.distance = float('nan')", "response.error_code = -21", "return response"]
    assert "✓ can_reach.py" in gaps.accept("can_reach.py", "\n".join(sound))
