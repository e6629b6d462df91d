"""What must hold for every response of the IK service, clause by clause, in every scenario."""

from __future__ import annotations

import math

from rcl_interfaces.msg import ParameterType, ParameterValue

from autograder.authoring import (
    Call,
    Failure,
    Transcript,
    answered_within,
    answers_without_waiting,
    calls,
    ev,
    expect,
    held_up,
    obligation,
    unseen,
    whole_run,
)

from .advice import advice_for, advice_on_the_side
from .reply import CODES, Reply, Response, code_in_words, side_in_words
from .two_link_arm import DEFAULT, TOLERANCE, TwoLinkArm

SERVICE = "compute_ik"
SETTING = ("set_parameters", "set_parameters_atomically")
AHEAD = 0.02  # m; for targets farther back, "above the line" is ambiguous
ARM_TOLERANCE = 0.01  # m; the servos of the robot's arm bring the hand to within 2 mm
COMPUTE = "Compute and return the response: the callback must neither sleep nor wait for anything."

answers_in_time = answered_within(2.0, SERVICE, clause=7, help=COMPUTE)
never_waits = answers_without_waiting(SERVICE, lambda call: "any request", clause=7, help=COMPUTE)


@obligation(7, of=calls(SERVICE), see="04_your_own_interfaces#cosine-why")
def answers_every_call(call: Call) -> str:
    """Every request gets a response, whatever its target and whatever lengths were set"""
    Reply(call, DEFAULT)
    return "with invalid lengths" if _arm(call) is None else "with valid lengths"


@obligation(1, of=calls(SERVICE), see="04_your_own_interfaces#cosine-why")
def refuses_nothing_within_reach(call: Call) -> str | None:
    """A target within reach gets SUCCESS"""
    reply = _reply(call)
    if reply is None or not reply.is_within_reach:
        return None
    _require_code(
        reply,
        Response.SUCCESS,
        because=reply.reach,
        help="Compare the target's distance with the lengths, in metres: a target is within reach up to their sum.",
    )
    return "within reach"


@obligation(1, 2, of=calls(SERVICE), see="04_your_own_interfaces#cosine-why")
def reaches_the_point(call: Call) -> str | None:
    """A target within reach gets SUCCESS, and the angles bring the hand to the point within 1 mm"""
    reply = _reply(call)
    if reply is None or reply.is_out_of_reach:
        return None
    if refuses_nothing_within_reach.require(call) is None and not reply.is_a_success:
        return None
    missed_by = reply.arm.hand_error(*reply.shoulder_and_elbow, reply.target)
    where = "these angles give no position"
    if missed_by < math.inf:
        x, y = reply.arm.hand_at(*reply.shoulder_and_elbow)
        where = f"the hand is at ({x:.3f}, {y:.3f}), {missed_by * 1000:.0f} mm off"
    if missed_by > TOLERANCE:
        raise Failure(
            expected=f"angles that bring the hand within 1 mm of {reply.question}, with links of "
            f"{reply.arm.upper_arm:.2f} and {reply.arm.forearm:.2f} m",
            observed=f"{reply.angles}: {where}",
            help=advice_for(*reply.shoulder_and_elbow, reply.target, reply.arm, _arms_before(call)),
            at=reply.at,
        )
    if not reply.is_within_reach:
        return "at a limit of the reach"
    return "ahead" if reply.target[0] >= AHEAD else "above, below or behind"


@obligation(3, of=calls(SERVICE), see="04_your_own_interfaces#cosine-why")
def bends_the_elbow_as_asked(call: Call) -> str | None:
    """For a target ahead, the elbow is above the line to it if elbow_up is true, else below"""
    reply = _reply(call)
    if reply is None or not reply.is_within_reach or reply.target[0] < AHEAD or not reply.is_a_success:
        return None
    side, is_above = side_in_words(reply.elbow_up), reply.elbow_is_above
    reply.call.require(
        is_above is not None,
        expected=f"two finite angles for {reply.question}",
        observed=reply.angles,
        help="Find where the NaN or infinity comes from: a division by zero, or acos of more than 1.",
    )
    reply.call.require(
        is_above == reply.elbow_up,
        expected=f"the elbow {side} the line from shoulder to target for {reply.question}",
        observed=f"{reply.angles}: the elbow is {side_in_words(bool(is_above))} that line",
        help=advice_on_the_side(reply.elbow_up, _side_of_the_twin(reply)),
    )
    return f"the elbow {side}"


@obligation(4, of=calls(SERVICE))
def says_what_is_out_of_reach(call: Call) -> str | None:
    """A target too far or too near gets NO_IK_SOLUTION"""
    reply = _reply(call)
    if reply is None or not reply.is_out_of_reach:
        return None
    _require_code(
        reply,
        Response.NO_IK_SOLUTION,
        because=reply.reach,
        help="Check cos(elbow) before acos: below -1 or above 1 there is no such triangle. Do not clamp the value.",
    )
    return "too far" if reply.distance > reply.arm.farthest else "too near"


@obligation(5, of=calls(SERVICE), see="04_your_own_interfaces#server-why")
def refuses_other_frames(call: Call) -> str:
    """A target gets FRAME_TRANSFORM_FAILURE if its frame is not "shoulder", and only then"""
    reply = Reply(call, DEFAULT)
    if reply.frame == "shoulder":
        reply.call.require(
            reply.error_code != Response.FRAME_TRANSFORM_FAILURE,
            expected=f"an error_code other than FRAME_TRANSFORM_FAILURE for {reply.question}, as the frame is right",
            observed=f"error_code {code_in_words(reply.error_code)}",
            help="Compare request.target.header.frame_id with 'shoulder'.",
        )
        return "in shoulder"
    either = "" if reply.frame else " either"
    _require_code(
        reply,
        Response.FRAME_TRANSFORM_FAILURE,
        because="the only valid frame is 'shoulder'",
        help=f"{reply.frame!r} is not 'shoulder'{either}: before computing, return FRAME_TRANSFORM_FAILURE for every "
        "other frame.",
    )
    return "in another frame" if reply.frame else "in an empty frame"


@obligation(6, of=calls(SERVICE))
def refuses_a_pose_that_is_not_finite(call: Call) -> str | None:
    """A target whose x or y is NaN or infinite never gets SUCCESS"""
    reply = Reply(call, DEFAULT)
    if reply.frame != "shoulder" or all(map(math.isfinite, reply.target)):
        return None
    reply.call.require(
        not reply.is_a_success,
        expected=f"any error_code but SUCCESS for {reply.question}",
        observed=f"error_code {code_in_words(reply.error_code)}, {reply.angles}",
        help="Every `<` and `>` with NaN is false: use math.isfinite(), or test that the value is within the limits.",
    )
    return "NaN" if any(map(math.isnan, reply.target)) else "infinite"


@obligation(9, of=calls(SERVICE), see="04_your_own_interfaces#parameters-why")
def uses_the_lengths_it_accepted(call: Call) -> str | None:
    """Lengths that set_parameters accepted are used from the next request on; after a rejection, the previous ones"""
    if not _settings(call):
        return None
    each = [reaches_the_point, says_what_is_out_of_reach, bends_the_elbow_as_asked]
    return " and ".join(filter(None, (one.require(call) for one in each))) or None


@obligation(8, of=whole_run, see="04_your_own_interfaces#parameters-intro")
def lengths_are_parameters(run: Transcript) -> str:
    """upper_arm_length and forearm_length are parameters of type double: 0.30 and 0.25 m"""
    asked = [call for call in run.calls if call.service.endswith("/get_parameters")]
    if not asked:
        raise unseen(run, "the parameters were never read")
    for call in asked:
        values = iter(call.response.values)
        for name in call.request.names:
            length = DEFAULT.parameters[name]
            # a node that lacks one of them may return no values at all
            value = next(values, ParameterValue())
            is_double = value.type == ParameterType.PARAMETER_DOUBLE
            expect(
                is_double and math.isclose(value.double_value, length, abs_tol=1e-6),
                expected=f"a parameter {name} of type double with the value {length:.2f}",
                observed=f"the value {value.double_value:g}" if is_double else "no value of type double",
                help=f"Declare it with its default in the constructor: self.declare_parameter({name!r}, {length:.2f}).",
                at=call.sent.t,
            )
    return "at the start"


@obligation(2, 8, of=whole_run)
def moves_the_real_hand(run: Transcript) -> str | None:
    """The angles bring the robot's hand to the point, as far as its servos allow"""
    reports = run.all(ev.ArmReported)
    for arm in reports:
        answered = [call for call in calls(SERVICE)(run) if call.answer and call.answer.t < arm.t]
        if not answered:
            raise unseen(run, "the arm was moved before a response with angles")
        reply = Reply(answered[-1], DEFAULT)
        if run.last_command("move_joints", before=arm.t).t < reply.at:
            raise held_up(run, f"the arm was not moved to the angles for {reply.question}")
        x, y = reply.target
        away = math.dist(arm.hand, (x, 0.0, y))
        expect(
            away <= ARM_TOLERANCE,
            expected=f"the robot's hand within {ARM_TOLERANCE * 1000:.0f} mm of {reply.question}",
            observed=f"{reply.angles}: the hand at ({arm.hand[0]:.3f}, {arm.hand[2]:.3f}), {away * 1000:.0f} mm away",
            help="The robot's elbow bends one way only: with elbow_up false, the elbow's angle must be positive.",
            at=arm.t,
        )
    return "the robot's arm" if reports else None


# -- the truth --------------------------------------------------------------------------------------------------------


def _settings(call: Call) -> list[Call]:
    """Return the calls that set parameters before a call; each must have been answered."""
    asked = [each for each in call.run.calls if each.service.split("/")[-1] in SETTING]
    return [each for each in asked if each.sent.t < call.sent.t and each.answered]


def _accepted(setting: Call) -> dict[str, float]:
    """Return the parameters in a set_parameters call that the node accepted, by name."""
    together = setting.service.endswith("_atomically")
    asked, response = setting.request.parameters, setting.response
    results = [response.result] * len(asked) if together else response.results
    return {
        new.name: new.value.double_value
        for new, result in zip(asked, results, strict=False)
        if result.successful
    }


def _lengths(call: Call) -> list[dict[str, float]]:
    """Return the lengths (m) that the node has had up to a call: at the start, then after each accepted change."""
    lengths = [DEFAULT.parameters | (call.run.params.get("started_with") or {})]
    for setting in _settings(call):
        lengths.append(lengths[-1] | _accepted(setting))
    return lengths


def _arm(call: Call) -> TwoLinkArm | None:
    """Return the arm at the time of a call; None if the node had accepted a length that is not finite and above 0."""
    upper_arm, forearm = (_lengths(call)[-1][name] for name in DEFAULT.parameters)
    return TwoLinkArm(upper_arm, forearm) if upper_arm > 0.0 < forearm < math.inf > upper_arm else None


def _arms_before(call: Call) -> list[TwoLinkArm]:
    """Return the arms from all combinations of the lengths that the node has had before a call."""
    uppers, forearms = (
        [DEFAULT.parameters[name], *(each[name] for each in _lengths(call))] for name in DEFAULT.parameters
    )
    return [TwoLinkArm(upper_arm, forearm) for upper_arm in uppers for forearm in forearms]


def _reply(call: Call) -> Reply | None:
    """Return the response to a call; None if its target is not a finite point in "shoulder", or a length is invalid."""
    arm, point = _arm(call), call.request.target.point
    reply = Reply(call, arm or DEFAULT)
    is_a_point = reply.frame == "shoulder" and all(map(math.isfinite, (point.x, point.y, point.z)))
    return reply if arm and is_a_point else None


def _side_of_the_twin(reply: Reply) -> bool | None:
    """Return the elbow's side in the response to the same target with the opposite elbow_up, or None."""
    others = (Reply(each, reply.arm) for each in calls(SERVICE)(reply.call.run) if each.answer)
    twins = (each for each in others if each.target == reply.target and each.elbow_up != reply.elbow_up)
    return next((twin.elbow_is_above for twin in twins), None)


def _require_code(reply: Reply, code: int, *, because: str, help: str) -> None:
    reply.call.require(
        reply.error_code == code,
        expected=f"error_code {CODES[code]} ({code}) for {reply.question}: {because}",
        observed=f"error_code {code_in_words(reply.error_code)}",
        help=help
        if reply.error_code in CODES
        else "Set response.error_code to one of the constants of ComputeIK.Response. In a new response it is 0, which "
        "is not one of them.",
    )
