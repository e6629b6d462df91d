"""The cells of chapter 3b show what its text says."""

from __future__ import annotations

import re
from collections.abc import Callable

import pytest
from execution import Executed, in_order
from gap_trials import GapTrials

CHAPTER = "03b_clients_in_bad_company"


@pytest.fixture
def chapter(executed: Callable[[str], Executed]) -> Executed:
    return executed(CHAPTER)


def number(text: str, pattern: str) -> float:
    """The number that a cell printed where the pattern has `#`."""
    found = re.search(pattern.replace("#", r"(-?[\d.]+)"), text)
    assert found, text
    return float(found[1])


def test_a_late_answer_is_an_old_position_unless_its_request_was_removed(chapter: Executed) -> None:
    mailbox, own_future = chapter.text("late-run"), chapter.text("late-fix-run")
    assert in_order(mailbox, "first:  None", "second:", "success=True")
    assert in_order(own_future, "first:  None", "second:", "success=True")
    assert number(mailbox, "is # m off") > 0.3
    assert abs(number(own_future, "is # m off")) < 0.2


def test_only_removed_requests_are_forgotten(chapter: Executed) -> None:
    printed = chapter.text("leak-run")
    assert in_order(printed, "given up:             100 of 100", "given up and removed: 0 of 100")


def test_a_retry_walks_twice_unless_the_request_is_idempotent(chapter: Executed) -> None:
    twice, once = chapter.text("forward-run"), chapter.text("go-run")
    assert in_order(twice, "exit status 0", "try 1: no answer", "to x 0.30 m", "to x 0.60 m")
    assert number(twice, "has walked # m") > 0.5
    assert in_order(once, "exit status 0", "try 1: no answer", "to x 0.30 m", "to x 0.30 m")
    assert 0.2 < number(once, "has walked # m") < 0.4


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
    assert number(fixed, "ready after # ms") > number(fixed, r"20 \+ 30 = 50 after # ms")


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


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        (
            "if not response.success:\n    print(response.message, file=sys.stderr)",
            "but the program printed on stdout",
        ),
        (
            "if not response.success:\n    print(response.message)\n    return 1",
            "but the program printed on stdout",
        ),
        ("if not response.success:\n    return 1", "file=sys.stderr"),
        (
            "if not response.success:\n    print(response.message, file=sys.stderr)\n    return",
            "ended with exit status 0",
        ),
        (
            "print(response.message, file=sys.stderr)\nreturn 1",
            "return 1 only when response.success is false",
        ),
        ("if not response.succes:\n    return 1", "AttributeError"),
    ],
)
def test_the_gap_of_a_refusal_says_what_is_wrong(gaps: GapTrials, lines: str, said: str) -> None:
    assert said in gaps.reply("forward_fixed.py", lines)


@pytest.mark.parametrize(
    ("lines", "said"),
    [
        (
            "request = AddTwoInts.Request()\nfor factor in (1, 10):\n    request.a = factor * a\n"
            "    request.b = factor * b\n    sent.append((request, client.call_async(request)))",
            "the second call has overwritten the first request",
        ),
        (
            "request = AddTwoInts.Request(a=a, b=b)\nsent.append((request, client.call_async(request)))",
            "10 * a",
        ),
        (
            "for factor in (1, 10):\n    sent.append(client.call_async(AddTwoInts.Request(a=a, b=b)))",
            "unpack",
        ),
        ("for factor in (1, 10):\n    AddTwoInts.Request(a=factor * a, b=factor * b)", "no sums"),
    ],
)
def test_the_gap_of_two_requests_says_what_is_wrong(gaps: GapTrials, lines: str, said: str) -> None:
    assert said in gaps.reply("sum_fixed.py", lines)


@pytest.mark.parametrize(
    ("file", "lines"),
    [
        (
            "forward_fixed.py",
            "if response.success is False:\n    sys.stderr.write(response.message)\n    return 1",
        ),
        (
            "forward_fixed.py",
            "if not response.success:\n    sys.exit(f'refused: {response.message}')",
        ),
        (
            "sum_fixed.py",
            "first = AddTwoInts.Request()\nfirst.a, first.b = a, b\n"
            "second = AddTwoInts.Request()\nsecond.a, second.b = 10 * a, 10 * b\n"
            "sent += [(first, client.call_async(first)), (second, client.call_async(second))]",
        ),
    ],
)
def test_other_correct_lines_fill_the_gaps(gaps: GapTrials, file: str, lines: str) -> None:
    assert f"✓ {file}" in gaps.accept(file, lines)
