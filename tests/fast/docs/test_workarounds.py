"""The README says of every workaround why it is needed, its state upstream, and how to remove it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from ros_runtime import workarounds
from ros_runtime.project import PROJECT

ROOM = Path(workarounds.__file__).parent
TESTS = PROJECT / "tests"
PAGE = (ROOM / "README.md").read_text(encoding="utf-8")
PIECES = sorted(
    f"{path.name}/" if path.is_dir() else path.name
    for path in ROOM.iterdir()
    if (path / "__init__.py").exists() or (path.suffix == ".py" and path.name != "__init__.py")
)


def sections() -> dict[str, str]:
    """The page's sections by their headings."""
    _, *parts = re.split(r"^## (.+)$", PAGE, flags=re.MULTILINE)
    return dict(zip(parts[::2], parts[1::2], strict=True))


def test_every_piece_has_a_section() -> None:
    assert PIECES
    assert sections().keys() - {"Workarounds in other folders"} == set(PIECES)


@pytest.mark.parametrize("piece", PIECES)
def test_its_section_has_every_part(piece: str) -> None:
    section = sections()[piece]
    for heading in ("Why.", "Upstream.", "What depends on it.", "How to remove it."):
        assert re.search(rf"^\*\*{re.escape(heading)}\*\*\s+\S", section, re.MULTILINE), heading
    upstream = section.split("**Upstream.**")[1].split("**What depends on it.**")[0]
    assert "https://" in upstream or "no upstream issue was found" in " ".join(upstream.lower().split())


@pytest.mark.parametrize("piece", PIECES)
def test_the_tests_that_its_section_names_exist(piece: str) -> None:
    removal = sections()[piece].split("**How to remove it.**")[1]
    files = [found for name in re.findall(r"`(test_\w+\.py)`", removal) for found in TESTS.rglob(name)]
    assert files
    texts = [file.read_text(encoding="utf-8") for file in files]
    for test in re.findall(r"`(test_\w+)`", removal):
        assert any(f"def {test}(" in text for text in texts), test


def test_the_files_that_it_names_exist() -> None:
    roots = ("autograder", "lab", "ros_runtime", "robot_sim", "setup", "tests")
    named = re.findall(rf"`((?:{'|'.join(roots)})/[\w/.]*)`", PAGE)
    assert named
    assert [name for name in named if not (PROJECT / name).exists()] == []
