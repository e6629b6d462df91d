"""A correct submission with one mistake in it, and all that can be made of an exercise's correct submissions."""

from __future__ import annotations

import ast
import difflib
import hashlib
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

from autograder.audit.generated.mistakes import OPERATORS
from autograder.audit.generated.program import Mistake, Program
from autograder.audit.known_submission import KNOWN
from autograder.engine.exercise import exercises_folder, file_names

_Place = tuple[int, ...]
_Meaning = tuple[tuple[_Place, str], ...]


@dataclass(frozen=True)
class Mutant:
    """The program `source`, made by an operator from the correct program `base`; `sentence` says what is wrong.

    `name` is operator.function.hash.base. The hash is of the changed statement alone, so that names outlast edits of
    other lines.
    """

    name: str
    operator: str
    sentence: str
    base: Path
    source: str

    def diff(self, context: int = 3) -> list[str]:
        """Return the lines of the unified diff from the correct program."""
        before = self.base.read_text(encoding="utf-8").splitlines()
        names = f"correct/{self.base.name}", self.name
        return list(difflib.unified_diff(before, self.source.splitlines(), *names, n=context, lineterm=""))

    def changed_lines(self) -> list[str]:
        """Return the lines of the diff that begin with - or +, without its head."""
        return [line for line in self.diff(context=0)[2:] if not line.startswith("@@")]


def mutants_of_exercise(exercise: str) -> list[Mutant]:
    """Return every mutant of the programs in <exercise>/known/correct; none where students write no single program."""
    names = file_names(exercise)
    if len(names) != 1 or not names[0].endswith(".py"):
        return []
    bases = sorted((exercises_folder() / exercise / KNOWN / "correct").glob("*.py"))
    return [mutant for base in bases for mutant in mutants_of_program(base)]


def mutants_of_program(base: Path) -> list[Mutant]:
    """Return the mutants of one program that compile, each program once."""
    source = base.read_text(encoding="utf-8")
    program = Program(source)
    seen: set[_Meaning] = set()
    named: Counter[str] = Counter()
    found = []
    for operator, mistake in _mistakes(program):
        changed = program.changed(mistake.edits)
        places = tuple(_place(program, edit.node) for edit in mistake.edits)
        meaning = _meaning(_parsed(changed), places)
        if meaning is None or meaning in seen or meaning == _meaning(program.tree, places):
            continue
        seen.add(meaning)
        first = mistake.edits[0].node
        name = f"{operator}.{program.function_name(first)}.{_hash(program, mistake)}"
        named[name] += 1
        number = f"-{named[name]}" if named[name] > 1 else ""
        sentence = f"{' '.join(mistake.sentence.split())}, in line {getattr(first, 'lineno', 1)}"
        found.append(Mutant(f"{name}{number}.{base.stem}", operator, sentence, base, changed))
    return found


def _mistakes(program: Program) -> Iterator[tuple[str, Mistake]]:
    for name, operator in OPERATORS.items():
        for mistake in operator(program):
            yield name, mistake


def _parsed(source: str) -> ast.Module | None:
    """Return the syntax tree of a program; None if it does not compile."""
    try:
        tree = ast.parse(source)
        compile(tree, "mutant", "exec")
    except SyntaxError:
        return None
    return tree


def _place(program: Program, node: ast.AST) -> _Place:
    """Return the numbers of the module's statement that a node is in, and of that of a class."""
    around = [node, *program.above(node)][::-1]
    numbers = []
    for outer, inner in pairwise(around):
        if not isinstance(outer, ast.Module | ast.ClassDef) or inner not in outer.body:
            break
        numbers.append(next(number for number, one in enumerate(outer.body) if one is inner))
    return tuple(numbers)


def _meaning(tree: ast.Module | None, places: tuple[_Place, ...]) -> _Meaning | None:
    """Return the syntax trees at these places, which are all that a mistake changes."""
    if tree is None:
        return None
    found = []
    for place in places:
        part: Any = tree
        for number in place:
            part = part.body[number]
        found.append((place, ast.dump(part)))
    return tuple(found)


def _hash(program: Program, mistake: Mistake) -> str:
    """Return a few digits that stand for the statement that is changed, without its block, and for the change."""
    words = []
    for edit in mistake.edits:
        if edit.start != edit.end:
            words += [program.head(edit.node), program.text(edit.node)]
        words.append(edit.text)
    return hashlib.sha256(" ".join(" ".join(words).split()).encode()).hexdigest()[:6]
