"""What is done to the calibration server. No expected answers here: this runs in the arena."""

from __future__ import annotations

from collections.abc import Callable

from geometry_msgs.msg import Vector3Stamped
from std_msgs.msg import Empty
from std_srvs.srv import Trigger

from autograder.arena.scripted_service import SILENCE, Reply, ScriptedService
from autograder.arena.sequence import Steps, carry_out
from autograder.arena.stage import Stage
from humanoid_interfaces.msg import RobotState
from ros_runtime.recorded_client.service_client import Call

KNOWN_TIME = 1.5  # s for a change to be known everywhere; longer than the model lets a message be on its way
ANSWERING = 8.0  # s that the longest calibration may take: asking, collecting, and some
ASKED = 1.0  # s for get_status to be asked; a server that never asks is past that, but not at its end
LISTENING = 3.0  # s for a first heartbeat, or for a latched message
WALKING = 5.0  # s for a robot to begin to walk, or to stand again
BIAS = (0.012, -0.008, 0.005)  # rad/s; far from zero, and no two axes alike
NO_VELOCITY = (0.0, 0.0, 0.0)


def in_order(stage: Stage, steps: Steps, hears_bias: bool = True, interrupt: bool = False) -> None:
    """Calibrate, change how get_status answers, walk, unplug the imu: in the order of the steps; then press Ctrl-C."""
    robot = stage.robot

    def offer() -> ScriptedService:
        return stage.offer_service("get_status", Trigger, _reply(0.0))

    status = [offer()]  # the last one answers
    heartbeat = stage.listen("heartbeat", Empty)
    if hears_bias:
        stage.listen("imu_bias", Vector3Stamped)
    calibrate = stage.service("calibrate_imu", Trigger)
    stage.open()
    robot.set_gyro_bias(BIAS)
    robot.wait_for_commands()
    stage.wait_until(lambda: heartbeat.messages, LISTENING)
    stage.wait(KNOWN_TIME)
    on_their_way: list[Call] = []

    def begin(number: int = 1) -> None:
        asked = status[-1].requests
        on_their_way.extend([calibrate.send() for _ in range(number)])
        stage.wait_for_requests(status[-1], asked + 1, ASKED)

    def end() -> bool:
        answered = [call.wait(ANSWERING) for call in on_their_way]
        on_their_way.clear()
        return all(answered)

    def listen() -> None:
        late = stage.listen("imu_bias", Vector3Stamped, latched=True)
        stage.wait_until(lambda: late.messages, LISTENING)

    def command(give: Callable[..., None]) -> Callable[..., None]:
        def until_it_has_taken_effect(*arguments: object) -> None:
            give(*arguments)
            robot.wait_for_commands()

        return until_it_has_taken_effect

    def walk(*velocity: float) -> None:
        robot.walk(velocity)
        robot.wait_for(lambda state: state.mode == RobotState.WALKING, timeout=WALKING)

    def walk_steps(number: int, *velocity: float) -> None:
        before = robot.state.steps
        walk(*velocity)
        robot.wait_for(lambda state: state.steps >= before + number, timeout=WALKING)
        robot.walk(NO_VELOCITY)

    def stand() -> None:
        robot.walk(NO_VELOCITY)
        robot.wait_for(lambda state: state.mode == RobotState.STANDING, timeout=WALKING)

    carry_out(
        stage,
        steps,
        {
            "calibrate": lambda: calibrate.call(timeout=ANSWERING),
            "begin": begin,
            "send": lambda: on_their_way.append(calibrate.send()),
            "end": end,
            "status_answers": lambda after: status[-1].reply_with(_reply(after)),
            "status_is_silent": lambda: status[-1].reply_with(SILENCE),
            "status_says_no": lambda after: status[-1].reply_with(_reply(after, success=False)),
            "withdraw_status": lambda: status[-1].withdraw(),
            "offer_status": lambda: status.append(offer()),
            "set_bias": command(lambda *bias: robot.set_gyro_bias(bias)),
            "unplug_imu": command(lambda: robot.connect_imu(False)),
            "plug_in_imu": command(robot.connect_imu),
            "publish_robot_state": command(robot.publish_robot_state),
            "walk": walk,
            "walk_steps": walk_steps,
            "stand": stand,
            "listen": listen,
            "wait": stage.wait,
        },
    )
    if interrupt:
        stage.interrupt_node()


def _reply(after: float, success: bool = True) -> Reply:
    """Return an answer of get_status that is sent so many seconds after the request."""
    message = "Motors: ON" if success else "Motors: unknown"
    return Reply(Trigger.Response(success=success, message=message), after=after)
