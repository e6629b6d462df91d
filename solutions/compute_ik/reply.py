"""A response of the IK service, in terms of a planar arm (m, rad)."""

from __future__ import annotations

import math

from autograder.authoring import Call, Failure, shown
from humanoid_interfaces.srv import ComputeIK

from .two_link_arm import TOLERANCE, Point, TwoLinkArm

Response = ComputeIK.Response
CODES = {getattr(Response, name): name for name in ("SUCCESS", "NO_IK_SOLUTION", "FRAME_TRANSFORM_FAILURE")}


class Reply:
    """The response to a call, from a node that computes with `arm`.

    Attributes:
        target, frame, elbow_up: the fields of the request.
        distance: of the target from the shoulder (m).
        error_code, shoulder_and_elbow: the fields of the response, which came at `at` (s).

    Raises:
        Failure: there is no response.
    """

    def __init__(self, call: Call, arm: TwoLinkArm) -> None:
        target = call.request.target
        self.call, self.arm = call, arm
        self.target: Point = (target.point.x, target.point.y)
        self.distance = math.hypot(*self.target)
        self.frame: str = target.header.frame_id
        self.elbow_up: bool = call.request.elbow_up
        try:
            response = call.response
        except Failure as failure:
            failure.expected = f"a response to {self.question}"
            raise
        self.at = call.answered.t
        self.error_code: int = response.error_code
        self.is_a_success = self.error_code == Response.SUCCESS
        self.shoulder_and_elbow: tuple[float, float] = (response.shoulder, response.elbow)

    @property
    def is_within_reach(self) -> bool:
        """Whether the target is certainly within reach: within 1 mm of a limit, rounding may decide."""
        return self.arm.nearest + TOLERANCE < self.distance < self.arm.farthest - TOLERANCE

    @property
    def is_out_of_reach(self) -> bool:
        """Whether the target is certainly out of reach."""
        return not self.arm.nearest - TOLERANCE <= self.distance <= self.arm.farthest + TOLERANCE

    @property
    def elbow_is_above(self) -> bool | None:
        """Whether the elbow is above the line to the target; None if its angle is NaN or infinite."""
        shoulder = self.shoulder_and_elbow[0]
        return self.arm.elbow_is_above(shoulder, self.target) if math.isfinite(shoulder) else None

    # -- words --------------------------------------------------------------------------------------------------------

    @property
    def question(self) -> str:
        """The request in words."""
        x, y = self.target
        return f"({x:g}, {y:g}) in frame {self.frame!r}, elbow_up {shown(self.elbow_up)}"

    @property
    def reach(self) -> str:
        """The range of the arm and the target's distance, in words."""
        arm = self.arm
        reach = f"the arm reaches from {arm.nearest:.3f} to {arm.farthest:.3f} m"
        return f"{reach}; the target is {self.distance:.3f} m away"

    @property
    def angles(self) -> str:
        """The angles of the response, in words."""
        return "shoulder {:.4f}, elbow {:.4f} rad".format(*self.shoulder_and_elbow)


def code_in_words(code: int) -> str:
    """Return an error code with the name of its constant."""
    return f"{CODES.get(code, 'no constant')} ({code})"


def side_in_words(is_above: bool) -> str:
    """Return the side of the elbow as a word."""
    return "above" if is_above else "below"
