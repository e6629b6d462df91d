"""What is asked of an answer of the IK service: the right code, the hand at the target, the elbow on the right side."""

from __future__ import annotations

import math
from dataclasses import dataclass

from autograder.authoring.checks import Failure, expect
from autograder.authoring.server_checks import require_answer
from autograder.authoring.transcript import Transcript

from .advice import advice_for
from .two_link_arm import DEFAULT, TOLERANCE, Point, TwoLinkArm

SERVICE = "compute_ik"
SUCCESS, NO_IK_SOLUTION, FRAME_TRANSFORM_FAILURE = 1, -31, -21
CODES = {
    SUCCESS: "SUCCESS",
    NO_IK_SOLUTION: "NO_IK_SOLUTION",
    FRAME_TRANSFORM_FAILURE: "FRAME_TRANSFORM_FAILURE",
}
AHEAD = 0.02  # m; farther back, "above the line" may be read in two ways


@dataclass(frozen=True)
class Reply:
    """An answered question: what was asked for (m, rad) and what came back, `at` (s)."""

    target: Point
    frame: str
    elbow_up: bool
    error_code: int
    shoulder: float
    elbow: float
    at: float

    @property
    def question(self) -> str:
        """The request in words."""
        x, y = self.target
        return f"({x:g}, {y:g}) in frame {self.frame!r}, elbow_up {str(self.elbow_up).lower()}"

    @property
    def angles(self) -> str:
        """The answer's angles in words."""
        return f"shoulder {self.shoulder:.4f}, elbow {self.elbow:.4f} rad"


def replies(run: Transcript, group: str) -> list[Reply]:
    """Return the answers to one group of a scenario's questions; every one must have been asked and answered."""
    number = 1
    for name, requests in {**run.params["questions"], **run.params.get("then", {})}.items():
        if name == group:
            return [_reply(run, nth) for nth in range(number, number + len(requests))]
        number += len(requests)
    raise KeyError(f"{run.scenario} has no questions {group!r}")


def _reply(run: Transcript, number: int) -> Reply:
    for earlier in run.calls_to(SERVICE)[
        : number - 1
    ]:  # after a question that was not answered no other is asked
        require_answer(run, earlier)
    call = run.call(SERVICE, number)
    answer, request = require_answer(run, call), call.sent.request
    point = request["target"]["point"]
    return Reply(
        target=(point["x"], point["y"]),
        frame=request["target"]["header"]["frame_id"],
        elbow_up=request["elbow_up"],
        error_code=answer.response["error_code"],
        shoulder=answer.response["shoulder"],
        elbow=answer.response["elbow"],
        at=answer.t,
    )


def require_code(reply: Reply, code: int, *, because: str, help: str) -> None:
    """The answer has this error code."""
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
    """The answer says that the target is out of reach."""
    require_code(
        reply,
        NO_IK_SOLUTION,
        because=_reach(reply, arm),
        help="Look at cos(elbow) before acos: beyond -1 and 1 there is no such triangle. Forcing it into that range "
        "makes a failure look like a success.",
    )


def require_hit(reply: Reply, arm: TwoLinkArm = DEFAULT) -> None:
    """The answer's angles bring the hand of `arm` to the target, on whichever side the elbow is."""
    require_code(reply, SUCCESS, because=_reach(reply, arm), help=_NOT_A_SUCCESS)
    missed_by = arm.misses(reply.shoulder, reply.elbow, reply.target)
    if missed_by <= TOLERANCE:
        return
    raise Failure(
        expected=f"angles that bring the hand within 1 mm of {reply.question}, with links of "
        f"{arm.upper_arm:.2f} and {arm.forearm:.2f} m",
        observed=f"{reply.angles}: {_where_that_is(reply, arm, missed_by)}",
        help=advice_for(reply.shoulder, reply.elbow, reply.target, arm),
        at=reply.at,
    )


def require_side(reply: Reply, arm: TwoLinkArm = DEFAULT) -> None:
    """The elbow is on the side asked for; judged only of targets ahead of the shoulder."""
    if reply.target[0] < AHEAD:
        return
    is_above = arm.elbow_is_above(reply.shoulder, reply.target)
    expect(
        is_above == reply.elbow_up,
        expected=f"the elbow {_side(reply.elbow_up)} the line from shoulder to target for {reply.question}",
        observed=f"{reply.angles}: the elbow is {_side(is_above)} it",
        help="The arm bends to either side: cos(elbow) gives the size of the elbow's angle, elbow_up its sign. "
        "Ahead of the shoulder a positive elbow angle has the elbow below the line.",
        at=reply.at,
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
    x, y = arm.hand_at(reply.shoulder, reply.elbow)
    return f"the hand is at ({x:.3f}, {y:.3f}), {missed_by * 1000:.0f} mm off"


def _side(is_above: bool) -> str:
    return "above" if is_above else "below"
