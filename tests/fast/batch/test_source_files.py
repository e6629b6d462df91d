"""The programs of a class as input for plagiarism detection: the students' lines, and separately the starter code."""

from __future__ import annotations

from pathlib import Path

from autograder.classroom.batch.collection import Work
from autograder.classroom.batch.runner import Graded
from autograder.classroom.batch.source_files import write_base_code, write_source
from autograder.engine.verdict import Grade
from ros_runtime.project import PROJECT


def result(student, sources, exercise="battery_service"):
    return Graded(Work(student, exercise), Grade(exercise, student, "namespaces"), sources)


def files(folder: Path) -> dict[str, str]:
    return {
        path.relative_to(folder).as_posix(): path.read_text() for path in folder.rglob("*") if path.is_file()
    }


def test_a_folder_an_exercise_and_a_student_with_what_was_graded(tmp_path):
    interfaces = {"NavigateToPose.action": "#\n", "GetBatteryStatus.srv": "#\n"}
    write_source(tmp_path, result("anna", {"battery_service.py": "x = 1\n"}))
    write_source(tmp_path, result("_base", {"battery_service.py": "x = 2\n"}))
    write_source(tmp_path, result("anna", interfaces, "interfaces"))
    assert files(tmp_path / "sources") == {
        "battery_service/anna/battery_service.py": "x = 1\n",
        "battery_service/_base/battery_service.py": "x = 2\n",
        "interfaces/anna/NavigateToPose.action": "#\n",
        "interfaces/anna/GetBatteryStatus.srv": "#\n",
    }


def test_a_resubmission_replaces_the_earlier_files_and_an_unreadable_one_has_none(tmp_path):
    both = {"NavigateToPose.action": "1\n", "GetBatteryStatus.srv": "1\n"}
    write_source(tmp_path, result("anna", both, "interfaces"))
    write_source(tmp_path, result("bert", {"battery_service.py": "1\n"}))
    write_source(tmp_path, result("anna", {"GetBatteryStatus.srv": "2\n"}, "interfaces"))
    write_source(tmp_path, result("bert", None))
    assert files(tmp_path / "sources") == {"interfaces/anna/GetBatteryStatus.srv": "2\n"}


def test_the_starter_code_is_in_a_separate_folder_of_the_same_layout(tmp_path):
    for exercise in ("battery_service", "battery_service", "walk_to"):
        write_base_code(tmp_path, exercise, PROJECT / "exercises")
    given = files(tmp_path / "sources/_base")
    assert set(given) == {"battery_service/battery_service.py", "walk_to/walk_to.py"}
    assert "# YOUR CODE HERE" in given["walk_to/walk_to.py"]
    assert "%%writefile" not in given["walk_to/walk_to.py"]
    write_base_code(tmp_path, "battery_service", tmp_path)  # no notebook there
    assert set(files(tmp_path / "sources/_base")) == set(given)
