"""What docs/grading.md promises of students' processes is what the posture test compares them with."""

from __future__ import annotations

from ros_runtime.project import PROJECT
from student_posture import promise_table


def test_the_page_has_the_promises_as_they_are_tested() -> None:
    page = (PROJECT / "docs/grading.md").read_text()
    assert promise_table() in page, f"put this into docs/grading.md:\n{promise_table()}"
