"""The cells of chapter 3a show what its text says."""

from __future__ import annotations

import re

import pytest
from execution import Executed, in_order, number
from gap_trials import GapTrials, Trial

CHAPTER = "03_clients_that_survive"


def test_the_time_limit_follows_from_the_way_to_stop(chapter: Executed) -> None:
    printed = chapter.text("budget")
    distance = number("stops within # m", printed)
    assert 0 < distance < 0.5
    assert number("leaves # s", printed) == pytest.approx((1 - distance) / 0.3, abs=0.1)


def test_ros2_service_call_gets_an_answer(chapter: Executed) -> None:
    assert in_order(chapter.text("server-run"), "requester: making request", "success=True", "x ")


def test_the_textbook_client_ends_only_when_all_is_well(chapter: Executed) -> None:
    assert in_order(chapter.text("forever-run"), "<ask_forever.py: exit status 0", "The robot is at x")
    missing, killed = chapter.text("kill-forever").split("2. ")
    assert in_order(missing, "had not ended", "was stopped", "waiting for where_am_i")
    assert in_order(killed, "had not ended", "was stopped")
    assert "The robot is at" not in killed


def test_silence_is_drawn_as_a_request_without_an_answer(chapter: Executed) -> None:
    assert "no answer within one second" in chapter.text("kill-draw")
    assert "notebook to where_am_i" in chapter.html("kill-draw")


def test_a_limit_alone_turns_silence_into_none(chapter: Executed) -> None:
    printed = chapter.text("half-run")
    assert in_order(printed, "exit status 1", "AttributeError: 'NoneType' object has no attribute 'message'")


def test_a_negative_limit_is_no_limit(chapter: Executed) -> None:
    printed = chapter.text("negative-run")
    assert in_order(printed, "exit status 0", "response: None", "had not ended", "was stopped")


def test_the_bounded_client_ends_and_says_how(chapter: Executed) -> None:
    well, missing, slow, dies = re.split("missing:|slow:|dies:", chapter.text("fix-run"))
    assert in_order(well, "exit status 0", "The robot is at x")
    assert in_order(missing, "exit status 1", "where_am_i is not there")
    assert in_order(slow, "exit status 0", "The robot is at x", "asked, answered, asked, answered")
    assert in_order(dies, "exit status 1", "where_am_i looks ready and does not answer")


def test_a_retry_reaches_the_server_that_came_back(chapter: Executed) -> None:
    printed = chapter.text("restart")
    is_answered = in_order(printed, "exit status 0", "The robot is at x")
    was_too_fast = in_order(printed, "exit status 1", "refuses: no odom has arrived yet")  # the text says so
    assert is_answered or was_too_fast


def test_a_refusal_is_exit_status_1_and_is_not_retried(chapter: Executed) -> None:
    printed = chapter.text("refused")
    assert in_order(
        printed, "exit status 1", "where_am_i refuses: no odom has arrived yet", "the server: asked\n"
    )
    assert in_order(chapter.text("refused-cli"), "success=False", "go on")


def test_the_gaps_say_what_is_wrong(gaps: GapTrials, trial: Trial) -> None:
    gaps.require_reply(trial)


def test_the_gap_of_the_deadline_asks_for_the_one_before_it(gaps: GapTrials) -> None:
    gaps.run(
        "%%writefile ask_once.py\ndef ask_once(node, client, request, seconds):\n    raise NotImplementedError"
    )
    assert "fill the gap of ask_once.py first" in gaps.reply(
        "bounded.py", "return ask_once(node, client, request, 1.0)"
    )


def test_a_retry_is_drawn_on_a_time_line(chapter: Executed) -> None:
    drawn = chapter.html("fix-draw")
    assert "A retry" in drawn
    assert in_order(drawn, "where_am_i.py", "ask.py")
