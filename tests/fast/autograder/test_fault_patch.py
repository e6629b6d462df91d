"""A faulty submission is stored as a patch of a correct one, from which the whole program is restored."""

import pytest
from typer.testing import CliRunner

from autograder.classroom.audit.fault_patch import as_patch, whole_program
from autograder.classroom.audit.known_submission import known_submission, known_submissions
from autograder.engine.exercise import FOLDER_VARIABLE, exercise_names
from course_cli.app import app
from ros_runtime.course_error import CourseError

SOUND = '"""Style: plain."""\n' + "".join(f"line_{number} = {number}\n" for number in range(20))
FAULTY = '"""Fault: forgets\nCaught by: counts\n"""\n' + SOUND.split("\n", 1)[1].replace("line_7 = 7\n", "")
OTHER = '"""Fault: is another program\nCaught by: counts\n"""\n' + "print()\n" * 20


@pytest.fixture
def known(tmp_path, monkeypatch):
    """The folder known/ of an exercise with a correct and a faulty program."""
    monkeypatch.setenv(FOLDER_VARIABLE, str(tmp_path))
    folder = tmp_path / "counting" / "known"
    for name, text in {"correct/plain": SOUND, "faulty/forgets": FAULTY, "faulty/another": OTHER}.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / f"{name}.py").write_text(text)
    (tmp_path / "counting" / "checks.py").write_text("")
    return folder


def course(*arguments):
    """Run a command, as people do; return its exit status and what it printed."""
    ran = CliRunner().invoke(app("audit"), ["audit", *arguments])
    return ran.exit_code, " ".join(ran.output.split())


def test_a_program_becomes_a_patch_that_is_shorter_and_gives_the_program_back(known):
    status, said = course("counting", "--to-patch", "forgets")
    assert (status, "11 lines" in said) == (0, True), said
    assert not (known / "faulty/forgets.py").exists()
    assert (known / "faulty/forgets.patch").read_text().count("\n-line_7 = 7\n") == 1
    assert whole_program(known / "faulty/forgets.patch") == FAULTY
    submission = known_submission("counting", "faulty/forgets")
    assert submission.caught_by == ("counts",)
    assert submission.read().sources == {"counting.py": FAULTY}
    assert CliRunner().invoke(app("audit"), ["audit", "--show", "counting/faulty/forgets"]).output == FAULTY


def test_a_program_that_shares_too_little_stays_whole(known):
    assert as_patch(known / "faulty/another.py", [known / "correct/plain.py"]) is None
    assert course("counting", "--to-patch", "another")[0] == 0
    assert (known / "faulty/another.py").read_text() == OTHER


def test_a_patch_that_no_longer_applies_says_what_to_do(known):
    course("counting", "--to-patch", "forgets")
    sound = known / "correct/plain.py"
    sound.write_text(SOUND.replace("line_6 = 6", "line_6 = 60"))
    with pytest.raises(CourseError, match=r"no longer applies to correct/plain\.py.*--to-patch forgets"):
        whole_program(known / "faulty/forgets.patch")
    sound.unlink()
    with pytest.raises(CourseError, match="the line --- must name the correct submission"):
        whole_program(known / "faulty/forgets.patch")


def test_an_unknown_name_is_refused(known):
    status, said = course("--show", "counting/faulty/none")
    assert status == 2
    assert "faulty/none; found none" in said


@pytest.mark.parametrize("exercise", exercise_names())
def test_every_patch_applies(exercise):
    for known in known_submissions(exercise):
        assert known.read().sources
