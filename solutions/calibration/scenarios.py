"""What is done to the calibration server. No expected answers here: this runs in the arena."""

from __future__ import annotations

from functools import partial

from geometry_msgs.msg import Vector3Stamped
from std_msgs.msg import Empty
from std_srvs.srv import Trigger

from autograder.arena.scripted_service import SILENCE, Reply, ScriptedService
from autograder.arena.sequence import Steps, carry_out
from autograder.arena.stage import Stage
from humanoid_interfaces.msg import RobotState
from ros_runtime.recorded_client.service_client import Call

SETTLING = 1.5  # s for a change to be known everywhere; longer than the model lets a message be on its way
ANSWERING = 8.0  # s that the longest calibration may take: asking, collecting, and some
ASKED = 1.0  # s for get_status to be asked; a server that never asks is past that, but not at its end
LISTENING = 3.0  # s for a first heartbeat, or for a latched message
WALKING = 5.0  # s for a robot to begin to walk, or to stand again
BIAS = (0.012, -0.008, 0.005)  # rad/s; far from zero, and no two axes alike
NO_VELOCITY = (0.0, 0.0, 0.0)


def in_order(stage: Stage, steps: Steps, hears_bias: bool = True, interrupt: bool = False) -> None:
    """Calibrate, change how get_status answers, walk, unplug the imu: in the order of the steps; then press Ctrl-C."""
    on = Reply(Trigger.Response(success=True, message="Motors: ON"))
    status = stage.offer_service("get_status", Trigger, on)
    heartbeat = stage.listen("heartbeat", Empty)
    if hears_bias:
        stage.listen("imu_bias", Vector3Stamped)
    calibrate = stage.service("calibrate_imu", Trigger)
    stage.open()
    stage.robot.set_gyro_bias(BIAS)
    stage.robot.wait_for_commands()
    stage.wait_until(lambda: heartbeat.messages, LISTENING)
    stage.wait(SETTLING)
    played = _Played(stage, status)
    on_their_way: list[Call] = []

    def begin(number: int = 1) -> None:
        asked = played.status.requests
        on_their_way.extend([calibrate.send() for _ in range(number)])
        stage.wait_for_requests(played.status, asked + 1, ASKED)

    def send() -> None:
        on_their_way.append(calibrate.send())

    def end() -> bool:
        answered = [call.wait(ANSWERING) for call in on_their_way]
        on_their_way.clear()
        return all(answered)

    def listen() -> None:
        late = stage.listen("imu_bias", Vector3Stamped, latched=True)
        stage.wait_until(lambda: late.messages, LISTENING)

    carry_out(
        stage,
        steps,
        {
            "calibrate": lambda: calibrate.call(timeout=ANSWERING),
            "begin": begin,
            "send": send,
            "end": end,
            "status_answers": played.answer,
            "status_is_silent": played.fall_silent,
            "status_says_no": partial(played.answer, success=False),
            "withdraw_status": lambda: played.status.withdraw(),
            "offer_status": played.offer,
            "set_bias": lambda *bias: _command(stage, stage.robot.set_gyro_bias, bias),
            "unplug_imu": lambda: _command(stage, stage.robot.connect_imu, False),
            "plug_in_imu": lambda: _command(stage, stage.robot.connect_imu, True),
            "publish_robot_state": lambda: _command(stage, stage.robot.publish_robot_state),
            "walk": partial(_walk, stage),
            "walk_steps": partial(_walk_steps, stage),
            "stand": partial(_stand, stage),
            "listen": listen,
            "wait": stage.wait,
        },
    )
    if interrupt:
        stage.interrupt_node()


class _Played:
    """get_status, which the grader plays, and how it treats the next requests."""

    def __init__(self, stage: Stage, status: ScriptedService) -> None:
        self._stage = stage
        self.status = status

    def answer(self, after: float, success: bool = True) -> None:
        response = Trigger.Response(success=success, message="Motors: ON" if success else "Motors: unknown")
        self.status.reply_with(Reply(response, after=after))

    def fall_silent(self) -> None:
        self.status.reply_with(SILENCE)

    def offer(self) -> None:
        on = Reply(Trigger.Response(success=True, message="Motors: ON"))
        self.status = self._stage.offer_service("get_status", Trigger, on)


def _command(stage: Stage, command: object, *arguments: object) -> None:
    """Give the robot a command and wait until it has taken effect."""
    command(*arguments)  # type: ignore[operator]
    stage.robot.wait_for_commands()


def _walk(stage: Stage, *velocity: float) -> None:
    """Make the robot walk (m/s, m/s, rad/s in base_link)."""
    stage.robot.walk(velocity)
    stage.robot.wait_for(lambda robot: robot.mode == RobotState.WALKING, timeout=WALKING)


def _walk_steps(stage: Stage, steps: int, *velocity: float) -> None:
    """Make the robot walk (m/s, m/s, rad/s in base_link) and stop it after so many steps."""
    before = stage.robot.state.steps
    _walk(stage, *velocity)
    stage.robot.wait_for(lambda robot: robot.steps >= before + steps, timeout=WALKING)
    stage.robot.walk(NO_VELOCITY)


def _stand(stage: Stage) -> None:
    stage.robot.walk(NO_VELOCITY)
    stage.robot.wait_for(lambda robot: robot.mode == RobotState.STANDING, timeout=WALKING)
