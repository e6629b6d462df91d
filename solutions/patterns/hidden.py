"""What only the instructor's grading checks: the other six situations."""

from __future__ import annotations

from autograder.authoring.checks import check

from .checks import ANSWERS, answers_everything
from .judging import Situation, judge_of

UNSEEN = (
    Situation(
        7,
        "the robot's mode, also for those who come later",
        "topic",
        "b",
        {
            "service": "Everybody would have to ask again and again to notice a fall; told is sooner.",
            "action": "A state is no task: nobody set it as a goal.",
            "a": "A topic that is seldom published is a topic all the same.",
            "c": "Safety does not decide it: what is needed is that everybody hears of it without asking.",
        },
    ),
    Situation(
        8,
        "three joints by name, once an hour",
        "service",
        "c",
        {
            "topic": "It would listen to twenty messages a second to use one an hour, in another order than it wants.",
            "action": "The answer is there at once: nothing to watch, nothing to cancel.",
            "a": "Where they flow they go by topic; here one question has one answer, in the asker's own order.",
            "b": "How rare it is decides nothing.",
        },
    ),
    Situation(
        9,
        "one step forward, which can be called off",
        "action",
        "b",
        {
            "topic": "Then nobody is told whether the step was made, or called off in time.",
            "service": "A service cannot be cancelled, however short it is: the foot would come down.",
            "a": "Under a second is a rule of thumb for services, and no more.",
            "c": "What the legs are has no part in it.",
        },
    ),
    Situation(
        10,
        "camera pictures for two displays",
        "topic",
        "c",
        {
            "service": "Each display would pull every picture by itself, and the camera would answer twice.",
            "action": "There is no goal, and no end.",
            "a": "The size of a message decides nothing about the pattern.",
            "b": "A display that misses one picture shows the next.",
        },
    ),
    Situation(
        11,
        "a new top speed, accepted or refused with a reason",
        "service",
        "a",
        {
            "topic": "The new value could be impossible, and the sender would never know.",
            "action": "It is set at once; there is nothing in between.",
            "b": "That it is one number decides nothing.",
            "c": "It concerns walking, and is none: nothing moves because of it.",
        },
    ),
    Situation(
        12,
        "stand up from a crouch, with its phases on a display",
        "action",
        "c",
        {
            "topic": "The phases could go by a topic. But who asks for it, and learns how it ended?",
            "service": "The answer would come at the end, and the display would stay empty until then.",
            "a": "It does not fail more often than other things, and every pattern has ways to fail.",
            "b": "Many joints move in many ways: what decides is progress, and that it may have to be stopped.",
        },
    ),
)

situations = [
    check(points=1, on=ANSWERS, needs=answers_everything)(judge_of(situation)) for situation in UNSEEN
]
