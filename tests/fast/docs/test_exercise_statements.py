"""The statement of each exercise: its duration, its folded hints, and the checks that each step passes."""

from __future__ import annotations

import json
import re

import pytest

from autograder.engine.exercise import exercises_folder, load_exercise

EXERCISES = (
    "arm_architecture",
    "balance_controller",
    "battery_guard",
    "battery_service",
    "cancellable_walk",
    "joint_query",
    "low_battery_fetch",
    "motor_services",
    "move_arm",
    "navigate_to_pose",
    "pick_and_place",
    "stand_up",
    "walk_to",
)
LADDERS = (
    "balance_controller",
    "cancellable_walk",
    "low_battery_fetch",
    "move_arm",
    "navigate_to_pose",
    "pick_and_place",
    "stand_up",
    "walk_to",
)
ON_NO_STEP = {"server_appears", "ends_cleanly"}  # the starter passes them


def cells_of(exercise: str) -> dict[str, str]:
    notebook = json.loads((exercises_folder() / exercise / f"{exercise}.ipynb").read_text(encoding="utf-8"))
    return {cell["id"]: "".join(cell["source"]) for cell in notebook["cells"]}


@pytest.mark.parametrize("exercise", EXERCISES)
def test_a_statement_says_how_long_it_takes_and_how_hard_it_is(exercise: str) -> None:
    title = cells_of(exercise)["title"]
    assert re.search(r"^About \d+ (minutes|hours): \d+", title, re.MULTILINE)
    assert re.search(r"Difficulty: (easy|medium|hard)\.", title)


@pytest.mark.parametrize("exercise", EXERCISES)
def test_hints_are_folded_and_a_stretch_task_comes_after_the_self_check(exercise: str) -> None:
    cells = cells_of(exercise)
    assert cells["stuck"].count("<details>") == cells["stuck"].count("</details>") >= 2
    assert list(cells)[list(cells).index("verdicts") - 1] == "stretch"
    assert "Not graded." in cells["stretch"]


@pytest.mark.parametrize("exercise", LADDERS)
def test_a_ladder_names_every_visible_check_once(exercise: str) -> None:
    solution = cells_of(exercise)["solution"]
    ladder = solution[solution.index("# The ladder.") :].partition("def __init__")[0]
    steps = re.findall(r"\[([\w, ]+)\]", re.sub(r"\n *# *", " ", ladder))
    named = [check for step in steps for check in step.split(", ")]
    visible = {check.id for check in load_exercise(exercise, hidden=False).checks}
    assert sorted(named) == sorted(visible - ON_NO_STEP)
