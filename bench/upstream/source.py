"""Where rclpy's tests come from: no package on PyPI or in Debian holds them, so they are not part of this project.

They are downloaded from rclpy's repository, once, at a pinned commit and with known hashes, or taken from a checkout.
"""

from __future__ import annotations

import hashlib
import urllib.error
import urllib.request
from collections.abc import Callable
from pathlib import Path

from ros_runtime.project import PROJECT

COMMIT = "85415f713bf7f03152799496dc4287a75df1fc36"  # 7.1.3, of the branch jazzy
ADDRESS = f"https://raw.githubusercontent.com/ros2/rclpy/{COMMIT}/rclpy/test"
HASHES = Path(__file__).with_name("tests.sha256")
PACKAGE = "rclpy_tests"  # one of them imports its neighbour relatively
KEPT = PROJECT / "build" / "upstream" / COMMIT
_LIMIT_BYTES = 1_000_000
_PATIENCE = 20.0  # s for one file


class NoTests(Exception):
    """rclpy's tests cannot be had here."""


def expected_files() -> dict[str, str]:
    """The files by name, with the SHA-256 that each has at `COMMIT`."""
    lines = HASHES.read_text(encoding="ascii").splitlines()
    return {name: digest for digest, name in (line.split() for line in lines)}


def downloaded_tests(note: Callable[[str], None]) -> Path:
    """The folder with the tests of `COMMIT`; what is not there yet is downloaded.

    Raises:
        NoTests: a file cannot be had, or is another one.
    """
    folder = KEPT / PACKAGE
    folder.mkdir(parents=True, exist_ok=True)
    _make_package(folder)
    for name, digest in expected_files().items():
        path = folder / name
        if not path.exists() or _digest(path.read_bytes()) != digest:
            note(f"downloading {name} of rclpy 7.1.3")
            path.write_bytes(_download(name, digest))
    return folder


def copied_tests(checkout: Path, into: Path) -> tuple[Path, list[str]]:
    """Copy the tests of a checkout of rclpy; returns the folder, and which files are others than those of `COMMIT`.

    Args:
        checkout: the repository, its folder rclpy, or the folder test in that.
        into: an empty folder.

    Raises:
        NoTests: there are none.
    """
    places = [place for place in (checkout / "rclpy/test", checkout / "test", checkout) if place.is_dir()]
    found = next((place for place in places if any(place.glob("test_*.py"))), None)
    if found is None:
        raise NoTests(
            f"{checkout} holds no rclpy/test/test_*.py; expected a checkout of ros2/rclpy.\n"
            "Next: git clone --branch jazzy https://github.com/ros2/rclpy, and name that folder."
        )
    folder = into / PACKAGE
    folder.mkdir()
    _make_package(folder)
    changed = []
    for name, digest in expected_files().items():
        if not (found / name).is_file():
            continue
        content = (found / name).read_bytes()
        (folder / name).write_bytes(content)
        if _digest(content) != digest:
            changed.append(name)
    return folder, changed


def _make_package(folder: Path) -> None:
    """Upstream's own __init__.py imports C libraries of a build folder, which these tests do not need."""
    (folder / "__init__.py").touch()


def _download(name: str, digest: str) -> bytes:
    try:
        with urllib.request.urlopen(f"{ADDRESS}/{name}", timeout=_PATIENCE) as answer:
            content = answer.read(_LIMIT_BYTES)
    except (OSError, urllib.error.URLError) as error:
        raise NoTests(
            f"{ADDRESS}/{name} cannot be read: {error}.\n"
            "Next: on a machine with a network, git clone --branch jazzy https://github.com/ros2/rclpy,\n"
            "and here  ./course bench --upstream --upstream-tests THAT_FOLDER"
        ) from error
    if _digest(content) != digest:
        raise NoTests(
            f"{ADDRESS}/{name} is another file than expected (SHA-256 {_digest(content)}, expected {digest})"
        )
    return content


def _digest(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()
