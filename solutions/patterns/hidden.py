"""The hidden checks, which only the instructor's grading runs: the other six situations."""

from __future__ import annotations

from .judging import situation

situations = [
    situation(
        7,
        "the robot's mode, also for programs that start later",
        "topic b",
        service="Every program would have to send requests all the time to notice a fall; a topic delivers it at once.",
        action="An action needs a goal, and a state is not a goal.",
        a="A topic may carry few messages, so how often the mode changes does not decide it.",
        c="Safety alone does not decide it: every program must receive the mode without a request.",
    ),
    situation(
        8,
        "three joints by name, once an hour",
        "service c",
        topic="The program would receive twenty messages a second to use one an hour, with joints in another order.",
        action="The response comes at once, so there is nothing to watch or to cancel.",
        a="Sensor data is often on a topic, but here one request gets one response, with the joints in its order.",
        b="How often it happens does not decide it.",
    ),
    situation(
        9,
        "one step forward, which can be cancelled",
        "action b",
        topic="A topic does not tell the operator whether the step was made or cancelled in time.",
        service="A service cannot be cancelled, however short it is, so the robot would finish the step.",
        a="“Less than a second” is only a rule of thumb for services.",
        c="Which part moves does not matter. What matters is that the step can be cancelled.",
    ),
    situation(
        10,
        "camera pictures for two displays",
        "topic c",
        service="Each display would have to request every picture, and the camera would send each picture twice.",
        action="An action needs a goal and a result, and there is neither.",
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
        c="Setting a limit moves nothing and is done at once. What matters is whether it is accepted.",
    ),
    situation(
        12,
        "stand up from a crouch, with its phases on a display",
        "action c",
        topic="A topic could show the phases, but it does not tell the caller how the motion ended.",
        service="The response would come only at the end, and the display would stay empty until then.",
        a="A service can report a failure, too.",
        b="How many joints move does not matter. What matters is that a display needs the progress.",
    ),
]
