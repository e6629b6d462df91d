"""Mistakes with how things end: a cancel unseen, the wrong status or code, an exit status or clean-up lost."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from autograder.audit.generated.messages import Messages, other_constants
from autograder.audit.generated.program import Mistake, Program, last_name

_ENDS = ("succeed", "abort", "canceled")
_OTHER_ANSWER = {"ACCEPT": "REJECT", "REJECT": "ACCEPT"}
_TIDY = ("destroy_node", "try_shutdown", "destroy")  # nobody misses these at the end of a process
_OTHER_STREAM = {"stdout": "stderr", "stderr": "stdout"}


def misses_a_cancel(program: Program) -> Iterator[Mistake]:
    """A cancel is not looked for in one of the places where it may come."""
    for asked in program.every(ast.Attribute):
        if asked.attr == "is_cancel_requested":
            where = program.function_name(asked)
            yield Mistake((program.replace(asked, "False"),), f"a cancel is not seen in {where}")


def swaps_the_status(program: Program) -> Iterator[Mistake]:
    """A goal ends with another status, an answer is the other one, a code is another one."""
    messages = Messages(program)
    compared = {node for one in program.every(ast.Compare) for node in ast.walk(one)}
    for constant in program.every(ast.Constant):
        word = constant.value
        if isinstance(word, str) and word in _ENDS and constant not in compared:
            for other in [other for other in _ENDS if other != word]:
                yield Mistake((program.replace(constant, f'"{other}"'),), f"{other} instead of {word}")
    for place in program.every(ast.Attribute):
        others: list[str] = []
        if place.attr in _ENDS:
            others = [other for other in _ENDS if other != place.attr]
        elif last_name(place.value) in ("GoalResponse", "CancelResponse"):
            others = [_OTHER_ANSWER[place.attr]]
        elif place not in compared:
            others = other_constants(messages.class_of(place.value), place.attr)
        for other in others:
            text = f"{program.text(place.value)}.{other}"
            yield Mistake((program.replace(place, text),), f"{other} instead of {place.attr}")


def takes_the_code_for_the_status(program: Program) -> Iterator[Mistake]:
    """A goal counts as succeeded when its result has no error code, whatever its status."""
    for compared in program.every(ast.Compare):
        if last_name(compared.comparators[0]) != "STATUS_SUCCEEDED" or last_name(compared.left) != "status":
            continue
        left = compared.left
        result = f"{program.text(left.value)}.result" if isinstance(left, ast.Attribute) else "result"
        wanted = "==" if isinstance(compared.ops[0], ast.Eq) else "!="
        text = f"{result}.error_code {wanted} 0"
        yield Mistake((program.replace(compared, text),), f"{text} instead of {program.text(compared)}")


def loses_the_exit_status(program: Program) -> Iterator[Mistake]:
    """The program ends with status 0 whatever main() returns."""
    statuses = [
        one for one in program.every(ast.Return) if program.function_name(one) == "main" and one.value
    ]
    if all(isinstance(one.value, ast.Constant) and not one.value.value for one in statuses):
        return  # it always is 0
    for call in program.every(ast.Call):
        if last_name(call) in ("exit", "SystemExit") and call.args and isinstance(call.args[0], ast.Call):
            statement = program.statement(call)
            edit = program.replace(statement, program.text(call.args[0]))
            yield Mistake((edit,), f"{program.text(call.args[0])} without {last_name(call)}")


def prints_to_the_other_stream(program: Program) -> Iterator[Mistake]:
    """What belongs on stdout is printed on stderr, or the other way round."""
    for stream in program.every(ast.Attribute):
        if stream.attr in _OTHER_STREAM and last_name(stream.value) == "sys":
            other = f"sys.{_OTHER_STREAM[stream.attr]}"
            yield Mistake((program.replace(stream, other),), f"{other} instead of {program.text(stream)}")
    for call in program.every(ast.Call):
        if last_name(call) == "print" and not any(word.arg == "file" for word in call.keywords):
            text = program.text(call)
            elsewhere = f'{text[:-1].rstrip().rstrip(",")}, file=__import__("sys").stderr)'
            yield Mistake((program.replace(call, elsewhere),), f"{text} on stderr")


def drops_the_finally(program: Program) -> Iterator[Mistake]:
    """What has to be done however it ends is left out."""
    for attempt in program.every(ast.Try):
        if not all(_ends_with_the_process(statement) for statement in attempt.finalbody):
            edits = tuple(program.drop(statement) for statement in attempt.finalbody)
            yield Mistake(edits, f"the finally of {program.function_name(attempt)} is left out")


def _ends_with_the_process(statement: ast.stmt) -> bool:
    return isinstance(statement, ast.Expr) and last_name(statement.value) in _TIDY
