"""`course collect` converts each platform's download."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from downloads import (
    ALL,
    CANVAS,
    CLASSROOM50,
    GRADESCOPE,
    METADATA,
    MOODLE,
    PROGRAM,
    notebook,
    unpacked,
    zipped,
)
from typer.testing import CliRunner, Result

from autograder.classroom.batch.collection import collect
from course_cli.app import app
from ros_runtime.project import PROJECT

WANTED = {
    "canvas": {"leeanna-101": "second = 2\n", "oneilbert-102": PROGRAM},
    "moodle": {"Anna Lee-9001": PROGRAM, "Zoë O'Neil-9002": PROGRAM},
    "gradescope": {"2101": PROGRAM, "bert@x.org": "named = 1\n", "cleo@x.org": "named = 1\n"},
    "classroom50": {"anna-lee": PROGRAM, "bert": PROGRAM},
}


def course(*arguments: object) -> Result:
    return CliRunner().invoke(app("collect"), ["collect", *map(str, arguments)])


def said(done: Result) -> str:
    return re.sub(r"\s+", " ", done.output)


def programs(submitted: Path) -> dict[str, str]:
    """Return the program of each student that `course grade` reads in the folder, all for battery_service."""
    works = collect(submitted).works
    assert {work.exercise for work in works} == {"battery_service"}
    return {work.student: work.read().sources["battery_service.py"] for work in works}


# What platforms write that an ordinary download does not show: who is to be collected from it.
ODD = {
    "moodle 4.1 and later": (
        "moodle",
        ["Anna Lee_9001_assignsubmission_file/{}", "Bo_9002_assignsubmission_file/w/{}"],
        ["Anna Lee-9001", "Bo-9002"],
    ),
    "moodle, anonymous, in German and in Chinese": (
        "moodle",
        ["Teilnehmerin_9001_assignsubmission_file/{}", "参与者_9002_assignsubmission_file_{}"],
        ["Teilnehmerin-9001", "参与者-9002"],
    ),
    "moodle, groups, and those who are in none": (
        "moodle",
        ["Team 3_77_assignsubmission_file/{}", "Default group_assignsubmission_file/{}"],
        ["Default group", "Team 3-77"],
    ),
    "canvas, anonymous": (
        "canvas",
        ["anon_aB3cD_7701_{}", "LATE_anon_Zq9kE_7702_{}", "anon_12345_7703_{}"],
        ["anon_12345", "anon_Zq9kE", "anon_aB3cD"],
    ),
    "canvas, a name without a letter, another with _, and one of digits": (
        "canvas",
        ["_501_7701_{}", "le_e_LATE_502_7702_{}", "7_503_7703_{}"],
        ["501", "7-503", "le_e-502"],
    ),
    "classroom 50, with its own scores": (
        "classroom50",
        ["scores.csv", "r-battery-service-bo/results.json", "r-battery-service-bo/{}"],
        ["bo"],
    ),
}


@pytest.mark.parametrize("odd", ODD)
def test_every_form_of_a_platforms_download_is_known(tmp_path: Path, odd: str) -> None:
    platform, names, students = ODD[odd]
    files = dict.fromkeys([name.format("battery_service.py") for name in names], PROGRAM)
    download = zipped(tmp_path / "d.zip", files)
    done = course(download, "--from", platform, "--out", tmp_path / "s")
    assert done.exit_code == 0, done.output
    assert sorted(programs(tmp_path / "s")) == students
    _, _, late = said(done).partition("late, according to the platform: ")
    assert late.startswith(("anon_Zq9kE ", "le_e-502 ")) == (platform == "canvas")


@pytest.mark.parametrize("packed", [zipped, unpacked])
@pytest.mark.parametrize("platform", ALL)
def test_every_download_becomes_what_grade_reads(tmp_path: Path, platform: str, packed) -> None:
    download = packed(tmp_path / "download", ALL[platform])
    done = course(download, "--from", platform, "--out", tmp_path / "submitted")
    assert done.exit_code == 0, done.output
    assert programs(tmp_path / "submitted") == WANTED[platform]


@pytest.mark.parametrize("platform", ["canvas", "moodle", "classroom50"])
def test_a_folder_around_all_submissions_is_not_a_student(tmp_path: Path, platform: str) -> None:
    download = zipped(
        tmp_path / "d.zip", {f"submissions/{name}": text for name, text in ALL[platform].items()}
    )
    course(download, "--from", platform, "--out", tmp_path / "submitted")
    assert programs(tmp_path / "submitted") == WANTED[platform]


@pytest.mark.parametrize(
    ("platform", "lines"),
    [
        (
            "canvas",
            [
                "question.html is no notebook or program (.ipynb, .py)",
                "was handed in again as",
                "late, according to the platform: oneil",
                "no submission from: kimcleo-103; --exercise NAME accepts a file of any name",
            ],
        ),
        ("moodle", ["onlinetext.html does not have the name of a Moodle submission"]),
        (
            "gradescope",
            [
                "submission_79/battery_service.py belongs to no submission",
                "my.ipynb is not named like an exercise",
            ],
        ),
        (
            "classroom50",
            [
                "README.md is no notebook or program (.ipynb, .py)",
                "walk_to.py is for walk_to, not for battery_service",
            ],
        ),
    ],
)
def test_ignored_files_are_named(tmp_path: Path, platform: str, lines: list[str]) -> None:
    done = course(
        zipped(tmp_path / "d.zip", ALL[platform]), "--from", platform, "--out", tmp_path / "submitted"
    )
    for line in lines:
        assert line in said(done)


def test_the_time_of_a_submission_is_kept(tmp_path: Path) -> None:
    course(zipped(tmp_path / "d.zip", GRADESCOPE), "--from", "gradescope", "--out", tmp_path / "s")
    assert {work.student: work.timestamp for work in collect(tmp_path / "s").works} == {
        "2101": "2026-03-01 12:30:05 UTC",
        "bert@x.org": "2026-03-01 10:00:00 UTC",
        "cleo@x.org": "2026-03-01 10:00:00 UTC",
    }


def test_a_file_of_any_name_counts_where_the_exercise_is_given(tmp_path: Path) -> None:
    files = {
        "leeanna_1_5_final (2).ipynb": notebook(),
        "kim_2_6_walk_to.py": PROGRAM,
        "bo_3_7_notes.txt": "hm",
        "jo_4_8_hw.zip": b"PK",
    }
    done = course(
        zipped(tmp_path / "d.zip", files),
        "--from",
        "canvas",
        "--exercise",
        "battery_service",
        "--out",
        tmp_path / "s",
    )
    assert programs(tmp_path / "s") == {"leeanna-1": PROGRAM}
    assert "walk_to.py is for walk_to, not for battery_service" in said(done)
    assert "notes.txt is no notebook or program (.ipynb, .py)" in said(done)
    assert "hw.zip is an archive, and archives are not opened: unpack the download" in said(done)
    assert "no submission from: bo-3, jo-4, kim-2 leeanna-1 · battery_service fingerprint " in said(done)


def test_files_with_the_expected_name_are_preferred(tmp_path: Path) -> None:
    files = {"lee_1_5_battery_service.ipynb": notebook("right = 1\n"), "lee_1_9_scratch.ipynb": notebook()}
    download = zipped(tmp_path / "d.zip", files)
    course(download, "--from", "canvas", "--exercise", "battery_service", "--out", tmp_path / "s")
    assert programs(tmp_path / "s") == {"lee-1": "right = 1\n"}


def test_an_exercise_of_two_files_keeps_both(tmp_path: Path) -> None:
    names = ["NavigateToPose.action", "GetBatteryStatus.srv"]
    files = {f"lee_1_{i}_{name}": f"# {name}\n" for i, name in enumerate(names)}
    course(zipped(tmp_path / "d.zip", files), "--from", "canvas", "--out", tmp_path / "s")
    assert {path.name for path in (tmp_path / "s/lee-1/interfaces").iterdir()} == set(names)


def test_an_exercise_may_have_another_name_in_classroom50(tmp_path: Path) -> None:
    files = {"robotics-hw-1-anna/battery_service.py": PROGRAM, "robotics-hw-1-bo-b/main.py": PROGRAM}
    download = zipped(tmp_path / "d.zip", files)
    told = ("--exercise", "battery_service", "--assignment", "hw-1")
    assert course(download, "--from", "classroom50", "--out", tmp_path / "s").exit_code == 2
    course(download, "--from", "classroom50", *told, "--out", tmp_path / "s")
    assert programs(tmp_path / "s") == {"anna": PROGRAM, "bo-b": PROGRAM}


def test_nothing_is_overwritten_without_the_option(tmp_path: Path) -> None:
    first = zipped(tmp_path / "1.zip", {"lee_1_5_battery_service.ipynb": notebook("old = 1\n")})
    second = zipped(
        tmp_path / "2.zip", {"lee_1_9_battery_service.py": "new = 1\n", "kim_2_9_battery_service.py": PROGRAM}
    )
    out = tmp_path / "s"
    assert course(first, "--from", "canvas", "--out", out).exit_code == 0
    again = course(first, "--from", "canvas", "--out", out)
    assert again.exit_code == 0
    assert "1 unchanged" in said(again)
    refused = course(second, "--from", "canvas", "--out", out)
    assert refused.exit_code == 1
    assert "--overwrite replaces it" in said(refused)
    assert programs(out) == {"lee-1": "old = 1\n", "kim-2": PROGRAM}
    assert course(second, "--from", "canvas", "--out", out, "--overwrite").exit_code == 0
    assert programs(out)["lee-1"] == "new = 1\n"


@pytest.mark.parametrize("platform", ALL)
def test_the_download_of_another_platform_is_refused_with_what_is_expected(
    tmp_path: Path, platform: str
) -> None:
    other = {"canvas": CLASSROOM50, "moodle": CANVAS, "gradescope": MOODLE, "classroom50": CANVAS}[platform]
    done = course(zipped(tmp_path / "d.zip", other), "--from", platform, "--out", tmp_path / "s")
    assert done.exit_code == 2
    assert "expected" in said(done)
    assert not (tmp_path / "s").exists()


def test_unusable_arguments(tmp_path: Path) -> None:
    download = zipped(tmp_path / "d.zip", CANVAS)
    assert course(download, "--from", "blackboard").exit_code == 2
    assert course(download, "--from", "canvas", "--exercise", "nothing").exit_code == 2
    assert course(download, "--from", "classroom50", "--assignment", "hw1").exit_code == 2
    (tmp_path / "text.zip").write_text("no zip")
    assert course(tmp_path / "text.zip", "--from", "canvas").exit_code == 2
    assert course(tmp_path / "missing.zip", "--from", "canvas").exit_code == 2


def test_the_last_attachment_counts_whatever_was_put_around_its_name(tmp_path: Path) -> None:
    files = {
        "ohl_1_9001_battery_service.ipynb": notebook("first = 1\n"),
        "ohl_1_9002_battery_service (1)-1.ipynb": notebook("second = 1\n"),
        "kim_LATE_2_9003_battery_service-Copy1.ipynb": notebook("copy = 1\n"),
        "li_3_9004_Copy of battery_service.ipynb": notebook("colab = 1\n"),
        "pat_4_9005_battery_service.ipynb.txt": notebook("safari = 1\n"),
        "team_5_9006_Battery_Service.IPYNB": notebook("capitals = 1\n"),
        "zoe_6_9007_battery_service.py": "work = 1\n",
        "zoe_6_9008_battery_service-1.ipynb": (
            PROJECT / "exercises/battery_service/battery_service.ipynb"
        ).read_text(),
    }
    done = course(zipped(tmp_path / "d.zip", files), "--from", "canvas", "--out", tmp_path / "s")
    assert programs(tmp_path / "s") == {
        "ohl-1": "second = 1\n",
        "kim-2": "copy = 1\n",
        "li-3": "colab = 1\n",
        "pat-4": "safari = 1\n",
        "team-5": "capitals = 1\n",
        "zoe-6": "work = 1\n",
    }
    assert "9001_battery_service.ipynb was handed in again as ohl_1_9002" in said(done)
    assert "zoe_6_9008_battery_service-1.ipynb is the unchanged starter" in said(done)


TOPS = {
    "moodle": "Mira_4_assignsubmission_file_/",
    "gradescope": "submission_77/",
    "classroom50": "ros-battery_service-mira/",
}


@pytest.mark.parametrize("platform", TOPS)
def test_a_copy_in_a_folder_never_comes_before_the_work_at_the_top(tmp_path: Path, platform: str) -> None:
    places = [f"{folder}battery_service.py" for folder in ("", "old/", "venv/lib/", ".venv/", "a/.backup/")]
    files = {f"{TOPS[platform]}{place}": f"place = {place!r}\n" for place in places}
    files |= {"submission_metadata.yml": METADATA} if platform == "gradescope" else {}
    done = course(zipped(tmp_path / "d.zip", files), "--from", platform, "--out", tmp_path / "s")
    assert set(programs(tmp_path / "s").values()) == {"place = 'battery_service.py'\n"}
    assert said(done).count("lies deeper than") == 2


@pytest.mark.parametrize("packed", [zipped, unpacked])
def test_backslashes_between_folders_are_slashes(tmp_path: Path, packed) -> None:
    files = {f"hw/{name}".replace("/", "\\"): text for name, text in MOODLE.items()}
    done = course(packed(tmp_path / "d", files), "--from", "moodle", "--out", tmp_path / "s")
    assert done.exit_code == 0, done.output
    assert programs(tmp_path / "s") == WANTED["moodle"]


@pytest.mark.parametrize("packed", [zipped, unpacked])
def test_a_locale_without_utf8_takes_every_name(tmp_path: Path, packed) -> None:
    download = packed(tmp_path / "d", {"李伟_101_5001_battery_service.py": PROGRAM})
    done = subprocess.run(
        [Path(sys.executable).with_name("course"), "collect", download, "--from", "canvas"],
        cwd=tmp_path,
        env={**os.environ, "LC_ALL": "C", "PYTHONUTF8": "0"},
        capture_output=True,
    )
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "submitted/李伟-101/battery_service/battery_service.py").read_text() == PROGRAM
