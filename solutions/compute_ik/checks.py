"""What students can see being checked."""

from __future__ import annotations

import math

from autograder.authoring import events as ev
from autograder.authoring import standard
from autograder.authoring.checks import RESTING, Scenario, check, expect
from autograder.authoring.missing import held_up, unseen
from autograder.authoring.transcript import Transcript

from .judging import (
    Reply,
    Response,
    code_in_words,
    replies,
    require_code,
    require_hit,
    require_refusal,
    require_sides,
)
from .questions import ask_for, ask_for_both
from .two_link_arm import TwoLinkArm

ROBOTS_ARM = TwoLinkArm(upper_arm=0.22, forearm=0.30)  # m: shoulder to elbow, elbow to between the fingers
ARM_TOLERANCE = 0.01  # m; its servos bring the hand within 2 mm

POINTS = Scenario(
    "ask",
    {
        "questions": {
            "within reach": [*ask_for_both(0.4, 0.3), *ask_for_both(0.45, -0.1), *ask_for_both(0.1, 0.3)],
            "out of reach": [
                *(ask_for(0.5, 0.4), ask_for(0.56, 0.0), ask_for(-0.3, -0.5)),
                *(ask_for(0.03, 0.02), ask_for(0.0, 0.0)),
            ],
            "not a number": [ask_for(math.nan, 0.3), ask_for(0.4, 0.3)],
        }
    },
    robot=None,
)
FRAMES = Scenario(
    "ask",
    {
        "questions": {
            "in shoulder": [ask_for(0.4, 0.3)],
            "in others": [ask_for(0.4, 0.3, frame=frame) for frame in ("base_link", "l_shoulder", "")],
        }
    },
    robot=None,
)
REAL_ARM = Scenario(
    "move_the_arm",
    {
        "questions": {
            "with the arm": [ask_for(0.4, 0.1), ask_for(0.3, -0.25)],
            "near the shoulder": [ask_for(0.1, 0.05), ask_for(-0.05, 0.12)],
        }
    },
    parameters={"upper_arm_length": ROBOTS_ARM.upper_arm, "forearm_length": ROBOTS_ARM.forearm},
)
# It has a robot, which notices a busy machine; on such a machine Python takes seconds to end.
INTERRUPT = Scenario("interrupt", {"questions": {"within reach": [ask_for(0.4, 0.3)]}}, robot=RESTING)


server_appears = standard.server_appears("compute_ik", points=1, on=INTERRUPT, see="02_services#first-file")


@check(points=2, on=POINTS, needs=server_appears, see="04_your_own_interfaces#cosine-why")
def reaches_the_point(run: Transcript) -> None:
    """The angles it answers with bring the hand to the point, within 1 mm"""
    for reply in replies(run, "within reach"):
        require_hit(reply)


@check(points=2, on=POINTS, needs=reaches_the_point, see="04_your_own_interfaces#cosine-why")
def bends_the_elbow_as_asked(run: Transcript) -> None:
    """The elbow is above the line to the target with elbow_up, below it without"""
    require_sides(replies(run, "within reach"))


@check(points=2, on=POINTS, needs=server_appears, see="04_your_own_interfaces#cosine-why")
def says_what_is_out_of_reach(run: Transcript) -> None:
    """Too far and too near is NO_IK_SOLUTION, and what can be reached is not"""
    for reply in replies(run, "within reach"):
        require_code(
            reply,
            Response.SUCCESS,
            because="this can be reached",
            help="Only what cannot be reached is refused.",
        )
    for reply in replies(run, "out of reach"):
        require_refusal(reply)


@check(points=1, on=FRAMES, needs=server_appears, see="04_your_own_interfaces#server-why")
def refuses_other_frames(run: Transcript) -> None:
    """A target in any frame but "shoulder" is FRAME_TRANSFORM_FAILURE, and no other is"""
    for reply in replies(run, "in shoulder"):
        expect(
            reply.error_code != Response.FRAME_TRANSFORM_FAILURE,
            expected=f"another error_code for {reply.question}: that is the right frame",
            observed=f"error_code {code_in_words(reply.error_code)}",
            help="Compare request.target.header.frame_id with 'shoulder'.",
            at=reply.at,
        )
    for reply in replies(run, "in others"):
        require_code(
            reply,
            Response.FRAME_TRANSFORM_FAILURE,
            because="only 'shoulder' is the frame of the arm",
            help=f"{reply.frame!r} is not 'shoulder'{'' if reply.frame else ' either'}: refuse everything else, "
            "before computing.",
        )


@check(points=2, on=REAL_ARM, needs=bends_the_elbow_as_asked, see="04_your_own_interfaces#parameters-why")
def moves_the_real_hand(run: Transcript) -> None:
    """Started with the robot's own lengths as parameters, its angles bring the robot's hand to the point"""
    for reply in replies(run, "with the arm"):
        require_hit(reply, ROBOTS_ARM)
        _require_the_hand_there(run, reply)


def _arm_after(run: Transcript, reply: Reply) -> ev.ArmReported:
    """Return the arm in the simulator after it had been moved to the answer's angles."""
    for arm in run.all(ev.ArmReported):
        if arm.t > reply.at:
            if run.told("move_joints", before=arm.t).t < reply.at:
                raise held_up(run, f"the arm was not moved to the angles for {reply.question}")
            return arm
    raise unseen(run, f"the robot did not say where its hand was for {reply.question}")


def _require_the_hand_there(run: Transcript, reply: Reply) -> None:
    """Require that the hand was at the target when the arm had come to rest."""
    arm = _arm_after(run, reply)
    x, y = reply.target
    away = math.dist(arm.hand, (x, 0.0, y))
    expect(
        away <= ARM_TOLERANCE,
        expected=f"the robot's hand within {ARM_TOLERANCE * 1000:.0f} mm of {reply.question}",
        observed=f"{reply.angles}: the hand came to {arm.hand[0]:.3f} m forward, {arm.hand[2]:.3f} m up, "
        f"{away * 1000:.0f} mm off",
        help="The robot's elbow bends one way only, as yours does: with elbow_up false its angle has to be positive.",
        at=arm.t,
    )


ends_cleanly = standard.ends_cleanly(
    points=1, on=INTERRUPT, needs=server_appears, see="02_services#conventions"
)
