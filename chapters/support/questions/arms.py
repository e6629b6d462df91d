"""Chapter 9: arms."""

from lab.learning.question import Choice, Question

QUESTIONS = (
    Question(
        "A program sends a trajectory of ten points, each with velocities of 0.0. How does the arm move?",
        (
            Choice(
                "As if there were no velocities.",
                "Only an empty list means that no velocities are given. A list of zeros is a list of velocities.",
            ),
            Choice(
                "It comes to rest at each of the ten points.",
                "You command 0 rad/s at each point. Leave the list empty, or send velocities that fit the motion.",
                right=True,
            ),
            Choice(
                "It does not move: its velocity is 0.",
                "The joints still have to reach the positions at their times. So the arm moves between the points.",
            ),
        ),
    ),
    Question(
        "A joint is held 0.2 rad before its last point. The path tolerance is 0.5 rad, the goal tolerance 0.05 rad. "
        "What ends the goal?",
        (
            Choice(
                "The path tolerance, as soon as the joint is held.",
                "The joint is at most 0.2 rad behind, so it never leaves the path.",
            ),
            Choice(
                "Neither: it succeeds, because it is near enough.",
                "0.2 rad is four times the goal tolerance. At the end of an arm of half a metre it is 10 cm.",
            ),
            Choice(
                "The goal tolerance, some time after the end.",
                "On the way an error of 0.2 rad is allowed. At the end it is not.",
                right=True,
            ),
        ),
    ),
    Question(
        "Your server finds that the arm is blocked. What does it do, and in which order?",
        (
            Choice(
                "abort(), then an empty trajectory.",
                "The status ABORTED is published at once. A client that reads it may send the next goal at once, and "
                "then your empty trajectory would stop that goal's motion.",
            ),
            Choice(
                "An empty trajectory, then abort() with a code.",
                "The motion ends first, and only then the client is informed.",
                right=True,
            ),
            Choice(
                "abort() with a code; a goal that has ended moves nothing.",
                "A terminal call only informs the client. The robot goes on with its trajectory.",
            ),
        ),
    ),
    Question(
        "A trajectory has a position outside the joint's range, which you know from joint_limits. What does the server "
        "do?",
        (
            Choice(
                "Reject the goal.",
                "The server knows the mistake before anything moves. It logs the reason, because a rejection carries "
                "none.",
                right=True,
            ),
            Choice(
                "Clamp the position to the joint's range and go on.",
                "The client would read SUCCEEDED, but the arm wouldn't be where the client wants it.",
            ),
            Choice(
                "Accept it, because the goal tolerance will detect it.",
                "It would, but only after the arm has moved as far as it can. Report a mistake as soon as you know it.",
            ),
        ),
    ),
    Question(
        "The cup is 6 cm wide. The fingers press with 400 N for each metre by which the commanded opening is smaller "
        "than the cup. Each finger should press with 10 N. Which opening do you command?",
        (
            Choice(
                "0.035 m.",
                "The opening must be 10 / 400 = 0.025 m smaller than the cup. Read wrench to see whether the force is "
                "10 N.",
                right=True,
            ),
            Choice(
                "0.06 m: that is its width.",
                "Then the opening is as wide as the cup, and the fingers touch it without force.",
            ),
            Choice(
                "0.0 m: closed.",
                "Then the opening is 6 cm smaller than the cup, which is 24 N: enough to crush a paper cup.",
            ),
        ),
    ),
    Question(
        "A goal is cancelled while the hand holds a full cup above the floor. Which reaction is wrong?",
        (
            Choice(
                "Hold still, keep the cup, CANCELED.",
                "This one is right: the robot stands, and the cup is safe. The documentation has to say that the cup "
                "stays in the hand.",
            ),
            Choice(
                "Put it down where it was taken, then CANCELED.",
                "This one is right, as long as the motion is short and the place is free.",
            ),
            Choice(
                "Open the hand at once, CANCELED.",
                "The goal ends quickly, but the cup falls. A cancel must leave both the robot and what it holds safe.",
                right=True,
            ),
        ),
    ),
)

PREDICTIONS = (
    Question(
        "Two points, both with velocities=[0.0]. What does the elbow do at the middle one?",
        (
            Choice(
                "It passes at a constant speed.",
                "A sensible guess: that is what happens without velocities. But a velocity of 0 at a point is a "
                "command like any other velocity.",
            ),
            Choice(
                "The robot ignores the message.",
                "A sensible guess: 0 rad/s sounds like the speed of the whole motion. But it is only the speed at that "
                "point; between the points the joint moves.",
            ),
            Choice(
                "It comes to rest, and starts again.",
                "The message commands 0 rad/s at 1.5 s, so the joint slows down before that and speeds up after it.",
                right=True,
            ),
        ),
    ),
    Question(
        "The left elbow moves, and a new trajectory names only the right elbow. What does the left one do?",
        (
            Choice(
                "It goes on to its end.",
                "A sensible guess: no command stops it. But the robot follows one trajectory at a time, and the "
                "new one has no positions for the left elbow.",
            ),
            Choice(
                "It stops where it is.",
                "The new trajectory replaces the old one as a whole. A joint that it doesn't name holds its position.",
                right=True,
            ),
            Choice(
                "It goes back to where it was before.",
                "A sensible guess: the robot could undo the old trajectory. But it only drops it, and the elbow holds "
                "its position.",
            ),
        ),
    ),
    Question(
        "Somebody holds the elbow half way. The server only waits for the time to pass. How does its goal end?",
        (
            Choice(
                "SUCCEEDED, after four seconds.",
                "The server calls succeed() after its sleep, wherever the elbow is.",
                right=True,
            ),
            Choice(
                "ABORTED, on the way.",
                "A sensible guess: the motors push and the joint doesn't move. But the topic "
                "joint_trajectory carries no answer, and the server doesn't read joint_states.",
            ),
            Choice(
                "Not at all: it waits for the elbow.",
                "A sensible guess: the goal isn't reached. But this server waits for the time to pass, not for "
                "the elbow.",
            ),
        ),
    ),
    Question(
        "The goal was aborted two seconds ago. Now the hand lets go of the elbow. What does the arm do?",
        (
            Choice(
                "It jumps to the end of the trajectory.",
                "The trajectory ran on without the elbow, and the motor pushed all the time.",
                right=True,
            ),
            Choice(
                "It stays: its goal is over.",
                "A sensible guess: it should stay. But no message stopped the robot's motion. The robot knows "
                "only trajectories, and no goals.",
            ),
            Choice(
                "It goes on from here, as slowly as planned.",
                "A sensible guess: the path is the same. But a trajectory doesn't wait for its joints, and the time of "
                "its last point has passed.",
            ),
        ),
    ),
    Question(
        "The fingers press with 0.6 N each, and the hand goes up by 10 cm. Where is the cup?",
        (
            Choice(
                "In the hand, 10 cm up.",
                "A sensible guess: it looks like a grasp. But friction carries the cup, and 0.6 N gives too little of "
                "it.",
            ),
            Choice(
                "It slips half way and falls.",
                "A sensible guess: things do slip from hands. But friction is too small from the beginning, so the cup "
                "never leaves the table.",
            ),
            Choice(
                "On the table.",
                "With a friction coefficient of 1.5, two fingers carry 2 · 1.5 · 0.6 N = 1.8 N. The cup weighs 2.9 N.",
                right=True,
            ),
        ),
    ),
)
