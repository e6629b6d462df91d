"""What is done to a joint query. No expected answers here: this runs in the arena."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from autograder.arena.stage import Stage
from humanoid_interfaces.srv import GetJointPositions

SERVICE = "get_joint_positions"
ON_ITS_WAY = 1.2  # s; longer than the checks let a message be on its way, of which there are 20 a second
MOTION = 1.0  # s of the robot's time from one posture to the next
SETTLING = 0.3  # s of it to come to rest

Names = Sequence[str]
Posture = Mapping[str, float]  # rad


def _open(stage: Stage) -> None:
    stage.open(services={SERVICE: GetJointPositions})
    stage.wait(ON_ITS_WAY)


def _ask(stage: Stage, *requests: Names) -> bool:
    """Ask for one list of names after the other until there is no answer; returns whether all came."""
    return all(
        stage.wait_for_answer(SERVICE, stage.send_call(SERVICE, {"names": list(names)})) for names in requests
    )


def _move(stage: Stage, posture: Posture) -> None:
    stage.command_robot("move_joints", positions=dict(posture), duration=MOTION)
    stage.wait_for_commands()
    at_rest = stage.robot["simulated"] + MOTION + SETTLING
    stage.wait_for_robot(lambda robot: robot["simulated"] >= at_rest)
    stage.wait(ON_ITS_WAY)


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
        stage.wait_for_commands()
        stage.wait(ON_ITS_WAY)
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
    stage.wait_for_commands()
    stage.wait(ON_ITS_WAY)
    _ask(stage, reordered, *([part] for part in parts))


def ask_once(stage: Stage, names: Names) -> None:
    """Ask for some joints."""
    _open(stage)
    _ask(stage, names)


def interrupt(stage: Stage, names: Names) -> None:
    """Ask once, then press Ctrl-C."""
    _open(stage)
    _ask(stage, names)
    stage.interrupt_node()
