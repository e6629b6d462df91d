"""What only the instructor's grading checks."""

from __future__ import annotations

import random

from autograder.authoring import standard_hidden
from autograder.authoring.checks import Scenario, check
from autograder.authoring.robot_topic import DELIVERY
from autograder.authoring.transcript import Transcript

from .checks import (
    ON_A_STAND,
    SILENT_ROBOT,
    powers_on,
    refuses_off_while_walking,
    says_when_it_knows_nothing,
    tells_the_status,
)
from .judging import (
    require_granted,
    require_refused,
    require_standing_as_told,
    require_status,
    require_switched,
    require_walking_as_told,
    require_walking_on,
)


def _any_way_but_ahead(random: random.Random) -> dict:
    """Turning on the spot, sideways or backwards (m/s, m/s, rad/s)."""
    side = random.choice((-1, 1))
    velocities = (
        [0.0, 0.0, side * random.uniform(0.25, 0.4)],
        [0.0, side * random.uniform(0.07, 0.11), 0.0],
        [-random.uniform(0.1, 0.18), 0.0, 0.0],
    )
    return {"velocity": [round(value, 3) for value in random.choice(velocities)]}


RANDOM_WALK = Scenario("switch_while_walking_and_after", _any_way_but_ahead)
MANY_AT_ONCE = Scenario("ask_many_at_once", {"bursts": 3, "switches": 3, "questions": 5}, robot=ON_A_STAND)
OTHER_NAMESPACE = Scenario("switch_off_and_on", robot=ON_A_STAND, namespace="/lab_7/robot")


@check(points=1, on=RANDOM_WALK, needs=refuses_off_while_walking, see="02_services#set-refuse-why")
def refuses_however_it_walks(run: Transcript) -> None:
    """Turning on the spot, sideways or backwards is walking, too"""
    require_refused(run.call("off while walking"))


@check(
    points=2, on=RANDOM_WALK, needs=[powers_on, refuses_however_it_walks], see="02_services#set-refuse-why"
)
def refuses_nothing_else(run: Transcript) -> None:
    """Power on is granted while the robot walks, and power off once it stands again"""
    on, off = run.call("on while walking"), run.call("off once it stands")
    require_walking_as_told(on)
    require_granted(on)
    require_walking_on(on)
    require_standing_as_told(off)
    require_switched(off)


@check(
    points=1,
    on=SILENT_ROBOT,
    needs=[tells_the_status, says_when_it_knows_nothing],
    see="02_services#m9-fix-why",
)
def recovers_when_the_robot_speaks(run: Transcript) -> None:
    """Once the first robot_state has come, get_status answers with it"""
    call = run.call("after the first message")
    run.told("robot_state", before=call.sent.t - DELIVERY, published=True)
    require_status(call, on=True)


answers_every_request = standard_hidden.answers_every_request(
    24,
    help="Publish and answer: the callback must not sleep while others wait for the same thread.",
    points=1,
    on=MANY_AT_ONCE,
    needs=[tells_the_status, powers_on],
)


@check(points=1, on=OTHER_NAMESPACE, needs=[tells_the_status, powers_on], see="01_robot_and_graph#names-why")
def works_in_any_namespace(run: Transcript) -> None:
    """Started in another namespace, it serves the robot there"""
    require_switched(run.call("off"))
    require_status(run.call("status after off"), on=False)
    require_switched(run.call("on"))
