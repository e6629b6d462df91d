"""The checks that students can see and run themselves."""

from __future__ import annotations

from .judging import answers_everything, situation

__all__ = ["answers_everything", "situations"]

situations = [
    situation(
        1,
        "joint angles for any program that draws or logs them",
        "topic a",
        service="Every subscriber would have to send twenty requests a second for numbers that are published anyway.",
        action="An action needs a goal that can be reached or cancelled, and there is none here.",
        b="A lost sample does no harm: the next one comes 50 ms later.",
        c="The robot sends the angles without a request. What decides is who starts the communication.",
    ),
    situation(
        2,
        "motors on or off, unless the robot walks",
        "service b",
        topic="A topic carries no response: the program that publishes “off” does not learn that the robot refused.",
        action="The robot does it or refuses it at once, so there is nothing to watch or to cancel.",
        a="How often it happens does not matter. What matters is whether the caller needs a response.",
        c="No pattern guarantees that the work is done: the server can die before it.",
    ),
    situation(
        3,
        "walk to the table",
        "action c",
        topic="A topic tells the caller neither that the robot arrived nor how to cancel this walk.",
        service="The caller would wait for half a minute, see no progress, and could not stop the robot.",
        a="The distance does not matter. Ask whether the caller may have to stop or watch the walk.",
        b="A service can do that as well. Look for what only an action can do.",
    ),
    situation(
        4,
        "velocity commands from a joystick",
        "topic a",
        service="Twenty commands a second need no responses: the next command comes before you could use a response.",
        action="A velocity is not a goal: it is never reached.",
        b="Topics, services and actions can all carry commands, so that does not decide it.",
        c="A lost command does no harm: the next one comes 50 ms later, and without commands the robot stops.",
    ),
    situation(
        5,
        "joint angles for a point that the hand has to reach",
        "service b",
        topic="On a topic nothing connects a response with its request, so a client cannot find its own response.",
        action="The robot computes it in less than a millisecond, so there is nothing to watch or to cancel.",
        a="All three patterns can carry the result of a calculation.",
        c="A message on a topic can have a frame, too.",
    ),
    situation(
        6,
        "grasp the cup and lift it",
        "action a",
        topic="A topic does not tell the caller that the cup has slipped.",
        service="The caller could not stop the arm on the way, and would not see how far it is.",
        b="The response of a service can have a number, too.",
        c="The duration does not matter. What matters is that it can fail on the way and can be stopped.",
    ),
]
