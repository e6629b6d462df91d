"""What students can see being checked: the form of the answers, and the first six situations."""

from __future__ import annotations

from autograder.authoring.checks import check, program
from autograder.authoring.transcript import Transcript

from .judging import Situation, judge_of, require_answers

PATTERNS = "01_robot_and_graph#patterns"  # the lesson
ANSWERS = program("print_answers", timed=False)


@check(points=1, on=ANSWERS)
def answers_everything(run: Transcript) -> None:
    """Each of the twelve situations has a pattern and a reason"""
    require_answers(run)


SEEN = (
    Situation(
        1,
        "joint angles for whoever draws or logs them",
        "topic",
        "a",
        {
            "service": "Twenty questions a second from every listener, for numbers that flow anyway?",
            "action": "There is no goal here that could be reached or given up.",
            "b": "Sensor data need not arrive every time: the next sample is 50 ms away.",
            "c": "On the contrary: they flow whether anybody asks or not, and that is what decides.",
        },
    ),
    Situation(
        2,
        "motors on or off, unless the robot walks",
        "service",
        "b",
        {
            "topic": "A topic has no way to say no: whoever publishes “off” never learns that it was refused.",
            "action": "Nothing lasts here: it is done, or refused, at once. There is nothing to watch or to cancel.",
            "a": "How often it happens decides nothing. Whether the caller needs the answer does.",
            "c": "No service is carried out for certain: the server can die before the work. It can only be answered.",
        },
    ),
    Situation(
        3,
        "walk to the table",
        "action",
        "c",
        {
            "topic": "Who hears whether it arrived? And how is one walk among others called off?",
            "service": "Its caller would be blocked for half a minute, see nothing, and could not stop it.",
            "a": "A long way is no reason, a short one none against: may it have to be stopped or watched?",
            "b": "An action has an answer, too, but that is what it shares with a service.",
        },
    ),
    Situation(
        4,
        "velocity commands from a joystick",
        "topic",
        "a",
        {
            "service": "An answer to each of twenty commands a second would come when the next one is long on its way.",
            "action": "A velocity has no end that could be reached.",
            "b": "Commands go by topics, services or actions: what it is called decides nothing.",
            "c": "A lost command does no harm: the next one comes 50 ms later, and silence means stop.",
        },
    ),
    Situation(
        5,
        "joint angles for a point the hand shall reach",
        "service",
        "b",
        {
            "topic": "Whose answer is whose? On a topic nothing ties an answer to the question it belongs to.",
            "action": "It is computed in less than a millisecond: nobody can watch or cancel that.",
            "a": "Mathematics can stand behind any of the three.",
            "c": "A topic can carry a frame and units as well.",
        },
    ),
    Situation(
        6,
        "grasp the cup and lift it",
        "action",
        "a",
        {
            "topic": "Nobody would learn that the cup has slipped.",
            "service": "While it is under way nobody could stop the arm, and the caller would not know how far it is.",
            "b": "A number in an answer fits a service as well.",
            "c": "Two seconds or twenty: what decides is that it goes on and can be stopped on the way.",
        },
    ),
)

situations = [
    check(points=1, on=ANSWERS, needs=answers_everything, see=PATTERNS)(judge_of(situation))
    for situation in SEEN
]
