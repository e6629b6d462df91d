"""A verdict as plain text, for readers that show neither tables nor drawings."""

from __future__ import annotations

from autograder.engine.verdict import CheckVerdict

LONGEST_TEXT = 8000  # characters


def verdict_text(verdict: CheckVerdict, longest: int = LONGEST_TEXT) -> str:
    """Return what was expected, what was observed and when, what to do next, and what the node printed.

    Nothing is left out, so the text of a hidden check's verdict is for instructors only.
    """
    lines = [verdict.status.capitalize() + "."]
    for label, text in (
        ("Expected", verdict.expected),
        ("Observed", verdict.observed),
        ("Next", verdict.help),
    ):
        if text:
            lines.append(f"{label}: {text}")
    if verdict.robot_time is not None:
        lines.append(f"At {verdict.robot_time:.1f} s.")
    if verdict.log and verdict.status != "passed":
        lines.append(f"What the node printed:\n{verdict.log}")
    text = "\n".join(lines)
    return text if len(text) <= longest else f"{text[:longest]}\n… cut here"
