"""Mistakes with conditions: forgotten, for the first element only, for another state."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from autograder.audit.generated.messages import Messages, other_constants
from autograder.audit.generated.program import Mistake, Program, last_name

_LEAVING = (ast.Return, ast.Raise, ast.Continue, ast.Break)


def tests_for_another_state(program: Program) -> Iterator[Mistake]:
    """A state is compared with the wrong constant, or one of several is forgotten."""
    messages = Messages(program)
    for compared in program.every(ast.Compare):
        for constant in [
            node for right in compared.comparators for node in program.every(ast.Attribute, right)
        ]:
            for other in other_constants(messages.class_of(constant.value), constant.attr):
                text = f"{program.text(constant.value)}.{other}"
                yield Mistake((program.replace(constant, text),), f"{other} instead of {constant.attr}")
        for several in compared.comparators:
            if isinstance(several, ast.Tuple | ast.List | ast.Set) and len(several.elts) > 1:
                for one in several.elts:
                    yield Mistake((program.without(one),), f"{program.text(one)} is forgotten among several")


def drops_a_condition(program: Program) -> Iterator[Mistake]:
    """One of several conditions is forgotten."""
    for several in program.every(ast.BoolOp):
        for one in several.values:
            yield Mistake((program.without(one),), f"the condition {program.text(one)} is forgotten")
    for compared in program.every(ast.Compare):
        if len(compared.ops) == 2:
            for side in (0, 1):
                left = compared.left if side == 0 else compared.comparators[0]
                kept = ast.Compare(left, [compared.ops[side]], [compared.comparators[side]])
                yield Mistake(
                    (program.replace(compared, ast.unparse(kept)),), f"only {ast.unparse(kept)} is required"
                )
    for listed in _lists_of_all(program):
        for element in listed.elts:
            yield Mistake((program.without(element),), f"{program.text(element)} is forgotten in all(…)")


def drops_a_guard(program: Program) -> Iterator[Mistake]:
    """A case is not looked at, or a guard lets through what it should refuse."""
    for case in program.every(ast.If):
        if not program.functions(case):
            continue
        text = program.text(case.test)
        yield Mistake((program.replace(case.test, "False"),), f"the case {text} is forgotten")
        if isinstance(case.body[-1], _LEAVING) and not case.orelse:
            yield Mistake((program.replace(case.test, f"not ({text})"),), f"the guard {text} is turned round")


def checks_the_first_only(program: Program) -> Iterator[Mistake]:
    """Only the first of several is checked."""
    for call in program.every(ast.Call):
        if last_name(call) in ("all", "any") and len(call.args) == 1:
            within = call.args[0]
            if isinstance(within, ast.GeneratorExp | ast.ListComp):
                within = within.generators[0].iter
            elif isinstance(within, ast.Call) and last_name(within) == "map" and len(within.args) == 2:
                within = within.args[1]
            yield _first_of(program, within)
    for loop in program.every(ast.For):
        if any(isinstance(one, ast.If) and isinstance(one.body[-1], _LEAVING) for one in loop.body):
            yield _first_of(program, loop.iter)


def lets_nan_through(program: Program) -> Iterator[Mistake]:
    """A test for NaN and infinity is missing."""
    for name, harmless in (("isfinite", "True"), ("isnan", "False"), ("isinf", "False")):
        for call in program.every(ast.Call):
            text = program.text(call)
            if last_name(call) == name:
                yield Mistake((program.replace(call, harmless),), f"{text} is not asked")
            for given in call.args:
                if isinstance(given, ast.Name | ast.Attribute) and last_name(given) == name:
                    edit = program.replace(given, f"lambda number: {harmless}")
                    yield Mistake((edit,), f"{name} is not asked in {text}")


def _lists_of_all(program: Program) -> Iterator[ast.Tuple | ast.List]:
    """Yield the lists of which all(…) or any(…) looks at every element, in its call or by a name."""
    calls = [call for call in program.every(ast.Call) if last_name(call) in ("all", "any")]
    names = {node.id for call in calls for node in ast.walk(call) if isinstance(node, ast.Name)}
    found = [node for call in calls for node in ast.walk(call)]
    found += [
        assigned.value
        for assigned in program.every(ast.Assign)
        if any(isinstance(target, ast.Name) and target.id in names for target in assigned.targets)
    ]
    for node in found:
        if isinstance(node, ast.Tuple | ast.List) and isinstance(node.ctx, ast.Load) and len(node.elts) > 1:
            yield node


def _first_of(program: Program, several: ast.expr) -> Mistake:
    text = program.text(several)
    return Mistake((program.replace(several, f"list({text})[:1]"),), f"only the first of {text} is looked at")
