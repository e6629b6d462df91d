"""Chapter 9: arms."""

from lab.learning.question import Choice, Question

QUESTIONS = (
    Question(
        "A program sends a trajectory of ten points, each with velocities of 0.0. How does the arm move?",
        (
            Choice(
                "As if there were no velocities.",
                "An empty list means that nothing is demanded. A list of zeros is a demand.",
            ),
            Choice(
                "It comes to rest at each of the ten points.",
                "0 rad/s at a point is what you asked for. Leave the list empty, or send velocities that fit.",
                right=True,
            ),
            Choice(
                "It does not move: its velocity is 0.",
                "The positions still have to be reached at their times. Between the points it moves.",
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
                "0.2 rad are four times the goal tolerance. With an arm of half a metre they are 10 cm.",
            ),
            Choice(
                "The goal tolerance, when the time is over and the patience, too.",
                "On the way 0.2 rad are allowed. At the end they are not.",
                right=True,
            ),
        ),
    ),
    Question(
        "Your server finds that the arm is blocked. What does it do, and in which order?",
        (
            Choice(
                "abort(), then an empty trajectory.",
                "The status ABORTED goes out at once. Whoever watches it, or has its result from a server in C++, "
                "may send the next goal, and your empty trajectory would stop that one.",
            ),
            Choice(
                "An empty trajectory, then abort() with a code and the joint's name.",
                "First the motion ends, then the client learns of it.",
                right=True,
            ),
            Choice(
                "abort() with a code; a goal that has ended moves nothing.",
                "A terminal call is a message to the client. The robot goes on with its trajectory.",
            ),
        ),
    ),
    Question(
        "A trajectory asks for a position outside the joint's range. joint_limits has told you the range. What now?",
        (
            Choice(
                "Reject the goal.",
                "You know it before anything moves. Log the reason, because a rejection carries none.",
                right=True,
            ),
            Choice(
                "Bring the position to the end of the range and go on.",
                "The client would read SUCCEEDED and have an arm somewhere else. Nobody asked for that.",
            ),
            Choice(
                "Accept it; the goal tolerance will find it out.",
                "It would, after the arm has moved as far as it can. What you know at once, say at once.",
            ),
        ),
    ),
    Question(
        "The cup is 6 cm wide, and the fingers press with 400 N for each metre that is missing. Each finger is to "
        "press with 10 N. Which opening do you command?",
        (
            Choice(
                "0.035 m.",
                "10 / 400 = 0.025 m have to be missing. wrench tells whether that became 10 N.",
                right=True,
            ),
            Choice(
                "0.06 m: that is its width.",
                "Then nothing is missing, and the fingers touch it with no force.",
            ),
            Choice(
                "0.0 m: closed.",
                "6 cm are missing then, which is 24 N: enough to crush a paper cup.",
            ),
        ),
    ),
    Question(
        "A goal is cancelled while the hand holds a full cup above the floor. Which answer is not sound?",
        (
            Choice(
                "Hold still, keep the cup, CANCELED.",
                "That is sound: the robot stands, the cup is safe. The documentation has to say that the cup stays in "
                "the hand.",
            ),
            Choice(
                "Put it down where it was taken, then CANCELED.",
                "That is sound, as long as it is short and the place is free.",
            ),
            Choice(
                "Open the hand at once, CANCELED.",
                "The quickest end of the goal, and the worst for the cup. Safe means: the robot, and what it holds.",
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
                "It passes at a constant speed: the two halves are equally long.",
                "A sensible guess: that is what happens without velocities. But a velocity of 0 at a point is a "
                "demand like any other.",
            ),
            Choice(
                "The robot ignores the message: with a velocity of 0 nothing can move.",
                "A sensible guess: 0 rad/s sounds like a speed for the way. But it is the speed at the point, and the "
                "way has its own.",
            ),
            Choice(
                "It comes to rest, and sets out again.",
                "0 rad/s at 1.5 s is what the message says, so the robot slows down before and speeds up after it.",
                right=True,
            ),
        ),
    ),
    Question(
        "The left elbow moves, and a new trajectory names only the right elbow. What does the left one do?",
        (
            Choice(
                "It goes on to its end: the new trajectory does not name it.",
                "A sensible guess: nobody told it to stop. But the robot follows one trajectory at a time, and in the "
                "new one the left elbow has no place to go to.",
            ),
            Choice(
                "It stops where it is.",
                "The new trajectory replaces the old one as a whole. What it does not name holds.",
                right=True,
            ),
            Choice(
                "It goes back to where it was before.",
                "A sensible guess: what is replaced might be undone. But it is only given up, and the elbow holds.",
            ),
        ),
    ),
    Question(
        "Somebody holds the elbow half way. How does the goal of the server that believes the clock end?",
        (
            Choice(
                "SUCCEEDED, after four seconds.",
                "The sleep was over, and succeed() follows whatever sleep is over.",
                right=True,
            ),
            Choice(
                "ABORTED: the robot notices that it cannot move.",
                "A sensible guess: the robot has motors that push and joints that do not move. But the topic "
                "joint_trajectory has no way back, and the server asks nobody.",
            ),
            Choice(
                "Not at all: the server waits until the elbow is there.",
                "A sensible guess: a goal is there to be reached. But this server waits for the clock, not for "
                "the elbow.",
            ),
        ),
    ),
    Question(
        "The goal has been aborted two seconds ago. Now the hand lets go of the elbow. What does the arm do?",
        (
            Choice(
                "It jumps to the end of the trajectory.",
                "The trajectory ran on without the elbow, and the motor pushed all the time.",
                right=True,
            ),
            Choice(
                "It stays: its goal is over.",
                "A sensible guess: so it should be. But nobody told the robot. It knows trajectories, and no goals.",
            ),
            Choice(
                "It goes on from here, as slowly as planned.",
                "A sensible guess: the way is the same. But a trajectory does not wait for its joints, and its times "
                "are over.",
            ),
        ),
    ),
    Question(
        "The fingers press with 0.6 N each, and the hand goes up by 10 cm. Where is the cup?",
        (
            Choice(
                "In the hand, 10 cm up: the hand is closed.",
                "A sensible guess: it looks like a grasp. But friction carries the cup, and 0.6 N give too little.",
            ),
            Choice(
                "It slips half way and falls.",
                "A sensible guess: things do slip from hands. But friction is too small from the beginning, so the cup "
                "never leaves the table.",
            ),
            Choice(
                "On the table.",
                "2 · 1.5 · 0.6 N = 1.8 N of friction, and the cup weighs 2.9 N.",
                right=True,
            ),
        ),
    ),
)
