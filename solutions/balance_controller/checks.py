"""What students can see being checked."""

from __future__ import annotations

import math
from collections.abc import Sequence

from rcl_interfaces.msg import ParameterDescriptor

from autograder.authoring import events as ev
from autograder.authoring import standard
from autograder.authoring.checks import RESTING, Failure, Scenario, check, expect, program
from autograder.authoring.readiness import require_alive, require_ready
from autograder.authoring.transcript import Transcript

from .gains import DEFAULTS, NAMES, set_each, set_together
from .published import require_accepted, require_gains, require_once, require_published, require_silence
from .refused import require_bad_start_refused, require_refused
from .sets import NEAR_DEFAULT, TOPIC, call_named, require_doubles
from .standing import require_standing_after_push

DECLARED = "10_parameters_and_balance#circle-why"
TWO_CALLBACKS = "10_parameters_and_balance#book-why"
ONE_BY_ONE = "10_parameters_and_balance#atomic-why"
ALL_AT_ONCE = "10_parameters_and_balance#atomic-fix-why"
WHO_SEES_IT = "10_parameters_and_balance#guarded-gap"
FROM_THE_START = "10_parameters_and_balance#late-why"
PUSHED = "10_parameters_and_balance#push-why"
LATE = "01_robot_and_graph#late-why"

SETS = Scenario(
    "set_gains",
    {
        "sets": [
            set_each("one gain", kp_pitch=320.0),
            set_together("three at once", kp_roll=350.0, kd_roll=44.0, max_torque=4000.0),
            set_each("two in a row", kd_roll=40.0, kp_pitch=300.0),
        ]
    },
    robot=None,
)
REFUSALS = Scenario(
    "set_gains",
    {
        "sets": [
            set_each("too weak", kp_pitch=40.0),
            set_each("too weak in roll", kp_roll=12.5),
            set_each("negative", kd_pitch=-5.0),
            set_each("negative torque", max_torque=-1.0),
            set_each("a good one at last", kd_roll=44.0),
        ]
    },
    robot=None,
)
ALL_OR_NONE = Scenario(
    "set_gains",
    {
        "sets": [
            set_together("a good one and a bad one", kp_pitch=333.0, kd_roll=-3.0),
            set_together("two good ones and a weak one", kd_pitch=41.0, kp_roll=340.0, kp_pitch=20.0),
            set_each("a good one alone", max_torque=5000.0),
        ]
    },
    robot=None,
)
AT_ONCE = 0.5  # s; what comes in a longer time comes from a timer
AT_START = {"kp_pitch": 310.0, "kd_roll": 41.5}
START = Scenario("start", robot=None, parameters=AT_START)
LATE_LISTENER = Scenario(
    "late_listener", {"sets": [set_together("two gains", kp_roll=333.0, kd_roll=42.0)]}, robot=None
)
WEAK_START = program("start_with", {"name": "kp_pitch", "value": "40.0"}, timed=False)
PUSH = Scenario(
    "push",
    {
        "sets": [set_together("new gains", kp_pitch=340.0, kp_roll=370.0, kd_roll=46.0)],
        "impulse": [10.0, 0.0, 0.0],
    },
)
# It has a robot, which notices a busy machine; on such a machine Python takes seconds to end.
INTERRUPT = Scenario("interrupt", {"sets": [set_each("one gain", kp_pitch=300.0)]}, robot=RESTING)


@check(points=1, on=SETS, see=DECLARED)
def server_appears(run: Transcript) -> None:
    """The node offers its parameters, as the node balance_controller"""
    require_ready(run)
    try:  # rclpy offers them before the constructor is at its end, where a node may fail
        call_named(run, "describe")
    except Failure:
        require_alive(run)
        raise


@check(points=1, on=SETS, needs=server_appears, see=DECLARED, clauses=[1])
def declares_the_robots_gains(run: Transcript) -> None:
    """The five parameters are doubles, and their defaults are the robot's own gains"""
    found = require_doubles(run, "at the start")
    for name, default in DEFAULTS.items():
        expect(
            math.isclose(found[name], default, abs_tol=NEAR_DEFAULT),
            expected=f"{name} {default:g}, the robot's own",
            observed=f"{found[name]:g}",
            help="Take the defaults from the table of the task: a node that has just started should change nothing.",
            at=call_named(run, "at the start").answered.t,
        )


@check(points=1, on=SETS, needs=server_appears, see=DECLARED, clauses=[2])
def describes_its_parameters(run: Transcript) -> None:
    """Each parameter has a description and a range that holds its default"""
    call = call_named(run, "describe")
    described = iter(call.response.descriptors)
    for name in NAMES:
        descriptor = next(described, ParameterDescriptor())
        expect(
            bool(descriptor.description.strip()),
            expected=f"a description of {name}",
            observed="none",
            help="Give declare_parameter a ParameterDescriptor(description=…, floating_point_range=[…]) as its third "
            "argument: say what the gain does, and its unit.",
            at=call.answered.t,
        )
        ranges = descriptor.floating_point_range
        expect(
            any(one.from_value < DEFAULTS[name] <= one.to_value for one in ranges),
            expected=f"a floating_point_range of {name} that holds {DEFAULTS[name]:g}",
            observed=", ".join(f"{one.from_value:g} to {one.to_value:g}" for one in ranges) or "none",
            help="floating_point_range=[FloatingPointRange(from_value=…, to_value=…)], in a list: rclpy then refuses "
            "the rest by itself.",
            at=call.answered.t,
        )


@check(points=2, on=SETS, needs=declares_the_robots_gains, see=TWO_CALLBACKS, clauses=[6, 7])
def publishes_what_it_accepted(run: Transcript) -> None:
    """After an accepted set, balance_gains has all five gains as they are then"""
    for name in ("one gain", "three at once", "two in a row"):
        require_accepted(run, name)
        require_published(run, name)


@check(points=2, on=SETS, needs=publishes_what_it_accepted, see=ONE_BY_ONE, clauses=[8])
def publishes_once(run: Transcript) -> None:
    """One message for each accepted set, also when a set has several gains"""
    for name in ("one gain", "three at once", "two in a row"):
        require_once(run, name)


@check(points=2, on=REFUSALS, needs=server_appears, see=TWO_CALLBACKS, clauses=[3, 5])
def refuses_bad_gains(run: Transcript) -> None:
    """A gain that is negative, or too weak to hold the trunk, is refused with a reason"""
    for name in ("too weak", "too weak in roll"):
        require_refused(
            run,
            name,
            "gravity topples the trunk with 51 N·m/rad",
            "Refuse a kp that is not above 51.0 in the on-set callback: the new values are in its argument.",
        )
    for name in ("negative", "negative torque"):
        require_refused(
            run,
            name,
            "it is negative",
            "Let the range begin at 0.0, or look at the value in the on-set callback.",
        )


@check(points=1, on=REFUSALS, needs=[publishes_once, refuses_bad_gains], see=TWO_CALLBACKS, clauses=[9])
def says_nothing_of_refused_gains(run: Transcript) -> None:
    """Nothing is published for a set that is refused"""
    for name in ("too weak", "too weak in roll", "negative", "negative torque"):
        require_silence(run, name)
    require_accepted(run, "a good one at last")
    require_once(run, "a good one at last")


@check(points=2, on=ALL_OR_NONE, needs=says_nothing_of_refused_gains, see=ALL_AT_ONCE, clauses=[9, 10])
def sets_all_or_none(run: Transcript) -> None:
    """Of an atomic set with one bad gain nothing is kept, published or applied later"""
    for name in ("a good one and a bad one", "two good ones and a weak one"):
        require_refused(
            run,
            name,
            "one of them is bad, and an atomic set is all or none",
            "Look at every parameter in the list that the on-set callback gets, not only at the first one.",
        )
        require_silence(run, name)
    require_accepted(run, "a good one alone")
    require_once(run, "a good one alone")


@check(points=1, on=LATE_LISTENER, needs=publishes_what_it_accepted, see=LATE, clauses=[11])
def keeps_the_last_gains(run: Transcript) -> None:
    """A robot that starts later gets the last gains, because the topic is latched"""
    require_accepted(run, "two gains")
    subscribed = run.mark("subscribed")
    heard = [event for event in run.heard(TOPIC) if event.t >= subscribed]
    require_alive(run)
    expect(
        bool(heard),
        expected=f"the last message of {TOPIC} at a node that subscribes after the set",
        observed="none",
        help="Give the publisher QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL) instead of 10.",
        at=subscribed,
    )
    require_gains(
        heard[-1],
        require_doubles(run, "at the start") | dict(run.params["sets"][0]["values"]),
        after="these were accepted before",
    )


@check(points=1, on=START, needs=keeps_the_last_gains, see=WHO_SEES_IT, clauses=[12])
def publishes_at_the_start(run: Transcript) -> None:
    """At the start it publishes its gains once, with the values that it was started with"""
    found = require_doubles(run, "at the start")
    for name, value in AT_START.items():
        expect(
            math.isclose(found[name], value),
            expected=f"{name} {value:g}, as it was started with",
            observed=f"{found[name]:g}",
            help="Declare the parameters with their defaults and nothing more: rclpy puts the values from the start in "
            "their place.",
            at=call_named(run, "at the start").answered.t,
        )
    heard = run.heard(TOPIC)
    expect(
        len(heard) == 1,
        expected=f"1 message on {TOPIC} at the start",
        observed=f"{len(heard)}",
        help=_about_the_start(heard),
        at=heard[-1].t if heard else run.end,
    )
    require_gains(heard[-1], found, after="these are its parameters")


def _about_the_start(heard: Sequence[ev.MessageReceived]) -> str:
    """Return what to do about no message, about many in a row, or about those of a timer."""
    if not heard:
        return "Publish once at the end of the constructor: the robot has to know with which gains you begin."
    if heard[-1].t - heard[0].t > AT_ONCE:
        return "Publish once at the end of the constructor, and from no timer."
    return "Each declaration is a set: register a callback that publishes behind the declarations; then publish once."


@check(points=2, on=WEAK_START, needs=server_appears, see=FROM_THE_START, clauses=[13])
def refuses_a_bad_start(run: Transcript) -> None:
    """Started with a bad gain, it ends with status 1 and a line that says why"""
    require_bad_start_refused(run)


@check(points=2, on=PUSH, needs=publishes_what_it_accepted, see=PUSHED, clauses=[14])
def survives_a_push(run: Transcript) -> None:
    """With the gains that it publishes the robot survives a push of 10 N·s"""
    require_accepted(run, "new gains")
    require_published(run, "new gains")
    require_standing_after_push(run)


ends_cleanly = standard.ends_cleanly(points=1, on=INTERRUPT, needs=server_appears, clauses=[15])
