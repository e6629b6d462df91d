"""What the text of a student's program says about its callbacks, its threads and its waits; nothing is executed."""

from __future__ import annotations

import ast
import re
from contextlib import suppress
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from autograder.classroom.audit.generated.program import Edits, Named, Program, callbacks, last_name
from ros_runtime.drawing.svg import shorten

WAITS = ("sleep", "wait", "wait_for")  # names of calls that keep the thread
MOST_LINES = 2000  # of a program that is read, so that no text keeps the command busy for hours
LONGEST_QUOTE = 100  # characters of a line of code
_KINDS = ("subscription", "service", "timer", "feedback", "goal", "cancel", "execute", "accepted", "done")
_JUMPS = (ast.Return, ast.Raise, ast.Continue, ast.Break)
_NEW_LINE = re.compile("\r\n|\r|\n")  # what ends a line in Python; str.splitlines knows more


class UnreadableProgram(Exception):
    """The program cannot be parsed, or imports interfaces that do not exist."""


class StudentProgram(Program):
    """The syntax tree of a student's program, with the text of its lines and the kind of each callback."""

    def __init__(self, text: str) -> None:
        """Raises `UnreadableProgram`: whatever a student's text can cause is caught here."""
        self.lines = _NEW_LINE.split(text)
        if len(self.lines) > MOST_LINES:
            raise UnreadableProgram(f"it has {len(self.lines)} lines; at most {MOST_LINES} are read")
        try:
            _require_interfaces(ast.parse(text))
            super().__init__(text)
            ast.unparse(self.tree)
        except Exception as error:
            raise UnreadableProgram(f"{type(error).__name__}: {error}") from error
        self.named = [one for one in self.every(ast.stmt) if isinstance(one, Named)]
        registered = ((one, kind) for kind in _KINDS for one in callbacks(self, kind))
        self.kinds = {one: kind for one, kind in registered if not self._makes_callbacks(one)}

    def quoted(self, line: int) -> str:
        """Return a line as a question quotes it: 'line 41, `goal_handle.canceled()`'."""
        return f"line {line}, {as_code(self.lines[line - 1])}"

    def _makes_callbacks(self, function: Named) -> bool:
        """Whether a function returns a function, so that not itself but what it returns is the callback."""
        inner = {one.name for one in self.named if self.function(one) is function}
        returned = [one.value for one in self.every(ast.Return, function)]
        return any(isinstance(one, ast.Lambda) or getattr(one, "id", "") in inner for one in returned)

    def callbacks(self, *kinds: str) -> list[Named]:
        """Return the callbacks of these kinds."""
        return [one for one, kind in self.kinds.items() if kind in kinds]

    def function(self, node: ast.AST) -> Named | None:
        """Return the innermost named function around a node."""
        return next((one for one in self.functions(node) if isinstance(one, Named)), None)

    def reached(self, function: Named) -> list[Named]:
        """Return a function and all functions of the program that it reaches by calls."""
        names = [one.name for one in self.named]
        by_name = {one.name: one for one in self.named if names.count(one.name) == 1}
        found = [function]
        for one in found:  # the loop appends to this list
            called = (by_name.get(last_name(call)) for call in self.every(ast.Call, one))
            found += dict.fromkeys(each for each in called if each and each not in found)
        return found

    def runs_for(self, node: ast.AST) -> tuple[str, str]:
        """Return the name and the kind of the only callback that reaches the function around a node; else "", ""."""
        function = self.function(node)
        found = [(one.name, kind) for one, kind in self.kinds.items() if function in self.reached(one)]
        return found[0] if len(found) == 1 else ("", "")

    def waits(self, function: Named) -> list[ast.expr]:
        """Return where a function, and those that it calls, keep the thread for a time, or give it back by `await`."""
        return [wait for one in self.reached(function) for wait in self.waits_in(one)]

    def waits_in(self, node: ast.AST) -> list[ast.expr]:
        """Return the waits inside one node."""
        calls = [one for one in self.every(ast.Call, node) if last_name(one) in WAITS]
        awaited = [one for one in calls if isinstance(self.parent(one), ast.Await)]
        return [*self.every(ast.Await, node), *(one for one in calls if one not in awaited)]

    def loop(self, node: ast.AST) -> ast.While | ast.For | None:
        """Return the innermost loop around a node in its own function."""
        around = (one for one in self.above(node) if isinstance(one, Named | ast.While | ast.For))
        return one if isinstance(one := next(around, None), ast.While | ast.For) else None

    def condition(
        self, node: ast.AST, *, follows: bool = True
    ) -> tuple[ast.If | ast.ExceptHandler | None, bool]:
        """Return the last `if` or `except` that decides that a node is reached, and whether it was true.

        That is one around the node, or an `if` before it whose body leaves the block. If the function has none, and
        `follows`, it is that of the function's only call.
        """
        below = node
        for one in self.above(node):
            blocks = (block for _, block in ast.iter_fields(one) if isinstance(block, list))
            before: list[Any] = next((block[: block.index(below)] for block in blocks if below in block), [])
            before = [each for each in before if not isinstance(each, Named)]
            leaving = [each for each in before if any(isinstance(part, _JUMPS) for part in ast.walk(each))]
            for last in leaving[-1:]:
                is_guard = isinstance(last, ast.If) and not last.orelse and isinstance(last.body[-1], _JUMPS)
                return (last, False) if is_guard else (None, True)
            if isinstance(one, Named):
                calls = [call for call in self.every(ast.Call) if follows and last_name(call) == one.name]
                is_only = len(calls) == 1 and one not in self.kinds
                return self.condition(calls[0], follows=False) if is_only else (None, True)
            if isinstance(one, ast.ExceptHandler) or (isinstance(one, ast.If) and below is not one.test):
                return one, below in one.body
            below = one
        return None, True

    def stores(self, read: ast.AST, outside: Named | None) -> list[ast.Assign]:
        """Return the assignments, elsewhere in the program, to the attributes that an expression reads.

        Assignments in `__init__`, in the function `outside` and in other classes do not count, nor do attributes of the
        function's parameters.
        """
        parameters = {one.arg for one in outside.args.args} - {"self"} if outside else set()
        names = {ast.unparse(one) for one in self.every(ast.Attribute, read)}
        names = {name for name in names if name.split(".")[0] not in parameters}
        of_class = next((one for one in self.above(read) if isinstance(one, ast.ClassDef)), None)
        assigned = [
            one for one in self.every(ast.Assign, of_class) if names & set(map(ast.unparse, one.targets))
        ]
        return [one for one in assigned if self.function(one) is not outside and not self.is_of_start(one)]

    def is_of_start(self, node: ast.AST) -> bool:
        """Whether a node is in `main`, in an `__init__`, or outside all functions."""
        return self.function_name(node) in ("main", "__init__", "module")

    def executor(self) -> ast.Call | None:
        """Return the call that decides how many threads run the callbacks; None if that is not clear."""
        calls = list(self.every(ast.Call))
        executors = [one for one in calls if last_name(one).endswith("Executor")]
        spins = [one for one in calls if re.match(r"rclpy\.spin", ast.unparse(one.func))]
        found = executors or spins[:1]
        is_known = not executors or last_name(found[0]) in ("MultiThreadedExecutor", "SingleThreadedExecutor")
        return found[0] if len(found) == 1 and is_known else None

    def with_text(self, edits: Edits) -> str | None:
        """Return the program with edits in single lines and no line moved; None if the text cannot express them."""
        lines = list(self.lines)
        for node, new in sorted(edits.items(), key=lambda edit: -edit[0].col_offset):  # type: ignore[attr-defined]
            assert isinstance(node, ast.expr | ast.stmt)
            if "\n" in new or node.lineno != node.end_lineno:
                return None
            old = lines[node.lineno - 1].encode()
            changed = old[: node.col_offset] + new.encode() + old[node.end_col_offset :]
            lines[node.lineno - 1] = changed.decode(errors="replace")
        text = "\n".join(lines)
        with suppress(SyntaxError):
            return text if ast.dump(ast.parse(text)) == ast.dump(ast.parse(self.changed(edits))) else None
        return None


def as_code(line: str) -> str:
    """Return a line between backticks, without the colon that would stand before the sentence's own punctuation."""
    code = line.strip().removesuffix(":").replace("`", "'")
    return f"`{shorten(code, LONGEST_QUOTE)}`"


def _require_interfaces(tree: ast.Module) -> None:
    """Require that a program imports its interfaces from packages of interfaces: `Program` imports these, too."""
    for one in ast.walk(tree):
        package, _, kind = (getattr(one, "module", "") or "").rpartition(".")
        if isinstance(one, ast.ImportFrom) and kind in ("msg", "srv", "action"):
            found = find_spec(package) if package.isidentifier() else None
            places = (found and found.submodule_search_locations) or ()
            if not any((Path(place) / kind).is_dir() for place in places):
                raise ImportError(f"there is no package of interfaces {package!r}")
