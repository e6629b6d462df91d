"""What only the instructor's grading checks: the other six situations."""

from __future__ import annotations

from .judging import situation

situations = [
    situation(
        7,
        "the robot's mode, also for those who come later",
        "topic b",
        service="Every program would have to ask again and again to notice a fall; a topic tells it at once.",
        action="An action needs a goal, and a state is none.",
        a="A topic may carry few messages: how often it changes does not decide it.",
        c="Safety alone does not decide it: every program must get the mode without asking.",
    ),
    situation(
        8,
        "three joints by name, once an hour",
        "service c",
        topic="It would receive twenty messages a second to use one an hour, and in the wrong order.",
        action="The answer comes at once, so there is nothing to watch or to cancel.",
        a="Sensor data is often a topic, but here one question gets one answer, in its own order.",
        b="How often it happens does not decide it.",
    ),
    situation(
        9,
        "one step forward, which can be called off",
        "action b",
        topic="A topic does not tell the operator whether the step was made or cancelled in time.",
        service="A service cannot be cancelled, however short it is, so the robot would finish the step.",
        a="“Less than a second” is only a rule of thumb for services.",
        c="Which part moves does not matter: being able to cancel does.",
    ),
    situation(
        10,
        "camera pictures for two displays",
        "topic c",
        service="Each display would have to request every picture, and the camera would answer twice.",
        action="An action needs a goal and an end, and there is neither.",
        a="The size of a message does not decide the pattern.",
        b="A display that misses one picture shows the next.",
    ),
    situation(
        11,
        "a new top speed, accepted or refused with a reason",
        "service a",
        topic="The value may be impossible, and a topic would not tell the sender.",
        action="The robot sets it at once, so there is nothing to watch or to cancel.",
        b="All three patterns can carry one number.",
        c="Setting a limit moves nothing; it is done at once, so what matters is the yes or no.",
    ),
    situation(
        12,
        "stand up from a crouch, with its phases on a display",
        "action c",
        topic="A topic could show the phases, but it does not tell the caller how the motion ended.",
        service="The answer would come at the end, and the display would stay empty until then.",
        a="A service can report a failure, too.",
        b="How many joints move does not matter. What matters is that a display needs the progress.",
    ),
]
