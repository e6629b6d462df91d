"""The cells of chapter 10 show what its text says."""

from __future__ import annotations

import re
from collections.abc import Callable

import pytest
from execution import Executed, in_order, number
from gap_trials import GapTrials

CHAPTER = "10_parameters_and_balance"


@pytest.fixture
def chapter(executed: Callable[[str], Executed]) -> Executed:
    return executed(CHAPTER)


def test_gains_that_are_weaker_than_gravity_topple_the_robot(chapter: Executed) -> None:
    assert 0.5 < number(r"fallen ([\d.]+) s after the push", chapter.text("weak-run")) < 20
    drawn = chapter.html("weak-plot")
    assert in_order(drawn, "pitch in rad", "push", "STANDING → FALLEN")
    assert "The robot for" in chapter.html("weak-film")


def test_a_parameter_is_listed_and_described(chapter: Executed) -> None:
    printed = chapter.text("circle-run")
    assert in_order(printed, "  speed", "  start_type_description_service", "  turn", "  use_sim_time")
    assert in_order(
        printed, "Parameter name: speed", "Type: double", "Description: m/s, ahead", "Min value: 0.0"
    )
    assert in_order(
        printed, "Max value: 0.4", "Parameter name: turn", "Min value: -0.45", "Double value is: 0.0"
    )


def test_a_value_within_the_range_moves_the_robot_and_one_beyond_is_refused(chapter: Executed) -> None:
    printed = chapter.text("walk-run")
    assert printed.count("Set parameter successful") == 2
    assert in_order(printed, "Setting parameter failed: Parameter speed out of range", "robot: WALKING")


def test_an_integer_does_not_stop_the_robot_and_a_double_does(chapter: Executed) -> None:
    assert in_order(
        chapter.text("int-run"),
        "Setting parameter failed: Wrong parameter type, expected 'Type.DOUBLE' got 'Type.INTEGER'",
        "exit status 0",
        "robot: WALKING",
        "Set parameter successful",
        "exit status 0",
        "robot: STANDING",
    )


def test_the_textbooks_callback_is_one_set_late_and_a_refused_set_moves_the_robot(chapter: Executed) -> None:
    first, second = re.findall(r"walks at ([+-][\d.]+)", chapter.text("book-run"))
    assert chapter.text("book-run").count("Set parameter successful") == 2
    assert abs(float(first)) < 0.03
    assert float(second) > 0.1
    printed = chapter.text("book-stop-run")
    assert printed.count("Setting parameter failed") == 2
    assert "failed:" not in printed  # it gives no reason
    assert all(float(speed) < -0.1 for speed in re.findall(r"walks at ([+-][\d.]+)", printed))


def test_a_rule_about_two_numbers_refuses_with_a_reason_and_the_last_radius_is_kept(
    chapter: Executed,
) -> None:
    printed = chapter.text("guarded-run")
    assert printed.count("Set parameter successful") == 2
    assert in_order(
        printed, "failed: 0.1 m/s is too slow", "failed: Parameter turn out of range", "value: nan"
    )
    assert in_order(printed, "Double value is: 0.2", "data: 0.5")


def test_one_by_one_makes_a_third_circle_and_atomically_none_or_all(chapter: Executed) -> None:
    assert chapter.text("atomic-start").endswith("radius: [0.5]\n")
    one_by_one = chapter.text("atomic-run")
    assert in_order(
        one_by_one, "refused: 0.1 m/s is too slow for a turn of 0.45", "set\n", "radius: [0.5, 1.0]\n"
    )
    atomically = chapter.text("atomic-fix-run")
    assert in_order(atomically, "set\n", "radius: [0.5, 1.0, 0.44]\n", "refused: Parameter turn out of range")
    assert atomically.endswith("radius: [0.5, 1.0, 0.44]\n")


def test_a_callback_registered_late_misses_the_values_from_the_start(chapter: Executed) -> None:
    assert in_order(
        chapter.text("late-run"),
        "late.py runs",
        "Double value is: 0.45",
        "guarded.py has ended:",
        "InvalidParameterValueException",
        "0.1 m/s is too slow for a turn of 0.45 rad/s",
        "guarded.py has ended:",
        "InvalidParameterTypeException",
        "expecting type 'DOUBLE'",
    )


def test_a_dumped_file_is_loaded_by_half_and_then_whole(chapter: Executed) -> None:
    assert in_order(
        chapter.text("dump-run"), "/robot/circle:", "ros__parameters:", "speed: 0.1", "turn: 0.2", "both: set"
    )
    first, second = chapter.text("load-run").replace("\r", "").split("0.2\n0.2\n")
    assert in_order(first, "Set parameter speed failed: 0.1 m/s is too slow", "Set parameter turn successful")
    assert in_order(first, "failed: Trying to set a read-only parameter", "exit status 0")
    assert in_order(second, "Set parameter speed successful", "Set parameter turn successful", "0.1\n0.2\n")


def test_pushes_add_up_with_a_gain_that_is_just_above_gravity(chapter: Executed) -> None:
    pattern = r"at most ([\d.]+) rad, at the end (-?[\d.]+) rad, STANDING"
    strong, weak = (
        re.search(pattern, chapter.text("push-helper")),
        re.search(pattern, chapter.text("push-run")),
    )
    assert strong
    assert weak
    assert float(strong[1]) < 0.06
    assert abs(float(strong[2])) < 0.01
    assert float(weak[1]) > 0.1
    assert float(weak[2]) > 0.04
    assert in_order(chapter.html("push-run"), "kp 276:", "kp 60:")


def test_the_clock_does_not_stand_up(chapter: Executed) -> None:
    printed = chapter.text("rise-run")
    assert "end: SUCCEEDED" in printed
    assert 0.50 < number(r"height: ([\d.]+) m", printed) < 0.57


def test_the_pushed_robot_is_still_for_a_moment_before_it_is_at_rest(chapter: Executed) -> None:
    spells = re.findall(r"(still|moves) for ([\d.]+) s", chapter.text("still-run"))
    assert [name for name, _ in spells] == ["moves", "still", "moves", "still"]
    assert float(spells[1][1]) < 0.3
    assert float(spells[3][1]) > 1.0


def test_phases_end_by_measurement(chapter: Executed) -> None:
    printed = chapter.text("phases-run")
    assert "end: SUCCEEDED | phases: rising settling" in printed
    assert number(r"height: ([\d.]+) m", printed) >= 0.59
    assert in_order(chapter.html("phases-run"), "rising", "settling", "result: SUCCEEDED")


# A trial changes the file, so the gap that needs the other solutions is tried first.
@pytest.mark.parametrize(
    ("lines", "said"),
    [
        (
            "circle:\n  ros__parameters:\n    speed: 0.2\n    turn: 0.25",
            "the node's full name, /robot/circle:",
        ),
        ("/robot/circle:\n  speed: 0.2\n  turn: 0.25", "write ros__parameters: with two underscores"),
        ("/robot/circle:\n  ros_parameters:\n    speed: 0.2\n    turn: 0.25", "two underscores"),
        ("/robot/circle:\n  ros__parameters:\n    speed: 0.2\n    turn: 0", "make turn a double"),
        (
            "/robot/circle:\n  ros__parameters:\n    sped: 0.2\n    turn: 0.25",
            "add speed below ros__parameters",
        ),
        (
            "/robot/circle:\n  ros__parameters:\n    speed: 0.25\n    turn: 0.2",
            "write speed: 0.2 and turn: 0.25",
        ),
        ("speed: 0.2\nturn: 0.25", "the node's full name, /robot/circle:"),
        ("/robot/circle:\n  ros__parameters:\n    speed:0.2\n    turn:0.25", "a space after each colon"),
    ],
)
def test_the_gap_of_the_file_says_what_is_wrong(gaps: GapTrials, lines: str, said: str) -> None:
    assert said in gaps.reply("start.yaml", lines)


ON_SET = "self.add_on_set_parameters_callback(self.decide)\n"
POST_SET = "self.add_post_set_parameters_callback(self.apply)\n"
DECLARE, APPLY = "self.declare()\n", "self.apply([])"


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        (f"{DECLARE}{ON_SET}{POST_SET}{APPLY}", "register self.decide before self.declare()"),
        (f"{ON_SET}{POST_SET}{DECLARE}{APPLY}", "call self.declare(), then register self.apply"),
        (f"{ON_SET}{DECLARE}{POST_SET}", "call self.apply([]) once"),
        (f"{ON_SET}{DECLARE}{APPLY}", "register self.apply with self.add_post_set_parameters_callback()"),
        (f"{DECLARE}{POST_SET}{APPLY}", "register self.decide with self.add_on_set_parameters_callback()"),
        (f"{ON_SET.replace('decide', 'apply')}{DECLARE}{APPLY}", "self.apply needs both parameters"),
        (f"{ON_SET}{POST_SET}{APPLY}", "self.apply needs both parameters"),
    ],
)
def test_the_gap_of_the_order_says_what_is_wrong(gaps: GapTrials, lines: str, said: str) -> None:
    assert said in gaps.reply("guarded.py", lines)


DECIDED = 'if not wanted["speed"] >= TIGHTEST * abs(wanted["turn"]):\n'
REFUSED = '    return SetParametersResult(successful=False, reason="too tight")'
OVER = "for parameter in parameters:\n    wanted[parameter.name] = parameter.value\n"


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        (f"{DECIDED}{REFUSED}", "check the new value"),
        (f"{OVER.replace('wanted', 'now')}{DECIDED}{REFUSED}", "deciding has no side effect"),
        (
            f'{OVER}if wanted["speed"] < TIGHTEST * abs(wanted["turn"]):\n{REFUSED}',
            "every `<` and `>` with NaN is false",
        ),
        (
            f'{OVER}if not wanted["speed"] > TIGHTEST * abs(wanted["turn"]):\n{REFUSED}',
            "require at least TIGHTEST * abs(turn), with >=",
        ),
        (
            f'{OVER}if not wanted["speed"] >= TIGHTEST * wanted["turn"]:\n{REFUSED}',
            "a turn to the right is negative",
        ),
        (
            f'{OVER}if not wanted["speed"] / abs(wanted["turn"]) >= TIGHTEST:\n{REFUSED}',
            "multiply instead of dividing",
        ),
        (f"{OVER}{DECIDED}    return False", "return SetParametersResult(successful=False"),
        (f"{OVER}{DECIDED}    return SetParametersResult(successful=False)", "without a reason"),
        (
            "new = {parameter.name: parameter.value for parameter in parameters}\n"
            'if not new.get("speed", 0.0) >= TIGHTEST * abs(new.get("turn", 0.0)):\n' + REFUSED,
            "take a value that is not in `parameters`",
        ),
        (
            "for parameter in parameters:\n    wanted[parameter.name] = parameter.value\n"
            '    if not wanted["speed"] >= TIGHTEST * abs(wanted["turn"]):\n    ' + REFUSED,
            "before you check the radius",
        ),
        (f"{OVER}{DECIDED}    raise ValueError('too tight')", "ends the node"),
    ],
)
def test_the_gap_of_the_decision_says_what_is_wrong(gaps: GapTrials, lines: str, said: str) -> None:
    assert said in gaps.reply("decide.py", lines)


FORGET = "if not is_so:\n    self.since = None\n    return False\n"
BEGIN = "if self.since is None:\n    self.since = now\n"
LASTS = "return now - self.since >= self.seconds"


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        ("return is_so", "the condition has only just become true"),
        (f"if not is_so:\n    return False\n{BEGIN}{LASTS}", "set self.since to None when it is false"),
        (f"{FORGET}if not self.since:\n    self.since = now\n{LASTS}", "test `self.since is None`"),
        (f"{FORGET}self.since = now\n{LASTS}", "do not overwrite self.since while it stays true"),
        (
            "self.since = now if is_so else None\nreturn is_so and now - self.since >= self.seconds",
            "do not overwrite self.since while it stays true",
        ),
        (f"{FORGET}{BEGIN}    return False\n{LASTS}", "Steady(0.0) needs no more"),
        (f"{FORGET}{BEGIN}{LASTS.replace('>=', '>')}", "Steady(0.0) needs no more"),
        (f"{FORGET}{BEGIN}return now - self.since >= 0.5", "compare with self.seconds"),
        (f"{FORGET}{BEGIN}return now - Steady.since >= self.seconds", "AttributeError"),
        (
            f"{FORGET}{BEGIN}if now - self.since >= self.seconds:\n    return True",
            "end each path with `return`",
        ),
    ],
)
def test_the_gap_of_the_lasting_condition_says_what_is_wrong(gaps: GapTrials, lines: str, said: str) -> None:
    assert said in gaps.reply("steady.py", lines)


@pytest.mark.parametrize(
    ("file", "lines"),
    [
        (
            "decide.py",
            "wanted.update((one.name, one.value) for one in parameters)\n"
            'speed, turn = wanted["speed"], abs(wanted["turn"])\n'
            "if speed != speed or turn != turn or speed < TIGHTEST * turn:\n"
            '    return SetParametersResult(successful=False, reason=f"{speed} / {turn} is too tight")',
        ),
        (
            "decide.py",
            "for one in parameters:\n    if one.name not in now:\n        return SetParametersResult(reason=one.name)\n"
            f"    wanted[one.name] = one.value\n{DECIDED}{REFUSED}",
        ),
        (
            "guarded.py",
            f"{ON_SET}{DECLARE}{APPLY}\n{POST_SET}",
        ),
        (
            "steady.py",
            "if not is_so or self.since is None:\n    self.since = now\n"
            "return is_so and now - self.since >= self.seconds",
        ),
        ("start.yaml", "/**:\n  ros__parameters: {speed: 0.2, turn: 0.25}"),
    ],
)
def test_the_gaps_accept_other_correct_lines(gaps: GapTrials, file: str, lines: str) -> None:
    assert f"✓ {file}" in gaps.accept(file, lines)
