"""Chapter 3 shows what it says."""

from __future__ import annotations

import re
from collections.abc import Callable

import pytest
from execution import Executed, in_order


@pytest.fixture
def chapter(executed: Callable[[str], Executed]) -> Executed:
    return executed("03_clients_that_survive")


def metres(text: str, pattern: str) -> float:
    """The number that a cell printed at the place of `#` in the pattern."""
    found = re.search(pattern.replace("#", r"(-?[\d.]+)"), text)
    assert found, text
    return float(found[1])


def test_the_time_limit_follows_from_the_way_to_stop(chapter: Executed) -> None:
    printed = chapter.text("budget")
    way = metres(printed, "stops within # m")
    assert 0 < way < 0.5
    assert metres(printed, "leaves # s") == pytest.approx((1 - way) / 0.3, abs=0.1)


def test_the_textbook_client_ends_only_when_all_is_well(chapter: Executed) -> None:
    assert in_order(chapter.text("forever-run"), "<ask_forever.py: exit status 0", "The robot is at x")
    missing, killed = chapter.text("kill-forever").split("2. ")
    assert in_order(missing, "had not ended", "was stopped", "waiting for where_am_i")
    assert in_order(killed, "had not ended", "was stopped")
    assert "The robot is at" not in killed


def test_a_limit_alone_turns_silence_into_none(chapter: Executed) -> None:
    printed = chapter.text("half-run")
    assert in_order(printed, "exit status 1", "AttributeError: 'NoneType' object has no attribute 'message'")


def test_the_bounded_client_ends_and_says_how(chapter: Executed) -> None:
    well, missing, slow, dies = re.split("missing:|slow:|dies:", chapter.text("fix-run"))
    assert in_order(well, "exit status 0", "The robot is at x")
    assert in_order(missing, "exit status 1", "where_am_i is not there")
    assert in_order(slow, "exit status 0", "The robot is at x", "try 1: no answer; the server looks ready")
    assert "try 2" not in slow
    assert in_order(dies, "exit status 1", "the server looks ready", "try 2", "where_am_i does not answer")


def test_a_retry_reaches_the_server_that_came_back(chapter: Executed) -> None:
    assert in_order(chapter.text("restart"), "exit status 0", "The robot is at x", "try 1: no answer")


def test_a_late_answer_is_an_old_position_unless_its_request_was_removed(chapter: Executed) -> None:
    mailbox, own_future = chapter.text("late-run"), chapter.text("late-fix-run")
    assert in_order(mailbox, "first:  None", "second:", "success=True")
    assert in_order(own_future, "first:  None", "second:", "success=True")
    assert metres(mailbox, "is # m off") > 0.3
    assert abs(metres(own_future, "is # m off")) < 0.2


def test_only_removed_requests_are_forgotten(chapter: Executed) -> None:
    printed = chapter.text("leak-run")
    assert in_order(printed, "given up:             100 of 100", "given up and removed: 0 of 100")


def test_a_retry_walks_twice_unless_the_request_is_idempotent(chapter: Executed) -> None:
    twice, once = chapter.text("forward-run"), chapter.text("go-run")
    assert in_order(twice, "exit status 0", "try 1: no answer", "to x 0.30 m", "to x 0.60 m")
    assert metres(twice, "has walked # m") > 0.5
    assert in_order(once, "exit status 0", "try 1: no answer", "to x 0.30 m", "to x 0.30 m")
    assert 0.2 < metres(once, "has walked # m") < 0.4


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
    assert metres(fixed, "ready after # ms") > metres(fixed, r"20 \+ 30 = 50 after # ms")


def test_two_servers_of_one_name_both_work(chapter: Executed) -> None:
    printed = chapter.text("two-run")
    assert printed.count("asked True, answered True") == 2
    assert "servers of that name: 2" in printed


def test_an_exception_in_a_pool_is_lost_until_somebody_collects_it(chapter: Executed) -> None:
    lost, collected = chapter.text("lost-run").split("\n<ask_in_pool.py: ")
    assert re.fullmatch(r"<ask_in_pool\.py: exit status 0 after [\d.]+ s>", lost.strip())
    assert in_order(collected, "exit status 1", "AttributeError", "'mesage'")


def test_spinning_in_a_callback_makes_the_node_deaf_and_await_does_not(chapter: Executed) -> None:
    printed = chapter.text("inside-run")
    assert in_order(printed, "1 std_srvs", "2 no answer", "3 no answer", "<report.py: running>")
    fixed = chapter.text("inside-fix-run")
    assert in_order(
        fixed, "alone:     std_srvs", "success=False, message='no position'", "together:  std_srvs"
    )
    assert in_order(
        fixed, "together:  ", "I am at x", "killed:    ", "no position", "restarted: ", "I am at x"
    )
    assert in_order(chapter.html("inside-draw"), "notebook to report server", "report server to notebook")
