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
from pathlib import Path
from posixpath import normpath
from typing import Any

RUN_THEIR_CELL = ("capture", "prun", "time", "timeit")  # magics that run the rest of their cell as a cell
MOST_INSIDE = 3  # nested magics of this kind
MOST_CELLS, MOST_CODE = 2_000, 3_000_000  # code cells of a notebook, and characters in them
MOST_ALIASES = 10  # in a cell
LONGEST_PYTHON_CELL = 100_000  # characters of a cell without a magic; a longer one is not parsed
LONGEST_LINE = 1000  # characters of a magic's arguments; the parser is slow on longer ones
LONGEST_QUOTE = 120  # characters of a cell's first line
_ALIAS = re.compile(rf"^[ \t]*%alias_magic[ \t]+(.{{1,{LONGEST_LINE}}})$", re.MULTILINE)
_VARIABLE = re.compile(r"\{([^{}]+)\}|\$([\w.]+)")  # as IPython puts values into a magic's line


@dataclass(frozen=True)
class Written:
    """What the cells write, run from top to bottom in an empty folder.

    Attributes:
        files: the text of each file, by its path as written in the cell.
        failures: a sentence for each %%writefile that IPython refuses or whose file name cannot be determined.
    """

    files: dict[str, str] = field(default_factory=dict)
    failures: list[str] = field(default_factory=list)


def cells_in(text: str) -> list[dict[str, Any]]:
    """Return a notebook's cells, in any version of the format; the rest of the notebook may be malformed.

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
    """Return the text of a cell."""
    source = cell.get("source", cell.get("input"))  # of nbformat 3 and before
    return "".join(map(str, source)) if isinstance(source, list) else str(source or "")


def text_of_cell(notebook: Path, cell_id: str) -> str:
    """Return the text of a notebook's cell; "" if there is no readable notebook with such a cell."""
    try:
        cells = cells_in(notebook.read_text(encoding="utf-8-sig"))
    except (OSError, ValueError):
        return ""
    return next((source_of(cell) for cell in cells if cell.get("id") == cell_id), "")


def code_cells(text: str) -> list[str]:
    """Return the texts of a notebook's code cells.

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
    """Return what these code cells would write if they were run in this order; none is run."""
    from IPython.core.error import UsageError
    from IPython.core.magic_arguments import parse_argstring
    from IPython.core.magics.osm import OSMagics

    written = Written()
    # names of the magic, each with the arguments that an %alias_magic adds in front
    aliases = {"writefile": "", "file": ""}
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
                    f"{_quoted(name, line)} takes the file's name from a variable, but the grader runs no cell: "
                    "write the name itself"
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
    """Yield name, line and body of each cell magic in a cell, found in the output of IPython's transformer."""
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
    """Yield the three arguments of each statement get_ipython().run_cell_magic(name, line, body)."""
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
    """Return the statements of a program; [] if Python cannot parse it."""
    try:
        with warnings.catch_warnings():  # for example, invalid escape sequences in a student's code
            warnings.simplefilter("ignore")
            return ast.parse(code).body
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return []


def _new_aliases(cell: str, known: Mapping[str, str]) -> dict[str, str]:
    """Return the aliases of %%writefile that a cell defines with %alias_magic, with their arguments."""
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
    """Substitute variables in a magic's line; like IPython, return it unchanged if one of them is unknown."""
    names = [braces or dollar for braces, dollar in _VARIABLE.findall(line)]
    if not variables.keys() >= set(names):
        return line
    return _VARIABLE.sub(lambda found: variables[found[1] or found[2]], line)


def _texts_set_in(cell: str) -> dict[str, str]:
    """Return the variables that a cell assigns a literal string to, with their values."""
    texts = {}
    for statement in _statements(cell):
        match statement:
            case ast.Assign([ast.Name(name)], ast.Constant(str(text))) | ast.AnnAssign(
                ast.Name(name), _, ast.Constant(str(text))
            ):
                texts[name] = text
    return texts
