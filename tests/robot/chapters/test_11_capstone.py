"""The cells of chapter 11 show what its text says."""

from __future__ import annotations

import re

import pytest
from execution import Executed, in_order, numbers
from gap_trials import GapTrials, Trial

CHAPTER = "11_capstone"


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


def test_the_gaps_say_what_is_wrong(gaps: GapTrials, trial: Trial) -> None:
    gaps.require_reply(trial)
