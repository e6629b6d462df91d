"""ros2/examples' minimal action servers, graded: those that cannot be cancelled do not have full marks."""

from __future__ import annotations

from pathlib import Path

from course_command import course

COURSE = Path(__file__).with_name("ros_examples")


def test_every_style_and_every_fault_gets_its_known_verdict() -> None:
    audited = course("audit", "fibonacci", "--course", COURSE)

    said = audited.stdout + audited.stderr
    assert audited.returncode == 0, said
    assert "kills: 8 of 8" in said
    assert "false failures: 0 in 5 runs" in said
    assert "must catch 0" not in said
