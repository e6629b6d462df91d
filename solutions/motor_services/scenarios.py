"""What is done to the motor services. No expected answers here: this runs in the arena."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from std_srvs.srv import SetBool, Trigger

from autograder.arena.stage import ServiceClient, Stage
from humanoid_interfaces.msg import RobotState

SETTLING = 1.3  # s for a change to be known everywhere; longer than the checks let a message be on its way
OBEYING = 2.0  # s for the motors to be as asked
STRIDES = 2.0  # s of walking before a request
WATCHING = 2.0  # s of walking after one; longer than the checks watch


class Motors(NamedTuple):
    """The two services."""

    enable: ServiceClient
    status: ServiceClient

    def switch(self, on: bool, *, as_: str = "") -> bool:
        """Ask for power on or off; returns whether there was an answer."""
        return self.enable.call(SetBool.Request(data=on), as_=as_)


def tell_the_status(stage: Stage) -> None:
    """Ask for the status, cut the power and ask, return it and ask: the node has no part in these changes."""
    motors = _open(stage)
    answered = motors.status.call(as_="status at first")
    for on in (False, True):
        if not answered:
            return
        stage.robot.set_motor_power(on)
        stage.robot.wait_for_commands()
        stage.wait(SETTLING)
        answered = motors.status.call(as_=f"status after {'on' if on else 'off'}")


def ask_before_the_first_message(stage: Stage) -> None:
    """Ask for the status while the robot is silent; let it speak; ask again."""
    motors = _open(stage)
    motors.status.call(as_="before the first message")
    stage.robot.publish_robot_state()
    stage.robot.wait_for_commands()
    stage.wait(SETTLING)
    motors.status.call(as_="after the first message")


def switch_off_and_on(stage: Stage) -> None:
    """Switch the motors off, ask for the status, switch them on, ask again."""
    motors = _open(stage)
    for on, name in ((False, "off"), (True, "on")):
        if not motors.switch(on, as_=name):
            return
        _watch_the_motors(stage, on)
        if not motors.status.call(as_=f"status after {name}"):
            return


def switch_off_while_walking(stage: Stage, velocity: Sequence[float]) -> None:
    """Make the robot walk (m/s, m/s, rad/s in base_link) and ask for power off."""
    _switch_off_while_walking(stage, _open(stage), velocity)


def switch_while_walking_and_after(stage: Stage, velocity: Sequence[float]) -> None:
    """Ask for power off and on while the robot walks, and for power off once it stands."""
    motors = _open(stage)
    _switch_off_while_walking(stage, motors, velocity)
    if not motors.switch(True, as_="on while walking"):
        return
    stage.wait(WATCHING)
    stage.robot.walk([0.0, 0.0, 0.0])
    stage.robot.wait_for(lambda robot: robot.mode != RobotState.WALKING)
    stage.wait(SETTLING)
    if motors.switch(False, as_="off once it stands"):
        _watch_the_motors(stage, False)


def ask_many_at_once(stage: Stage, bursts: int, switches: int, questions: int) -> None:
    """Ask for power on `switches` times and for the status `questions` times without waiting, `bursts` times."""
    motors = _open(stage)
    for _ in range(bursts):
        calls = [motors.enable.send(SetBool.Request(data=True)) for _ in range(switches)]
        calls += [motors.status.send() for _ in range(questions)]
        answered = [call.wait() for call in calls]
        if not all(answered):
            return


def interrupt(stage: Stage) -> None:
    """Ask for the status once, then press Ctrl-C."""
    _open(stage).status.call()
    stage.interrupt_node()


def _open(stage: Stage) -> Motors:
    motors = Motors(stage.service("enable_motors", SetBool), stage.service("get_status", Trigger))
    stage.open()
    stage.wait(SETTLING)
    return motors


def _switch_off_while_walking(stage: Stage, motors: Motors, velocity: Sequence[float]) -> None:
    stage.robot.walk(velocity)
    stage.robot.wait_for(lambda robot: robot.mode == RobotState.WALKING, timeout=5.0)
    stage.wait(STRIDES)
    if motors.switch(False, as_="off while walking"):
        stage.wait(WATCHING)


def _watch_the_motors(stage: Stage, on: bool) -> None:
    """Return when they are as asked, and everybody has had the time to know."""
    stage.robot.wait_for(lambda robot: robot.motors_enabled == on, timeout=OBEYING)
    stage.wait(SETTLING)
