"""Only the machine leads to "not graded": each place that can say so, with the test in which a program leads there.

That program is judged: it loses the points. A new place needs a row here.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

PROJECT = Path(__file__).parents[3]
SAYING = ("CannotBeJudged", "NotGraded", "NoOccasion", "unseen", "not_shown", "held_up")

# The record lacks an event of the grader, because the program exited, was killed, or delayed the robot.
LEAVES = "arena/autograder/test_evidence.py::test_a_program_that_leaves_at_any_moment_is_judged"
HOLDS_UP = "fast/autograder/test_missing.py::test_a_submission_that_delays_the_robot_fails"
LATE = "fast/autograder/test_missing.py::test_a_late_command_is_the_fault_of_the_submission_that_delayed_the_robot"
FLOODS = "fast/autograder/test_bounds.py::test_a_flooded_graph_is_quoted_in_readable_length"
# The program alone decides whether it does what a check looks at.
NEVER_SHOWS = (
    "fast/autograder/test_missing.py::"
    "test_missing_evidence_that_depends_only_on_the_submission_costs_points_in_the_end"
)
NO_OCCASION = "fast/autograder/test_obligations.py::test_a_submission_for_which_no_obligation_applies_fails"
# The program uses up memory, processors or time, or sends unreadable data.
FILLS = "arena/isolation/test_student_sandbox.py::test_a_memory_bomb_ends_the_arena_and_names_the_cause"
STARVES = "fast/arena/test_processor_time.py::test_twelve_busy_processes_that_share_a_processor_lose_nothing"
UNREADABLE = (
    "fast/arena/test_spinning.py::test_messages_that_cannot_be_read_are_counted_and_the_next_one_is_taken"
)
BUILDS = "fast/autograder/test_interfaces_exercise.py::test_a_line_that_the_build_refuses_is_corrected"
BAD_FILE = (
    "fast/batch/test_runner.py::test_infrastructure_failures_are_not_graded_and_bad_submissions_are_zero"
)

AUTHORING, ENGINE = "autograder/authoring", "autograder/engine"
PLACES = {
    LEAVES: (
        f"{AUTHORING}/requirements/client_checks.py require_one_goal started_at",
        f"{AUTHORING}/requirements/falls.py require_knocked_over",
        f"{AUTHORING}/diagnosis/missing.py _exception_for",
        f"{AUTHORING}/obligation.py _require_sent",
        f"{AUTHORING}/diagnosis/readiness.py require_ready require_started",
        f"{AUTHORING}/evidence/robot_record.py _known last_command",
        f"{AUTHORING}/evidence/robot_topic.py known_messages",
        f"{AUTHORING}/requirements/standard.py exits_with_status_0",
        f"{AUTHORING}/walking/client_record.py _require_acts require_record",
        f"{AUTHORING}/walking/life.py accepted",
        "solutions/balance_controller/record.py gains_at_first",
        "solutions/battery_guard/life.py guards",
        "solutions/calibration/heartbeat.py beats",
        "solutions/calibration/truth.py _status",
        "solutions/compute_ik/model.py lengths_are_parameters moves_the_real_hand",
        "solutions/low_battery_fetch/fetching.py _require_whole_lives",
        "solutions/low_battery_fetch/turns.py _not_made",
        "solutions/stand_up/truth.py bodies",
    ),
    HOLDS_UP: (f"{ENGINE}/completeness.py _require_simulated_time require_whole",),
    LATE: (f"{ENGINE}/completeness.py _require_effects",),
    FLOODS: (f"{ENGINE}/completeness.py _require_nothing_dropped",),
    NEVER_SHOWS: (
        f"{AUTHORING}/diagnosis/missing.py not_shown",
        f"{AUTHORING}/walking/client_run.py started",
        f"{AUTHORING}/walking/obligations/walks.py ends_with_a_zero_twist",
        f"{AUTHORING}/walking/motion.py require_limited_velocity",
        f"{AUTHORING}/walking/obligations/ends.py tells_a_fall",
        "solutions/move_arm/motion.py stops_by_an_empty_trajectory",
        "solutions/navigate_to_pose/legs.py _leg_to led_astray under_way",
        "solutions/navigate_to_pose/model.py counts_the_detour names_its_phases",
    ),
    NO_OCCASION: (f"{AUTHORING}/obligation.py judge", "solutions/calibration/hidden.py _calibrates"),
    FILLS: (f"{ENGINE}/arena_run.py run_in_arena",),
    STARVES: (f"{ENGINE}/grading.py _run",),
    UNREADABLE: (f"{ENGINE}/arena_run.py _transcript read_events",),
    BUILDS: ("solutions/interfaces/judging.py _built _part _report require_built",),
    BAD_FILE: (
        "autograder/classroom/batch/worker_pool.py _lost",
        "autograder/classroom/batch/job.py _graded",
    ),
}


def said_in(node: ast.AST, function: str = "") -> Iterator[str]:
    """Yield the functions with a call that leads to "not graded"."""
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.Call):
            called = getattr(child.func, "id", getattr(child.func, "attr", ""))
            gives_reason = called == "Grade" and any(each.arg == "reason" for each in child.keywords)
            if called in SAYING or gives_reason:
                yield function
        yield from said_in(child, child.name if isinstance(child, ast.FunctionDef) else function)


def test_each_function_that_can_return_not_graded_is_listed() -> None:
    found = {
        f"{path.relative_to(PROJECT)} {function}"
        for folder in ("autograder", "solutions")
        for path in (PROJECT / folder).rglob("*.py")
        if not {"known", "audit"} & set(path.parts)
        for function in said_in(ast.parse(path.read_text()))
    }
    listed = [row.split() for rows in PLACES.values() for row in rows]
    assert found == {f"{path} {function}" for path, *functions in listed for function in functions}


def test_each_has_a_test_in_which_a_program_causes_it_and_is_judged() -> None:
    for test in PLACES:
        path, name = test.split("::")
        assert f"def {name}(" in (PROJECT / "tests" / path).read_text(), test
