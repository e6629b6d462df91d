"""A correct program whose places can be found and replaced, so that the rest of its text stays as it is."""

from __future__ import annotations

import ast
import copy
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import TypeVar

Named = ast.FunctionDef | ast.AsyncFunctionDef
Function = Named | ast.Lambda

_BINDING = (ast.BinOp, ast.UnaryOp, ast.BoolOp, ast.Compare, ast.Attribute, ast.Await)
_BOUND = (ast.Name, ast.Attribute, ast.Call, ast.Tuple, ast.Constant)  # what needs no parentheses in these

_Node = TypeVar("_Node", bound=ast.AST)


@dataclass(frozen=True)
class Edit:
    """Bytes `start` to `end` of a program become `text`; `node` is what is changed, or what stands after it."""

    node: ast.AST
    start: int
    end: int
    text: str


@dataclass(frozen=True)
class Mistake:
    """A place where an operator applies: the edits that make the mistake, the first at its line, and what it is."""

    edits: tuple[Edit, ...]
    sentence: str


class Program:
    """The source of a program with its syntax tree, in which every node knows its parent."""

    def __init__(self, source: str) -> None:
        """Raises SyntaxError when the source is no Python."""
        self.source = source.encode()
        self.tree = ast.parse(source)
        self._parents = {child: node for node in ast.walk(self.tree) for child in ast.iter_child_nodes(node)}
        self._nodes = list(_in_order(self.tree))
        self._lines = [0]
        for line in self.source.split(b"\n"):
            self._lines.append(self._lines[-1] + len(line) + 1)

    def every(self, kind: type[_Node], inside: ast.AST | None = None) -> Iterator[_Node]:
        """Yield the nodes of a kind in the order of the text, but those in f-strings, whose places are not known."""
        for node in self._nodes if inside is None else _in_order(inside):
            if isinstance(node, kind):
                yield node

    def named_functions(self) -> Iterator[Named]:
        """Yield the functions and methods of the program."""
        for statement in self.every(ast.stmt):
            if isinstance(statement, Named):
                yield statement

    def above(self, node: ast.AST) -> Iterator[ast.AST]:
        """Yield what a node is in, from the inside to the module."""
        while node in self._parents:
            node = self._parents[node]
            yield node

    def parent(self, node: ast.AST) -> ast.AST:
        """Return what a node is directly in."""
        return self._parents[node]

    def statement(self, node: ast.AST) -> ast.stmt:
        """Return the innermost statement that a node is in or is."""
        return next(one for one in (node, *self.above(node)) if isinstance(one, ast.stmt))

    def functions(self, node: ast.AST) -> list[Function]:
        """Return the functions around a node, the innermost first."""
        return [one for one in self.above(node) if isinstance(one, Function)]

    def function_name(self, node: ast.AST) -> str:
        """Name the innermost function with a name around a node, or which it is; "module" if there is none."""
        around = (node, *self.above(node))
        return next((one.name for one in around if isinstance(one, Named)), "module")

    def text(self, node: ast.AST) -> str:
        """Return the source of a node."""
        start, end = self._span(node)
        return self.source[start:end].decode()

    def replace(self, node: ast.AST, text: str) -> Edit:
        """Put another text in the place of a node; in the middle of an expression it stands in parentheses."""
        if isinstance(self._parents.get(node), _BINDING):
            new = ast.parse(f"({text})", mode="eval").body
            text = text if isinstance(new, _BOUND) else f"({text})"
        return Edit(node, *self._span(node), text)

    def drop(self, statement: ast.stmt) -> Edit:
        """Leave a statement out."""
        return Edit(statement, *self._span(statement), "pass")

    def without(self, element: ast.AST) -> Edit:
        """Take an element out of a list or a tuple, a keyword out of a call, a condition out of `and` or `or`."""
        parent = self.parent(element)
        smaller = copy.copy(parent)
        for name, value in ast.iter_fields(parent):
            if isinstance(value, list) and element in value:
                setattr(smaller, name, [one for one in value if one is not element])
        if isinstance(smaller, ast.BoolOp) and len(smaller.values) == 1:
            return self.replace(parent, ast.unparse(smaller.values[0]))
        return self.replace(parent, ast.unparse(smaller))

    def insert(self, before: ast.stmt, *statements: str) -> Edit:
        """Put statements before another one, in its block."""
        start, _ = self._span(before)
        indent = "\n" + " " * before.col_offset
        return Edit(before, start, start, "".join(statement + indent for statement in statements))

    def insert_first(self, block: list[ast.stmt], *statements: str) -> Edit:
        """Put statements at the beginning of a block, below its docstring."""
        first = block[0]
        is_docstring = (
            isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant) and len(block) > 1
        )
        return self.insert(block[1] if is_docstring else first, *statements)

    def head(self, node: ast.AST) -> str:
        """Return the source of the statement that a node is in, without its block, in one line."""
        statement = self.statement(node)
        start, end = self._span(statement)
        block = getattr(statement, "body", None)
        return " ".join(self.source[start : self._span(block[0])[0] if block else end].decode().split())

    def changed(self, edits: Iterable[Edit]) -> str:
        """Return the source with the edits made."""
        source = self.source
        for edit in sorted(edits, key=lambda edit: edit.start, reverse=True):
            source = source[: edit.start] + edit.text.encode() + source[edit.end :]
        return source.decode()

    def _span(self, node: ast.AST) -> tuple[int, int]:
        assert isinstance(node, ast.expr | ast.stmt | ast.keyword)
        assert node.end_lineno is not None
        assert node.end_col_offset is not None
        return (
            self._lines[node.lineno - 1] + node.col_offset,
            self._lines[node.end_lineno - 1] + node.end_col_offset,
        )


def last_name(node: ast.AST | None) -> str:
    """Return the last part of a dotted name or of the name of what is called: "sleep" of time.sleep; "" of others."""
    if isinstance(node, ast.Call):
        return last_name(node.func)
    if isinstance(node, ast.Attribute):
        return node.attr
    return node.id if isinstance(node, ast.Name) else ""


def _in_order(node: ast.AST) -> Iterator[ast.AST]:
    stack = [node]
    while stack:
        node = stack.pop()
        yield node
        if not isinstance(node, ast.JoinedStr):
            stack += reversed(list(ast.iter_child_nodes(node)))
