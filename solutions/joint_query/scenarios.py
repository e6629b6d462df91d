"""What is done to a joint query. No expected answers here: this runs in the arena."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from autograder.arena.stage import ServiceClient, Stage
from humanoid_interfaces.srv import GetJointPositions

ON_ITS_WAY = 1.2  # s; longer than the checks let a message be on its way, of which there are 20 a second
MOTION = 1.0  # s of the robot's time from one posture to the next
SETTLING = 0.3  # s of it to come to rest

Names = Sequence[str]
Posture = Mapping[str, float]  # rad


def ask(stage: Stage, names: Names, posture: Posture, strangers: Names) -> None:
    """Ask for some joints, for all, for those that have moved, for some that do not exist, and for one again."""
    query = _open(stage)
    if _ask(query, {"some joints": names, "all joints": []}):
        _move(stage, posture)
        _ask(query, {"moved joints": list(posture), "strangers": strangers, "one joint": names[:1]})


def ask_before_the_first_message(stage: Stage, names: Names) -> None:
    """Ask for some joints and for all while the joint sensors are unplugged; plug them in; ask for one."""
    query = _open(stage)
    if _ask(query, {"some joints": names, "all joints": []}):
        stage.robot.connect_joint_sensors()
        stage.robot.wait_for_commands()
        stage.wait(ON_ITS_WAY)
        _ask(query, {"after the first message": names[:1]})


def ask_in_every_way(
    stage: Stage, posture: Posture, burst: Mapping[str, Names], reordered: Names, parts: Mapping[str, Names]
) -> None:
    """Ask in a posture, for several lists at once, with another order on the topic, and for parts of names.

    A service keeps its last 10 requests: `burst` may not hold more.
    """
    query = _open(stage)
    _move(stage, posture)
    if not _ask(query, {"in a posture": list(posture)}):
        return
    at_once = [query.send(_request(names), as_=name) for name, names in burst.items()]
    answered = [call.wait() for call in at_once]
    if not all(answered):
        return
    stage.robot.reverse_joint_states()
    stage.robot.wait_for_commands()
    stage.wait(ON_ITS_WAY)
    _ask(query, {"in another order": reordered, **parts})


def ask_once(stage: Stage, names: Names) -> None:
    """Ask for some joints."""
    _ask(_open(stage), {"some joints": names})


def interrupt(stage: Stage, names: Names) -> None:
    """Ask once, then press Ctrl-C."""
    ask_once(stage, names)
    stage.interrupt_node()


def _open(stage: Stage) -> ServiceClient:
    query = stage.service("get_joint_positions", GetJointPositions)
    stage.open()
    stage.wait(ON_ITS_WAY)
    return query


def _ask(query: ServiceClient, requests: Mapping[str, Names]) -> bool:
    """Ask for one list of names after the other until there is no answer; returns whether all came."""
    return all(query.call(_request(names), as_=name) for name, names in requests.items())


def _request(names: Names) -> GetJointPositions.Request:
    return GetJointPositions.Request(names=list(names))


def _move(stage: Stage, posture: Posture) -> None:
    stage.robot.move_joints(posture, MOTION)
    stage.robot.wait(MOTION + SETTLING)
    stage.wait(ON_ITS_WAY)
