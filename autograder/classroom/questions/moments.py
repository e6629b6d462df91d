"""Questions about moments of a recorded run: a cancel, received or sent, an aborted goal, an answer to a request.

The run is that of the traced copy, so each key names the line that really acted. A question is made only if the reports
leave no doubt: they name one line, in the time in question.
"""

from __future__ import annotations

import ast
from typing import Any

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.call import Call
from autograder.authoring.evidence.fields import shown_fields
from autograder.authoring.evidence.goal import ABORTED, CANCELED, Cancel, Goal
from autograder.authoring.evidence.robot_record import between
from autograder.authoring.evidence.transcript import Transcript
from autograder.classroom.questions.question import Part, Question
from autograder.classroom.questions.student_program import StudentProgram
from autograder.classroom.questions.traced import ASKS, SEEN, STOPS, Mark, marks
from humanoid_interfaces.msg import RobotState

STILL = 0.05  # m/s, below which the robot counts as standing
STILL_TIME = 0.3  # s for which it must be slower than that
STANDING_TIME = 3.0  # s after the result of a cancelled goal in which the robot may come to a stop
OUTPUT_DELAY = 0.2  # s, at most, from what a program does to the report about it
LONGEST_TEXT = 300  # characters of a request or an answer
ALONE = 1.0  # s before a moment in which nothing else may happen, so that the reports belong to this moment
_OF_A_CANCEL = {
    STOPS: "Which line of your program commanded the robot to stop?",
    SEEN: "Which line of your program noticed the request?",
    "canceled": "Which line of your program made the client receive CANCELED?",
}
_RUNS_WHENEVER = {
    "subscription": "a message of its topic arrives",
    "service": "a request arrives",
    "timer": "its timer fires",
    "goal": "a goal is sent",
    "accepted": "a goal is accepted",
}


def moments(program: StudentProgram, run: Transcript) -> list[Question]:
    """Return the questions that can be asked about a run of the traced copy."""
    reported = marks(program, run)
    asked = [_cancel(program, run, one, reported) for one in run.cancels]
    asked += [_abort(program, run, one, reported) for one in run.goals]
    asked += [_answer(program, run, one, reported) for one in run.calls]
    asked += [_request(program, run, one, reported) for one in run.all(ev.CancelReceived)]
    return [question for question in asked if question and len(question.parts) > 1]


def _cancel(
    program: StudentProgram, run: Transcript, cancel: Cancel, reported: list[Mark]
) -> Question | None:
    """The only cancel of a goal, which ended it, while no other goal was sent."""
    goal = next((one for one in run.goals if one.name == cancel.sent.goal), None)
    if not goal or not goal.result or goal.status != CANCELED or len(goal.cancels) > 1:
        return None
    begun, over = cancel.sent.t, goal.result.t
    if any(begun - ALONE < one.sent.t < over for one in run.goals if one is not goal):
        return None
    found = {what: _only(reported, begun, over, what) for what in _OF_A_CANCEL}
    later = [one.sent.t for one in run.goals if one.sent.t > over]
    robot = between(run.ground_truth, begun, min(over + STANDING_TIME, *later, run.end))
    moving = [one.t for one in robot if one.speed > STILL]
    moved = bool(robot) and robot[0].speed > STILL
    walking = f", while the robot moved at {robot[0].speed:.2f} m/s" if moved else ""
    stands = moved and robot[-1].t - moving[-1] > STILL_TIME
    stood = f"; the robot stood (slower than {STILL:g} m/s) from {moving[-1]:.1f} s on" if stands else ""
    if not (end := found["canceled"]):
        return None
    parts = []
    for what, mark in found.items():
        if mark and (moved or what != STOPS):
            why = _why_not_earlier(program, mark.node) if what == SEEN else ""
            asked = f"{_OF_A_CANCEL[what]}{' Why did it not notice it earlier?' if why else ''}"
            key = f"{program.quoted(mark.line)}, {mark.t - begun:.2f} s after the request. {why}"
            parts.append(Part(asked, key.strip()))
    story = f"In a run of your program a client requested at {begun:.1f} s to cancel its goal{walking}. The client"
    return Question("moment", end.line, f"{story} received CANCELED at {over:.1f} s{stood}.", tuple(parts))


def _abort(program: StudentProgram, run: Transcript, goal: Goal, reported: list[Mark]) -> Question | None:
    """A goal that the server aborted because the robot fell, or because another goal was accepted."""
    if not goal.result or goal.status != ABORTED:
        return None
    begun, over = goal.sent.t, goal.result.t
    mark = _only(reported, over - ALONE, over, "abort")
    if not mark or any(
        one.result and abs(one.result.t - over) < ALONE for one in run.goals if one is not goal
    ):
        return None
    fell = [one.t for one in between(run.ground_truth, begun, over) if one.mode == RobotState.FALLEN]
    newer = [
        one.answer.t for one in run.goals if one.answer and one.answer.accepted and begun < one.sent.t < over
    ]
    if bool(fell) == bool(newer) or len(newer) > 1:
        return None
    cause = f"the robot had fallen at {fell[0]:.1f} s" if fell else ""
    cause = cause or f"a second goal was accepted at {newer[0]:.1f} s, while the first was active"
    story = f"In a run of your program {cause}. The client of the {'first ' if newer else ''}goal received ABORTED"
    asked = "Which line of your program made the client receive ABORTED?"
    parts = (Part(asked, f"{program.quoted(mark.line)}, at {mark.t:.1f} s."), *_why(program, mark.node))
    return Question("moment", mark.line, f"{story} at {over:.1f} s.", parts)


def _answer(program: StudentProgram, run: Transcript, call: Call, reported: list[Mark]) -> Question | None:
    """An answer to a request, while no other was sent: the line that filled the first of its simple fields."""
    if not call.answer:
        return None
    response, begun, over = call.answer.response, call.sent.t, call.answer.t
    if any(
        begun - OUTPUT_DELAY < one.sent.t < over + OUTPUT_DELAY for one in run.calls if one.name != call.name
    ):
        return None
    found = [(name, mark) for name in _simple(response) if (mark := _only(reported, begun, over, name))]
    if not found:
        return None
    name, mark = found[0]
    asked = f"Which line of your program gave `{name}` its value in this answer?"
    parts = (Part(asked, f"{program.quoted(mark.line)}."), *_why(program, mark.node))
    request = shown_fields(call.request, *_simple(call.request))[:LONGEST_TEXT]
    story = f"In a run of your program a client called {call.service} at {begun:.1f} s{request and f' with {request}'}."
    answer = shown_fields(response, *_simple(response))[:LONGEST_TEXT]
    return Question("moment", mark.line, f"{story} Your program answered {answer}.", parts)


def _request(
    program: StudentProgram, run: Transcript, cancel: ev.CancelReceived, reported: list[Mark]
) -> Question | None:
    """The only request of a client to cancel a goal: the line that sent it, and what led to that line."""
    mark = _only(reported, 0.0, cancel.t, ASKS)
    if not mark or len(run.all(ev.CancelReceived)) > 1:
        return None
    pressed = [one.t for one in run.all(ev.NodeSignalled) if one.t <= cancel.t]
    story = f"Ctrl-C was pressed at {pressed[-1]:.1f} s, and " if pressed else ""
    story = f"{story}the server of {cancel.action} received a request at {cancel.t:.1f} s to cancel its goal."
    asked = "Which line of your program sent the request?"
    parts = (Part(asked, f"{program.quoted(mark.line)}, at {mark.t:.1f} s."), *_why(program, mark.node))
    return Question("moment", mark.line, f"In a run of your program {story}", parts)


def _why_not_earlier(program: StudentProgram, node: ast.expr) -> str:
    """Say what decides when an expression is evaluated again; "" if the text does not show it."""
    (name, kind), loop = program.runs_for(node), program.loop(node)
    if kind in ("subscription", "timer"):
        return f"It runs for {name}, so only whenever {_RUNS_WHENEVER[kind]}."
    waits = [one for one in program.waits_in(loop) if program.loop(one) is loop] if loop else []
    place = f"the loop waits in {program.quoted(waits[0].lineno)}" if waits else ""
    return f"It runs once in each round of a loop, and {place}." if waits else ""


def _why(program: StudentProgram, node: ast.expr) -> list[Part]:
    """Ask for the condition that leads to an expression, and for the lines that store what it reads."""
    parts = []
    led, holds = program.condition(node)
    condition = led.test if isinstance(led, ast.If) else None
    if condition and condition.lineno == condition.end_lineno:
        key = f"{program.quoted(condition.lineno)}: it was {'true' if holds else 'false'}."
        parts.append(Part("Which condition led to that line, and was it true or false?", key))
    elif led and not condition:
        asked = "Which exception led to that line, and where is it caught?"
        parts.append(Part(asked, f"{program.quoted(led.lineno)}."))
    if stores := program.stores(condition or node, program.function(node)):
        of_whom = "condition" if condition else "line"
        asked = (
            f"Which lines store what that {of_whom} reads, outside its own function, and when do they run?"
        )
        parts.append(Part(asked, "; ".join(_where_and_when(program, one) for one in stores) + "."))
    return parts


def _where_and_when(program: StudentProgram, statement: ast.stmt) -> str:
    when = _RUNS_WHENEVER.get(program.runs_for(statement)[1], "it is called")
    return f"{program.quoted(statement.lineno)}, in {program.function_name(statement)}, which runs whenever {when}"


def _only(reported: list[Mark], begun: float, over: float, what: str) -> Mark | None:
    """Return the first report of a kind in a time; None unless all of them name one line, or a cancel is noticed."""
    ours = [mark for mark in reported if mark.what == what and begun <= mark.t <= over + OUTPUT_DELAY]
    return ours[0] if len({mark.line for mark in ours}) == 1 or (ours and what == SEEN) else None


def _simple(message: Any) -> list[str]:
    """Return the fields of a message that hold a truth value, a number, a text or a list."""
    kinds = (bool, int, float, str, list)
    return [one for one in message.get_fields_and_field_types() if isinstance(getattr(message, one), kinds)]
