"""Changes of one line of a student's program, from which questions are made if the grader sees what they break."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass

from autograder.classroom.audit.generated.mistakes import OPERATORS
from autograder.classroom.audit.generated.program import Edits, Named, last_name
from autograder.classroom.questions.question import Part
from autograder.classroom.questions.student_program import StudentProgram, as_code

# Mistakes that need understanding. Those left out are easy to see (a unit, a sign), or no line that a person writes.
USED = (
    *("misses_a_cancel", "ends_otherwise", "answers_otherwise", "takes_the_code_for_the_status"),
    *("counts_from_the_start", "lets_nan_through", "makes_a_name_absolute", "takes_the_usual_qos"),
    *("looks_at_the_first_only", "forgets_one_of_several", "forgets_a_reset", "halves_or_doubles"),
    *("takes_another_constant", "leaves_a_field_out", "drops_a_guard"),
)
SLEEP_TIME = 2.5  # s
_SAYS_SOMETHING = ("print", "info", "warning", "warn", "error", "debug", "fatal", "get_logger")
_THREADS_RUN_OTHERS = "its threads run several callbacks at the same time, so one of them can wait."
_AWAIT_GIVES_BACK = (
    "await gives the thread back to the executor until the future is complete. Meanwhile the executor runs the other "
    "callbacks; later it continues after that line."
)


@dataclass(frozen=True)
class Change:
    """A change of a line, and the question that it may become.

    Attributes:
        operator: what made it.
        line: its number.
        text: the whole changed program.
        supposed: the change in words: "line 41, …, were missing".
        first: what is asked first, about the program as it is.
        why: the reason for the effect, which the program shows; "" if the change is not about the executor.
    """

    operator: str
    line: int
    text: str
    supposed: str
    first: tuple[Part, ...] = ()
    why: str = ""


def changes(program: StudentProgram) -> Iterator[Change]:
    """Yield changes of single lines: those of the generated audit that need understanding, and lines left out."""
    for operator in USED:
        for made in OPERATORS[operator][1](program):
            edits = {node: new.replace("'/' + '", "'/") for node, new in made.items()}
            if not any(re.match(r"not \(|.*__", new) for new in edits.values()):  # nobody writes these
                yield from _change(program, operator, edits)
    for statement in program.every(ast.stmt):
        if _has_an_effect(statement) and not program.is_of_start(statement):
            yield from _change(program, "leaves_a_line_out", {statement: "pass"})


def executor_changes(program: StudentProgram) -> Iterator[Change]:
    """Yield changes of the threads, the callback groups and the waits, if the program's executor is known."""
    call = program.executor()
    if call and last_name(call) == "MultiThreadedExecutor":
        yield from _one_thread(program, call)
        yield from _one_group(program)
    elif call:
        yield from _sleeps_instead(program, call)
        yield from _sleeps_first(program, call)


def _change(
    program: StudentProgram, operator: str, edits: Edits, why: str = "", first: tuple[Part, ...] = ()
) -> Iterator[Change]:
    """Yield the change if all its edits are in one line, of which the question quotes enough to show it."""
    text = program.with_text(edits)
    line, *others = {node.lineno for node in edits if isinstance(node, ast.expr | ast.stmt)}
    if text and not others:
        old, new = program.quoted(line), as_code(text.split("\n")[line - 1])
        if new not in old:
            yield Change(
                operator, line, text, f"{old}, were {'missing' if new == '`pass`' else new}", first, why
            )


def _waits_of_goals(program: StudentProgram) -> list[tuple[ast.expr, Named]]:
    """Return the waits in loops of execute callbacks, each with a callback for messages that goes on meanwhile."""
    waits = [wait for execute in program.callbacks("execute") for wait in program.waits(execute)]
    others = program.callbacks("subscription")[:1]
    return [(wait, other) for wait in waits for other in others if program.loop(wait)]


def _one_thread(program: StudentProgram, call: ast.Call) -> Iterator[Change]:
    """An execute callback keeps a thread, and only further threads let the other callbacks run."""
    found = _waits_of_goals(program)
    for wait, other in () if any(isinstance(wait, ast.Await) for wait, _ in found) else found[:1]:
        place = program.quoted(wait.lineno)
        asked = (
            f"While {program.function_name(wait)} waits in {place}, {other.name} (line {other.lineno}) goes on. Which "
            "line of your program makes that possible, and how?"
        )
        why = (
            f"The only thread waits in {place} until the goal ends. Meanwhile no other callback runs: neither "
            f"{other.name} nor those for goals and cancels."
        )
        first = (Part(asked, f"{program.quoted(call.lineno)}: {_THREADS_RUN_OTHERS}"),)
        edits: Edits = {call: f"{ast.unparse(call.func)}(num_threads=1)"}
        yield from _change(program, "one_thread", edits, why, first)


def _one_group(program: StudentProgram) -> Iterator[Change]:
    """A callback that keeps its thread, or what it waits for, comes into the node's default group."""
    users = program.callbacks("service", "subscription", "timer")
    waiting = [one.name for one in users if program.waits(one)]
    why = (
        "None is the node's default group, which is mutually exclusive: however many threads there are, only one of "
        f"its callbacks runs at a time. {' and '.join(waiting)} waits."
    )
    for word in program.every(ast.keyword) if waiting else ():
        if word.arg == "callback_group":
            yield from _change(program, "one_group", {word.value: "None"}, why)


def _sleeps_instead(program: StudentProgram, spin: ast.Call) -> Iterator[Change]:
    """A coroutine sleeps where it awaits in a loop, in a node with one thread."""
    for wait, other in _waits_of_goals(program):
        statement = program.statement(wait)
        if isinstance(wait, ast.Await) and isinstance(statement, ast.Expr):
            sleep = wait.value if "sleep" in last_name(wait.value) else None
            seconds = ast.unparse(sleep.args[0]) if isinstance(sleep, ast.Call) and sleep.args else "0.05"
            asked = (
                f"Your node has one thread. Why does {other.name} (line {other.lineno}) go on while "
                f"{program.function_name(wait)} waits in {program.quoted(wait.lineno)}?"
            )
            why = f"The only thread ({program.quoted(spin.lineno)}) sleeps, and meanwhile no other callback runs."
            edits: Edits = {statement: f"{_import_time(program)}time.sleep({seconds})"}
            yield from _change(program, "sleeps_instead", edits, why, (Part(asked, _AWAIT_GIVES_BACK),))


def _sleeps_first(program: StudentProgram, spin: ast.Call) -> Iterator[Change]:
    """A callback sleeps, and everything else waits for the one thread."""
    for callback in program.callbacks("subscription", "timer", "feedback", "service", "goal"):
        others = program.callbacks("subscription", "timer", "feedback", "service", "goal", "execute")
        names = ", ".join(one.name for one in others if one is not callback)
        why = (
            f"One thread runs all callbacks ({program.quoted(spin.lineno)}): while {callback.name} sleeps, all others "
            f"have to wait ({names or 'also those for answers and results'}), and what {callback.name} stores or "
            "answers is late."
        )
        is_text = ast.get_docstring(callback) is not None
        for first in [one for one in callback.body[is_text:] if not hasattr(one, "body")][:1]:
            edits: Edits = {first: f"{_import_time(program)}time.sleep({SLEEP_TIME}); {ast.unparse(first)}"}
            yield from _change(program, "sleeps_first", edits, why)


def _has_an_effect(statement: ast.stmt) -> bool:
    """Whether a statement calls something other than a log, or stores something that other functions may read."""
    if isinstance(statement, ast.Assign):
        return isinstance(statement.targets[0], ast.Attribute)
    called = statement.value if isinstance(statement, ast.Expr) else None
    return isinstance(called, ast.Call) and last_name(called) not in _SAYS_SOMETHING


def _import_time(program: StudentProgram) -> str:
    imported = [name.name for one in program.every(ast.Import) for name in one.names if not name.asname]
    return "" if "time" in imported else "import time; "
