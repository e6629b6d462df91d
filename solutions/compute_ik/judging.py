"""Requirements on an answer of the IK service: the right code, the hand at the target, the elbow on the right side."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from autograder.authoring.call import Call
from autograder.authoring.failure import Failure, expect
from autograder.authoring.fields import shown
from autograder.authoring.transcript import Transcript
from humanoid_interfaces.srv import ComputeIK

from .advice import advice_for
from .two_link_arm import DEFAULT, TOLERANCE, Point, TwoLinkArm

Response = ComputeIK.Response
CODES = {getattr(Response, name): name for name in ("SUCCESS", "NO_IK_SOLUTION", "FRAME_TRANSFORM_FAILURE")}
AHEAD = 0.02  # m; farther back, "above the line" may be read in two ways


@dataclass(frozen=True)
class Reply:
    """An answered question, read in the terms of a planar arm: m, rad."""

    call: Call

    @property
    def target(self) -> Point:
        """The point asked for."""
        point = self.call.request.target.point
        return point.x, point.y

    @property
    def frame(self) -> str:
        """The frame asked in."""
        return self.call.request.target.header.frame_id

    @property
    def elbow_up(self) -> bool:
        """The side asked for."""
        return self.call.request.elbow_up

    @property
    def error_code(self) -> int:
        """The code of the answer."""
        return self.call.response.error_code

    @property
    def shoulder_and_elbow(self) -> tuple[float, float]:
        """The angles of the answer."""
        return self.call.response.shoulder, self.call.response.elbow

    @property
    def at(self) -> float:
        """When (s) it was answered."""
        return self.call.answered.t

    @property
    def question(self) -> str:
        """The request in words."""
        x, y = self.target
        return f"({x:g}, {y:g}) in frame {self.frame!r}, elbow_up {shown(self.elbow_up)}"

    @property
    def angles(self) -> str:
        """The answer's angles in words."""
        return "shoulder {:.4f}, elbow {:.4f} rad".format(*self.shoulder_and_elbow)


def replies(run: Transcript, group: str) -> list[Reply]:
    """Return the answers to one group of a scenario's questions; every one must have been asked and answered."""
    questions = {**run.params["questions"], **run.params.get("then", {})}
    calls = [run.call(f"{group} {number}") for number in range(1, len(questions[group]) + 1)]
    return [Reply(call) for call in calls if call.answered]


def require_code(reply: Reply, code: int, *, because: str, help: str) -> None:
    """Require that the answer has this error code."""
    expect(
        reply.error_code == code,
        expected=f"error_code {CODES[code]} ({code}) for {reply.question}: {because}",
        observed=f"error_code {code_in_words(reply.error_code)}",
        help=help if reply.error_code in CODES else _NO_CODE,
        at=reply.at,
    )


def code_in_words(code: int) -> str:
    """Return an error code with its name."""
    return f"{CODES.get(code, 'without a name')} ({code})"


def require_refusal(reply: Reply, arm: TwoLinkArm = DEFAULT) -> None:
    """Require that the answer says that the target is out of reach."""
    require_code(
        reply,
        Response.NO_IK_SOLUTION,
        because=_reach(reply, arm),
        help="Look at cos(elbow) before acos: beyond -1 and 1 there is no such triangle. Forcing it into that range "
        "makes a failure look like a success.",
    )


def require_hit(reply: Reply, arm: TwoLinkArm = DEFAULT) -> None:
    """Require that the answer's angles bring the hand of `arm` to the target, with the elbow on either side."""
    require_code(reply, Response.SUCCESS, because=_reach(reply, arm), help=_NOT_A_SUCCESS)
    missed_by = arm.misses(*reply.shoulder_and_elbow, reply.target)
    if missed_by <= TOLERANCE:
        return
    raise Failure(
        expected=f"angles that bring the hand within 1 mm of {reply.question}, with links of "
        f"{arm.upper_arm:.2f} and {arm.forearm:.2f} m",
        observed=f"{reply.angles}: {_where_that_is(reply, arm, missed_by)}",
        help=advice_for(*reply.shoulder_and_elbow, reply.target, arm),
        at=reply.at,
    )


def require_side(reply: Reply, arm: TwoLinkArm = DEFAULT, twin: Reply | None = None) -> None:
    """Require that the elbow is on the side asked for; judged only of targets ahead of the shoulder.

    `twin` is the answer for the same target with the other elbow_up, which tells what a wrong side comes from.
    """
    if reply.target[0] < AHEAD:
        return
    is_above = _elbow_is_above(reply, arm)
    if is_above is None:
        raise Failure(
            expected=f"two angles for {reply.question}",
            observed=f"{reply.angles}, which is nowhere",
            help="Look where a NaN or an infinite number comes from: a division by zero, or acos of more than 1.",
            at=reply.at,
        )
    observed = f"{reply.angles}: the elbow is {_side(is_above)} it"
    expect(
        is_above == reply.elbow_up,
        expected=f"the elbow {_side(reply.elbow_up)} the line from shoulder to target for {reply.question}",
        observed=observed,
        help=_help_with_the_side(reply, None if twin is None else _elbow_is_above(twin, arm)),
        at=reply.at,
    )


def require_sides(answers: Sequence[Reply], arm: TwoLinkArm = DEFAULT) -> None:
    """Require of each answer that the elbow is on the side asked for."""
    for reply in answers:
        twins = [
            other for other in answers if other.target == reply.target and other.elbow_up != reply.elbow_up
        ]
        require_side(reply, arm, twins[0] if twins else None)


def _elbow_is_above(reply: Reply, arm: TwoLinkArm) -> bool | None:
    """Return the side of the elbow; None for an angle that is no number."""
    if not math.isfinite(reply.shoulder_and_elbow[0]):
        return None
    return arm.elbow_is_above(reply.shoulder_and_elbow[0], reply.target)


def _help_with_the_side(reply: Reply, twin_is_above: bool | None) -> str:
    """Say what to do about an elbow on the wrong side, given the side of the answer with the other elbow_up."""
    if twin_is_above is None:
        return (
            "elbow_up decides the sign of the elbow's angle: ahead of the shoulder a positive angle has the elbow "
            "below the line."
        )
    other = shown(not reply.elbow_up)
    if twin_is_above == reply.elbow_up:
        return (
            f"With elbow_up {other} the elbow was {_side(twin_is_above)}: elbow_up is used the wrong way round. Turn "
            "the sign of the elbow's angle."
        )
    return (
        f"With elbow_up {other} the elbow was also {_side(twin_is_above)}: elbow_up is not used. Let it decide the "
        "sign of the elbow's angle."
    )


_NO_CODE = (
    "Set response.error_code to one of ComputeIK.Response's constants. A new response has 0, which is none."
)
_NOT_A_SUCCESS = (
    "Compare the distance of the target with the lengths in metres: their sum is the farthest it may be."
)


def _reach(reply: Reply, arm: TwoLinkArm) -> str:
    distance = math.hypot(*reply.target)
    return (
        f"the arm reaches from {arm.nearest:.2f} to {arm.farthest:.2f} m, and this is {distance:.2f} m away"
    )


def _where_that_is(reply: Reply, arm: TwoLinkArm, missed_by: float) -> str:
    if math.isinf(missed_by):
        return "no place at all"
    x, y = arm.hand_at(*reply.shoulder_and_elbow)
    return f"the hand is at ({x:.3f}, {y:.3f}), {missed_by * 1000:.0f} mm off"


def _side(is_above: bool) -> str:
    return "above" if is_above else "below"
