"""What is done to the motor services. No expected answers here: this runs in the arena."""

from __future__ import annotations

from collections.abc import Sequence

from std_srvs.srv import SetBool, Trigger

from autograder.arena.stage import Stage

ENABLE = "enable_motors"
STATUS = "get_status"
WALKING = 2  # humanoid_interfaces/RobotState
SETTLING = 1.3  # s for a change to be known everywhere; longer than the checks let a message be on its way
OBEYING = 2.0  # s for the motors to be as asked
STRIDES = 2.0  # s of walking before a request
WATCHING = 2.0  # s of walking after one; longer than the checks watch


def tell_the_status(stage: Stage) -> None:
    """Ask for the status, cut the power and ask, return it and ask: the node has no part in these changes."""
    _open(stage)
    if not _ask_status(stage):
        return
    for on in (False, True):
        stage.command_robot("motor_power", on=on)
        stage.wait_for_commands()
        stage.wait(SETTLING)
        if not _ask_status(stage):
            return


def ask_before_the_first_message(stage: Stage) -> None:
    """Ask for the status while the robot is silent; let it speak; ask again."""
    _open(stage)
    _ask_status(stage)
    stage.command_robot("robot_state", published=True)
    stage.wait_for_commands()
    stage.wait(SETTLING)
    _ask_status(stage)


def switch_off_and_on(stage: Stage) -> None:
    """Switch the motors off, ask for the status, switch them on, ask again."""
    _open(stage)
    for on in (False, True):
        if not _switch(stage, on):
            return
        _watch_the_motors(stage, on)
        if not _ask_status(stage):
            return


def switch_off_while_walking(stage: Stage, velocity: Sequence[float]) -> None:
    """Make the robot walk (m/s, m/s, rad/s in base_link) and ask for power off."""
    _open(stage)
    _walk(stage, velocity)
    if _switch(stage, False):
        stage.wait(WATCHING)


def switch_while_walking_and_after(stage: Stage, velocity: Sequence[float]) -> None:
    """Ask for power off and on while the robot walks, and for power off once it stands."""
    switch_off_while_walking(stage, velocity)
    if not _switch(stage, True):
        return
    stage.wait(WATCHING)
    stage.command_robot("walk", velocity=[0.0, 0.0, 0.0])
    stage.wait_for_robot(lambda robot: robot["mode"] != WALKING)
    stage.wait(SETTLING)
    if _switch(stage, False):
        _watch_the_motors(stage, False)


def ask_many_at_once(stage: Stage, bursts: int, switches: int, questions: int) -> None:
    """Ask for power on `switches` times and for the status `questions` times without waiting, `bursts` times."""
    _open(stage)
    for _ in range(bursts):
        sent = [(ENABLE, stage.send_call(ENABLE, {"data": True})) for _ in range(switches)]
        sent += [(STATUS, stage.send_call(STATUS)) for _ in range(questions)]
        answered = [stage.wait_for_answer(service, call) for service, call in sent]
        if not all(answered):
            return


def interrupt(stage: Stage) -> None:
    """Ask for the status once, then press Ctrl-C."""
    _open(stage)
    _ask_status(stage)
    stage.interrupt_node()


def _open(stage: Stage) -> None:
    stage.open(services={ENABLE: SetBool, STATUS: Trigger})
    stage.wait(SETTLING)


def _walk(stage: Stage, velocity: Sequence[float]) -> None:
    stage.command_robot("walk", velocity=list(velocity))
    stage.wait_for_robot(lambda robot: robot["mode"] == WALKING, timeout=5.0)
    stage.wait(STRIDES)


def _switch(stage: Stage, on: bool) -> bool:
    return stage.wait_for_answer(ENABLE, stage.send_call(ENABLE, {"data": on}))


def _watch_the_motors(stage: Stage, on: bool) -> None:
    """Return when they are as asked, and everybody has had the time to know."""
    stage.wait_for_robot(lambda robot: robot["motors_enabled"] == on, timeout=OBEYING)
    stage.wait(SETTLING)


def _ask_status(stage: Stage) -> bool:
    return stage.wait_for_answer(STATUS, stage.send_call(STATUS))
