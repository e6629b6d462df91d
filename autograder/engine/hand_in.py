"""Chooses which of a student's files is graded; `check`, `collect` and `grade` share this rule.

A file belongs to an exercise by its name: the name of the exercise's notebook or files, in any capitals, with the
additions that Jupyter, browsers, file managers and cloud drives make for copies. Of several files one is chosen by:

- readable work, then unreadable files, then the untouched starter;
- the later hand-in, if the platform gives the order;
- the smaller folder depth, so that a copy in old/ is not chosen;
- the later modification, if the times differ by more than TIME_TOLERANCE (a clone gives all files the same time);
- the notebook before the file that it writes, and the exact name before a copy's.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path, PurePath
from typing import Protocol

from autograder.engine.exercise import file_names
from autograder.engine.starter import given_in, released, same_texts
from autograder.engine.submission import (
    MAX_NOTEBOOK_BYTES,
    UnusableSubmission,
    most_bytes,
    read_bytes,
    sources_of,
)

TIME_TOLERANCE = 60.0  # s; modification times that differ by less count as the same
ANY_NAME = (
    2  # value of `Named.copy` if the exercise is known from the folder or an option, not from the file's name
)
PROGRAMS_DIFFER = "their programs differ"
MOST_FOLDERS = 6  # levels of folders that are searched below a student's folder
TOOL_FOLDERS = ("__MACOSX", "__pycache__", "node_modules", "site-packages")  # folders that tools create
_COPY = "copy|copie|copia|cópia|kopie|kopia|kopi|kopio|kopya|копия|másolat|副本|コピー|복사본"
_OF = "of|von|de|di|da|van|av|af|z"
_KINDS = re.compile(r"(?P<stem>.+?)(?P<kind>\.\w+?)(?:\.txt|\.json|(?P=kind))?", re.IGNORECASE)


@dataclass(frozen=True)
class Named:
    """The exercise and the file that a file name stands for.

    Attributes:
        exercise: name of the exercise.
        name: the file's name in the exercise.
        copy: 0: the exact name; -n: a numbered later version, such as "name (n)"; positive: any other copy.
    """

    exercise: str
    name: str
    copy: int = 0


class Names:
    """The names of the files of exercises, and those of their copies."""

    def __init__(self, files: Mapping[str, Sequence[str]]) -> None:
        self.files = files
        self._folders = {_in_words(exercise): exercise for exercise in files}
        self._known = {
            (_in_words(PurePath(name).stem), PurePath(name).suffix.lower()): (exercise, name)
            for exercise, names in files.items()
            for name in (f"{exercise}.ipynb", *names)
        }
        stems = "|".join(sorted({re.escape(stem) for stem, _ in self._known}, key=len, reverse=True))
        self._copies = re.compile(
            rf"(?P<before>(?:(?:{_COPY})_(?:(?:{_OF})_)?)*)(?P<stem>{stems})"
            rf"(?P<after>(?:_(?:another_)?的?(?:{_COPY})?_?\d{{0,3}})*)"
        )

    def of(self, name: str) -> Named | None:
        """Return the exercise and file that a file name stands for; None if it belongs to no exercise."""
        kinds = _KINDS.fullmatch(name)
        words = self._copies.fullmatch(_in_words(kinds["stem"])) if kinds else None
        if not kinds or not words or not (known := self._known.get((words["stem"], kinds["kind"].lower()))):
            return None
        exercise, own = known
        if name == own:
            return Named(exercise, own)
        is_copy = words["before"] or re.search(_COPY, words["after"])
        numbers = [] if is_copy else re.findall(r"\d+", words["after"])
        return Named(exercise, own, -int(numbers[-1]) if numbers else 1)

    def any_of(self, exercise: str, name: str) -> Named | None:
        """Return the exercise's notebook or program, by its suffix, for a file of any name; else None."""
        kind = PurePath(name).suffix.lower()
        own = [f"{exercise}.ipynb", *(self.files[exercise] if len(self.files[exercise]) == 1 else ())]
        return next((Named(exercise, one, ANY_NAME) for one in own if PurePath(one).suffix == kind), None)

    def exercise_of(self, folder: str) -> str | None:
        """Return the exercise whose name a folder has; None if there is none."""
        return self._folders.get(_in_words(folder))


def _in_words(stem: str) -> str:
    return re.sub(r"[\W_]+", "_", unicodedata.normalize("NFC", stem).casefold()).strip("_")


class Readable(Protocol):
    """A file of a hand-in."""

    def read(self, limit: int) -> bytes:
        """Return its content; raises `UnusableSubmission` if that is more than `limit` bytes, or cannot be read."""


@dataclass(frozen=True)
class OwnFile:
    """A file in a student's folder on this machine; symbolic links are refused."""

    path: Path

    def read(self, limit: int) -> bytes:
        """Return its content; raises `UnusableSubmission`, whose message has the file's name without its path."""
        name = self.path.name
        if self.path.is_symlink() and self.path.is_dir():
            raise UnusableSubmission(
                f"the folder {name} is a link; hand in the folder itself, with the files in it"
            )
        if self.path.is_symlink() or not self.path.is_file():
            raise UnusableSubmission(f"{name} is not an ordinary file")
        return read_bytes(self.path, limit, called=name)


@dataclass(frozen=True, eq=False)
class Candidate:
    """A notebook, or the program files of an exercise, that may be a student's work.

    Attributes:
        exercise: its name.
        path: its name in messages.
        files: readable files by their names in the exercise.
        turn: order of hand-ins; the highest turn is the latest.
        depth: number of folders around it, without the exercise's own folder.
        changed: modification time, s since the epoch.
        copy: as in `Named`.
    """

    exercise: str
    path: PurePath
    files: Mapping[str, Readable]
    turn: int = 0
    depth: int = 0
    changed: float = 0.0
    copy: int = 0

    @property
    def is_notebook(self) -> bool:
        """Whether it is the notebook."""
        return f"{self.exercise}.ipynb" in self.files

    @cached_property
    def sources(self) -> dict[str, str] | UnusableSubmission:
        """The texts of the exercise's files, or why they cannot be read."""
        sources: dict[str, str] = {}
        try:
            for name, file in self.files.items():
                called = PurePath(self.path.name) if len(self.files) == 1 else PurePath(name)
                sources |= sources_of(name, file.read(most_bytes(name)), self.exercise, called)
        except UnusableSubmission as error:
            return error
        return sources

    @cached_property
    def given(self) -> dict[str, str]:
        """The files that the notebook's untouched solution cells write; empty for other files."""
        if not self.is_notebook or isinstance(self.sources, UnusableSubmission):
            return {}
        (file,) = self.files.values()
        return given_in(file.read(MAX_NOTEBOOK_BYTES))


def work_in(folder: Path, exercise: str, *, depth: int = MOST_FOLDERS) -> tuple[Path, list[str]] | None:
    """Return the path of an exercise's work in a folder, and a sentence on each rejected file; None without work.

    Raises:
        OSError: the folder cannot be read.
    """
    found = candidates_in(folder, {exercise: file_names(exercise)}, depth=depth).get(exercise)
    if not found:
        return None
    chosen, others = choose_work(found)
    return folder / chosen.path, others


def merged(found: Iterable[Candidate]) -> list[Candidate]:
    """Return the candidates, where the files of a multi-file exercise are joined into one candidate per folder."""
    whole: list[Candidate] = []
    parts: dict[tuple[str, PurePath], list[Candidate]] = {}
    for one in found:
        if one.is_notebook or len(file_names(one.exercise)) == 1:
            whole.append(one)
        else:
            parts.setdefault((one.exercise, one.path.parent), []).append(one)
    for (exercise, folder), ones in parts.items():
        best = sorted(ones, key=lambda one: (one.turn, -one.copy))  # later ones replace earlier ones
        files = {name: file for one in best for name, file in one.files.items()}
        turn, changed = max(one.turn for one in ones), max(one.changed for one in ones)
        whole.append(Candidate(exercise, folder, files, turn, ones[0].depth, changed))
    return whole


def choose_work(candidates: Sequence[Candidate]) -> tuple[Candidate, list[str]]:
    """Return the candidate to grade, and a sentence on each other one with different content."""
    if len(candidates) == 1:
        return candidates[0], []
    exercise = candidates[0].exercise
    given = [released(exercise), *(one.given for one in candidates)]

    def standing(one: Candidate) -> int:
        if isinstance(one.sources, UnusableSubmission):
            return 1
        return 2 if any(same_texts(one.sources, texts) for texts in given) else 0

    standings = {one: standing(one) for one in candidates}
    rest = _least(candidates, lambda one: one.copy == ANY_NAME and 2 - one.is_notebook)
    rest = _least(rest, standings.__getitem__)
    rest = _least(rest, lambda one: -one.turn)
    rest = _least(rest, lambda one: one.depth)
    newest = max(one.changed for one in rest)
    rest = [one for one in rest if one.changed > newest - TIME_TOLERANCE]
    chosen = min(rest, key=lambda one: (not one.is_notebook, one.copy, str(one.path)))

    def why(one: Candidate) -> str:
        if one.copy == ANY_NAME != chosen.copy:
            return f"does not have the file name of {exercise}, and {chosen.path} has"
        if standings[one] != standings[chosen]:
            return "is the unchanged starter" if standings[one] == 2 else f"cannot be read: {one.sources}"
        if one.turn != chosen.turn:
            return f"was handed in again as {chosen.path}"
        if one.depth != chosen.depth:
            return f"lies deeper than {chosen.path}"
        if one.changed <= newest - TIME_TOLERANCE:
            return f"is older than {chosen.path}"
        first = "a notebook" if chosen.is_notebook > one.is_notebook else "that name"
        return f"was saved within a minute of {chosen.path}, and {first} counts first"

    def in_words(one: Candidate) -> str:
        both_count = standings[one] == standings[chosen] == 0
        return f"{one.path} {why(one)}" + (f"; {PROGRAMS_DIFFER}" if both_count else "")

    others = sorted(
        (one for one in candidates if one is not chosen and not same_texts(one.sources, chosen.sources)),
        key=lambda one: str(one.path),
    )
    return chosen, [in_words(one) for one in others]


def _least(candidates: Sequence[Candidate], key: Callable[[Candidate], int]) -> list[Candidate]:
    least = min(map(key, candidates))
    return [one for one in candidates if key(one) == least]


def candidates_in(
    folder: Path, files: Mapping[str, Sequence[str]], *, depth: int = MOST_FOLDERS
) -> dict[str, list[Candidate]]:
    """Find the candidates in a student's folder, by exercise; symbolic links are not followed.

    A folder with the name of an exercise can hold work for that exercise only, under any file name.

    Raises:
        OSError: the folder cannot be read.
    """
    names = Names(files)
    found: list[Candidate] = []
    for path in _visible_files(folder, depth, names):
        within = path.relative_to(folder)
        homes = [home for part in within.parts[:-1] if (home := names.exercise_of(part))]
        own = names.of(path.name)
        if not own and path.is_symlink() and (linked := names.exercise_of(path.name)):
            own = Named(linked, f"{linked}.ipynb")
        if not own and homes and names.exercise_of(path.parent.name) == homes[-1]:
            own = names.any_of(homes[-1], path.name)
        if own and (not homes or homes[-1] == own.exercise):
            place = {own.name: OwnFile(path)}
            deep, changed = len(within.parts) - 1 - bool(homes), path.lstat().st_mtime
            found.append(Candidate(own.exercise, within, place, depth=deep, changed=changed, copy=own.copy))
    by_exercise: dict[str, list[Candidate]] = {}
    named = {one.exercise for one in found if one.copy != ANY_NAME}
    for one in merged(one for one in found if one.copy != ANY_NAME or one.exercise not in named):
        by_exercise.setdefault(one.exercise, []).append(one)
    return by_exercise


def _visible_files(folder: Path, depth: int, names: Names) -> Iterator[Path]:
    """Yield all entries that are not folders, and folders with a file's name, down to `depth` levels."""
    deeper: list[Path] = []
    for path in sorted(folder.iterdir()):
        if path.name.startswith(".") or path.name in TOOL_FOLDERS:
            continue
        if path.is_symlink() or not path.is_dir() or names.of(path.name):
            yield path
        elif depth:
            deeper.append(path)
    for path in deeper:
        yield from _visible_files(path, depth - 1, names)
