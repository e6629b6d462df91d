"""The files that a notebook's cells write with %%writefile, as IPython reads the cells; none of them is run."""

from __future__ import annotations

import ast
import json
import re
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import reduce
from itertools import islice
from posixpath import normpath
from typing import Any

RUN_THEIR_CELL = ("capture", "prun", "time", "timeit")  # magics that hand their cell to IPython again
MOST_INSIDE = 3  # of those in each other
MOST_CELLS, MOST_CODE = 2_000, 3_000_000  # code cells of a notebook, and characters in them
MOST_ALIASES = 10  # in a cell
LONGEST_PYTHON_CELL = 100_000  # characters of a cell without a magic that are still looked at
LONGEST_LINE = 1000  # characters behind a magic, whose parser takes ever longer for more
LONGEST_QUOTE = 120  # characters of a cell's first line
_ALIAS = re.compile(rf"^[ \t]*%alias_magic[ \t]+(.{{1,{LONGEST_LINE}}})$", re.MULTILINE)
_VARIABLE = re.compile(r"\{([^{}]+)\}|\$([\w.]+)")  # as IPython puts values into a magic's line


@dataclass(frozen=True)
class Written:
    """What the cells write, run from top to bottom in an empty folder.

    Attributes:
        files: the text of each file by its path as the cell gives it.
        failures: a sentence for each %%writefile of which it cannot be told what it writes, or which IPython refuses.
    """

    files: dict[str, str] = field(default_factory=dict)
    failures: list[str] = field(default_factory=list)


def cells_in(text: str) -> list[dict[str, Any]]:
    """Return a notebook's cells, in any version of the format; nothing else of it has to be sound.

    Raises:
        ValueError: the text is no notebook; the message says why.
    """
    try:
        notebook = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise ValueError(f"is not a notebook: {error}") from error
    try:
        sheets = notebook.get("worksheets") or [notebook]  # cells lay in sheets until nbformat 3
        return [cell for sheet in sheets for cell in sheet["cells"] if isinstance(cell, dict)]
    except (AttributeError, KeyError, TypeError) as error:
        raise ValueError("is not a notebook: it is JSON without a list of cells") from error


def source_of(cell: Mapping[str, Any]) -> str:
    """Return what stands in a cell."""
    source = cell.get("source", cell.get("input"))  # of nbformat 3 and before
    return "".join(map(str, source)) if isinstance(source, list) else str(source or "")


def code_cells(text: str) -> list[str]:
    """Return what stands in a notebook's code cells.

    Raises:
        ValueError: the text is no notebook, or one with too much code; the message says which.
    """
    code = [source_of(cell) for cell in cells_in(text) if cell.get("cell_type") == "code"]
    if len(code) > MOST_CELLS or sum(map(len, code)) > MOST_CODE:
        raise ValueError(
            f"holds {len(code):,} code cells and {sum(map(len, code)):,} characters in them; "
            f"at most {MOST_CELLS:,} and {MOST_CODE:,} are read"
        )
    return code


def written_by(cells: Sequence[str]) -> Written:
    """Return what code cells write, run in this order."""
    from IPython.core.error import UsageError
    from IPython.core.magic_arguments import parse_argstring
    from IPython.core.magics.osm import OSMagics

    written = Written()
    aliases = {"writefile": "", "file": ""}  # with the arguments that each puts before its own
    variables: dict[str, str] = {}
    has_variables = any(_VARIABLE.search(cell[:LONGEST_LINE].partition("\n")[0]) for cell in cells)
    for cell in cells:
        magics = list(_cell_magics(cell))
        for name, line, body in magics:
            if re.match(r"(writefile|file)\s", name):
                written.failures.append(f"{f'%%{name}'[:LONGEST_QUOTE]!r} has no space behind %%writefile")
            if name not in aliases or not body:  # IPython refuses to write an empty cell
                continue
            line = f"{aliases[name]} {line}".strip()
            line = _expanded(line, variables)
            if _VARIABLE.search(line):
                written.failures.append(
                    f"{_quoted(name, line)} takes the file's name from a variable, and no cell is run here: "
                    "write the name"
                )
                continue
            try:
                if len(line) > LONGEST_LINE:
                    raise UsageError(f"its arguments have {len(line):,} characters")
                arguments = parse_argstring(OSMagics.writefile, line)
            except (UsageError, ValueError) as error:
                written.failures.append(
                    f"Jupyter refuses {_quoted(name, line)}: {str(error)[:LONGEST_QUOTE]}"
                )
                continue
            path = normpath(re.sub(r"^(['\"])(.*)\1$", r"\2", arguments.filename))
            written.files[path] = (written.files.get(path, "") if arguments.append else "") + body
        aliases.update(_new_aliases(cell, aliases))
        if has_variables:
            variables.update(_texts_set_in(cell))
        misplaced = re.search(r"^[ \t]*%%(writefile|file) +(.*)", cell, re.MULTILINE)
        if misplaced and not magics:
            written.failures.append(f"{_quoted(*misplaced.groups())} is not the first line of its cell")
    return written


def _quoted(name: str, line: str) -> str:
    return repr(f"%%{name} {line}"[:LONGEST_QUOTE])


def _cell_magics(cell: str, inside: int = 0) -> Iterator[tuple[str, str, str]]:
    """Yield name, line and body of each cell magic that a cell calls, as IPython's transformer says it in Python."""
    from IPython.core.inputtransformer2 import TransformerManager

    manager: Any = TransformerManager()
    lines = (cell if cell.endswith("\n") else f"{cell}\n").splitlines(keepends=True)
    plain = _transformed(lines, manager.cleanup_transforms)
    lines = _transformed(plain, manager.line_transforms)
    code = "".join(lines)
    if "run_cell_magic" not in code or (lines is plain and len(code) > LONGEST_PYTHON_CELL):
        return
    for name, line, body in _calls(code):
        if name in RUN_THEIR_CELL and inside < MOST_INSIDE:
            yield from _cell_magics(body, inside + 1)
        else:
            yield name, line, body


def _transformed(lines: list[str], transforms: Iterable[Callable[[list[str]], list[str]]]) -> list[str]:
    return reduce(lambda done, transform: transform(done), transforms, lines)


def _calls(code: str) -> Iterator[tuple[str, str, str]]:
    """Yield what statements of a program hand to get_ipython().run_cell_magic()."""
    for statement in _statements(code):
        match statement:
            case ast.Expr(
                ast.Call(
                    ast.Attribute(ast.Call(ast.Name("get_ipython")), "run_cell_magic"),
                    [ast.Constant(str(name)), ast.Constant(str(line)), ast.Constant(str(body))],
                )
            ):
                yield name, line, body


def _statements(code: str) -> list[ast.stmt]:
    """Return the statements of a program; none of one that Python does not read."""
    try:
        with warnings.catch_warnings():  # of Python, on what a student wrote
            warnings.simplefilter("ignore")
            return ast.parse(code).body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return []


def _new_aliases(cell: str, known: Mapping[str, str]) -> dict[str, str]:
    """Return the names that a cell gives to %%writefile with %alias_magic."""
    from IPython.core.error import UsageError
    from IPython.core.magic_arguments import parse_argstring
    from IPython.core.magics.basic import BasicMagics

    aliases = {}
    for found in islice(_ALIAS.finditer(cell), MOST_ALIASES):
        try:
            arguments = parse_argstring(BasicMagics.alias_magic, found[1])
        except (UsageError, ValueError):
            continue
        if (target := arguments.target.lstrip("%")) in known:
            params = (arguments.params or "").strip("'\"")
            aliases[arguments.name.lstrip("%")] = f"{known[target]} {params}".strip()
    return aliases


def _expanded(line: str, variables: Mapping[str, str]) -> str:
    """Return a magic's line with the variables' texts in it; as it is, as in IPython, unless all of them are known."""
    names = [braces or dollar for braces, dollar in _VARIABLE.findall(line)]
    if not variables.keys() >= set(names):
        return line
    return _VARIABLE.sub(lambda found: variables[found[1] or found[2]], line)


def _texts_set_in(cell: str) -> dict[str, str]:
    """Return the variables that a cell sets to a text."""
    texts = {}
    for statement in _statements(cell):
        match statement:
            case ast.Assign([ast.Name(name)], ast.Constant(str(text))) | ast.AnnAssign(
                ast.Name(name), _, ast.Constant(str(text))
            ):
                texts[name] = text
    return texts
