"""The essay on a six-joint arm: its rubric, its marked samples, and the model answers for instructors."""

from __future__ import annotations

import re

import nbformat
import pytest

from autograder.engine.essay import load_essay
from ros_runtime.design import Design, read_design
from ros_runtime.project import PROJECT

NAME = "arm_architecture"
FOLDER = PROJECT / "solutions" / NAME
CRITERIA = {criterion.id: criterion for criterion in load_essay(NAME).criteria}
WEAK = read_design((FOLDER / "marked/weak.txt").read_text())
NEEDS = 10


def cells(folder: str) -> dict[str, str]:
    notebook = nbformat.read(PROJECT / folder / NAME / f"{NAME}.ipynb", as_version=4)
    return {cell.id: cell.source for cell in notebook.cells}


SOLUTION, RELEASE = cells("solutions"), cells("exercises")
FULL = read_design(SOLUTION["solution"].partition("\n")[2])


def table(text: str) -> list[list[str]]:
    rows = [line.strip("|").split("|") for line in text.splitlines() if line.startswith("| ")]
    return [[cell.strip() for cell in row] for row in rows[1:]]


def test_six_facts_and_the_graph_are_marked() -> None:
    assert list(CRITERIA) == ["graph", "pattern", "type", "qos", "rate", "failure", "safety"]
    assert sum(criterion.points for criterion in CRITERIA.values()) == 20


def test_students_read_the_rubric_before_the_task() -> None:
    assert list(RELEASE)[:3] == ["title", "rubric", "task"]
    for criterion in CRITERIA.values():
        for points, words in criterion.levels.items():
            assert f"**{points}**: {words}" in RELEASE["rubric"]
            assert f"**{points}**: {words}" in RELEASE[criterion.id]


@pytest.mark.parametrize("sample", ["sample-a", "sample-b"])
def test_the_marks_of_a_sample_add_up(sample: str) -> None:
    said = re.match(r"\*\*(\d+) of 20\.\*\*", RELEASE[f"{sample}-marks"])
    assert said
    rows = table(RELEASE[f"{sample}-marks"])
    given = [tuple(map(int, row[1].split(" of "))) for row in rows]
    assert [row[0] for row in rows] == [criterion.title for criterion in CRITERIA.values()]
    assert [most for _, most in given] == [criterion.points for criterion in CRITERIA.values()]
    assert sum(points for points, _ in given) == int(said[1])


@pytest.mark.parametrize("sample", ["sample-a", "sample-b"])
def test_a_sample_is_of_another_system_and_lacks_nothing_a_program_sees(sample: str) -> None:
    design = read_design(RELEASE[sample].partition("\n")[2])
    assert design.problems == ()
    assert [link.missing() for link in design.links] == [[], [], []]
    assert set(design.nodes) & set(FULL.nodes) == set()
    assert "wire" not in RELEASE[sample]  # which of the arm's links are wires, students find out


def test_the_full_answer_serves_every_need_and_lacks_nothing_a_program_sees() -> None:
    assert FULL.problems == ()
    assert len(FULL.links) >= 8
    assert [link for link in FULL.links if link.missing()] == []
    served = re.findall(r"# needs? ([\d, ]+)", SOLUTION["solution"])
    assert {int(need) for needs in served for need in needs.split(",")} == set(range(1, NEEDS + 1))
    assert RELEASE["task"].count(f"\n{NEEDS}. ") == 1


def stopping(design: Design) -> set[str]:
    """The patterns of the links that a button begins, or that cut the motors' power."""
    return {link.pattern for link in design.links if link.sender in ("stop_button", "safety_relay")}


def test_its_hard_stop_runs_through_wires_alone() -> None:
    assert stopping(FULL) == {"wire"}
    assert "action" not in {link.pattern for link in FULL.links if "mergency" in link.type}


def test_the_weak_sample_stops_by_an_action_and_has_all_facts() -> None:
    assert WEAK.problems == ()
    assert len(WEAK.links) >= 8
    assert [link for link in WEAK.links if link.missing()] == []
    assert ("action", "arm_interfaces/action/EmergencyStop") in [
        (link.pattern, link.type) for link in WEAK.links
    ]


def test_the_marks_for_instructors_are_of_this_rubric_and_add_up() -> None:
    *rows, total = table((FOLDER / "marked/README.md").read_text())
    assert [row[0] for row in rows] == list(CRITERIA)
    assert [int(row[1]) for row in rows] == [criterion.points for criterion in CRITERIA.values()]
    weak = [int(row[2]) for row in rows]
    assert all(points in CRITERIA[row[0]].levels for row, points in zip(rows, weak, strict=True))
    assert total[2] == f"**{sum(weak)}**"


def test_the_release_contains_no_solution() -> None:
    text = "\n".join(RELEASE.values())
    for secret in ("safety_relay", "EtherCAT", "FollowJointTrajectory", "BEGIN SOLUTION", "ArmMode"):
        assert secret not in text
    assert "# YOUR CODE HERE" in RELEASE["solution"]


def test_the_marker_sees_a_drawing_where_there_is_a_link() -> None:
    picture = load_essay(NAME).picture
    assert picture
    assert "camera -&gt; part_finder" in (picture({f"{NAME}.txt": RELEASE["solution"]}) or "")
    assert picture({f"{NAME}.txt": "prose"}) is None
    assert picture({}) is None
