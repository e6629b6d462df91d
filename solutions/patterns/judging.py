"""Marks the answers: each situation needs the right pattern and the right reason."""

from __future__ import annotations

import re

from autograder.authoring import Check, Failure, Transcript, check, expect, program, require_success
from autograder.authoring.checks import check_by
from autograder.authoring.failure import ReportedBy

LESSON = "01_robot_and_graph#patterns"
ANSWERS = program("print_answers", timed=False)
PRINT_TIMEOUT = 20.0  # s for printing twelve lines
PATTERNS = ("topic", "service", "action")
REASONS = "abc"
SITUATIONS = range(1, 13)

_LINE = re.compile(r"\s*(\d{1,4})\W+(\w+)\W+(\w+)\s*")


def situation(number: int, about: str, answer: str, **against: str) -> Check:
    """Make the check of one situation, from its right answer as printed, and the objection `against` each wrong one."""
    right_pattern, right_reason = answer.split()

    def judge(run: Transcript) -> None:
        try:
            answers = _answers(run)
        except Failure as failure:
            raise ReportedBy(answers_everything.title) from failure
        expected = "the right pattern and the reason that decides it"
        expect(number in answers, expected=expected, observed="no answer", help=_how_to_answer(run, number))
        pattern, reason = answers[number]
        _require_form(number, pattern, reason)
        if (pattern, reason) != (right_pattern, right_reason):
            help = against[pattern if pattern != right_pattern else reason]
            raise Failure(expected=expected, observed=f"pattern {pattern}, reason {reason}", help=help)

    title, id = f"Situation {number}: {about}", f"situation_{number}"
    return check_by(judge, title, on=ANSWERS, see=LESSON, clauses=[1, 2, 3], id=id)


@check(on=ANSWERS, see=LESSON, clauses=[1, 2, 4])
def answers_everything(run: Transcript) -> None:
    """Each of the twelve situations has a pattern and a reason"""
    answers = _answers(run)
    for number in SITUATIONS:
        if number in answers:
            _require_form(number, *answers[number])
    missing = [number for number in SITUATIONS if number not in answers]
    expect(
        not missing,
        expected="a line “NUMBER PATTERN REASON” for each of the 12 situations",
        observed=f"no line for {', '.join(map(str, missing))}",
        help=_how_to_answer(run, missing[0] if missing else 0),
    )


def _answers(run: Transcript) -> dict[int, tuple[str, str]]:
    """Return pattern and reason by the number of the situation; the last line for a situation counts."""
    require_success(run, PRINT_TIMEOUT)
    found = [match for line in run.output("stdout").splitlines() if (match := _LINE.fullmatch(line))]
    return {int(match[1]): (match[2].lower(), match[3].lower()) for match in found}


def _how_to_answer(run: Transcript, number: int) -> str:
    """Return advice on a situation without an answer."""
    printed = [line for line in run.output("stdout").splitlines() if line.strip()]
    if not printed:
        return (
            f"Nothing was printed: ANSWERS has no entry for situation {number}, or main() does not print it. Add a "
            f"line {number}: (pattern, reason), and let main() print it."
        )
    if not _answers(run):
        return f"“{printed[-1][:60]}” is not in the right form: print only the number, the pattern and the reason."
    return f"Add a line {number}: (pattern, reason) to ANSWERS; main() prints it."


def _require_form(number: int, pattern: str, reason: str) -> None:
    expect(
        pattern in PATTERNS and len(reason) == 1 and reason in REASONS,
        expected=f"for situation {number} one of {', '.join(PATTERNS)}, and a reason a, b or c",
        observed=f"{pattern} {reason}",
        help=f"Write one of the words {', '.join(PATTERNS)} and then one of the letters, as strings: ('topic', 'a').",
    )
