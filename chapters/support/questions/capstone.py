"""Chapter 11: the capstone."""

from lab.learning.question import Choice, Question

QUESTIONS = (
    Question(
        "An execute callback calls the client's send_goal(), on a node with one thread. Why does that never return?",
        (
            Choice(
                "The goal isn't sent before the callback returns.",
                "It's sent at once: sending needs no executor. The child works, as you have seen.",
            ),
            Choice(
                "The child's answer has to be taken in by the thread that waits for it.",
                "Only the executor takes answers in, and its only thread is inside your callback.",
                right=True,
            ),
            Choice(
                "A node can't have a server and a client of the same type.",
                "It can. The same file works with eight threads.",
            ),
        ),
    ),
    Question(
        "Your parent has sent the cancel to its child, and the child has agreed. When does the parent call canceled()?",
        (
            Choice(
                "Now: the child has agreed.",
                "The child said 'I will try'. The robot is in mid-step, and your client would take it for safe.",
            ),
            Choice(
                "When the child's result has come.",
                "The result comes when the child's goal has ended. Before that something still moves for you.",
                right=True,
            ),
            Choice(
                "Before it asks the child, so that the client needn't wait.",
                "Then the goal of the child has no owner. If it refuses the cancel, nobody even knows.",
            ),
        ),
    ),
    Question(
        "A child has been silent for longer than you wait. You cancel it, and no answer comes. What now?",
        (
            Choice(
                "Wait on: CANCELED without the child's end would be a lie.",
                "The dead don't end. Without a limit here, your own client waits forever.",
            ),
            Choice(
                "Send the goal once more.",
                "Perhaps the child is only mute, and still at work. Then it gets a second goal.",
            ),
            Choice(
                "After a limited time, abort, and name the child.",
                "ABORTED isn't a promise that all is safe. The reason tells people where to look.",
                right=True,
            ),
        ),
    ),
    Question(
        "The child ends CANCELED, but nobody has cancelled your goal: somebody else stopped the child. How do you end?",
        (
            Choice(
                "ABORTED, with the child's name in error_msg.",
                "Your client asked for no cancel. From EXECUTING no transition leads to CANCELED: canceled() raises.",
                right=True,
            ),
            Choice(
                "CANCELED, like the child.",
                "Without a cancel request canceled() raises. And it would tell your client that it had asked for it.",
            ),
            Choice(
                "Send the goal again, until it succeeds.",
                "Somebody stopped that walk, perhaps for a reason. A robot that starts again by itself is dangerous.",
            ),
        ),
    ),
    Question(
        "The battery gets low while a gripper holds a full glass over the table. What is safe?",
        (
            Choice(
                "Cancel the arm, then put the glass down, then give up.",
                "The child at work ends first. Then comes the way out that fits what is in the hand. (Only a child "
                "that puts down what it holds by itself, as the exercise's does, is left to finish.)",
                right=True,
            ),
            Choice(
                "Abort at once: the battery must not get any lower.",
                "The energy for putting it down is a fraction of a percent. The glass is what you lose.",
            ),
            Choice(
                "Send the lowering at once, and the cancel of the lift afterwards.",
                "Then two goals command one arm. At most one child is at work at any moment.",
            ),
        ),
    ),
)

PREDICTIONS = (
    Question(
        "One thread, an errand of 0.8 m, and send_goal() inside execute. What do legs and parent do?",
        (
            Choice(
                "The legs don't walk: the parent blocks before its goal goes out.",
                "A sensible guess: the executor is busy. But sending is a direct call down to the middleware. Only "
                "what comes *in* needs the executor.",
            ),
            Choice(
                "The legs walk and succeed; the parent never hears of it.",
                "The goal goes out at once. The answer would have to be taken in by the thread that waits for it.",
                right=True,
            ),
            Choice(
                "Both work: rclpy goes on spinning inside send_goal().",
                "A sensible guess: rclpy has calls that spin while they wait. But this one only waits for an event, "
                "and leaves the spinning to others.",
            ),
        ),
    ),
    Question(
        "The errand has been cancelled and has ended CANCELED. What does the robot do two seconds later?",
        (
            Choice(
                "It stands: the child is cancelled together with its parent.",
                "A sensible guess: it would be good manners. But to rclpy they are two goals of two servers, "
                "and nothing connects them except your code.",
            ),
            Choice(
                "It stands: go_ahead stops when its client has gone.",
                "A sensible guess: nobody waits for it any more. But the client hasn't gone, only its goal has, and a "
                "server doesn't look for its client anyway.",
            ),
            Choice(
                "It walks on, for nobody.",
                "Nobody has cancelled go_ahead's goal, so go_ahead carries it out.",
                right=True,
            ),
        ),
    ),
    Question(
        "Two errands at once, and legs that take one goal at a time. What becomes of the two?",
        (
            Choice(
                "The second waits until the first is done.",
                "A sensible guess: there's only one pair of legs. But nobody has written a queue, "
                "neither in the parent nor in the child.",
            ),
            Choice(
                "The second takes the legs over from the first.",
                "A sensible guess: chapter 7's server did that. But it preempted by lines of its own, and these legs "
                "have none.",
            ),
            Choice(
                "The second is aborted, the first goes on.",
                "The parent accepts both. The legs reject the second child, so the parent can only give up.",
                right=True,
            ),
        ),
    ),
    Question(
        "The legs are killed on the way. What does the errand notice?",
        (
            Choice(
                "The future of the result raises an exception.",
                "A sensible guess: a broken TCP connection does that. But an answer of ROS that never comes looks "
                "like one that comes later.",
            ),
            Choice(
                "The child's status becomes ABORTED or UNKNOWN.",
                "A sensible guess: somebody should say so. But the status comes from the server, and it's dead.",
            ),
            Choice(
                "Nothing.",
                "Feedback stops, and that's all. Only a limit on silence turns it into knowledge.",
                right=True,
            ),
        ),
    ),
)
