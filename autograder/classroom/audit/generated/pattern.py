"""Patterns that match expressions: a single capital letter in a pattern stands for any expression.

`f(X, *R)` matches a call of f, a.f or a.b.f with at least one argument. `**K` matches all keyword arguments. A name
also matches a dotted name that ends with it, so `status` matches `answer.status`.
"""

from __future__ import annotations

import ast
from typing import Any

from autograder.classroom.audit.generated.program import last_name

Bound = dict[str, Any]  # each letter with the expression, or the list of expressions, that it stands for


def parsed(pattern: str) -> ast.expr:
    """Parse the text of a pattern."""
    return ast.parse(pattern, mode="eval").body


def match(pattern: ast.expr, node: ast.expr) -> Bound | None:
    """Return what the letters of a pattern stand for in a node; None if the node does not match."""
    bound: Bound = {}
    return bound if _matches(pattern, node, bound) else None


def filled(replacement: str, bound: Bound) -> str:
    """Replace the letters in an expression by what they stand for, and return its source."""
    return ast.unparse(_Substitution(bound).visit(parsed(replacement)))


def _matches(pattern: Any, node: Any, bound: Bound) -> bool:
    if isinstance(pattern, list):
        if pattern and (letter := _letter_of_rest(pattern[-1])):
            pattern = pattern[:-1]
            bound[letter], node = node[len(pattern) :], node[: len(pattern)]
        both = zip(pattern, node, strict=False)
        return len(pattern) == len(node) and all(_matches(one, other, bound) for one, other in both)
    if _is_letter(pattern):
        is_one = isinstance(node, ast.expr) and not isinstance(node, ast.Starred)
        return is_one and ast.dump(bound.setdefault(pattern.id, node)) == ast.dump(node)
    if isinstance(pattern, ast.Name):
        return isinstance(node, ast.Name | ast.Attribute) and last_name(node) == pattern.id
    if not isinstance(pattern, ast.AST):
        return type(pattern) is type(node) and bool(pattern == node)
    fields = ((getattr(pattern, name, None), getattr(node, name, None)) for name in pattern._fields)
    return type(pattern) is type(node) and all(_matches(one, other, bound) for one, other in fields)


class _Substitution(ast.NodeTransformer):
    def __init__(self, bound: Bound) -> None:
        self._bound = bound

    def generic_visit(self, node: ast.AST) -> Any:
        letter = node.id if isinstance(node, ast.Name) else _letter_of_rest(node)
        return self._bound[letter] if letter in self._bound else super().generic_visit(node)


def _letter_of_rest(pattern: ast.AST) -> str:
    """Return the letter of `*R` or `**K`; "" for anything else."""
    if isinstance(pattern, ast.Starred) or (isinstance(pattern, ast.keyword) and pattern.arg is None):
        return last_name(pattern.value) if _is_letter(pattern.value) else ""
    return ""


def _is_letter(node: Any) -> bool:
    return isinstance(node, ast.Name) and len(node.id) == 1 and node.id.isupper()
