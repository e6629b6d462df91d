"""Questions about moments of a recorded run: a cancel, received or sent, an aborted goal, an answer to a request.

The run is that of the traced copy, so each key names the line that really acted. A question is made only if the reports
leave no doubt: they name one line, in the time in question.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import chain
from typing import Any

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.call import Call
from autograder.authoring.evidence.fields import shown_fields
from autograder.authoring.evidence.goal import ABORTED, CANCELED, Goal
from autograder.authoring.evidence.robot_record import between
from autograder.authoring.evidence.transcript import Transcript
from autograder.classroom.questions.question import Part, Question
from autograder.classroom.questions.student_program import StudentProgram
from autograder.classroom.questions.traced import ASKS, SEEN, STOPS, Mark, marks
from humanoid_interfaces.msg import RobotState
from ros_runtime.drawing.svg import shorten

STILL = 0.05  # m/s, below which the robot counts as standing
STILL_TIME = 0.3  # s for which it must be slower than that
STANDING_TIME = 3.0  # s after the result of a cancelled goal in which the robot may come to a stop
OUTPUT_DELAY = 0.2  # s, at most, from what a program does to the report about it
LONGEST_TEXT = 300  # characters of a request or an answer
ALONE = 1.0  # s before a moment in which nothing else may happen, so that the reports belong to this moment
_IN_A_RUN = "In a run of your program"
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
    "feedback": "feedback arrives",
    "done": "the future is complete",
}


def moments(program: StudentProgram, run: Transcript) -> list[Question]:
    """Return the questions that can be asked about a run of the traced copy."""
    seen = _SeenRun(program, run, marks(program, run))
    asked = [*map(seen.cancel, run.goals), *map(seen.abort, run.goals)]
    asked += [
        *map(seen.request, run.all(ev.CancelReceived)),
        *chain.from_iterable(map(seen.answers, run.calls)),
    ]
    return [question for question in asked if question and len(question.parts) > 1]


@dataclass(frozen=True)
class _SeenRun:
    """A run of the traced copy of a program, and what the copy reported."""

    program: StudentProgram
    run: Transcript
    reported: list[Mark]

    def cancel(self, goal: Goal) -> Question | None:
        """The only cancel of a goal, which ended it, while no other goal was sent."""
        if not goal.result or goal.status != CANCELED or len(goal.cancels) != 1:
            return None
        begun, over = goal.cancels[0].sent.t, goal.result.t
        others = [one.sent.t for one in self.run.goals if one is not goal]
        found = {what: self._only(begun, over, what) for what in _OF_A_CANCEL}
        if not (end := found["canceled"]) or any(begun - ALONE < t < over for t in others):
            return None
        watched_until = min([over + STANDING_TIME, self.run.end, *(t for t in others if t > over)])
        robot = between(self.run.ground_truth, begun, watched_until)
        moving = [one.t for one in robot if one.speed > STILL]
        moved = bool(robot) and robot[0].speed > STILL
        walking = f", while the robot moved at {robot[0].speed:.2f} m/s" if moved else ""
        stands = moved and robot[-1].t - moving[-1] > STILL_TIME
        stood = f"; the robot stood (slower than {STILL:g} m/s) from {moving[-1]:.1f} s on" if stands else ""
        parts = []
        for what, mark in found.items():
            if mark and (moved or what != STOPS):
                why = self._why_not_earlier(mark.node) if what == SEEN else ""
                asked = f"{_OF_A_CANCEL[what]}{' Why did it not notice it earlier?' if why else ''}"
                key = f"{self.program.quoted(mark.line)}, {mark.t - begun:.2f} s after the request. {why}"
                parts.append(Part(asked, key.strip()))
        story = (
            f"a client requested at {begun:.1f} s to cancel its goal{walking}. The client received CANCELED"
        )
        return Question("moment", end.line, f"{_IN_A_RUN} {story} at {over:.1f} s{stood}.", tuple(parts))

    def abort(self, goal: Goal) -> Question | None:
        """A goal that the server aborted because the robot fell, or because another goal was accepted."""
        if not goal.result or goal.status != ABORTED:
            return None
        begun, over = goal.sent.t, goal.result.t
        others = [one for one in self.run.goals if one is not goal]
        mark = self._only(over - ALONE, over, "abort")
        if not mark or any(one.result and abs(one.result.t - over) < ALONE for one in others):
            return None
        states = between(self.run.ground_truth, begun, over)
        fell = [one.t for one in states if one.mode == RobotState.FALLEN][:1]
        newer = [
            one.answer.t for one in others if one.answer and one.answer.accepted and begun < one.sent.t < over
        ]
        if len(fell) + len(newer) != 1:
            return None
        causes = [f"the robot had fallen at {t:.1f} s" for t in fell]
        causes += [f"a second goal was accepted at {t:.1f} s, while the first was active" for t in newer]
        story = f"{causes[0]}. The client of the {'first ' if newer else ''}goal received ABORTED at {over:.1f} s."
        return self._about(mark, story, "Which line of your program made the client receive ABORTED?")

    def answers(self, call: Call) -> Iterator[Question]:
        """An answer to a request, while no different one was sent: the lines that gave its fields their values."""
        if not call.answer:
            return
        response, begun, over = call.answer.response, call.sent.t, call.answer.t
        others = [one for one in self.run.calls if one.sent.t < over + OUTPUT_DELAY]
        near = [one for one in others if not one.answer or one.answer.t > begun - OUTPUT_DELAY]
        if any(not one.answer or _words_of(one) != _words_of(call) for one in near):
            return
        request, answer = _words_of(call)
        story = f"a client called {request} at {begun:.1f} s."
        for name in _simple(response):
            if mark := self._only(begun, over, name):
                asked = f"Which line of your program gave `{name}` its value in this answer?"
                yield self._about(mark, f"{story} Your program answered {answer}.", asked)

    def request(self, cancel: ev.CancelReceived) -> Question | None:
        """The only request of a client to cancel a goal: the line that sent it, and what led to that line."""
        mark = self._only(0.0, cancel.t, ASKS)
        if not mark or len(self.run.all(ev.CancelReceived)) > 1:
            return None
        pressed = [one.t for one in self.run.all(ev.NodeSignalled) if one.t <= cancel.t]
        story = f"Ctrl-C was pressed at {pressed[-1]:.1f} s, and " if pressed else ""
        story = (
            f"{story}the server of {cancel.action} received a request at {cancel.t:.1f} s to cancel its goal."
        )
        return self._about(mark, story, "Which line of your program sent the request?")

    def _about(self, mark: Mark, story: str, asked: str) -> Question:
        """Return a question about the line that acted, the condition that led to it, and what they read."""
        parts = [Part(asked, f"{self.program.quoted(mark.line)}, at {mark.t:.1f} s.")]
        led, holds = self.program.condition(mark.node)
        condition = led.test if isinstance(led, ast.If) else None
        if condition and condition.lineno == condition.end_lineno:
            key = f"{self.program.quoted(condition.lineno)}: it was {'true' if holds else 'false'}."
            parts.append(
                Part("Which condition decided last that this line is reached, and was it true or false?", key)
            )
        elif led and not condition:
            key = f"{self.program.quoted(led.lineno)}."
            parts.append(Part("Which exception led to that line, and where is it caught?", key))
        if stores := self.program.stores(read := condition or mark.node, self.program.function(read)):
            of_whom = "condition" if condition else "line"
            asked = f"Which lines store what that {of_whom} reads, outside its own function, and when do they run?"
            parts.append(Part(asked, "; ".join(map(self._where_and_when, stores)) + "."))
        return Question("moment", mark.line, f"{_IN_A_RUN} {story}", tuple(parts))

    def _where_and_when(self, statement: ast.stmt) -> str:
        when = _RUNS_WHENEVER.get(self.program.runs_for(statement)[1], "it is called")
        place = f"{self.program.quoted(statement.lineno)}, in {self.program.function_name(statement)}"
        return f"{place}, which runs whenever {when}"

    def _why_not_earlier(self, node: ast.expr) -> str:
        """Say what decides when an expression is evaluated again; "" if the text does not show it."""
        (name, kind), loop = self.program.runs_for(node), self.program.loop(node)
        if kind in ("subscription", "timer"):
            return f"It runs for {name}, so only whenever {_RUNS_WHENEVER[kind]}."
        waits = [one for one in self.program.waits_in(loop) if self.program.loop(one) is loop] if loop else []
        place = f"the loop waits in {self.program.quoted(waits[0].lineno)}" if waits else ""
        return f"It runs once in each round of a loop, and {place}." if waits else ""

    def _only(self, begun: float, over: float, what: str) -> Mark | None:
        """Return the first report of a kind in a time; None unless all name one line, or a cancel is noticed."""
        until = over + OUTPUT_DELAY
        ours = [mark for mark in self.reported if mark.what == what and begun <= mark.t <= until]
        return ours[0] if len({mark.line for mark in ours}) == 1 or (ours and what == SEEN) else None


def _words_of(call: Call) -> tuple[str, str]:
    """Describe a request to a service, and its response."""
    told = (call.request, call.response)
    request, answer = (shorten(shown_fields(one, *_simple(one)), LONGEST_TEXT) for one in told)
    return f"{call.service}{request and f' with {request}'}", answer


def _simple(message: Any) -> list[str]:
    """Return the fields of a message that hold a truth value, a number, a text or a list."""
    kinds = (bool, int, float, str, list)
    return [one for one in message.get_fields_and_field_types() if isinstance(getattr(message, one), kinds)]
