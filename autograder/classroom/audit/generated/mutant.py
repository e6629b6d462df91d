"""Makes mutants, which are correct submissions with one mistake each."""

from __future__ import annotations

import ast
import difflib
import hashlib
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

from autograder.classroom.audit.generated.mistakes import OPERATORS
from autograder.classroom.audit.generated.program import Edits, Program
from autograder.classroom.audit.known_submission import KNOWN
from autograder.engine.exercise import exercises_folder, file_names


@dataclass(frozen=True)
class Mutant:
    """A program made by an operator from the correct program `base`; `sentence` says what is wrong.

    `name` is operator.function.hash.base. Only the changed statement is hashed, so the name stays the same when other
    lines are edited.
    """

    name: str
    operator: str
    sentence: str
    base: Path
    program: Program = field(compare=False, repr=False)
    edits: Edits = field(compare=False, repr=False)

    @property
    def source(self) -> str:
        """The source of the mutant, without comments."""
        return self.program.changed(self.edits)

    def diff(self, context: int = 3) -> list[str]:
        """Return the lines of the unified diff between the correct program and the mutant, both without comments."""
        texts = (self.program.changed({}).splitlines(), self.source.splitlines())
        names = f"correct/{self.base.name}", self.name
        return list(difflib.unified_diff(*texts, *names, n=context, lineterm=""))


def mutants_of_exercise(exercise: str) -> list[Mutant]:
    """Return every mutant of the programs in <exercise>/known/correct; [] unless students write one Python file."""
    names = file_names(exercise)
    if len(names) != 1 or not names[0].endswith(".py"):
        return []
    bases = sorted((exercises_folder() / exercise / KNOWN / "correct").glob("*.py"))
    return [mutant for base in bases for mutant in mutants_of_program(base)]


def mutants_of_program(base: Path) -> list[Mutant]:
    """Return the mutants of one program, without duplicates."""
    program = Program(base.read_text(encoding="utf-8"))
    seen: set[tuple[ast.stmt, str]] = set()
    named: Counter[str] = Counter()
    found = []
    for operator, (sentence, edits_of) in OPERATORS.items():
        for edits in edits_of(program):
            first = next(iter(edits))
            statement = program.statement(first)
            before = ast.unparse(statement)
            after = program.changed(edits, statement)
            if after == before or (statement, after) in seen:
                continue
            seen.add((statement, after))
            name = f"{operator}.{program.function_name(first)}.{_hash(before.splitlines()[0], edits)}"
            named[name] += 1
            number = f"-{named[name]}" if named[name] > 1 else ""
            words = f"{sentence}, in line {statement.lineno}: {_change(ast.unparse(first), edits[first])}"
            found.append(Mutant(f"{name}{number}.{base.stem}", operator, words, base, program, edits))
    return found


def _hash(head: str, edits: Edits) -> str:
    """Return a short hash of the first line of the changed statement and of the change."""
    words = [head, *(text for node, new in edits.items() for text in (ast.unparse(node), new))]
    text = "\n".join(words).replace("lambda :", "lambda:")  # Python 3.10 writes a space
    return hashlib.sha256(text.encode()).hexdigest()[:6]


def _change(before: str, after: str) -> str:
    """Describe a change in one line: "NEW instead of OLD", or the added text."""
    old, new = before.splitlines(), after.splitlines()
    added = "; ".join(line.strip() for line in new if line not in old)
    removed = "; ".join(line.strip() for line in old if line not in new)
    return f"{added} instead of {removed}" if removed else f"{added} is added"
