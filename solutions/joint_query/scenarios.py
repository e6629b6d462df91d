"""What is done to a joint query. No expected answers here: this runs in the arena."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from autograder.arena.sequence import Steps, carry_out
from autograder.arena.stage import Stage
from humanoid_interfaces.srv import GetJointPositions

ON_ITS_WAY = 1.2  # s; longer than the model lets a message be on its way, of which there are 20 a second
MOTION = 1.0  # s of the robot's time from one posture to the next
TURN = 3.0  # s of the robot's time for a motion that nobody waits for
REST_TIME = 0.3  # s of it to come to rest


def in_order(stage: Stage, steps: Steps, interrupt: bool = False) -> None:
    """Ask for lists of names at once, move joints, change what joint_states says, wait; then press Ctrl-C."""
    query = stage.service("get_joint_positions", GetJointPositions)
    stage.open()

    def ask(*lists: Sequence[str]) -> bool:
        return query.call_at_once([GetJointPositions.Request(names=list(names)) for names in lists])

    def move(posture: Mapping[str, float]) -> None:
        stage.robot.move_joints(posture, MOTION)
        stage.robot.wait(MOTION + REST_TIME)
        stage.wait(ON_ITS_WAY)

    def let_arrive() -> None:
        stage.robot.wait_for_commands()
        stage.wait(ON_ITS_WAY)

    carry_out(
        stage,
        steps,
        {
            "ask": ask,
            "move": move,
            "turn": lambda joint, position: stage.robot.move_joints({joint: position}, TURN),
            "read": stage.robot.set_joint_readings,
            "reverse": stage.robot.reverse_joint_states,
            "alternate": stage.robot.alternate_joint_states,
            "unplug": lambda: stage.robot.connect_joint_sensors(False),
            "plug_in": stage.robot.connect_joint_sensors,
            "set_clock": stage.robot.set_clock,
            "let_arrive": let_arrive,
            "wait": stage.wait,
        },
    )
    if interrupt:
        stage.interrupt_node()
