"""What is done to a battery service. No expected answers here: this runs in the arena."""

from __future__ import annotations

from collections.abc import Sequence

from autograder.arena.stage import Stage
from humanoid_interfaces.srv import GetBatteryStatus

SERVICE = "get_battery_status"
PERIOD = 0.5  # s between two messages of the robot
ON_ITS_WAY = 1.1  # s; longer than the checks let a message be on its way
SILENCE = 2.5  # s; longer than the checks ask for


def _open(stage: Stage) -> None:
    stage.open(services={SERVICE: GetBatteryStatus})


def _let_it_be_known(stage: Stage, messages: int = 1) -> None:
    """Return when the battery has been published as it is now, and everybody has had the time to hear of it."""
    stage.wait_for_published("battery", messages)
    stage.wait(ON_ITS_WAY)


def ask_once(stage: Stage) -> None:
    """Ask when the robot has published twice, so that the first message is not the last."""
    _open(stage)
    _let_it_be_known(stage, messages=2)
    stage.call(SERVICE)


def ask_before_the_first_message(stage: Stage) -> None:
    """Ask while the battery sensor is unplugged; plug it in; ask again."""
    _open(stage)
    stage.wait(PERIOD)
    stage.call(SERVICE)
    stage.command_robot("battery_sensor", connected=True)
    _let_it_be_known(stage)
    stage.call(SERVICE)


def ask_at_levels(stage: Stage, levels: Sequence[float]) -> None:
    """Set the battery to each level (0..1) in turn and ask each time."""
    _open(stage)
    for level in levels:
        stage.command_robot("set_battery", percentage=level)
        _let_it_be_known(stage)
        stage.call(SERVICE)


def ask_after_the_sensor_stopped(stage: Stage) -> None:
    """Let the sensor publish, unplug it, ask."""
    _open(stage)
    _let_it_be_known(stage)
    stage.command_robot("battery_sensor", connected=False)
    stage.wait_for_commands()
    stage.wait(SILENCE)
    stage.call(SERVICE)


def ask_many_at_once(stage: Stage, bursts: int, burst: int) -> None:
    """Send `burst` requests without waiting in between, `bursts` times.

    A service keeps its last 10 requests: more than that at once would be lost through no fault of the node.
    """
    _open(stage)
    _let_it_be_known(stage)
    for _ in range(bursts):
        calls = [stage.send_call(SERVICE) for _ in range(burst)]
        answered = [stage.wait_for_answer(SERVICE, call) for call in calls]
        if not all(answered):
            return


def interrupt(stage: Stage) -> None:
    """Ask once, when a message has come, then press Ctrl-C."""
    _open(stage)
    stage.wait_for_published("battery", 1)
    stage.wait(PERIOD)
    stage.call(SERVICE)
    stage.interrupt_node()
