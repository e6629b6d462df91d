"""The cells of chapter 11 show what its text says."""

from __future__ import annotations

import re
from collections.abc import Callable

import pytest
from execution import Executed, in_order, numbers
from gap_trials import GapTrials

CHAPTER = "11_capstone"


@pytest.fixture
def chapter(executed: Callable[[str], Executed]) -> Executed:
    return executed(CHAPTER)


def moments(html: str, node: str) -> dict[str, float]:
    """The times (s) at which a node printed its lines, by line, from the text of a timeline."""
    (words,) = re.findall(
        rf"{re.escape(node)} began at [\d.]+ s; (.*?)\.(?: |</desc>)(?=\w+\.py|It still|<|$)", html
    )
    return {said: float(at) for at, said in re.findall(r"([\d.]+) s: ([^;]+)", words)}


def test_on_one_thread_the_child_works_and_its_parent_receives_no_result(chapter: Executed) -> None:
    printed = chapter.text("blocked-run")
    assert in_order(printed, "cancel: no answer", "legs:   SUCCEEDED", "errand: EXECUTING")


def test_with_more_threads_the_same_file_succeeds(chapter: Executed) -> None:
    assert chapter.text("threads-run") == "errand: SUCCEEDED\n"


def test_an_orphan_walks_on_and_blocks_the_next_errand(chapter: Executed) -> None:
    printed = chapter.text("hasty-run")
    assert in_order(printed, "cancel: accepted", "errand: CANCELED", "the robot: WALKING")
    assert in_order(printed, "another errand: ABORTED", "go_ahead has not accepted the goal")


def test_an_empty_request_to_cancel_catches_the_orphan(chapter: Executed) -> None:
    printed = chapter.text("hasty-cli")
    assert in_order(printed, "goals_canceling=[action_msgs", "legs:  CANCELED, and the robot stands")
    assert in_order(printed, "robot: STANDING")
    drawn = chapter.html("hasty-draw")
    parent, child = moments(drawn, "hasty_errand.py"), moments(drawn, "legs.py")
    assert child["CANCELED, and the robot stands"] > parent["CANCELED"] + 2.0
    assert in_order(chapter.html("hasty-film"), "The robot for 2.", ">CANCELED</b>")


def test_the_careful_parent_ends_after_its_child(chapter: Executed) -> None:
    printed = chapter.text("careful-run")
    assert in_order(printed, "cancel: accepted", "errand: CANCELED after", "robot:  STANDING")
    assert numbers(r"([\d.]+) s, \d+ steps", printed)[0] < 5.0
    assert numbers(r"(\d+) steps", printed)[0] > 0
    drawn = chapter.html("careful-draw")
    parent, child = moments(drawn, "careful_errand.py"), moments(drawn, "legs.py")
    assert parent["the errand has ended"] >= child["CANCELED, and the robot stands"]  # in tenths of a second


def test_a_second_errand_is_aborted_because_the_legs_reject_its_child(chapter: Executed) -> None:
    printed = chapter.text("two-run")
    assert in_order(printed, "new: ABORTED", "go_ahead has not accepted", "old: EXECUTING", "old: CANCELED")


def test_a_newer_errand_begins_when_the_old_child_has_ended(chapter: Executed) -> None:
    printed = chapter.text("newest-run")
    assert in_order(printed, "old: ABORTED (error_code 2", "a newer errand came", "new: SUCCEEDED")
    child = moments(chapter.html("newest-draw"), "legs.py")
    assert child["walks 5.0 m"] < child["CANCELED, and the robot stands"] < child["walks 0.5 m"]


def test_a_parent_is_not_notified_when_its_child_dies(chapter: Executed) -> None:
    printed = chapter.text("dead-run")
    assert in_order(printed, "errand EXECUTING, robot STANDING", "cancel: accepted", "errand CANCELING")
    assert in_order(chapter.html("dead-draw"), "legs.py", "killed")


def test_a_limit_on_silence_ends_the_errand_and_names_the_child(chapter: Executed) -> None:
    printed = chapter.text("patient-run")
    assert in_order(printed, "errand: ABORTED", "go_ahead")
    assert 2.0 < numbers(r"([\d.]+) s after the legs died", printed)[0] < 8.0


def test_without_a_low_battery_the_glass_is_carried(chapter: Executed) -> None:
    printed = chapter.text("carry-run")
    assert "come SUCCEEDED, lift SUCCEEDED, carry SUCCEEDED, lower SUCCEEDED" in printed
    assert in_order(printed, "SUCCEEDED ''", "robot STANDING")


@pytest.mark.parametrize(
    ("cell", "ends"),
    [
        ("come-run", "come CANCELED\n"),
        ("lift-run", "lift CANCELED, lower SUCCEEDED\n"),
        ("walk-run", "come SUCCEEDED, lift SUCCEEDED, carry CANCELED, lower SUCCEEDED\n"),
    ],
)
def test_there_are_three_ways_to_give_up(chapter: Executed, cell: str, ends: str) -> None:
    printed = chapter.text(cell)
    assert ends in printed
    assert in_order(printed, "ABORTED 'the battery is low'", "robot STANDING")
    (low,) = numbers(r"hand ([\d.]+) m, robot", printed)
    assert 0.3 < low < 0.6


def test_the_glass_is_lowered_from_where_it_was(chapter: Executed) -> None:
    for cell in ("lift-run", "walk-run"):
        high, low = re.search(
            r"hand is ([\d.]+) m.*hand ([\d.]+) m, robot", chapter.text(cell), re.DOTALL
        ).groups()
        assert float(high) > float(low) + 0.04
    lifted = numbers(r"hand is ([\d.]+) m", chapter.text("walk-run"))[0]
    assert 0.6 < lifted < 0.8


def test_the_three_ways_are_films_beside_each_other(chapter: Executed) -> None:
    assert in_order(
        chapter.html("ways-films"), "The robot for", ">come</b>", "The robot for", ">lift</b>", ">carry</b>"
    )


def test_on_the_way_the_legs_end_before_the_glass_is_lowered(chapter: Executed) -> None:
    drawn = chapter.html("walk-run")
    parent, child = moments(drawn, "carry_glass.py"), moments(drawn, "legs.py")
    stands, begins = child["CANCELED, and the robot stands"], parent["lower begins"]  # printed to 0.01 s
    assert stands <= begins < parent["lower SUCCEEDED"]


LOOP = "asked = False\nwhile not end.done():\n"
ASK = "    if self.should_stop(goal_handle) and not asked:\n        child.cancel_goal_async()\n"


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        (
            "while not end.done():\n    time.sleep(TICK)",
            "go_ahead received no cancel request within 2 s",
        ),
        (f"{LOOP}{ASK}        return\n    time.sleep(TICK)", "keep waiting until end.done()"),
        (
            f"{LOOP}    if self.should_stop(goal_handle):\n        goal_handle.canceled()\n        return\n"
            "    time.sleep(TICK)",
            "but its child is still active",
        ),
        (
            "child.cancel_goal_async()\nwhile not end.done():\n    time.sleep(TICK)",
            "only if self.should_stop",
        ),
        ("return", "return only when end.done()"),
        (
            "while not self.should_stop(goal_handle):\n    time.sleep(TICK)\nchild.cancel_goal_async()\n"
            "while not end.done():\n    time.sleep(TICK)",
            "leave the loop as soon as end.done()",
        ),
        (
            f"{LOOP}{ASK}        asked = True\n    time.sleep(TICK)\n"
            "if goal_handle.is_cancel_requested:\n    goal_handle.canceled()",
            "finish() makes the terminal call",
        ),
        (f"{LOOP}{ASK}        asked = True\n    time.sleep(TOCK)", "fix the error that is named here"),
        (f"{LOOP}{ASK}    time.sleep(TICK)", "remember that you have sent one"),
        (
            f"{LOOP}{ASK.replace('self.should_stop(goal_handle)', 'goal_handle.is_cancel_requested')}"
            "        asked = True\n    time.sleep(TICK)",
            "check self.should_stop(goal_handle), not goal_handle.is_cancel_requested",
        ),
        (
            f"{LOOP}{ASK.replace('cancel_goal_async', 'cancel_goal')}        asked = True\n    time.sleep(TICK)",
            "cancel_goal() blocks until a response arrives",
        ),
        (f"{LOOP}{ASK}        asked = True", "call time.sleep(TICK) in each round"),
        (f"{LOOP}{ASK}        asked = True\n    time.sleep(0.005)", "call time.sleep(TICK) in each round"),
    ],
)
def test_the_gap_of_the_cancel_says_what_is_wrong(gaps: GapTrials, lines: str, said: str) -> None:
    assert said in gaps.reply("careful_errand.py", lines)


SILENT = "if time.monotonic() - self.heard > PATIENCE:\n"
CANCEL = "    child.cancel_goal_async()\n"
WAIT = "    wait_for(end, PATIENCE)\n"
ABORT = "    goal_handle.abort()\n"
RETURN = '    return WalkTo.Result(error_msg="go_ahead is silent")\n'


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        (
            f"if not wait_for(end, PATIENCE):\n{CANCEL}{WAIT}{ABORT}{RETURN}",
            "measure the time since the last feedback",
        ),
        (f"{SILENT}{ABORT}{RETURN}", "the child may still walk"),
        (f"{SILENT}{CANCEL}{ABORT}{RETURN}", "wait_for(end, PATIENCE)"),
        ("pass", "in every round"),
        (f"{SILENT}{CANCEL}{WAIT}{ABORT}    return WalkTo.Result()", "an error_msg that names go_ahead"),
        (f"{SILENT}{CANCEL}{WAIT}    goal_handle.canceled()\n{RETURN}", "end it with goal_handle.abort()"),
        (
            f"{SILENT}{CANCEL}    while not end.done():\n        time.sleep(TICK)\n{ABORT}{RETURN}",
            "wait only with a limit",
        ),
    ],
)
def test_the_gap_of_the_silence_says_what_is_wrong(gaps: GapTrials, lines: str, said: str) -> None:
    assert said in gaps.reply("patient_errand.py", lines)


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        ("if step == COME:\n    return True, []\nreturn True, [LOWER]", "let the arm finish"),
        ("if step == LOWER:\n    return False, []\nreturn True, [LOWER]", "the hand is empty"),
        ("return step != LOWER, []", "the hand has the glass"),
        ("if step in (LIFT, CARRY):\n    return True, [LOWER]", "end each path with `return`"),
        ("return step != LOWER, [LOWERED]", "NameError"),
    ],
)
def test_the_gap_of_the_ways_out_says_what_is_wrong(gaps: GapTrials, lines: str, said: str) -> None:
    assert said in gaps.reply("way_out.py", lines)


@pytest.mark.parametrize(
    ("file", "lines"),
    [
        (
            "careful_errand.py",
            "while not end.done() and not self.should_stop(goal_handle):\n    time.sleep(TICK)\n"
            "if not end.done():\n    child.cancel_goal_async()\nwhile not end.done():\n    time.sleep(TICK)",
        ),
        (
            "careful_errand.py",
            "from errand import wait_for\nanswer = None\nwhile not wait_for(end, TICK):\n"
            "    if answer is None and self.should_stop(goal_handle):\n"
            "        answer = child.cancel_goal_async()",
        ),
        (
            "patient_errand.py",
            "silence = time.monotonic() - self.heard\nif silence >= PATIENCE:\n"
            "    child.cancel_goal_async()\n    until = time.monotonic() + 3.0\n"
            "    while not end.done() and time.monotonic() < until:\n        time.sleep(TICK)\n"
            '    result = WalkTo.Result(error_msg=f"nothing of go_ahead for {silence:.1f} s")\n'
            "    goal_handle.abort()\n    return result",
        ),
        (
            "way_out.py",
            "ways = {COME: (True, ()), LIFT: (True, (LOWER,)), CARRY: (True, (LOWER,)), LOWER: (False, ())}\n"
            "return ways[step]",
        ),
    ],
)
def test_the_gaps_accept_other_correct_lines(gaps: GapTrials, file: str, lines: str) -> None:
    assert f"✓ {file}" in gaps.accept(file, lines)
