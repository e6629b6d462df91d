"""Lists the files of a download, a zip file or a folder, without unpacking it.

The content comes from students and is not trusted. Names in a zip file are never used as paths. Links, devices and
paths that leave the download are refused. No file is read beyond the size limit of a submission, even if the zip file
declares a smaller size.
"""

from __future__ import annotations

import os
import re
import stat
import zipfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path, PurePosixPath
from typing import BinaryIO

from autograder.engine.hand_in import TOOL_FOLDERS
from autograder.engine.submission import CLEAR_OUTPUTS, MAX_NOTEBOOK_BYTES, UnusableSubmission
from ros_runtime.course_error import CourseError

MAX_FILES = 200_000
MAX_TOTAL_BYTES = 4 * 2**30  # bytes read from one download, in total
_HIDDEN = re.compile(r"\.[^.].*")  # files of git, Jupyter, editors, virtual environments and macOS


class Refused(UnusableSubmission):
    """One file of the download is not read; the message says why."""


@dataclass(frozen=True)
class File:
    """One file of a download: its path in it, a function that opens it, and its modification time (s)."""

    path: PurePosixPath
    open: Callable[[], BinaryIO]
    budget: Budget
    changed: float = 0.0

    def read(self, limit: int) -> bytes:
        """Return the file's content.

        Raises:
            Refused: the file has more than `limit` bytes or cannot be read.
        """
        try:
            with self.open() as file:
                content = file.read(limit + 1)
        except Exception as error:  # each compression method raises its own errors
            raise Refused(f"{self.path} cannot be read: {error}") from error
        if len(content) > limit:
            advice = f": {CLEAR_OUTPUTS}" if limit == MAX_NOTEBOOK_BYTES else ""
            raise Refused(f"{self.path} has more than {limit:,} bytes, the limit of a submission{advice}")
        self.budget.spend(len(content))
        return content


@dataclass
class Budget:
    """The number of bytes that may still be read from a download."""

    left: int = MAX_TOTAL_BYTES

    def spend(self, count: int) -> None:
        """Subtract `count` bytes; raises `CourseError` when the budget is exceeded."""
        self.left -= count
        if self.left < 0:
            raise CourseError(
                f"the download holds more than {MAX_TOTAL_BYTES // 2**30} GiB; collect it in parts"
            )


@dataclass(frozen=True)
class Download:
    """The regular files of a download, sorted by path, and a message for every other entry."""

    files: list[File]
    refused: list[str]


@contextmanager
def open_download(path: Path) -> Iterator[Download]:
    """Open a zip file or a folder.

    Raises:
        CourseError: `path` is neither a zip file nor a folder, or it has too many files.
    """
    budget = Budget()
    if path.is_dir():
        yield _sorted(_from_folder(path, budget))
        return
    try:
        archive = zipfile.ZipFile(path)
    except (OSError, zipfile.BadZipFile, ValueError) as error:
        raise CourseError(f"{path} is neither a folder nor a zip file: {error}") from error
    with archive:
        yield _sorted(_from_zip(archive, budget))


def _sorted(found: Iterator[File | str]) -> Download:
    files: list[File] = []
    refused: list[str] = []
    for one in found:
        if isinstance(one, str):
            refused.append(one)
        else:
            files.append(one)
        if len(files) + len(refused) > MAX_FILES:
            raise CourseError(f"the download holds more than {MAX_FILES:,} files; collect it in parts")
    return Download(sorted(files, key=lambda file: file.path), refused)


def _from_zip(archive: zipfile.ZipFile, budget: Budget) -> Iterator[File | str]:
    seen: set[PurePosixPath] = set()
    for entry in archive.infolist():
        path = _place(entry.filename)
        kind = stat.S_IFMT(entry.external_attr >> 16)
        if entry.filename.endswith(("/", "\\")) or _is_junk(path):
            continue
        if _leaves_download(path):
            yield f"{entry.filename!r} is a path outside the download"
        elif kind not in (0, stat.S_IFREG):
            yield f"{entry.filename!r} is a link or a device"
        elif entry.flag_bits & 1:
            yield f"{entry.filename!r} is encrypted"
        elif path in seen:
            yield f"{entry.filename!r} occurs twice"
        else:
            seen.add(path)
            yield File(path, _opener(archive, entry), budget, _time_of(entry))


def _place(name: str) -> PurePosixPath:
    """Return the path of a zip entry; some Windows programs write backslashes, which the format does not allow."""
    return PurePosixPath(name.replace("\\", "/"))


def _leaves_download(path: PurePosixPath) -> bool:
    return path.is_absolute() or ".." in path.parts or ":" in path.parts[0][1:2]


def _time_of(entry: zipfile.ZipInfo) -> float:
    try:
        return datetime(*entry.date_time).timestamp()
    except (ValueError, OverflowError):
        return 0.0


def _opener(archive: zipfile.ZipFile, entry: zipfile.ZipInfo) -> Callable[[], BinaryIO]:
    return lambda: archive.open(entry)  # type: ignore[return-value]


def _from_folder(folder: Path, budget: Budget) -> Iterator[File | str]:
    for place, folders, names in os.walk(folder):
        inside = PurePosixPath(Path(place).relative_to(folder).as_posix())
        links = [name for name in folders if os.path.islink(os.path.join(place, name))]
        folders[:] = sorted(
            name for name in folders if not _is_junk(PurePosixPath(name)) and name not in links
        )
        for name in sorted([*links, *names]):
            path = _place(str(inside / name))
            if _is_junk(path):
                continue
            found = os.lstat(os.path.join(place, name))
            if _leaves_download(path):
                yield f"{name!r} is a path outside the download"
            elif stat.S_ISREG(found.st_mode):
                yield File(path, _plain_opener(Path(place) / name), budget, found.st_mtime)
            else:
                yield f"{str(path)!r} is a link or a device"


def _plain_opener(path: Path) -> Callable[[], BinaryIO]:
    def opened() -> BinaryIO:
        return os.fdopen(os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK), "rb")

    return opened


def _is_junk(path: PurePosixPath) -> bool:
    return not path.parts or any(part in TOOL_FOLDERS or _HIDDEN.fullmatch(part) for part in path.parts)
