"""Which functions of a program ROS calls, and for what."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

from autograder.audit.generated.program import Function, Program, last_name

Kind = Literal["subscription", "service", "execute", "goal", "cancel", "accepted", "timer", "feedback"]

# Of the calls that take a callback: its kind, its place among the arguments, its keyword.
_TAKERS: dict[str, tuple[tuple[Kind, int | None, str], ...]] = {
    "create_subscription": (("subscription", 2, "callback"),),
    "create_service": (("service", 2, "callback"),),
    "create_timer": (("timer", 1, "callback"),),
    "send_goal_async": (("feedback", 1, "feedback_callback"),),
    "ActionServer": (
        ("execute", 3, "execute_callback"),
        ("goal", None, "goal_callback"),
        ("accepted", None, "handle_accepted_callback"),
        ("cancel", None, "cancel_callback"),
    ),
}


@dataclass(frozen=True)
class Callback:
    """A function of the program that ROS calls; `interface` is the expression of the type, None for a timer."""

    kind: Kind
    function: Function
    interface: ast.expr | None

    @property
    def name(self) -> str:
        """Its name in sentences."""
        name = "lambda" if isinstance(self.function, ast.Lambda) else self.function.name
        return f"the {self.kind} callback {name}"

    @property
    def parameters(self) -> list[str]:
        """The names of its parameters, without self."""
        names = [parameter.arg for parameter in self.function.args.args]
        return names[1:] if names[:1] == ["self"] else names


def callbacks(program: Program) -> Iterator[Callback]:
    """Yield the callbacks whose function stands in the program, each once."""
    seen: set[tuple[Kind, Function]] = set()
    for call in program.every(ast.Call):
        for kind, place, keyword in _TAKERS.get(last_name(call), ()):
            given = [one.value for one in call.keywords if one.arg == keyword]
            if place is not None and len(call.args) > place:
                given.append(call.args[place])
            function = _function(program, given[0], call) if given else None
            if function and (kind, function) not in seen:
                seen.add((kind, function))
                yield Callback(kind, function, _interface(call))


def _interface(call: ast.Call) -> ast.expr | None:
    if not last_name(call).startswith(("create_s", "ActionServer")):
        return None
    return call.args[1 if last_name(call) == "ActionServer" else 0] if len(call.args) > 1 else None


def _function(program: Program, given: ast.expr, call: ast.Call) -> Function | None:
    """Return the function of a name or a method; where several classes have one of that name, that of the call's."""
    if isinstance(given, ast.Lambda):
        return given
    if not isinstance(given, ast.Name | ast.Attribute):
        return None
    found = [one for one in program.named_functions() if one.name == last_name(given)]
    around = set(program.above(call))
    return next((one for one in found if program.parent(one) in around), found[0] if found else None)
