"""The steps of scenarios for a battery service. No expected responses here: this runs in the arena."""

from __future__ import annotations

from autograder.arena.events import BatteryPublished
from autograder.arena.sequence import Steps, carry_out
from autograder.arena.stage import Stage
from humanoid_interfaces.srv import GetBatteryStatus

DELIVERY_TIME = 1.1  # s; longer than the model allows for the delivery of a message


def in_order(stage: Stage, steps: Steps, interrupt: bool = False) -> None:
    """Call the service, set the charge, unplug sensors and wait, in the order of the steps; then send SIGINT."""
    battery = stage.service("get_battery_status", GetBatteryStatus)
    stage.open()

    def let_publish(messages: int) -> None:
        stage.robot.wait_for_published(BatteryPublished, messages)
        stage.wait(DELIVERY_TIME)

    carry_out(
        stage,
        steps,
        {
            "ask": lambda number: battery.call_at_once([None] * number),
            "set_battery": stage.robot.set_battery,
            "unplug": lambda: stage.robot.connect_battery_sensor(False),
            "plug_in": stage.robot.connect_battery_sensor,
            "measure_charge": stage.robot.connect_charge_sensor,
            "set_clock": stage.robot.set_clock,
            "let_publish": let_publish,
            "wait": stage.wait,
        },
        {
            "ask": "{number} × get_battery_status",
            "let_publish": "wait for {messages} × battery_state",
        },
    )
    if interrupt:
        stage.interrupt_node()
