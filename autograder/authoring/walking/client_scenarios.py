"""Scenarios for clients of `walk_to`, fixed and drawn ones, as data: a script for the server, and steps of the user.

`autograder/arena/scripted_walk.py` defines the scripts. All times are s on the arena's clock.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate
from random import Random
from typing import Any

from autograder.authoring.checks import Scenario, program

ARGUMENTS = ("1.025", "0.475", "0.335")  # x m, y m, yaw rad
SUCCEEDED, CANCELED, ABORTED = range(4, 7)  # of action_msgs/GoalStatus
LONGEST_GAP = 4.5  # s between two messages of the server: 5 s are a silence
LONGEST_WALK = 12.0  # s of feedback
OTHER_LINES = ("", "w", "quit", "stop", "please q", "qq")  # that must not cancel

Script = dict[str, Any]
Steps = list[list[Any]]


def walk(server: Script | None, *steps: list[Any], arguments: Sequence[str] = ARGUMENTS) -> Scenario:
    """Return a scenario with this server (None: there is none) and these steps of the user."""
    return program("in_order", {"arguments": list(arguments), "server": server, "steps": list(steps)})


def way(messages: int) -> list[float]:
    """Return the distances (m) of a robot that comes nearer and never arrives."""
    return [round(3.0 * 0.97**number, 3) for number in range(messages)]


ON_AND_ON: Script = {"distances": way(60), "ends_after": None}
ON_THE_WAY: Script = {"distances": way(5), "ends_after": 1.0}


def typed(*lines: str, after: float = 0.6, apart: float = 0.5) -> Steps:
    """Return the steps of a user who types lines while the robot walks."""
    steps: Steps = [["await_answer"], ["wait", after]]
    for line in lines:
        steps += [["type", line], ["wait", apart]]
    return steps


# -- fixed ------------------------------------------------------------------------------------------------------------

GOOD = walk({"distances": [1.12, 0.93, 0.71, 0.5, 0.28, 0.07], "ends_after": 1.4})
WRONG_ARGUMENTS = (["1.0"], ["one", "0.5"], ["1.0", "0.5", "0.3", "0.2"])


# -- drawn ------------------------------------------------------------------------------------------------------------


def any_pose(random: Random, arguments: int = 3) -> list[str]:
    """Return arguments with negative numbers, and a yaw beyond half a turn."""
    x, y, yaw = random.uniform(-2.0, -0.3), random.uniform(-2.0, -0.3), random.uniform(-6.0, -3.3)
    return [f"{value:.3f}" for value in (x, y, yaw)[:arguments]]


def any_walk(random: Random, arguments: int = 3) -> Script:
    """Return a walk whose distances fall, except for a detour, and which ends beside the pose."""
    pose = any_pose(random, arguments)
    distances = sorted((round(random.uniform(0.05, 2.5), 2) for _ in range(8)), reverse=True)
    distances[4] = round(distances[3] + random.uniform(0.1, 0.5), 2)
    x, y = (round(float(value) + random.uniform(-0.08, 0.08), 2) for value in pose[:2])
    server = {"distances": distances, "ends_after": 1.8, "final": [x, y, 0.3]}
    return {"arguments": pose, "server": server, "steps": []}


def slow_walk(random: Random) -> Script:
    """Return a walk of a minute in which the distance never changes; the server starts late and answers late."""
    gaps = [round(random.uniform(4.0, LONGEST_GAP), 2) for _ in range(15)]
    distance = round(random.uniform(0.1, 20.0), 2)
    server = {
        "after": round(random.uniform(3.0, 3.4), 2),
        "distances": [*[distance] * 14, 0.0],
        "every": gaps,
        "ends_after": round(sum(gaps), 2),
    }
    steps = [["wait", 2.5], ["offer"], ["await_answer"], ["wait", server["ends_after"]]]
    return {"arguments": any_pose(random), "server": server, "steps": steps}


def silence_on_the_way(random: Random, *, types: bool = False) -> Script:
    """Return a server that stops sending or dies, after a q if the user `types`, and never answers a cancel."""
    server: Script = {
        "distances": way(random.randrange(6)),
        "ends_after": random.choice([None, 1.2]),
        "result_after": None,
        "cancel": {"agreed": None},
    }
    steps = typed("q") if types else []
    if random.random() < 0.5:
        server |= ON_AND_ON
        steps = [*(steps or [["await_answer"], ["wait", 0.6]]), ["end_server"]]
    return {"arguments": any_pose(random), "server": server, "steps": steps}


def ctrl_c(random: Random, server: Script, *lines: str) -> Script:
    """Return a walk with Ctrl-C on the way, after these typed lines."""
    wait = round(random.uniform(0.5, 1.2), 2)
    steps = [*(typed(*lines) if lines else [["await_answer"]]), ["wait", wait], ["press_ctrl_c"]]
    return {"arguments": any_pose(random), "server": {"distances": way(60), **server}, "steps": steps}


def any_course(random: Random, *, types: bool = False) -> Script:
    """Return a walk with any answer, feedback, end, silence or Ctrl-C, and with typed lines if the user `types`."""
    course = random.choice(["ends", "ends", "silence", "rejects", "ctrl-c"])
    if course == "silence":
        return silence_on_the_way(random, types=types)
    lines = [random.choice(OTHER_LINES), *["q"] * random.choice([0, 1, 1, 2])] if types else []
    if course == "ctrl-c":
        return ctrl_c(random, _any_end(random, at_least=4.5) | {"cancel": _any_cancel(random, 3.0)}, *lines)
    if course == "rejects":
        after = round(random.uniform(1.5, 4.0), 2)
        steps = [["await_goal"], *(["type", line] for line in lines)] if types else []
        return {"arguments": any_pose(random), "server": {"accepted": False, "after": after}, "steps": steps}
    server = _any_way(random)
    early = types and random.random() < 0.4
    server["after"] = round(random.uniform(1.0 if early else 0.0, 4.0), 2)
    steps = [["await_goal"], *(["type", line] for line in lines)] if early else typed(*lines) if types else []
    if types and random.random() < 0.3:
        steps.append(["end_input"])
    arguments, cancel = any_pose(random), _any_cancel(random, 1.0)
    return {"arguments": arguments, "server": server | {"cancel": cancel}, "steps": steps}


def _any_way(random: Random) -> Script:
    """Return feedback with any distances, with gaps too short for a silence, and an end."""
    gaps = [round(random.uniform(0.1, LONGEST_GAP), 2) for _ in range(random.randrange(7))]
    gaps = gaps[: sum(t < LONGEST_WALK for t in accumulate(gaps))]
    distances = [round(random.uniform(0.0, 12.0), 2) for _ in gaps]
    if random.random() < 0.3:
        distances = distances[:1] * len(distances)  # it stands still
    end = sum(gaps) or random.uniform(0.0, 3.0)
    early = [round(random.uniform(3.0, 9.0), 2)] * random.choice([0, 0, 1])
    return _any_end(random, at_least=end) | {"early": early, "distances": distances, "every": gaps}


def _any_end(random: Random, at_least: float) -> Script:
    status = random.choice([SUCCEEDED, CANCELED, ABORTED])
    reasons = ("the robot fell at x 0.42 m", "the way is blocked: 3 obstacles", "no way", "")
    code = random.choice([0, 1, 2])  # whatever it is, the status decides
    kept = {"kept_for": 1.0} if random.random() < 0.5 else {}
    end = {"ends_after": round(at_least, 2), "status": status, "error_code": code}
    return {**end, "error_msg": random.choice(reasons), "final": [-0.42, 1.37, 0.2], **kept}


def _any_cancel(random: Random, ends_after: float) -> Script:
    """Return a script for a cancel; a goal that is CANCELED ends no sooner than `ends_after` (s)."""
    code = random.choice([0, 1])  # ERROR_NONE, ERROR_REJECTED
    return random.choice(
        [
            {"ends_after": round(random.uniform(ends_after, ends_after + 1.5), 2)},
            {"ends_after": None},
            {"agreed": False, "refusal": code, "after": round(random.uniform(0.0, 0.6), 2)},
            {"agreed": None},
        ]
    )
