"""What only the instructor's grading checks."""

from __future__ import annotations

from autograder.authoring import standard_hidden
from autograder.authoring.checks import RESTING, Scenario, check
from autograder.authoring.transcript import Transcript

from .checks import UNPLUGGED, answers_with_the_last_message, follows_the_battery, says_when_it_knows_nothing
from .judging import require_at_each_level, require_in_silence, require_last_message

RANDOM_LEVELS = Scenario(
    "ask_at_levels",
    lambda random: {"levels": [round(random.uniform(0.05, 0.95), 3) for _ in range(4)]},
    robot=RESTING,
)
SENSOR_STOPPED = Scenario("ask_after_the_sensor_stopped", robot=RESTING)
MANY_AT_ONCE = Scenario("ask_many_at_once", {"bursts": 4, "burst": 8}, robot=RESTING)
OTHER_NAMESPACE = Scenario("ask_once", robot=RESTING, namespace="/lab_7/robot")


@check(
    points=1,
    on=UNPLUGGED,
    needs=[answers_with_the_last_message, says_when_it_knows_nothing],
    see="02_services#m9-fix-why",
)
def recovers_when_the_sensor_appears(run: Transcript) -> None:
    """Once the first message has come, it answers with it"""
    call = run.call("after the first message")
    require_last_message(call, since=run.told("battery_sensor", before=call.sent.t, connected=True).t)


@check(
    points=1, on=[RANDOM_LEVELS, SENSOR_STOPPED], needs=follows_the_battery, see="02_services#battery-rules"
)
def keeps_the_last_message(changing: Transcript, stopped: Transcript) -> None:
    """Whatever the charge, and also when the sensor falls silent, it answers with the last message"""
    require_at_each_level(changing)
    require_in_silence(stopped.call("in silence"))


answers_every_request = standard_hidden.answers_every_request(
    32, points=1, on=MANY_AT_ONCE, needs=answers_with_the_last_message
)

works_in_any_namespace = standard_hidden.works_in_any_namespace(
    "serves the robot",
    lambda run: require_last_message(run.call("once")),
    points=1,
    on=OTHER_NAMESPACE,
    needs=answers_with_the_last_message,
)
