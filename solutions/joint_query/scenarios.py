"""The steps of scenarios for a joint query. No expected responses here: this runs in the arena."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from autograder.arena.sequence import Steps, carry_out
from autograder.arena.stage import Stage
from humanoid_interfaces.srv import GetJointPositions

DELIVERY_TIME = 1.2  # s; longer than the model allows for the delivery of a message
MOTION_DURATION = 1.0  # s of the robot's time, from one posture to the next
TURN_DURATION = 3.0  # s of the robot's time, for a motion during which the scenario goes on
REST_TIME = 0.3  # s of the robot's time, to come to rest


def in_order(stage: Stage, steps: Steps, interrupt: bool = False) -> None:
    """Send several requests at once, move joints, change joint_states, wait, in the order of the steps; then SIGINT."""
    query = stage.service("get_joint_positions", GetJointPositions)
    stage.open()

    def ask(*lists: Sequence[str]) -> bool:
        return query.call_at_once([GetJointPositions.Request(names=list(names)) for names in lists])

    def move(posture: Mapping[str, float]) -> None:
        stage.robot.move_joints(posture, MOTION_DURATION)
        stage.robot.wait(MOTION_DURATION + REST_TIME)
        stage.wait(DELIVERY_TIME)

    def let_arrive() -> None:
        stage.robot.wait_for_commands()
        stage.wait(DELIVERY_TIME)

    carry_out(
        stage,
        steps,
        {
            "ask": ask,
            "move": move,
            "turn": lambda joint, position: stage.robot.move_joints({joint: position}, TURN_DURATION),
            "read": stage.robot.set_joint_readings,
            "reverse": stage.robot.reverse_joint_states,
            "alternate": stage.robot.alternate_joint_states,
            "unplug": lambda: stage.robot.connect_joint_sensors(False),
            "plug_in": stage.robot.connect_joint_sensors,
            "set_clock": stage.robot.set_clock,
            "let_arrive": let_arrive,
            "wait": stage.wait,
        },
        {
            "ask": "get_joint_positions at once for each of {lists}",
            "let_arrive": "wait for the messages",
        },
    )
    if interrupt:
        stage.interrupt_node()
