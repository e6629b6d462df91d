"""Chapter 11: the capstone."""

from lab.learning.question import Choice, Question

QUESTIONS = (
    Question(
        "An execute callback calls the client's send_goal(), on a node with one thread. Why does that never return?",
        (
            Choice(
                "The goal isn't sent before the callback returns.",
                "It's sent at once: sending needs no executor. As you have seen, the child executes it.",
            ),
            Choice(
                "Only the thread that waits for the child's answer could receive it.",
                "Only the executor receives answers, and its only thread is inside your callback.",
                right=True,
            ),
            Choice(
                "A node can't have a server and a client of the same type.",
                "It can. The same file works with eight threads.",
            ),
        ),
    ),
    Question(
        "Your parent has cancelled its child's goal, and the child has accepted the cancel. When does the parent call "
        "canceled()?",
        (
            Choice(
                "Now: the child has accepted the cancel.",
                "The child has only promised to try. The robot is in mid-step, but your client would think it's safe.",
            ),
            Choice(
                "When the child's result has arrived.",
                "The result arrives when the child's goal has ended. Before that the robot still moves.",
                right=True,
            ),
            Choice(
                "Before it cancels the child's goal, so that the client doesn't have to wait.",
                "Then nobody watches the child's goal any more. If the child refuses the cancel, nobody notices.",
            ),
        ),
    ),
    Question(
        "A child has given no feedback for longer than your limit. You cancel it, and it doesn't answer. What now?",
        (
            Choice(
                "Keep waiting: CANCELED before the child's end would be false.",
                "A dead child never ends its goal. Without a limit here, your own client waits forever.",
            ),
            Choice(
                "Send the goal once more.",
                "The child may still work without sending feedback. Then it gets a second goal.",
            ),
            Choice(
                "After a limited time, abort, and name the child.",
                "ABORTED doesn't promise that the robot is safe. With the child's name people know where to look.",
                right=True,
            ),
        ),
    ),
    Question(
        "The child ends CANCELED, but nobody has cancelled your goal: somebody else stopped the child. How do you end?",
        (
            Choice(
                "ABORTED, with the child's name in error_msg.",
                "Your client has sent no cancel request. From EXECUTING no transition leads to CANCELED, so "
                "canceled() raises an exception.",
                right=True,
            ),
            Choice(
                "CANCELED, like the child.",
                "Without a cancel request canceled() raises an exception. And CANCELED would be wrong, because your "
                "client didn't cancel.",
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
                "The active child ends first. Then follow the steps that fit what is in the hand. (A child that puts "
                "down by itself what it holds, as in the exercise, is an exception: let it finish.)",
                right=True,
            ),
            Choice(
                "Abort at once: the battery must not get any lower.",
                "Putting the glass down costs a fraction of a percent of the charge. If you abort at once, you may "
                "lose the glass.",
            ),
            Choice(
                "Send the lowering at once, and the cancel of the lift afterwards.",
                "Then two goals command one arm. Only one child may be active at any moment.",
            ),
        ),
    ),
)

PREDICTIONS = (
    Question(
        "The parent has one thread and calls send_goal() inside execute, for an errand of 0.8 m. What do the legs and "
        "the parent do?",
        (
            Choice(
                "The legs don't walk: the parent blocks before its goal is sent.",
                "A sensible guess: the executor is busy. But to send is a direct call of the middleware. Only "
                "receiving needs the executor.",
            ),
            Choice(
                "The legs walk and succeed, but the parent never receives the answer.",
                "The goal is sent at once. But only the thread that waits for the answer could receive it.",
                right=True,
            ),
            Choice(
                "Both work: rclpy goes on spinning inside send_goal().",
                "A sensible guess: rclpy has calls that spin while they wait. But this one only waits for an event, "
                "and another thread would have to spin.",
            ),
        ),
    ),
    Question(
        "The errand has been cancelled and has ended CANCELED. What does the robot do two seconds later?",
        (
            Choice(
                "It stands: the child is cancelled together with its parent.",
                "A sensible guess: that would be useful. But for rclpy they are two goals of two servers, "
                "and only your code connects them.",
            ),
            Choice(
                "It stands: go_ahead stops when its client has gone.",
                "A sensible guess: nobody waits for go_ahead any more. But its client still runs, only the errand's "
                "goal has ended. And a server doesn't check whether its client exists.",
            ),
            Choice(
                "It walks on: go_ahead knows nothing of the errand.",
                "No cancel request was sent to go_ahead, so go_ahead executes its goal to the end.",
                right=True,
            ),
        ),
    ),
    Question(
        "You send two errands at once, but the legs accept one goal at a time. What happens to the two errands?",
        (
            Choice(
                "The second waits until the first is done.",
                "A sensible guess: there's only one pair of legs. But neither the parent nor the child has a queue.",
            ),
            Choice(
                "The second takes the legs over from the first.",
                "A sensible guess: the server of chapter 7 did that. But it had code for preemption, and these legs "
                "have none.",
            ),
            Choice(
                "The second is aborted, the first goes on.",
                "The parent accepts both. The legs reject the goal of the second errand, so the parent can only abort "
                "this errand.",
                right=True,
            ),
        ),
    ),
    Question(
        "The legs are killed on the way. What does the errand notice?",
        (
            Choice(
                "The future of the result raises an exception.",
                "A sensible guess: a broken TCP connection does that. But in ROS an answer that never arrives looks "
                "like one that arrives later.",
            ),
            Choice(
                "The child's status becomes ABORTED or UNKNOWN.",
                "A sensible guess: such a status would be useful. But the server publishes the status, and it's dead.",
            ),
            Choice(
                "Nothing: no answer looks like a late answer.",
                "Feedback stops, and nothing else happens. Only with a time limit can the errand conclude that the "
                "legs are dead.",
                right=True,
            ),
        ),
    ),
)
