"""The launcher detects when its environment no longer fits the clone."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

from autograder.classroom.archives import gradescope_package, student_bundle
from autograder.classroom.archives.student_bundle import files_of

ROOT = Path(__file__).resolve().parents[3]
WHAT_DECIDES = (
    "course",
    "pyproject.toml",
    "requirements.lock",
    "setup",
    "humanoid_interfaces",
    "ros_runtime",
)


@pytest.fixture
def clone(tmp_path: Path) -> Path:
    """A copy of the files from which the environment is made, with a fake environment that is up to date."""
    clone = tmp_path / "clone"
    clone.mkdir()
    for name in WHAT_DECIDES:
        source = ROOT / name
        if source.is_dir():
            shutil.copytree(source, clone / name, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            shutil.copy2(source, clone / name)
    for program in ("python", "course"):
        path = clone / ".venv/bin" / program
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("#!/bin/sh\n")
        path.chmod(0o755)
    fingerprint = dry_run(clone)[1]
    (clone / ".venv/course.stamp").write_text(f"{fingerprint}\n{clone}\nwheels\n")
    assert state(clone) == "ready"
    return clone


def dry_run(clone: Path, **environment: str) -> list[str]:
    """The state of the environment as the launcher reports it, and the fingerprint of the files for it."""
    inherited = {name: value for name, value in os.environ.items() if not name.startswith(("ROS_", "AMENT_"))}
    finished = subprocess.run(
        [clone / "course"],
        env={**inherited, "COURSE_DRY_RUN": "1", **environment},
        capture_output=True,
        text=True,
        check=True,
    )
    return finished.stdout.split()


def state(clone: Path, **environment: str) -> str:
    return dry_run(clone, **environment)[0]


@pytest.mark.parametrize(
    "changed",
    [
        "pyproject.toml",
        "requirements.lock",
        "setup/hatch_build.py",
        "humanoid_interfaces/package.xml",
        "humanoid_interfaces/msg/RobotState.msg",
        "ros_runtime/workarounds/scaled_clock/scaled_clock.c",
    ],
)
def test_a_changed_source_makes_it_stale(clone: Path, changed: str) -> None:
    with (clone / changed).open("a", encoding="utf-8") as source:
        source.write("\n")

    assert state(clone) == "stale"


def test_an_added_and_a_removed_interface_make_it_stale(clone: Path) -> None:
    added = clone / "humanoid_interfaces/srv/Wave.srv"
    added.write_text("---\n")
    assert state(clone) == "stale"

    added.unlink()
    assert state(clone) == "ready"

    (clone / "humanoid_interfaces/srv/ComputeIK.srv").unlink()
    assert state(clone) == "stale"


def test_a_new_date_of_the_same_content_changes_nothing(clone: Path) -> None:
    os.utime(clone / "pyproject.toml", (0, 0))

    assert state(clone) == "ready"


def test_an_interrupted_set_up_is_restarted(clone: Path) -> None:
    (clone / ".venv/course.stamp").unlink()

    assert state(clone) == "missing"


def test_an_environment_whose_python_is_gone_is_missing(clone: Path) -> None:
    python = clone / ".venv/bin/python"
    python.unlink()
    python.symlink_to(clone / "uninstalled/python3")

    assert state(clone) == "missing"


def test_a_moved_clone_needs_its_environment_made_again(clone: Path) -> None:
    moved = clone.with_name("moved")
    clone.rename(moved)

    assert state(moved) == "moved"


def test_sourcing_ros_2_jazzy_requires_an_environment_that_uses_it(clone: Path, tmp_path: Path) -> None:
    prefix = tmp_path / "opt/ros/jazzy"
    (prefix / "lib/python3.12/site-packages/rclpy").mkdir(parents=True)

    assert state(clone, ROS_DISTRO="jazzy", AMENT_PREFIX_PATH=f"/elsewhere:{prefix}") == "other-ros"
    assert state(clone, ROS_DISTRO="humble", AMENT_PREFIX_PATH=str(prefix)) == "ready"
    assert state(clone, ROS_DISTRO="jazzy", AMENT_PREFIX_PATH="/elsewhere") == "ready"


def test_a_clone_in_a_path_that_some_tools_cannot_take_is_used_through_a_link(clone: Path) -> None:
    odd = clone.rename(clone.with_name('Año 1 & "Sam\'s" $HOME'))
    (odd / ".venv/bin/course").write_text('#!/bin/sh\necho "$0"\n')
    link = plain_path(odd)
    try:
        assert re.fullmatch(r"[\w/.-]+", str(link), re.ASCII)
        assert link.readlink() == odd
        assert state(odd) == "moved"
        (odd / ".venv/course.stamp").write_text(f"{dry_run(odd)[1]}\n{link}\nwheels\n")
        assert state(odd) == "ready"
        assert subprocess.check_output([odd / "course"], text=True) == f"{link}/.venv/bin/course\n"

        link.parent.chmod(0o777)  # any user could replace the link
        assert plain_path(odd).parent != link.parent
    finally:
        for parent in ("/var/tmp", "/tmp"):
            shutil.rmtree(Path(parent, link.parent.name), ignore_errors=True)


def plain_path(clone: Path) -> Path:
    """The path by which the launcher calls the clone."""
    call = '. setup/plain_path.sh; plain_path "$PWD"'
    return Path(subprocess.check_output(["bash", "-c", call], cwd=clone, text=True).strip())


def test_a_colon_in_its_path_is_refused_in_a_sentence(clone: Path) -> None:
    odd = clone.rename(clone.with_name("12:30"))

    refused = subprocess.run([odd / "course"], capture_output=True, text=True)

    assert refused.returncode == 1
    assert "12:30, has a colon, which separates folders in PATH.\ncourse: Next: move it" in refused.stderr


@pytest.mark.parametrize("home", ["", "/nonexistent"])
def test_without_a_usable_home_the_clone_is_used_as_home(clone: Path, home: str) -> None:
    (clone / ".venv/bin/course").write_text('#!/bin/sh\necho "$HOME"\n')
    environment = {**os.environ, "HOME": home}
    environment.pop("ROS_DISTRO", None)

    printed = subprocess.run(
        [clone / "course"], env=environment, capture_output=True, text=True, check=True
    ).stdout

    assert printed.splitlines()[-1] == str(clone / "build/home")
    assert (clone / "build/home").is_dir()


def test_a_command_that_is_not_here_installs_nothing(clone: Path) -> None:
    (clone / ".venv/bin/course").write_text("#!/bin/sh\necho it says so\n")
    (clone / "setup/install_g1.sh").write_text("echo installed\n")
    (clone / ".venv/course.stamp").write_text(f"{dry_run(clone)[1]}\n{clone}\nwheels\n")
    assert run_test_command(clone) == (0, "it says so\n", "")

    (clone / ".venv/course.stamp").unlink()
    assert run_test_command(clone) == (
        2,
        "",
        "course: there is no command 'test'. ./course --help lists the commands.\n",
    )
    assert not (clone / "build").exists()


def test_the_robot_that_only_tests_need_is_installed_for_them(clone: Path) -> None:
    (clone / "tests/developer").mkdir(parents=True)
    (clone / "tests/developer/test.py").touch()
    (clone / ".venv/bin/course").write_text("#!/bin/sh\necho it runs\n")
    (clone / "setup/install_g1.sh").write_text("echo installed\n")
    (clone / ".venv/course.stamp").write_text(f"{dry_run(clone)[1]}\n{clone}\nwheels\n")
    status, printed, _ = run_test_command(clone)
    assert (status, printed) == (0, "installed\nit runs\n")


def run_test_command(clone: Path) -> tuple[int, str, str]:
    """Exit status, output and error output of `./course test` in a copy without ROS from apt."""
    inherited = {name: value for name, value in os.environ.items() if not name.startswith(("ROS_", "AMENT_"))}
    ran = subprocess.run([clone / "course", "test"], env=inherited, capture_output=True, text=True)
    return ran.returncode, ran.stdout, ran.stderr


def launch_with_rclpy(clone: Path, prefix: Path, version: str) -> subprocess.CompletedProcess[str]:
    """Run a command of the course where ROS 2 Jazzy is sourced and has this rclpy; the environment is up to date."""
    (prefix / "lib/python3.12/site-packages/rclpy").mkdir(parents=True)
    (prefix / "share/rclpy").mkdir(parents=True)
    (prefix / "share/rclpy/package.xml").write_text(
        f'<?xml version="1.0"?>\n<package format="2">\n  <name>rclpy</name>\n  <version>{version}</version>\n'
        "</package>\n"
    )
    sourced = {"ROS_DISTRO": "jazzy", "AMENT_PREFIX_PATH": str(prefix)}
    fingerprint = dry_run(clone, **sourced)[1]
    (clone / ".venv/course.stamp").write_text(f"{fingerprint}\n{clone}\napt\n")
    (clone / ".venv/bin/course").write_text("#!/bin/sh\necho it runs\n")
    return subprocess.run(
        [clone / "course"], env={**os.environ, **sourced}, capture_output=True, text=True, check=False
    )


@pytest.mark.parametrize("version", ["7.1.8", "7.1.9"])
def test_an_rclpy_that_loses_results_is_refused(clone: Path, tmp_path: Path, version: str) -> None:
    launched = launch_with_rclpy(clone, tmp_path / "opt/ros/jazzy", version)

    assert launched.returncode == 1
    assert "it runs" not in launched.stdout
    seen, remedy, other = launched.stderr.splitlines()[-3:]
    assert f"rclpy {version}" in seen
    assert "empty" in seen
    assert "sudo apt upgrade ros-jazzy-rclpy" in remedy
    assert "not sourced" in other


@pytest.mark.parametrize("version", ["7.1.7", "7.1.10", "7.1.80"])
def test_every_other_rclpy_of_apt_is_used(clone: Path, tmp_path: Path, version: str) -> None:
    launched = launch_with_rclpy(clone, tmp_path / "opt/ros/jazzy", version)

    assert launched.stdout.splitlines()[-1] == "it runs"
    assert launched.returncode == 0


@pytest.mark.parametrize(
    "parts",
    [(*student_bundle.SHOWN, *student_bundle.PARTS), gradescope_package.PARTS],
    ids=["students", "gradescope"],
)
def test_an_archive_holds_what_the_environment_is_made_from(tmp_path: Path, parts: tuple[str, ...]) -> None:
    for path in files_of(ROOT, parts):
        name = path.relative_to(ROOT)
        if name.parts[0] in (*WHAT_DECIDES, "LICENSE"):
            (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(path, tmp_path / name)
    assert dry_run(tmp_path) == ["missing", dry_run(ROOT)[1]]
    assert (tmp_path / "LICENSE").exists()  # pyproject.toml names it


def test_a_long_step_of_the_set_up_is_named_again(clone: Path) -> None:
    program = """
        started=$SECONDS
        sleep() { command sleep 0.02; }
        begin "building humanoid_interfaces (about a minute)"
        logged bash -c "sleep 1"
    """
    (clone / "build").mkdir()
    ran = subprocess.run(
        ["bash", "-c", f"root={clone}\n. {clone}/setup/environment.sh\n{program}"],
        stderr=subprocess.PIPE,
        text=True,
        check=True,
    )
    assert re.search(
        r"^course: still building humanoid_interfaces \(\d s since the beginning\)$", ran.stderr, re.MULTILINE
    )
