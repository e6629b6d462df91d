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
                "It's told afterwards: a latched topic, and servers that reject goals.",
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
        "How many of the 20 points does the conveyor's design get?",
        (
            Choice(
                "6.",
                "Type, QoS, failure and safety get 0 points each: more than half of the links lack the first three, "
                "and the emergency stop needs a program, a network and an answer.",
                right=True,
            ),
            Choice(
                "11.",
                "A sensible guess: each link says something about each fact. But a time limit is missing from every "
                "failure, and two of the three types have no unit.",
            ),
            Choice(
                "16.",
                "A sensible guess: the emergency stop is the worst single mistake, and it costs one point under "
                "pattern and three under safety. But type, QoS and failure get 0 points, too.",
            ),
        ),
    ),
)
