"""Chapter 12: the design of links."""

from lab.learning.question import Choice, Question

QUESTIONS = (
    Question(
        "Which part does ROS have in a hard emergency stop?",
        (
            Choice(
                "An action with feedback, so that the operator sees how far the stop is.",
                "A goal can be rejected, and it needs a network, a process and a free thread. None of them is sure.",
            ),
            Choice(
                "None at all: ROS must not know of it.",
                "It stops nothing. But nodes have to know, or they send goals to a robot without power.",
            ),
            Choice(
                "It's told afterwards: a latched topic says so, and servers reject goals meanwhile.",
                "A wire, a relay and the drives do the stopping, whether a program runs or not.",
                right=True,
            ),
        ),
    ),
    Question(
        "A design says of a link: 'rate: when needed'. What does the marker miss?",
        (
            Choice(
                "The QoS depth that goes with it.",
                "That belongs to QoS. Here something else is missing.",
            ),
            Choice(
                "A number, and where it comes from.",
                "Only a number says what silence is: two seconds are long at 20 Hz, and nothing at once a day.",
                right=True,
            ),
            Choice(
                "Nothing: a service has no rate.",
                "How often people call it decides a lot, also for services: 'by hand, some ten times a day' is enough.",
            ),
        ),
    ),
)

PREDICTIONS = (
    Question(
        "The gripper's design loses one point of 20. For what?",
        (
            Choice(
                "QoS: the force is best effort, so messages get lost.",
                "A sensible guess: lost sounds bad. But the design says why it does not matter, and that is what the "
                "rubric asks for.",
            ),
            Choice(
                "Rate: 'often' is no number.",
                "All links but one have a number, so it is 2 of 3.",
                right=True,
            ),
            Choice(
                "Safety: a gripper can crush a finger.",
                "A sensible guess: it could. But the limit of 20 N is in the gripper's own board, and no program can "
                "raise it.",
            ),
        ),
    ),
    Question(
        "The conveyor's design: where does it lose most?",
        (
            Choice(
                "Everywhere: type, QoS, failure and safety get 0 each.",
                "Two links of three lack the fact each time, and the stop needs a program, a network and an answer.",
                right=True,
            ),
            Choice(
                "In the pattern: the emergency stop is an action.",
                "A sensible guess: it is the worst single mistake. But the other two patterns fit, so that costs one "
                "point there. It costs three under safety.",
            ),
            Choice(
                "In the graph: a link from the button to the line is missing.",
                "A sensible guess: the line should know of a stop. But each of the three needs has its link.",
            ),
        ),
    ),
)
