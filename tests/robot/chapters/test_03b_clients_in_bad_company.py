"""The cells of chapter 3b show what its text says."""

from __future__ import annotations

import re

from execution import Executed, in_order, number
from gap_trials import GapTrials, Trial

CHAPTER = "03b_clients_in_bad_company"


def test_a_late_answer_is_an_old_position_unless_its_request_was_removed(chapter: Executed) -> None:
    mailbox, own_future = chapter.text("late-run"), chapter.text("late-fix-run")
    assert in_order(mailbox, "first:  None", "second:", "success=True")
    assert in_order(own_future, "first:  None", "second:", "success=True")
    assert number("is # m off", mailbox) > 0.3
    assert abs(number("is # m off", own_future)) < 0.2


def test_only_removed_requests_are_forgotten(chapter: Executed) -> None:
    printed = chapter.text("leak-run")
    assert in_order(printed, "given up:             100 of 100", "given up and removed: 0 of 100")


def test_a_retry_walks_twice_unless_the_request_is_idempotent(chapter: Executed) -> None:
    twice, once = chapter.text("forward-run"), chapter.text("go-run")
    assert in_order(twice, "exit status 0", "try 1: no answer", "to x 0.30 m", "to x 0.60 m")
    assert number("has walked # m", twice) > 0.5
    assert in_order(once, "exit status 0", "try 1: no answer", "to x 0.30 m", "to x 0.30 m")
    assert 0.2 < number("has walked # m", once) < 0.4


def test_a_refusal_is_read_or_overlooked(chapter: Executed) -> None:
    printed = chapter.text("success-run")
    assert in_order(printed, "<forward.py: exit status 0", "The robot walks 0.3 m forward.")
    assert in_order(printed, "<go_to.py: exit status 1", "go_to_x refuses: cannot walk: the motors are off")
    assert "FALLEN" in chapter.html("success-run")


def test_a_shared_request_and_foreign_arguments_mislead(chapter: Executed) -> None:
    printed = chapter.text("sum-run")
    assert in_order(printed, "20 + 30 = 5\n", "20 + 30 = 50")
    assert in_order(printed, "exit status 1", "ValueError: invalid literal for int()", "'--ros-args'")
    fixed = chapter.text("sum-fix-run")
    assert in_order(fixed, "2 + 3 = 5 ", "20 + 30 = 50 ", "exit status 1", "usage: sum_fixed.py A B")
    assert number("ready after # ms", fixed) > number(r"20 \+ 30 = 50 after # ms", fixed)


def test_two_servers_of_one_name_both_work(chapter: Executed) -> None:
    printed = chapter.text("two-run")
    assert printed.count("asked True, answered True") == 2
    assert "servers of that name: 2" in printed
    assert chapter.text("two-cli").count("/robot/where_am_i") == 2
    drawn = chapter.html("two-draw")
    assert in_order(drawn, "notebook to where_am_i", "where_am_i", "to notebook")


def test_an_error_in_a_done_callback_is_not_seen(chapter: Executed) -> None:
    well, slow = chapter.text("lost-run").split("slow: ")
    assert re.fullmatch(r"well: <ask_by_callback\.py: exit status 0 after [\d.]+ s>", well.strip())
    assert in_order(slow, "exit status 0", "Unhandled exception in done callback", "no attribute 'mesage'")


def test_an_exception_in_a_task_is_lost_until_somebody_reads_its_result(chapter: Executed) -> None:
    lost, collected = chapter.text("lost-task-run").split("\n<ask_in_task.py: ")
    assert in_order(lost, "exit status 0", "The following exception was never retrieved", "'mesage'")
    assert in_order(collected, "exit status 1", "AttributeError", "'mesage'")


def test_the_gaps_say_what_is_wrong(gaps: GapTrials, trial: Trial) -> None:
    gaps.require_reply(trial)
