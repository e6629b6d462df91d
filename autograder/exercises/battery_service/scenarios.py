"""What is done to a battery service. No expected answers here: this runs in the arena."""

from __future__ import annotations

from collections.abc import Sequence

from autograder.arena.stage import Stage
from humanoid_interfaces.srv import GetBatteryStatus

SERVICE = "get_battery_status"
BATTERY_PERIOD = 0.5  # s between two messages of the robot
SEVERAL_MESSAGES = 8 * BATTERY_PERIOD  # longer than the checks let a message be on its way


def _open(stage: Stage) -> None:
    stage.open(services={SERVICE: GetBatteryStatus})


def ask_once(stage: Stage) -> None:
    """Ask when the robot has published for a while."""
    _open(stage)
    stage.wait(SEVERAL_MESSAGES)
    stage.call(SERVICE)


def ask_before_the_first_message(stage: Stage) -> None:
    """Ask while the battery sensor is unplugged; plug it in; ask again."""
    _open(stage)
    stage.wait(SEVERAL_MESSAGES)
    stage.call(SERVICE)
    stage.command_robot("battery_sensor", connected=True)
    stage.wait(SEVERAL_MESSAGES)
    stage.call(SERVICE)


def ask_at_levels(stage: Stage, levels: Sequence[float]) -> None:
    """Set the battery to each level (0..1) in turn and ask each time."""
    _open(stage)
    for level in levels:
        stage.command_robot("set_battery", percentage=level)
        stage.wait(SEVERAL_MESSAGES)
        stage.call(SERVICE)


def ask_after_the_sensor_stopped(stage: Stage) -> None:
    """Let the sensor publish, unplug it, ask."""
    _open(stage)
    stage.wait(SEVERAL_MESSAGES)
    stage.command_robot("battery_sensor", connected=False)
    stage.wait(SEVERAL_MESSAGES)
    stage.call(SERVICE)


def ask_many_at_once(stage: Stage, bursts: int, burst: int) -> None:
    """Send `burst` requests without waiting in between, `bursts` times.

    A service keeps its last 10 requests: more than that at once would be lost through no fault of the node.
    """
    _open(stage)
    stage.wait(SEVERAL_MESSAGES)
    for _ in range(bursts):
        calls = [stage.send_call(SERVICE) for _ in range(burst)]
        answered = [stage.wait_for_answer(SERVICE, call) for call in calls]
        if not all(answered):
            return


def interrupt(stage: Stage) -> None:
    """Ask once, then press Ctrl-C."""
    ask_once(stage)
    stage.interrupt_node()
