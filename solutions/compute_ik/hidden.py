"""What only the instructor's grading checks."""

from __future__ import annotations

import math
from random import Random
from typing import Any

from rcl_interfaces.msg import ParameterType, ParameterValue

from autograder.authoring.checks import Scenario, check, expect
from autograder.authoring.transcript import Transcript

from .checks import (
    POINTS,
    REAL_ARM,
    ROBOTS_ARM,
    bends_the_elbow_as_asked,
    moves_the_real_hand,
    reaches_the_point,
    says_what_is_out_of_reach,
    server_appears,
)
from .judging import (
    Response,
    code_in_words,
    replies,
    require_code,
    require_hit,
    require_refusal,
    require_side,
)
from .questions import ahead, anywhere, ask_for
from .two_link_arm import DEFAULT, TwoLinkArm


def _anywhere_then_other_lengths(random: Random) -> dict[str, Any]:
    """Draw points all around the shoulder, then others that stay within reach if only one new length is accepted.

    The last one, 0.10 m away, is only within reach as long as both lengths are the old ones.
    """
    return {
        "questions": {"anywhere": [anywhere(random, DEFAULT) for _ in range(8)]},
        "lengths": {
            "upper_arm_length": round(random.uniform(0.38, 0.42), 3),
            "forearm_length": round(random.uniform(0.15, 0.19), 3),
        },
        "then": {"with other lengths": [*(ahead(random, 0.30, 0.42) for _ in range(3)), ask_for(0.08, 0.06)]},
    }


SET_LENGTHS = Scenario("set_lengths", _anywhere_then_other_lengths, robot=None)
OTHER_NAMESPACE = Scenario(
    "ask", {"questions": {"within reach": [ask_for(0.4, 0.3)]}}, robot=None, namespace="/lab_7/robot"
)


@check(
    points=2,
    on=[SET_LENGTHS, REAL_ARM],
    needs=[bends_the_elbow_as_asked, moves_the_real_hand],
    see="04_your_own_interfaces#fk-why",
)
def reaches_any_point(run: Transcript, with_other_lengths: Transcript) -> None:
    """All around the shoulder, and close to it with a forearm longer than the upper arm, it hits the point"""
    for reply in replies(run, "anywhere"):
        require_hit(reply)
        require_side(reply)
    for reply in replies(with_other_lengths, "near the shoulder"):
        require_hit(reply, ROBOTS_ARM)


@check(points=1, on=POINTS, needs=says_what_is_out_of_reach, see="02_services#nan")
def refuses_what_is_no_number(run: Transcript) -> None:
    """A target that is not a number is no success, and the next question is answered as ever"""
    nonsense, sound = replies(run, "not a number")
    expect(
        nonsense.error_code != Response.SUCCESS,
        expected=f"any error_code but SUCCESS for {nonsense.question}",
        observed=f"error_code {code_in_words(nonsense.error_code)}, {nonsense.angles}",
        help="Every comparison with NaN is false, so a test such as `distance > reach` lets it through: ask "
        "math.isfinite(), or test for what is good.",
        at=nonsense.at,
    )
    require_code(
        sound,
        Response.SUCCESS,
        because="this can be reached",
        help="Keep nothing from one request to the next.",
    )


@check(points=1, on=SET_LENGTHS, needs=server_appears, see="04_your_own_interfaces#parameters-intro")
def declares_its_lengths(run: Transcript) -> None:
    """upper_arm_length and forearm_length are parameters of type double: 0.30 and 0.25 m"""
    call = run.call("get_parameters")
    values = iter(call.response.values)
    for name, length in (("upper_arm_length", DEFAULT.upper_arm), ("forearm_length", DEFAULT.forearm)):
        value = next(values, ParameterValue())  # a node that lacks one may say nothing of any
        expect(
            value.type == ParameterType.PARAMETER_DOUBLE
            and math.isclose(value.double_value, length, abs_tol=1e-6),
            expected=f"a parameter {name} of type double with the value {length:.2f}",
            observed=_in_words(value),
            help=f"Declare it with its default in the constructor: self.declare_parameter({name!r}, {length:.2f}).",
            at=call.sent.t,
        )


@check(
    points=1,
    on=SET_LENGTHS,
    needs=[bends_the_elbow_as_asked, says_what_is_out_of_reach, declares_its_lengths],
    see="04_your_own_interfaces#parameters-why",
)
def does_what_it_says_of_new_lengths(run: Transcript) -> None:
    """Lengths that are set while it runs are taken into account, or refused"""
    arm = _arm_after_setting(run)
    for reply in replies(run, "with other lengths"):
        if math.hypot(*reply.target) > arm.nearest:
            require_hit(reply, arm)
            require_side(reply, arm)
        else:
            require_refusal(reply, arm)


@check(points=1, on=OTHER_NAMESPACE, needs=reaches_the_point, see="01_robot_and_graph#names-why")
def works_in_any_namespace(run: Transcript) -> None:
    """Started in another namespace, it serves there"""
    for reply in replies(run, "within reach"):
        require_hit(reply)


def _arm_after_setting(run: Transcript) -> TwoLinkArm:
    """Return the lengths that the node reported: each new one that it accepted, else the old one."""
    results = run.call("set_parameters").response.results
    lengths = [DEFAULT.upper_arm, DEFAULT.forearm]
    for index, (result, new) in enumerate(zip(results, run.params["lengths"].values(), strict=False)):
        if result.successful:
            lengths[index] = new
    return TwoLinkArm(*lengths)


def _in_words(value: ParameterValue) -> str:
    if value.type == ParameterType.PARAMETER_NOT_SET:
        return "no value: it is not declared, or without a default"
    is_double = value.type == ParameterType.PARAMETER_DOUBLE
    return f"the value {value.double_value:g}" if is_double else "a value of another type"
