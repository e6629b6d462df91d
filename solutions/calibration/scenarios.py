"""What is done to the calibration server. No expected answers here: this runs in the arena."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from geometry_msgs.msg import Vector3Stamped
from std_msgs.msg import Empty
from std_srvs.srv import Trigger

from autograder.arena.scripted_service import SILENCE, Reply, ScriptedService
from autograder.arena.stage import ServiceClient, Stage
from humanoid_interfaces.msg import RobotState

SETTLING = 1.5  # s for a change to be known everywhere; longer than the checks let a message be on its way
ANSWERING = 8.0  # s that the longest calibration may take: asking, collecting, and some
PUBLISHING = 1.5  # s for imu_bias to be heard after an answer
ASKED = 1.0  # s for get_status to be asked; a server that never asks is past that, but not at its end
LISTENING = 3.0  # s for a first heartbeat, or for a latched message
BIAS = (0.012, -0.008, 0.005)  # rad/s; far from zero, and no two axes alike
NO_VELOCITY = (0.0, 0.0, 0.0)

ON = Reply(Trigger.Response(success=True, message="Motors: ON"))


def after(seconds: float) -> Reply:
    """Return the answer of get_status so many s after the request."""
    return Reply(ON.response, after=seconds)


class Played(NamedTuple):
    """The student's service, and get_status, which the grader plays."""

    calibrate: ServiceClient
    status: ScriptedService | None


def interrupt(stage: Stage) -> None:
    """Press Ctrl-C."""
    _open(stage)
    stage.interrupt_node()


def calibrate_twice(stage: Stage, biases: Sequence[Sequence[float]]) -> None:
    """Calibrate, give the gyro another bias, calibrate again."""
    calibrate = _open(stage, bias=biases[0]).calibrate
    for bias, name in zip(biases, ("first", "second"), strict=False):
        stage.robot.set_gyro_bias(bias)
        stage.robot.wait_for_commands()
        stage.wait(SETTLING)
        if not calibrate.call(as_=name, timeout=ANSWERING):
            return
        stage.wait(PUBLISHING)


def calibrate_and_listen_late(stage: Stage, bias: Sequence[float]) -> None:
    """Calibrate, and subscribe to imu_bias only afterwards."""
    calibrate = _open(stage, bias=bias, hears_bias=False).calibrate
    if calibrate.call(as_="before anybody listens", timeout=ANSWERING):
        stage.wait(PUBLISHING)
        late = stage.listen("imu_bias", Vector3Stamped, latched=True)
        stage.wait_until(lambda: late.messages, LISTENING)


def calibrate_with_slow_status(stage: Stage, status_after: float, bias: Sequence[float]) -> None:
    """Calibrate while get_status takes its time."""
    played = _open(stage, after(status_after), bias=bias)
    played.calibrate.call(as_="slow status", timeout=ANSWERING)
    stage.wait(PUBLISHING)


def calibrate_while_walking(stage: Stage, velocity: Sequence[float]) -> None:
    """Make the robot walk (m/s, m/s, rad/s in base_link) and ask for a calibration."""
    calibrate = _open(stage).calibrate
    _walk(stage, velocity)
    stage.wait(SETTLING)
    calibrate.call(as_="while it walks", timeout=ANSWERING)
    stage.wait(PUBLISHING)


def begin_to_walk_meanwhile(stage: Stage, begin: float, velocity: Sequence[float], steps: int) -> None:
    """Let the robot begin to walk `begin` s after get_status was answered; stop it after `steps` (0: never)."""
    played = _open(stage)
    call = played.calibrate.send(as_="it begins to walk")
    _wait_until_asked(stage, played)
    stage.wait(begin)
    _walk(stage, velocity)
    if steps:
        before = stage.robot.state.steps
        stage.robot.wait_for(lambda robot: robot.steps >= before + steps, timeout=LISTENING)
        stage.robot.walk(NO_VELOCITY)
    call.wait(ANSWERING)
    stage.wait(PUBLISHING)


def calibrate_before_the_first_state(stage: Stage) -> None:
    """Ask while robot_state is silent; let it speak; ask again."""
    calibrate = _open(stage).calibrate
    if not calibrate.call(as_="before the first state", timeout=ANSWERING):
        return
    stage.robot.publish_robot_state()
    stage.robot.wait_for_commands()
    stage.wait(SETTLING)
    calibrate.call(as_="after the first state", timeout=ANSWERING)
    stage.wait(PUBLISHING)


def calibrate_from_two_clients(stage: Stage, apart: float, status_after: float) -> None:
    """Send a second request `apart` s after get_status was asked for the first one."""
    played = _open(stage, after(status_after))
    first = played.calibrate.send(as_="first caller")
    _wait_until_asked(stage, played)
    stage.wait(apart)
    second = played.calibrate.send(as_="second caller")
    if first.wait(ANSWERING):
        second.wait(ANSWERING)


def calibrate_without_an_answer(stage: Stage) -> None:
    """Ask while get_status is silent, and again when it answers."""
    calibrate = _open(stage, SILENCE, ON).calibrate
    if calibrate.call(as_="silent status", timeout=ANSWERING):
        stage.wait(PUBLISHING)
        calibrate.call(as_="status is back", timeout=ANSWERING)
        stage.wait(PUBLISHING)


def calibrate_without_status(stage: Stage) -> None:
    """Ask while nobody offers get_status."""
    calibrate = _open(stage, offers_status=False).calibrate
    calibrate.call(as_="nobody offers get_status", timeout=ANSWERING)
    stage.wait(PUBLISHING)


def answer_the_request_before(stage: Stage, status_after: float) -> None:
    """Answer get_status `status_after` s late, when the next calibration waits for an answer of its own."""
    calibrate = _open(stage, after(status_after), SILENCE).calibrate
    if calibrate.call(as_="late answer", timeout=ANSWERING):
        calibrate.call(as_="answer of another", timeout=ANSWERING)
        stage.wait(PUBLISHING)


def lose_the_imu(stage: Stage, begin: float) -> None:
    """Unplug the imu `begin` s after get_status was answered (0: before the request)."""
    played = _open(stage)
    if not begin:
        stage.robot.connect_imu(False)
        stage.robot.wait_for_commands()
        stage.wait(SETTLING)
    call = played.calibrate.send(as_="the imu falls silent")
    if begin:
        _wait_until_asked(stage, played)
        stage.wait(begin)
        stage.robot.connect_imu(False)
    call.wait(ANSWERING)
    stage.wait(PUBLISHING)


def _open(
    stage: Stage,
    *replies: Reply | None,
    bias: Sequence[float] = BIAS,
    offers_status: bool = True,
    hears_bias: bool = True,
) -> Played:
    """Play get_status, listen, give the gyro a bias, and wait for the first heartbeat."""
    status = stage.offer_service("get_status", Trigger, *(replies or (ON,))) if offers_status else None
    heartbeat = stage.listen("heartbeat", Empty)
    if hears_bias:
        stage.listen("imu_bias", Vector3Stamped)
    played = Played(stage.service("calibrate_imu", Trigger), status)
    stage.open()
    stage.robot.set_gyro_bias(bias)
    stage.robot.wait_for_commands()
    stage.wait_until(lambda: heartbeat.messages, LISTENING)
    stage.wait(SETTLING)
    return played


def _wait_until_asked(stage: Stage, played: Played) -> None:
    if played.status:
        stage.wait_for_requests(played.status, 1, ASKED)


def _walk(stage: Stage, velocity: Sequence[float]) -> None:
    stage.robot.walk(velocity)
    stage.robot.wait_for(lambda robot: robot.mode == RobotState.WALKING, timeout=5.0)
