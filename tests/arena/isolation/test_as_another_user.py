"""How root becomes another user that can still read root's files, also with missing kernel features."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from arenas import PACKAGE

pytestmark = pytest.mark.skipif(os.geteuid() != 0, reason="only root steps down")

_WITHOUT_MAPPED_OWNERS = """
import sys
sys.path.insert(0, sys.argv[1])
import as_another_user
def refuse(*arguments):
    raise OSError("no ID-mapped mounts")
as_another_user._mount_with_owner_mapped = refuse
del sys.argv[1]
as_another_user.main()
"""
_STEP_DOWN = [sys.executable, "-I", "-S", str(PACKAGE / "as_another_user.py")]
_STEP_DOWN_WITHOUT_MAPPED_OWNERS = [sys.executable, "-I", "-S", "-c", _WITHOUT_MAPPED_OWNERS, str(PACKAGE)]


def step_down(
    how: list[str], paths: list[Path], staging: Path, *program: str
) -> subprocess.CompletedProcess[str]:
    plan = {"parent": os.getpid(), "staging": str(staging), "paths": [str(path) for path in paths]}
    command = [*how, json.dumps(plan), *program]
    return subprocess.run(command, capture_output=True, text=True, check=False, timeout=30)


@pytest.fixture
def private(tmp_path: Path) -> Path:
    """A folder that only root can read, with a file and a link in it."""
    folder = tmp_path / "private"
    folder.mkdir()
    (folder / "note").write_text("read me")
    (folder / "link").symlink_to("note")
    (folder / "note").chmod(0o600)
    folder.chmod(0o700)
    return folder


@pytest.fixture
def staging(private: Path) -> Iterator[Path]:
    """A folder to mount on; after the test, neither it nor its source shows any change."""
    folder = Path(tempfile.mkdtemp(dir="/tmp"))
    yield folder
    for left in folder.iterdir():
        assert left.is_symlink()
        left.unlink()
    folder.rmdir()
    assert (private / "note").stat().st_mode & 0o777 == 0o600


def test_it_becomes_a_user_of_its_own_with_no_rights(staging: Path) -> None:
    users = {step_down(_STEP_DOWN, [], staging, "/usr/bin/id", "-u").stdout for _ in range(2)}
    assert len(users) == 2
    assert "0\n" not in users
    status = step_down(_STEP_DOWN, [], staging, "/bin/cat", "/proc/self/status").stdout
    fields = dict(line.split(":\t", 1) for line in status.splitlines())
    assert int(fields["CapEff"], 16) == 0
    assert fields["NoNewPrivs"] == "1"
    assert fields["Groups"].split() == []


@pytest.mark.parametrize("how", [_STEP_DOWN, _STEP_DOWN_WITHOUT_MAPPED_OWNERS], ids=["mapped", "copied"])
def test_it_reads_a_folder_that_was_roots_alone(how: list[str], private: Path, staging: Path) -> None:
    done = step_down(how, [private], staging, "/bin/cat", f"{staging}/0/note", f"{staging}/0/link")
    assert done.stdout == "read meread me", done.stderr


def test_what_it_can_neither_map_nor_copy_is_named_with_a_remedy(private: Path, staging: Path) -> None:
    done = step_down(_STEP_DOWN_WITHOUT_MAPPED_OWNERS, [private / "note"], staging, "/bin/true")
    assert done.returncode == 1
    assert f"an arena cannot read {private}/note" in done.stderr
    assert "chmod -R o+rX" in done.stderr


def test_roots_of_containers_that_may_not_mount_still_show_what_all_can_read(staging: Path) -> None:
    weak = ["/usr/bin/setpriv", "--bounding-set=-sys_admin", *_STEP_DOWN]
    done = step_down(weak, [Path("/etc/passwd")], staging, "/bin/cat", f"{staging}/0")
    assert done.stdout == Path("/etc/passwd").read_text(), done.stderr
