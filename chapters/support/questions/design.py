"""Chapter 12: a design."""

from lab.learning.question import Choice, Question

QUESTIONS = (
    Question(
        "Which role does ROS have in a hard emergency stop?",
        (
            Choice(
                "An action with feedback, so that the operator sees how far the stop is.",
                "A goal can be rejected, and it needs a network, a process and a free thread. Each of them can fail.",
            ),
            Choice(
                "None at all: no node may know about it.",
                "ROS doesn't stop the robot. But nodes have to know, or they send goals to a robot without power.",
            ),
            Choice(
                "It's informed afterwards: a latched topic reports the stop, and servers reject goals meanwhile.",
                "A wire, a relay and the drives stop the robot, whether a program runs or not.",
                right=True,
            ),
        ),
    ),
    Question(
        "A design has a link with 'rate: when needed'. What will the marker find missing?",
        (
            Choice(
                "The QoS depth that goes with it.",
                "The depth belongs to the fact QoS. The fact rate lacks something else.",
            ),
            Choice(
                "A number, and where it comes from.",
                "Only with a number you can decide whether silence is a failure: two seconds without a message are "
                "long at 20 Hz, but normal at once a day.",
                right=True,
            ),
            Choice(
                "Nothing: a service has no rate.",
                "A service has a rate, too: how often it is called. 'By hand, some ten times a day' is enough.",
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
                "A sensible guess: lost messages sound bad. But the design says why they don't matter, and the "
                "rubric requires just that.",
            ),
            Choice(
                "Rate: 'often' is not a number.",
                "All links except one have a number, which gives 2 points of 3.",
                right=True,
            ),
            Choice(
                "Safety: a gripper can crush a finger.",
                "A sensible guess: it could. But the gripper's own board limits the force to 20 N, and no program can "
                "raise this limit.",
            ),
        ),
    ),
    Question(
        "Where does the conveyor's design lose most points?",
        (
            Choice(
                "In many places: type, QoS, failure and safety get 0 points each.",
                "Two of the three links lack each of these facts. And the emergency stop needs a program, a network "
                "and an answer.",
                right=True,
            ),
            Choice(
                "In the pattern: the emergency stop is an action.",
                "A sensible guess: it is the worst single mistake. But the other two patterns fit, so it costs one "
                "point under pattern. It costs three under safety.",
            ),
            Choice(
                "In the graph: a link from the button to the line is missing.",
                "A sensible guess: the line should know about a stop. But each of the three required links is there.",
            ),
        ),
    ),
)
