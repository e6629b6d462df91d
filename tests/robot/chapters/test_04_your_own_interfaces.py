"""Chapter 4 shows what it says."""

from __future__ import annotations

import re
from collections.abc import Callable

import pytest
from execution import Executed, in_order


@pytest.fixture
def chapter(executed: Callable[[str], Executed]) -> Executed:
    return executed("04_your_own_interfaces")


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
        "no separator",
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
        "{'distance_remaining': 'double'}",
    )


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
        chapter.text("parameters-set"), "True | ", "0.10 m to 0.50 m", "False | Wrong parameter type"
    )
    assert in_order(chapter.text("parameters-int"), "InvalidParameterTypeException", "INTEGER", "DOUBLE")


def test_wrong_fields_are_found_late_or_at_once(chapter: Executed) -> None:
    unchecked, checked = chapter.text("fields").split("CHECK_FIELDS='1'")
    if "Assertion" not in unchecked:  # with which rclpy of apt ends the process
        assert unchecked.count("assigned,") == 4
        assert in_order(
            unchecked, "arrives as 5e-324", "SystemError", "Response.message", "TypeError", "TypeError"
        )
    assert "assigned" not in checked
    assert re.findall(r"The '(\w+)' field", checked) == ["distance", "error_code", "message", "message"]


def test_one_request_for_all_blames_the_last(chapter: Executed) -> None:
    answers = ["0.1", "0.3", "0.6"]
    for cell, questions in (("reuse-run", ["0.6"] * 3), ("reuse-fix", answers)):
        printed = re.findall(r"x = ([\d.]+): distance ([\d.]+) m", chapter.text(cell))
        assert printed == list(zip(questions, answers, strict=True))


def test_a_walk_as_a_service_goes_on_without_its_client(chapter: Executed) -> None:
    printed = chapter.text("walk-run")
    assert in_order(printed, "client: no answer within two seconds", "robot:  WALKING at x")
    walked_on = re.search(r"another ([\d.]+) m, for nobody", printed)
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


def test_who_forgets_to_build_is_told(chapter: Executed) -> None:
    assert chapter.text("battery-forgot") == (
        "AttributeError: 'BatteryLevel' object has no attribute 'percentage'\n"
    )


def test_an_old_edition_is_misread_in_silence_until_both_are_started_again(chapter: Executed) -> None:
    misread = re.search(r"^percentage ([\d.]+): go on$", chapter.text("battery-stale"), re.MULTILINE)
    assert misread
    assert 5 < float(misread[1]) <= 15  # of a hundred; the battery drains while the package is built
    hashes = dict(re.findall(r"^(\w+) +(RIHS01_\w+)…$", chapter.text("battery-hash"), re.MULTILINE))
    assert hashes.keys() == {"level", "guard"}
    assert len(set(hashes.values())) == 2
    fixed = re.match(r"percentage (0\.\d\d): walk home\none edition: True\n", chapter.text("battery-fixed"))
    assert fixed
    assert 0.05 < float(fixed[1]) <= 0.15
