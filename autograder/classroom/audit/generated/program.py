"""The syntax tree of a correct program, whose nodes can be replaced by other source text."""

from __future__ import annotations

import ast
import copy
from collections.abc import Iterator
from typing import TypeVar

from autograder.classroom.audit.generated.interfaces import Interfaces

Named = ast.FunctionDef | ast.AsyncFunctionDef
Function = Named | ast.Lambda
Edits = dict[ast.AST, str]  # each node to replace, with its new source

_Node = TypeVar("_Node", bound=ast.AST)
# The functions that take callbacks: the kind of each callback, by the position or keyword of its argument.
_CALLBACK_ARGUMENTS: dict[str, dict[int | str | None, str]] = {
    "create_subscription": {2: "subscription", "callback": "subscription"},
    "create_service": {2: "service", "callback": "service"},
    "create_timer": {1: "timer", "callback": "timer"},
    "send_goal_async": {1: "feedback", "feedback_callback": "feedback"},
    "add_done_callback": {0: "done"},
    "ActionServer": {
        3: "execute",
        "execute_callback": "execute",
        "goal_callback": "goal",
        "handle_accepted_callback": "accepted",
        "cancel_callback": "cancel",
    },
}


class Program:
    """The syntax tree of a program, with the parent of each node."""

    def __init__(self, source: str) -> None:
        """Raises SyntaxError when the source is not valid Python."""
        self.tree = ast.parse(source)
        self.interfaces = Interfaces(self.tree)
        self._parents = {child: node for node in ast.walk(self.tree) for child in ast.iter_child_nodes(node)}

    def every(self, kind: type[_Node], inside: ast.AST | None = None) -> Iterator[_Node]:
        """Yield the nodes of a type, in source order."""
        node = inside or self.tree
        if isinstance(node, kind):
            yield node
        for child in ast.iter_child_nodes(node):
            yield from self.every(kind, child)

    def above(self, node: ast.AST) -> Iterator[ast.AST]:
        """Yield the nodes that enclose a node, from its parent to the module."""
        while node in self._parents:
            node = self._parents[node]
            yield node

    def parent(self, node: ast.AST) -> ast.AST:
        """Return the parent of a node."""
        return self._parents[node]

    def statement(self, node: ast.AST) -> ast.stmt:
        """Return the node itself if it is a statement, else the innermost statement around it."""
        return next(one for one in (node, *self.above(node)) if isinstance(one, ast.stmt))

    def functions(self, node: ast.AST) -> list[Function]:
        """Return the functions around a node, the innermost first."""
        return [one for one in self.above(node) if isinstance(one, Function)]

    def function_name(self, node: ast.AST) -> str:
        """Name the innermost named function around a node; "module" if there is none."""
        return next((one.name for one in self.functions(node) if isinstance(one, Named)), "module")

    def without(self, element: ast.AST) -> Edits:
        """Return the edit that removes an element of a list, a keyword of a call, or an operand of `and` or `or`."""
        parent = self.parent(element)
        smaller = copy.copy(parent)
        for name, value in ast.iter_fields(parent):
            if isinstance(value, list) and element in value:
                setattr(smaller, name, [one for one in value if one is not element])
        if isinstance(smaller, ast.BoolOp) and len(smaller.values) == 1:
            smaller = smaller.values[0]
        return {parent: ast.unparse(smaller)}

    def begun_with(self, function: Named, statements: str) -> Edits:
        """Return the edit that inserts statements at the beginning of a function, below its docstring."""
        first = function.body[1 if ast.get_docstring(function) and len(function.body) > 1 else 0]
        return {first: f"{statements}\n{ast.unparse(first)}"}

    def changed(self, edits: Edits, inside: ast.AST | None = None) -> str:
        """Return the source of the whole program, or of one node, with the edits applied."""
        new = {id(node): _parsed(source, node) for node, source in edits.items()}
        # deepcopy's second argument maps ids of objects to finished copies: it uses the new nodes as these copies.
        return ast.unparse(copy.deepcopy(inside or self.tree, new))


def last_name(node: ast.AST | None) -> str:
    """Return the last part of a dotted name, or of a called function's name: "sleep" for time.sleep; else ""."""
    if isinstance(node, ast.Call):
        return last_name(node.func)
    if isinstance(node, ast.Attribute):
        return node.attr
    return node.id if isinstance(node, ast.Name) else ""


def _parsed(source: str, node: ast.AST) -> ast.AST:
    """Parse the new source of a node; in place of a statement it is a module, which may hold several statements."""
    return ast.parse(source) if isinstance(node, ast.stmt) else ast.parse(source, mode="eval").body


def callbacks(program: Program, *kinds: str) -> Iterator[Named]:
    """Yield the named functions that are callbacks of these kinds, each once."""
    named = [one for one in program.every(ast.stmt) if isinstance(one, Named)]
    found: dict[Named, None] = {}
    for call in program.every(ast.Call):
        given = [*enumerate(call.args), *((word.arg, word.value) for word in call.keywords)]
        taken = _CALLBACK_ARGUMENTS.get(last_name(call), {})
        around = set(program.above(call))
        for name in [last_name(value) for place, value in given if taken.get(place) in kinds]:
            of_one_name = [one for one in named if one.name == name]
            of_its_class = [one for one in of_one_name if program.parent(one) in around]
            found |= dict.fromkeys((of_its_class or of_one_name)[:1])
    yield from found
