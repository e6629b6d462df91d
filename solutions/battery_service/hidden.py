"""What only the instructor's grading checks."""

from __future__ import annotations

from autograder.checks import RESTING, CheckList, Scenario, expect
from autograder.common_checks import require_calls
from autograder.transcript import Transcript

from .checks import SENSOR_UNPLUGGED
from .judging import (
    require_last_message,
    require_last_message_after_plugging_in,
    require_last_message_after_silence,
    require_last_message_at_each_level,
)

CHECKS = CheckList(hidden=True)

RANDOM_LEVELS = Scenario(
    "ask_at_levels",
    lambda random: {"levels": [round(random.uniform(0.05, 0.95), 3) for _ in range(4)]},
    robot=RESTING,
)
SENSOR_STOPPED = Scenario("ask_after_the_sensor_stopped", robot=RESTING)
MANY_AT_ONCE = Scenario("ask_many_at_once", {"bursts": 4, "burst": 8}, robot=RESTING)
OTHER_NAMESPACE = Scenario("ask_once", robot=RESTING, namespace="/lab_7/robot")


@CHECKS.check(
    points=1, on=SENSOR_UNPLUGGED, needs=["answers_with_the_last_message", "says_when_it_knows_nothing"]
)
def recovers_when_the_sensor_appears(run: Transcript) -> None:
    """Once the first message has come, it answers with it"""
    require_last_message_after_plugging_in(run)


@CHECKS.check(points=1, on=[RANDOM_LEVELS, SENSOR_STOPPED], needs=["follows_the_battery"])
def keeps_the_last_message(changing: Transcript, stopped: Transcript) -> None:
    """Whatever the charge, and also when the sensor falls silent, it answers with the last message"""
    require_last_message_at_each_level(changing)
    require_last_message_after_silence(stopped)


@CHECKS.check(points=1, on=MANY_AT_ONCE, needs=["answers_with_the_last_message"])
def answers_every_request(run: Transcript) -> None:
    """Eight requests at once, four times, are all answered, each within 2 s"""
    calls = require_calls(run, run.params["bursts"] * run.params["burst"])
    latencies = [call.latency for call in calls]
    expect(
        max(latencies) <= 2.0,
        expected="every answer within 2 s",
        observed=f"the slowest of {len(latencies)} took {max(latencies):.1f} s",
        help="Answer from memory: the callback must not sleep or wait for the next message.",
    )


@CHECKS.check(points=1, on=OTHER_NAMESPACE, needs=["answers_with_the_last_message"])
def works_in_any_namespace(run: Transcript) -> None:
    """Started in another namespace, it serves the robot there"""
    require_last_message(run)
