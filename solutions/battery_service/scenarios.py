"""What is done to a battery service. No expected answers here: this runs in the arena."""

from __future__ import annotations

from collections.abc import Sequence

from autograder.arena.events import BatteryPublished
from autograder.arena.stage import ServiceClient, Stage
from humanoid_interfaces.srv import GetBatteryStatus

ON_ITS_WAY = 1.1  # s; longer than the checks let a message be on its way
SILENCE = 2.5  # s; longer than the checks ask for


def ask_once(stage: Stage) -> None:
    """Ask when the robot has published twice, so that the first message is not the last."""
    _open(stage, messages=2).call(as_="once")


def ask_before_the_first_message(stage: Stage) -> None:
    """Ask while the battery sensor is unplugged; plug it in; ask again."""
    battery = _open(stage, messages=0)
    battery.call(as_="before the first message")
    stage.robot.connect_battery_sensor()
    _let_it_be_known(stage)
    battery.call(as_="after the first message")


def ask_at_levels(stage: Stage, levels: Sequence[float]) -> None:
    """Set the battery to each level (0..1) in turn and ask each time."""
    battery = _open(stage, messages=0)
    for level in levels:
        stage.robot.set_battery(level)
        _let_it_be_known(stage)
        battery.call(as_=f"at {level:g}")


def ask_after_the_sensor_stopped(stage: Stage) -> None:
    """Let the sensor publish, unplug it, ask."""
    battery = _open(stage)
    stage.robot.connect_battery_sensor(False)
    stage.robot.wait_for_commands()
    stage.wait(SILENCE)
    battery.call(as_="in silence")


def ask_many_at_once(stage: Stage, bursts: int, burst: int) -> None:
    """Send `burst` requests without waiting in between, `bursts` times."""
    battery = _open(stage)
    battery.call_at_once([None] * burst, times=bursts)


def interrupt(stage: Stage) -> None:
    """Ask once, when a message has come, then press Ctrl-C."""
    _open(stage).call()
    stage.interrupt_node()


def _open(stage: Stage, messages: int = 1) -> ServiceClient:
    """Find the service, and let the robot publish its battery so many times."""
    battery = stage.service("get_battery_status", GetBatteryStatus)
    stage.open()
    _let_it_be_known(stage, messages)
    return battery


def _let_it_be_known(stage: Stage, messages: int = 1) -> None:
    stage.robot.wait_for_published(BatteryPublished, messages)
    stage.wait(ON_ITS_WAY)
