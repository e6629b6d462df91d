"""The promises about students' processes in docs/grading.md are those that the posture test checks."""

from __future__ import annotations

from ros_runtime.project import PROJECT
from student_posture import promise_table


def test_the_page_has_the_promises_as_they_are_tested() -> None:
    page = (PROJECT / "docs/grading.md").read_text()
    assert promise_table() in page, f"put this into docs/grading.md:\n{promise_table()}"
