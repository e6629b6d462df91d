"""Chapter 8 shows what it says."""

from __future__ import annotations

import re
from collections.abc import Callable

import pytest
from execution import Executed, in_order
from gap_trials import GapTrials

CHAPTER = "08_navigation"


@pytest.fixture
def chapter(executed: Callable[[str], Executed]) -> Executed:
    return executed(CHAPTER)


def number(pattern: str, text: str) -> float:
    """The number that a pattern finds in a text."""
    found = re.search(pattern, text)
    assert found, (pattern, text)
    return float(found[1])


def numbers(pattern: str, text: str) -> list[float]:
    """All the numbers that a pattern finds in a text."""
    return [float(found) for found in re.findall(pattern, text)]


def test_the_action_has_the_fields_of_nav2(chapter: Executed) -> None:
    printed = chapter.text("action")
    fields = "current_pose navigation_time estimated_time_remaining number_of_recoveries distance_remaining"
    assert in_order(printed, *fields.split())


def test_three_loops_succeed_beside_the_goal(chapter: Executed) -> None:
    printed = chapter.text("loops-run")
    assert "end: SUCCEEDED" in printed
    assert number(r"stands (\d+) cm", printed) > 25


def test_after_a_push_a_phase_that_is_decided_anew_leads_to_the_goal(chapter: Executed) -> None:
    printed = chapter.text("push-run")
    assert in_order(printed, "end: SUCCEEDED", "phases:", "walking", "turning to the heading", "arrived")
    assert number(r"stands (\d+) cm", printed) <= 10
    assert abs(number(r"heading (-?\d+)°", printed) - 90) < 9
    assert "push" in chapter.html("push-plot")


def test_a_robot_that_is_turned_off_its_way_gets_back_and_counts_it(chapter: Executed) -> None:
    printed = chapter.text("recovery-run")
    assert in_order(printed, "end: SUCCEEDED", "walking", "turning to the goal", "walking", "arrived")
    assert number(r"arrived +[\d.]+ m left, (\d+) rec", printed) >= 1
    assert number(r"stands (\d+) cm", printed) <= 10
    assert "the joystick takes the robot" in chapter.html("recovery-plot")


def test_the_trip_is_filmed(chapter: Executed) -> None:
    assert "The robot for" in chapter.html("film")


def test_a_naive_sum_of_odom_overcounts_and_the_filtered_one_does_not(chapter: Executed) -> None:
    printed = chapter.text("sway-run")
    straight = number(r"start to end: ([\d.]+) m", printed)
    assert abs(straight - 1.5) < 0.1
    assert number(r"pieces of odom:  ([\d.]+) m", printed) > 1.8
    filtered = number(r"filtered ([\d.]+) m", chapter.text("odometer-plot"))
    assert abs(filtered - straight) < 0.15 * straight
    assert in_order(chapter.html("odometer-plot"), "filtered:", "sum of all pieces:")


def test_the_estimate_counts_turns_and_is_within_a_factor_of_two(chapter: Executed) -> None:
    assert number(r"SUCCEEDED: ([\d.]+) m", chapter.text("eta-run")) == pytest.approx(1.5, rel=0.15)
    words = chapter.html("eta-run")
    truth = number(r"truth: time left, s from ([\d.]+)", words)
    assert truth / 2 < number(r"estimate: time left, s from ([\d.]+)", words) < truth * 2
    assert number(r"top speed: time left, s from ([\d.]+)", words) < truth / 3


def test_progress_by_distance_is_nonsense_for_a_turn_on_the_spot(chapter: Executed) -> None:
    printed = chapter.text("zero-run")
    assert "end: SUCCEEDED" in printed
    assert min(numbers(r"(-?\d+) %", printed)) < -1000


def test_progress_by_work_goes_from_0_to_100(chapter: Executed) -> None:
    turn, nothing = chapter.text("zero-fix-run").split("nothing to do:")
    assert "SUCCEEDED" in turn
    rising = numbers(r"(-?\d+) %", turn)
    assert rising[0] <= 10
    assert all(0 <= each <= 100 for each in rising)
    assert "SUCCEEDED" in nothing
    assert set(numbers(r"(-?\d+) %", nothing)) == {100.0}


def test_a_trip_that_takes_too_long_is_aborted_with_timeout(chapter: Executed) -> None:
    assert "ABORTED (error_code 3, error_msg 'not there after 20 s'" in chapter.text("late-run")


def test_the_numbers_of_the_text_are_impossible_and_those_of_the_run_are_not(chapter: Executed) -> None:
    printed = chapter.text("book-check")
    assert in_order(printed, "1.15 m/s", "1.45 m/s", "12 %", "after 2 s")
    run = chapter.text("book-run")
    assert in_order(run, "<go.py: exit status 0", "walking", "SUCCEEDED")
    assert number(r"SUCCEEDED, ([\d.]+) m walked", run) == pytest.approx(2.5, rel=0.15)
    checked = chapter.text("book-run-check")
    speeds = numbers(r"s: (-?[\d.]+) m/s", checked)
    assert len(speeds) >= 3
    assert all(0.1 < speed < 0.5 for speed in speeds)
    assert number(r"stands (\d+) cm", checked) <= 10


def test_a_key_the_command_line_and_a_button_cancel(chapter: Executed) -> None:
    assert in_order(chapter.text("stop-q"), "q: asking for a cancel", "CANCELED")
    assert in_order(chapter.text("stop-ctrl-c"), "Canceling goal", "Goal canceled", "robot: STANDING")
    printed = chapter.text("stop-both")
    assert in_order(printed, "button: return_code 0, 1 goal", "<go.py: exit status 0", "CANCELED")
    assert "goals_canceling=[]" in printed


def test_a_second_cancel_of_the_same_goal_is_answered_with_3(chapter: Executed) -> None:
    first, second, end = chapter.text("twice-run").splitlines()
    assert "accepted, return_code 0" in first
    assert "not accepted" not in first
    assert in_order(second, "not accepted, return_code 3", "CANCELING")
    assert end == "end:    CANCELED"


def test_canceled_is_not_standing(chapter: Executed) -> None:
    first, second = chapter.text("standing-run").splitlines()
    assert first == "status: CANCELED | robot: WALKING"
    assert second == "status: CANCELED | robot: STANDING"
    assert in_order(chapter.html("standing-run"), "result: CANCELED", "WALKING → STANDING")


def test_every_comparison_with_nan_is_false_and_float32_is_not_the_number(chapter: Executed) -> None:
    assert re.findall(r"True|False", chapter.text("guard-traps")) == ["False", "True", "False", "False"]
    assert in_order(
        chapter.text("float-run"),
        "received 0.20000000298023224, below: False",
        "received 0.69",
        "below: True",
    )


def test_the_guard_cancels_once_and_waits_for_both(chapter: Executed) -> None:
    printed = chapter.text("watch-run")
    assert re.findall(r"cancel (True|False)", printed) == ["False", "False", "True", "False"]
    assert in_order(printed, "status: CANCELED", "robot:  STANDING")


def test_there_is_no_map(chapter: Executed) -> None:
    assert in_order(chapter.text("map"), "no tf, no map", "frame_id: odom", "child_frame_id: base_link")


ROUTE = "if way.distance > NEAR:\n    {}\nreturn {}"
THERE = "ARRIVED if way.distance < CLOSE and abs(way.turn) < TURNED else LAST"
LIMIT = "limit = ASTRAY if phase == WALK else ALIGNED"


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        (
            ROUTE.format(f"{LIMIT}\n    return FIRST if way.bearing > limit else WALK", THERE),
            "a bearing to the right is negative",
        ),
        (
            ROUTE.format("return FIRST if abs(way.bearing) > ALIGNED else WALK", THERE),
            "it steers while it walks",
        ),
        (
            ROUTE.format("return FIRST if abs(way.bearing) > ASTRAY else WALK", THERE),
            "goes on until the bearing",
        ),
        (ROUTE.format("return WALK", THERE), "a bearing over ASTRAY ends the walking"),
        (
            ROUTE.format(
                f"{LIMIT}\n    return FIRST if abs(way.bearing) > limit else WALK",
                "ARRIVED if way.distance < CLOSE else LAST",
            ),
            "the turn is not below TURNED",
        ),
        (
            f"if phase == LAST:\n    return {THERE}\n{LIMIT}\nif way.distance < NEAR:\n    return LAST\n"
            "return FIRST if abs(way.bearing) > limit else WALK",
            "a push took the robot away",
        ),
        ("if way.distance > NEAR:\n    return FIRST if abs(way.bearing) > ALIGNED else WALK", "it steers"),
        (f"return {THERE} if way.distance < NEAR else None", "end each path with `return`"),
        ("return FIRST if way.angle > ASTRAY else WALK", "AttributeError"),
    ],
)
def test_the_gap_of_the_phases_says_what_is_wrong(gaps: GapTrials, lines: str, said: str) -> None:
    assert said in gaps.reply("route.py", lines)


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        (
            "if self.last:\n    self.metres += math.dist(self.last, self.here)\nself.last = self.here",
            "do nothing as long as the piece",
        ),
        ("if self.last is None:\n    self.last = self.here", "add up pieces"),
        (
            "self.last = self.last or self.here\npiece = math.dist(self.last, self.here)\n"
            "if piece >= LONG_ENOUGH:\n    self.metres += piece",
            "set self.last = self.here when a piece counts",
        ),
        (
            "self.last = self.last or self.here\npiece = math.dist(self.last, self.here)\n"
            "if piece >= LONG_ENOUGH:\n    self.metres = piece\n    self.last = self.here",
            "with +=",
        ),
        (
            "piece = math.dist(self.last, self.here)\nif piece > LONG_ENOUGH:\n    self.metres += piece",
            "TypeError",
        ),
        ("self.metres += 1", "not yet"),
    ],
)
def test_the_gap_of_the_distance_says_what_is_wrong(gaps: GapTrials, lines: str, said: str) -> None:
    assert said in gaps.reply("odometer.py", lines)


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        ("return percentage < LIMIT", "-0.05"),
        (
            "if not percentage >= LIMIT and not self.has_cancelled:\n    self.has_cancelled = True\n    return True\n"
            "return False",
            "nan",
        ),
        ("return 0.0 <= percentage <= 1.0 and percentage < LIMIT", "set self.has_cancelled"),
        (
            "if 0.0 <= percentage < LIMIT and not self.has_cancelled:\n    self.has_cancelled = True\n    return True\n"
            "return False",
            "0 warnings",
        ),
        (
            "if not 0.0 <= percentage <= 1.0:\n    self.warn('no charge')\n    return False\n"
            "fires = percentage < LIMIT and not self.has_cancelled\nself.has_cancelled |= fires\nreturn fires",
            "3 warnings",
        ),
        (
            "if not 0.0 < percentage <= 1.0:\n    return False\n"
            "fires = percentage < LIMIT and not self.has_cancelled\nself.has_cancelled |= fires\nreturn fires",
            "an empty battery",
        ),
        ("if percentage < LIMIT:\n    return True", "end each path with `return`"),
    ],
)
def test_the_gap_of_the_battery_says_what_is_wrong(gaps: GapTrials, lines: str, said: str) -> None:
    assert said in gaps.reply("battery_watch.py", lines)


@pytest.mark.parametrize(
    ("file", "lines"),
    [
        (
            "route.py",
            f"if way.distance <= NEAR:\n    return {THERE}\nif phase == WALK and abs(way.bearing) < ASTRAY:\n"
            "    return WALK\nif abs(way.bearing) < ALIGNED:\n    return WALK\nreturn FIRST",
        ),
        (
            "odometer.py",
            "self.lately = [*getattr(self, 'lately', []), self.here][-18:]\n"
            "mean = tuple(sum(values) / len(self.lately) for values in zip(*self.lately))\n"
            "if len(self.lately) == 18 and getattr(self, 'mean', None):\n"
            "    self.metres += math.dist(self.mean, mean)\nself.mean = mean",
        ),
        (
            "battery_watch.py",
            "import math\nif math.isnan(percentage) or percentage < 0 or percentage > 1:\n"
            "    if not self.has_warned:\n        self.has_warned = True\n        self.warn('no charge')\n"
            "elif percentage < LIMIT and not self.has_cancelled:\n    self.has_cancelled = True\n    return True\n"
            "return False",
        ),
    ],
)
def test_the_gaps_accept_other_sound_lines(gaps: GapTrials, file: str, lines: str) -> None:
    assert f"✓ {file}" in gaps.accept(file, lines)
