"""What is done to a joint query. No expected answers here: this runs in the arena."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from autograder.arena.stage import Stage
from humanoid_interfaces.srv import GetJointPositions

SERVICE = "get_joint_positions"
MANY_MESSAGES = 4.0  # s; longer than the checks let a message be on its way
MOTION = 1.0  # s from one posture to the next, long over when many messages have come
A_FEW_MESSAGES = 1.0  # s

Names = Sequence[str]
Posture = Mapping[str, float]  # rad


def _open(stage: Stage, listening: float = MANY_MESSAGES) -> None:
    stage.open(services={SERVICE: GetJointPositions})
    stage.wait(listening)


def _ask(stage: Stage, *requests: Names) -> bool:
    """Ask for one list of names after the other until there is no answer; returns whether all came."""
    return all(
        stage.wait_for_answer(SERVICE, stage.send_call(SERVICE, {"names": list(names)})) for names in requests
    )


def _move(stage: Stage, posture: Posture) -> None:
    stage.command_robot("move_joints", positions=dict(posture), duration=MOTION)
    stage.wait(MANY_MESSAGES)


def ask(stage: Stage, names: Names, posture: Posture, strangers: Names) -> None:
    """Ask for some joints, for all, for those that have moved, for some that do not exist, and for one again."""
    _open(stage)
    if _ask(stage, names, []):
        _move(stage, posture)
        _ask(stage, list(posture), strangers, names[:1])


def ask_before_the_first_message(stage: Stage, names: Names) -> None:
    """Ask for some joints and for all while the joint sensors are unplugged; plug them in; ask for one."""
    _open(stage)
    if _ask(stage, names, []):
        stage.command_robot("joint_sensors", connected=True)
        stage.wait(MANY_MESSAGES)
        _ask(stage, names[:1])


def ask_in_every_way(
    stage: Stage, posture: Posture, burst: Sequence[Names], reordered: Names, parts: Names
) -> None:
    """Ask in a posture, for several lists at once, with another order on the topic, and for parts of names.

    A service keeps its last 10 requests: `burst` may not hold more.
    """
    _open(stage)
    _move(stage, posture)
    if not _ask(stage, list(posture)):
        return
    at_once = [stage.send_call(SERVICE, {"names": list(names)}) for names in burst]
    if not all(stage.wait_for_answer(SERVICE, call) for call in at_once):
        return
    stage.command_robot("joint_states", reversed=True)
    stage.wait(MANY_MESSAGES)
    _ask(stage, reordered, *([part] for part in parts))


def ask_once(stage: Stage, names: Names) -> None:
    """Ask for some joints."""
    _open(stage)
    _ask(stage, names)


def interrupt(stage: Stage, names: Names) -> None:
    """Ask once, then press Ctrl-C."""
    _open(stage, A_FEW_MESSAGES)
    _ask(stage, names)
    stage.interrupt_node()
