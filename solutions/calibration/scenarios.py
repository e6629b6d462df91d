"""The steps of scenarios for a calibration server. No expected responses here: this runs in the arena."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps

from geometry_msgs.msg import Vector3Stamped
from std_msgs.msg import Empty
from std_srvs.srv import Trigger

from autograder.arena.scripted_service import SILENCE, Reply, ScriptedService
from autograder.arena.sequence import Steps, carry_out
from autograder.arena.stage import Stage
from humanoid_interfaces.msg import RobotState
from ros_runtime.recorded_client.service_client import Call

SETTLE_TIME = 1.5  # s for a change to reach every node; longer than the model allows for a message
RESPONSE_TIMEOUT = 8.0  # s for the longest calibration: call get_status, collect, and some slack
STATUS_REQUEST_TIMEOUT = 1.0  # s for the request to get_status
MESSAGE_TIMEOUT = 3.0  # s for a first heartbeat, or for a latched message
WALK_TIMEOUT = 5.0  # s for a robot to begin to walk, or to stand again
BIAS = (0.012, -0.008, 0.005)  # rad/s; no axis near zero, and no two axes alike
NO_VELOCITY = (0.0, 0.0, 0.0)


def in_order(stage: Stage, steps: Steps, hears_bias: bool = True, interrupt: bool = False) -> None:
    """Calibrate, change get_status's responses, walk, unplug the imu, in the order of the steps; then send SIGINT."""
    robot = stage.robot

    def offer() -> ScriptedService:
        return stage.offer_service("get_status", Trigger, _reply(0.0))

    status = [offer()]  # the last one is the current server
    heartbeat = stage.listen("heartbeat", Empty)
    if hears_bias:
        stage.listen("imu_bias", Vector3Stamped)
    calibrate = stage.service("calibrate_imu", Trigger)
    stage.open()
    robot.set_gyro_bias(BIAS)
    robot.wait_for_commands()
    stage.wait_until(lambda: heartbeat.messages, MESSAGE_TIMEOUT)
    stage.wait(SETTLE_TIME)
    pending: list[Call] = []

    def begin(number: int = 1) -> None:
        asked = status[-1].requests
        pending.extend([calibrate.send() for _ in range(number)])
        stage.wait_for_requests(status[-1], asked + 1, STATUS_REQUEST_TIMEOUT)

    def end() -> bool:
        answered = [call.wait(RESPONSE_TIMEOUT) for call in pending]
        pending.clear()
        return all(answered)

    def listen() -> None:
        late = stage.listen("imu_bias", Vector3Stamped, latched=True)
        stage.wait_until(lambda: late.messages, MESSAGE_TIMEOUT)

    def command(give: Callable[..., None]) -> Callable[..., None]:
        @wraps(give)
        def until_it_has_taken_effect(*arguments: object) -> None:
            give(*arguments)
            robot.wait_for_commands()

        return until_it_has_taken_effect

    def walk(*velocity: float) -> None:
        robot.walk(velocity)
        robot.wait_for(lambda state: state.mode == RobotState.WALKING, timeout=WALK_TIMEOUT)

    def walk_steps(number: int, *velocity: float) -> None:
        before = robot.state.steps
        walk(*velocity)
        robot.wait_for(lambda state: state.steps >= before + number, timeout=WALK_TIMEOUT)
        robot.walk(NO_VELOCITY)

    def stand() -> None:
        robot.walk(NO_VELOCITY)
        robot.wait_for(lambda state: state.mode == RobotState.STANDING, timeout=WALK_TIMEOUT)

    carry_out(
        stage,
        steps,
        {
            "calibrate": lambda: calibrate.call(timeout=RESPONSE_TIMEOUT),
            "begin": begin,
            "send": lambda: pending.append(calibrate.send()),
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
        {
            "calibrate": "calibrate_imu",
            "begin": "begin {number} × calibrate_imu",
            "send": "begin another calibrate_imu",
            "end": "wait for all answers",
        },
    )
    if interrupt:
        stage.interrupt_node()


def _reply(after: float, success: bool = True) -> Reply:
    """Return a response of get_status that is sent `after` s after the request."""
    message = "Motors: ON" if success else "Motors: unknown"
    return Reply(Trigger.Response(success=success, message=message), after=after)
