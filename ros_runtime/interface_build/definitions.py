"""Reads .msg, .srv and .action files line by line, and reports what is wrong with them."""

from __future__ import annotations

import io
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import redirect_stderr
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from rosidl_adapter.parser import Constant, Field, is_valid_message_name, parse_message_string

from ros_runtime.interface_build.advice import Finding, explain_line, explain_type, name_is_reserved
from ros_runtime.interface_build.known_types import KnownTypes

SEPARATOR = "---"
# A larger file is not a plausible interface, and checking or building it would take too long.
LARGEST_FILE = 64 * 1024  # bytes
MOST_LINES = 1000
LONGEST_LINE = 500  # characters, without its comment
MOST_ELEMENTS = 100  # fields and constants
PARTS = {"msg": ("message",), "srv": ("request", "response"), "action": ("goal", "result", "feedback")}


@dataclass(frozen=True)
class Problem:
    """Why a definition cannot be built; `line` counts from 1, and 0 means the whole file."""

    file: str
    line: int
    text: str
    wrong: str
    expected: str

    def __str__(self) -> str:
        place = f"{self.file}, line {self.line}: {self.text}" if self.line else self.file
        return f"{place}\n    wrong:    {self.wrong}\n    expected: {self.expected}"


class InvalidDefinitions(Exception):
    """The definitions cannot be built; `problems` lists every problem found."""

    def __init__(self, problems: Sequence[Problem]) -> None:
        super().__init__("\n".join(map(str, problems)))
        self.problems = list(problems)


@dataclass(frozen=True)
class Part:
    """A message, or a part of a service or action.

    `fields` maps names to ROS types, `constants` maps names to (type, value).
    """

    fields: dict[str, str] = field(default_factory=dict)
    constants: dict[str, tuple[str, Any]] = field(default_factory=dict)


@dataclass(frozen=True)
class Definition:
    """One interface: `kind` is "msg", "srv" or "action"; `uses` are the packages its fields come from."""

    file: Path
    kind: str
    name: str
    parts: Mapping[str, Part]
    uses: frozenset[str]


def read_definitions(source: Path, package: str, known: KnownTypes) -> list[Definition]:
    """Read every definition in `source` and its folders msg/, srv/ and action/.

    Raises:
        InvalidDefinitions: a definition cannot be built; the error lists every problem.
    """
    places = [place for kind in PARTS for place in (f"*.{kind}", f"{kind}/*.{kind}")]
    files = sorted(path for place in places for path in source.glob(place) if path.is_file())
    if not files:
        wanted = "files that end in .msg, .srv or .action, in it or in its folders msg, srv and action"
        raise InvalidDefinitions(
            [Problem(str(source), 0, "", "there is no definition in this folder", wanted)]
        )
    known = known.with_package(package, {path.stem for path in files if path.suffix == ".msg"})
    readers = [_Reader(path, path.relative_to(source).as_posix(), package, known) for path in files]
    problems = [problem for reader in readers for problem in reader.problems]
    problems += _duplicates(files)
    if problems:
        raise InvalidDefinitions(problems)
    return [reader.definition() for reader in readers]


def _duplicates(files: Iterable[Path]) -> Iterator[Problem]:
    seen: set[str] = set()
    for path in files:
        if path.name in seen:
            yield Problem(path.name, 0, "", "the folder has two files of this name", "only one of them")
        seen.add(path.name)


class _Reader:
    """Reads one file and continues after a problem, so that all problems are reported at once."""

    def __init__(self, path: Path, shown: str, package: str, known: KnownTypes) -> None:
        self.problems: list[Problem] = []
        self._path, self._shown, self._package, self._known = path, shown, package, known
        self._kind = path.suffix[1:]
        self._sections: list[Part] = [Part()]
        self._uses: set[str] = set()
        if not is_valid_message_name(path.stem) or "_" in path.stem:
            wanted = (
                f"a name such as {_camel_case(path.stem)}.{self._kind}: a capital first, letters and digits"
            )
            self._complain(0, "", f"{path.stem!r} cannot be the name of a type", wanted)
        lines = self._lines()
        for number, line in enumerate(lines[:MOST_LINES], start=1):
            self._read(number, line)
        if len(lines) <= MOST_LINES:
            self._check_sections()

    def definition(self) -> Definition:
        """Return the interface; call this only if there are no problems."""
        parts = dict(zip(PARTS[self._kind], self._sections, strict=True))
        return Definition(self._path, self._kind, self._path.stem, parts, frozenset(self._uses))

    def _lines(self) -> list[str]:
        """Return the lines of the file; none if it is too large to be checked line by line."""
        size = self._path.stat().st_size
        if size > LARGEST_FILE:
            self._complain(0, "", f"it has {size:,} bytes", f"at most {LARGEST_FILE:,}")
            return []
        try:
            lines = self._path.read_text(encoding="utf-8").splitlines()
        except UnicodeDecodeError as error:
            self._complain(0, "", f"it is not UTF-8 text: {error.reason} at byte {error.start}", "plain text")
            return []
        if len(lines) > MOST_LINES:
            self._complain(0, "", f"it has {len(lines):,} lines", f"at most {MOST_LINES:,}")
        return lines

    def _read(self, number: int, line: str) -> None:
        text = line.partition("#")[0].replace("\t", " ").rstrip()
        if line == SEPARATOR:
            self._sections.append(Part())
        elif len(text) > LONGEST_LINE:
            self._complain(number, text, f"the line has {len(text):,} characters", f"at most {LONGEST_LINE}")
        elif text and not text.strip("- "):
            wanted = f"a line that is exactly {SEPARATOR}, with nothing before and after it"
            self._complain(number, line, "this is not a separator", wanted)
        elif text:
            self._read_element(number, text)

    def _read_element(self, number: int, text: str) -> None:
        """Read a field or a constant with rosidl's own parser, and explain its errors in plain words."""
        try:
            with redirect_stderr(io.StringIO()):
                message = parse_message_string(self._package, "Line", text)
        except (
            Exception
        ) as error:  # besides its own errors the parser raises IndexError, TypeError and NameError
            self._complain(number, text, *explain_line(text, str(error), self._known))
            return
        for element in (*message.fields, *message.constants):
            if element.name in {**self._sections[-1].fields, **self._sections[-1].constants}:
                self._complain(number, text, f"this part already has a {element.name}", "another name")
            elif finding := self._build_fault(element):
                self._complain(number, text, *finding)
            else:
                self._keep(element)

    def _build_fault(self, element: Field | Constant) -> Finding | None:
        """Return a fault that rosidl's parser accepts but that makes the build fail; None without one."""
        if isinstance(element, Constant):
            return None
        if name_is_reserved(element.name):
            return Finding(
                f"{element.name} is a keyword of C, C++ or Python, for which code is generated",
                f"another name, such as {element.name}_value",
            )
        return explain_type(element.type, self._package, self._known)

    def _keep(self, element: Field | Constant) -> None:
        part = self._sections[-1]
        if isinstance(element, Constant):
            part.constants[element.name] = (element.type, element.value)
            return
        part.fields[element.name] = str(element.type)
        if not element.type.is_primitive_type():
            self._uses.add(element.type.pkg_name)

    def _check_sections(self) -> None:
        elements = sum(len(part.fields) + len(part.constants) for part in self._sections)
        if elements > MOST_ELEMENTS:
            self._complain(0, "", f"it has {elements:,} fields and constants", f"at most {MOST_ELEMENTS}")
        wanted = PARTS[self._kind]
        if len(self._sections) != len(wanted):
            shape = f" {SEPARATOR} ".join(wanted)
            self._complain(
                0,
                "",
                f"it has {len(self._sections) - 1} lines that are exactly {SEPARATOR}",
                f"{len(wanted) - 1}: a .{self._kind} is {shape}, and each may be empty",
            )

    def _complain(self, line: int, text: str, wrong: str, expected: str) -> None:
        self.problems.append(Problem(self._shown, line, text, wrong, expected))


def _camel_case(name: str) -> str:
    words = "".join(character if character.isalnum() else " " for character in name).split()
    return "".join(word[0].upper() + word[1:] for word in words).lstrip("0123456789") or "FindReach"
