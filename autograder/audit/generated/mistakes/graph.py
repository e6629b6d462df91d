"""Mistakes with the ROS graph: names and qualities of service."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from autograder.audit.generated.program import Mistake, Program, last_name

# The place of the name, and of the quality of service, among the arguments.
_NAME = {
    "create_subscription": 1,
    "create_publisher": 1,
    "create_service": 1,
    "create_client": 1,
    "ActionServer": 2,
    "ActionClient": 2,
}
_QOS = {"create_subscription": 3, "create_publisher": 2}


def makes_a_name_absolute(program: Program) -> Iterator[Mistake]:
    """A name begins with a slash, so that the namespace does not count."""
    for call in program.every(ast.Call):
        place = _NAME.get(last_name(call))
        if place is not None and len(call.args) > place:
            name = call.args[place]
            text = program.text(name)
            is_text = isinstance(name, ast.Constant)
            absolute = f"{text[0]}/{text[1:]}" if is_text else f'"/" + {text}'
            yield Mistake((program.replace(name, absolute),), f"the absolute name {absolute}")


def takes_the_usual_qos(program: Program) -> Iterator[Mistake]:
    """A quality of service that was chosen is replaced by 10, reliable and volatile."""
    for call in program.every(ast.Call):
        place = _QOS.get(last_name(call))
        if place is not None and len(call.args) > place and not isinstance(call.args[place], ast.Constant):
            qos = call.args[place]
            topic = program.text(call.args[_NAME[last_name(call)]])
            yield Mistake((program.replace(qos, "10"),), f"10 instead of {program.text(qos)} for {topic}")
