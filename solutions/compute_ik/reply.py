"""An answer of the IK service, read in the terms of a planar arm: m, rad."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from autograder.authoring.call import Call
from autograder.authoring.failure import Failure
from autograder.authoring.fields import shown
from humanoid_interfaces.srv import ComputeIK

from .two_link_arm import TOLERANCE, Point, TwoLinkArm

Response = ComputeIK.Response
CODES = {getattr(Response, name): name for name in ("SUCCESS", "NO_IK_SOLUTION", "FRAME_TRANSFORM_FAILURE")}


@dataclass(frozen=True)
class Reply:
    """The answer to a call of the node that computes with `arm`."""

    call: Call
    arm: TwoLinkArm

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
    def response(self) -> Any:
        """The answer, which must have come."""
        try:
            return self.call.response
        except Failure as failure:
            failure.expected = f"an answer to {self.question}"
            raise

    @property
    def error_code(self) -> int:
        """The code of the answer."""
        return self.response.error_code

    @property
    def is_a_success(self) -> bool:
        """Whether the answer is SUCCESS."""
        return self.error_code == Response.SUCCESS

    @property
    def shoulder_and_elbow(self) -> tuple[float, float]:
        """The angles of the answer."""
        return self.response.shoulder, self.response.elbow

    @property
    def at(self) -> float:
        """When (s) it was answered."""
        return self.call.answered.t

    @property
    def distance(self) -> float:
        """How far the target is from the shoulder."""
        return math.hypot(*self.target)

    @property
    def is_within_reach(self) -> bool:
        """Whether the target is certainly within reach; nearer than 1 mm to a limit, rounding may decide."""
        return self.arm.nearest + TOLERANCE < self.distance < self.arm.farthest - TOLERANCE

    @property
    def is_out_of_reach(self) -> bool:
        """Whether the target is certainly out of reach."""
        return not self.arm.nearest - TOLERANCE <= self.distance <= self.arm.farthest + TOLERANCE

    @property
    def elbow_is_above(self) -> bool | None:
        """The side of the elbow; None for an angle that is no number."""
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
        """What the arm can reach, and where the target is."""
        arm = self.arm
        return f"the arm reaches from {arm.nearest:.3f} to {arm.farthest:.3f} m, and this is {self.distance:.3f} m away"

    @property
    def angles(self) -> str:
        """The answer's angles in words."""
        return "shoulder {:.4f}, elbow {:.4f} rad".format(*self.shoulder_and_elbow)


def code_in_words(code: int) -> str:
    """Return an error code with its name."""
    return f"{CODES.get(code, 'without a name')} ({code})"


def side_in_words(is_above: bool) -> str:
    """Return the side of the elbow."""
    return "above" if is_above else "below"
