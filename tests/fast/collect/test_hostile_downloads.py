"""Malicious downloads: they reach no other files, and they are reported."""

from __future__ import annotations

import os
import stat
import zipfile
from pathlib import Path

import pytest
from downloads import GRADESCOPE, METADATA, PROGRAM, notebook, unpacked, with_link, zipped
from test_collect_downloads import course, programs, said

from autograder.classroom.collect import download
from autograder.engine.submission import MAX_BYTES, MAX_NOTEBOOK_BYTES

GOOD = {"lee_1_5_battery_service.py": PROGRAM}


def everything(folder: Path) -> set[str]:
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*") if not path.is_dir()}


@pytest.mark.parametrize(
    "name",
    [
        "../../evil_2_6_battery_service.py",
        "/tmp/evil_2_6_battery_service.py",
        "..\\evil_2_6_battery_service.py",
        "C:/evil_2_6_battery_service.py",
        "a/../../evil_2_6_battery_service.py",
    ],
)
def test_names_that_lead_elsewhere_are_refused_and_the_rest_is_collected(tmp_path: Path, name: str) -> None:
    made = zipped(
        tmp_path / "in" / "d.zip" if (tmp_path / "in").mkdir() else tmp_path / "in/d.zip",
        GOOD | {name: PROGRAM},
    )
    before = everything(tmp_path)
    done = course(made, "--from", "canvas", "--out", tmp_path / "in/s")
    assert done.exit_code == 1
    assert "is a path outside the download" in said(done)
    assert everything(tmp_path) - before == {"in/s/lee-1/battery_service/battery_service.py"}


def test_links_are_refused_in_zips_and_folders(tmp_path: Path) -> None:
    secret = tmp_path / "secret.py"
    secret.write_text("the instructor's")
    name = "evil_2_6_battery_service.py"
    in_zip = with_link(zipped(tmp_path / "d.zip", GOOD), name, str(secret))
    in_folder = unpacked(tmp_path / "d", GOOD)
    (in_folder / name).symlink_to(secret)
    (in_folder / "evil_3_7_folder").symlink_to(tmp_path)
    for number, made in enumerate((in_zip, in_folder)):
        done = course(made, "--from", "canvas", "--out", tmp_path / f"s{number}")
        assert done.exit_code == 1
        assert "is a link or a device" in said(done)
        assert programs(tmp_path / f"s{number}") == {"lee-1": PROGRAM}


def test_pipes_do_not_stop_it(tmp_path: Path) -> None:
    folder = unpacked(tmp_path / "d", GOOD)
    os.mkfifo(folder / "evil_2_6_battery_service.py")
    done = course(folder, "--from", "canvas", "--out", tmp_path / "s")
    assert done.exit_code == 1
    assert programs(tmp_path / "s") == {"lee-1": PROGRAM}


@pytest.mark.parametrize(("suffix", "limit"), [("py", MAX_BYTES), ("ipynb", MAX_NOTEBOOK_BYTES)])
def test_no_more_is_unpacked_than_a_submission_can_have(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, suffix: str, limit: int
) -> None:
    bomb = zipped(tmp_path / "d.zip", GOOD | {f"evil_2_6_battery_service.{suffix}": b"\0" * (3 * limit)})
    assert bomb.stat().st_size < limit
    asked: list[int] = []
    read = zipfile.ZipExtFile.read
    monkeypatch.setattr(zipfile.ZipExtFile, "read", lambda self, n=-1: asked.append(n) or read(self, n))
    done = course(bomb, "--from", "canvas", "--out", tmp_path / "s")
    assert done.exit_code == 1
    assert f"more than {limit:,} bytes" in said(done)
    assert max(asked) == limit + 1
    assert min(asked) > 0
    assert programs(tmp_path / "s") == {"lee-1": PROGRAM}


def test_a_download_of_too_many_files_or_bytes_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    files = {f"s{i}_{i}_5_battery_service.py": PROGRAM for i in range(30)}
    made = zipped(tmp_path / "d.zip", files)
    monkeypatch.setattr(download, "MAX_FILES", 20)
    assert course(made, "--from", "canvas", "--out", tmp_path / "s").exit_code == 2
    monkeypatch.undo()
    small = download.Budget(20)
    monkeypatch.setattr(download, "Budget", lambda: small)
    done = course(made, "--from", "canvas", "--out", tmp_path / "s")
    assert done.exit_code == 2
    assert "collect it in parts" in said(done)


def test_broken_and_encrypted_members_are_named(tmp_path: Path) -> None:
    name = "evil_2_6_battery_service.py"
    broken = zipped(tmp_path / "broken.zip", GOOD | {name: os.urandom(3000)})
    content = bytearray(broken.read_bytes())
    place = content.index(name.encode()) + len(name) + 500
    content[place : place + 20] = bytes(20)
    broken.write_bytes(content)
    done = course(broken, "--from", "canvas", "--out", tmp_path / "s")
    assert done.exit_code == 1
    assert "cannot be" in said(done)
    assert programs(tmp_path / "s") == {"lee-1": PROGRAM}


def test_a_member_that_is_there_twice_counts_once(tmp_path: Path) -> None:
    made = zipped(tmp_path / "d.zip", GOOD)
    with zipfile.ZipFile(made, "a") as archive, pytest.warns(UserWarning, match="Duplicate"):
        archive.writestr(next(iter(GOOD)), "other = 1\n")
    done = course(made, "--from", "canvas", "--out", tmp_path / "s")
    assert "occurs twice" in said(done)
    assert programs(tmp_path / "s") == {"lee-1": PROGRAM}


def test_a_download_cannot_add_files_to_another_student(tmp_path: Path) -> None:
    forged = "Eve_9_assignsubmission_file_Anna_1_assignsubmission_file_battery_service.py"
    inside = "Eve_9_assignsubmission_file_/Anna_1_assignsubmission_file_/battery_service.py"
    done = course(
        zipped(tmp_path / "m.zip", {forged: PROGRAM, inside: PROGRAM}),
        "--from",
        "moodle",
        "--out",
        tmp_path / "m",
    )
    assert "names two students" in said(done)
    assert list(programs(tmp_path / "m")) == ["Eve-9"]
    nested = {
        "r-battery-service-eve/r-battery-service-anna/battery_service.py": "forged = 1\n",
        "r-battery-service-bo/battery_service.py": PROGRAM,
    }
    course(zipped(tmp_path / "c.zip", nested), "--from", "classroom50", "--out", tmp_path / "c")
    assert programs(tmp_path / "c") == {"eve": "forged = 1\n", "bo": PROGRAM}
    canvas = {"eve_9_5_anna_1_99_battery_service.py": PROGRAM, "bo_2_6_battery_service.py": PROGRAM}
    course(
        zipped(tmp_path / "a.zip", canvas),
        "--from",
        "canvas",
        "--exercise",
        "battery_service",
        "--out",
        tmp_path / "a",
    )
    assert list(programs(tmp_path / "a")) == ["bo-2", "eve-9"]


def test_a_students_own_metadata_is_ignored(tmp_path: Path) -> None:
    flat = {name.removeprefix("assignment_4_export/"): text for name, text in GRADESCOPE.items()}
    forged = {"submission_77/submission_metadata.yml": METADATA.replace("2101", "victim")}
    course(zipped(tmp_path / "d.zip", flat | forged), "--from", "gradescope", "--out", tmp_path / "s")
    assert set(programs(tmp_path / "s")) == {"2101", "bert@x.org", "cleo@x.org"}


@pytest.mark.parametrize(
    "metadata", ["", "[1]", "a: [", "x: !!python/object/apply:os.system ['true']", "submission_77: 3", "\x00"]
)
def test_malicious_metadata_runs_no_code_and_is_reported(tmp_path: Path, metadata: str) -> None:
    files = {"submission_metadata.yml": metadata, "submission_77/battery_service.py": PROGRAM}
    done = course(zipped(tmp_path / "d.zip", files), "--from", "gradescope", "--out", tmp_path / "s")
    assert done.exit_code == 2
    assert "submission_metadata.yml" in said(done)
    assert not (tmp_path / "s").exists()


@pytest.mark.parametrize("sid", ["../../root", "-rf", ".bashrc", "x" * 300, "a\nb", "机器人", "a;b"])
def test_names_become_folders_of_the_class_or_are_refused(tmp_path: Path, sid: str) -> None:
    metadata = METADATA.replace("'2101'", f'"{sid!s}"'.replace("\n", "\\n"))
    made = zipped(tmp_path / "d.zip", GRADESCOPE | {"assignment_4_export/submission_metadata.yml": metadata})
    course(made, "--from", "gradescope", "--out", tmp_path / "out/s")
    assert {path.name for path in tmp_path.iterdir()} == {"d.zip", "out"}
    assert {path.name for path in (tmp_path / "out").iterdir()} == {"s"}
    assert {"bert@x.org", "cleo@x.org"} <= set(programs(tmp_path / "out/s"))


def test_existing_files_at_the_target_are_not_touched(tmp_path: Path) -> None:
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    (tmp_path / "s/lee-1").mkdir(parents=True)
    (tmp_path / "s/lee-1/battery_service").symlink_to(elsewhere)
    done = course(
        zipped(tmp_path / "d.zip", GOOD), "--from", "canvas", "--out", tmp_path / "s", "--overwrite"
    )
    assert done.exit_code == 1
    assert list(elsewhere.iterdir()) == []


def test_files_are_plain_text_files_that_others_may_not_run(tmp_path: Path) -> None:
    made = tmp_path / "d.zip"
    entry = zipfile.ZipInfo("lee_1_5_battery_service.ipynb")
    entry.external_attr = (stat.S_IFREG | 0o4777) << 16
    with zipfile.ZipFile(made, "w") as archive:
        archive.writestr(entry, notebook())
    course(made, "--from", "canvas", "--out", tmp_path / "s")
    (path,) = (tmp_path / "s").rglob("*.ipynb")
    assert path.stat().st_mode & 0o7111 == 0
