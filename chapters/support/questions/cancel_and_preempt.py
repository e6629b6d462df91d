"""Chapter 7: cancel and preempt."""

from lab.learning.question import Choice, Question

QUESTIONS = (
    Question(
        "A client cancels a goal. The answer has return_code 0 and an empty goals_canceling. What happens to the goal?",
        (
            Choice(
                "It is being cancelled: 0 means that there was no error.",
                "It should mean that, and rclpy's server answers 0 to a refusal, too. The goals that it will cancel "
                "are in the list, and the list is empty.",
            ),
            Choice(
                "It goes on as if nobody had asked.",
                "The server refused, as rclpy's default cancel callback does. Look for your goal in the list.",
                right=True,
            ),
            Choice(
                "It was over before.",
                "Then the answer would have been return_code 3, ERROR_GOAL_TERMINATED.",
            ),
        ),
    ),
    Question(
        "A server runs with rclpy.spin(node) and sleeps in its execute callback. When is a cancel request answered?",
        (
            Choice(
                "At once, because services have priority over actions.",
                "No callback has priority: they all wait for the one thread, and the execute callback has it.",
            ),
            Choice(
                "During the next time.sleep().",
                "A sleeping thread is still occupied. It returns to the executor only when the callback returns.",
            ),
            Choice(
                "After the execute callback has returned, which is too late.",
                "The only thread is free again only then, and the goal has ended: return_code 3.",
                right=True,
            ),
        ),
    ),
    Question(
        "Where does goal_handle.canceled() belong?",
        (
            Choice(
                "In the cancel callback: that is what it is for.",
                "There the goal is still EXECUTING, and from EXECUTING no transition leads to CANCELED: the call "
                "raises, and the exception ends the node.",
            ),
            Choice(
                "In the execute callback, as soon as is_cancel_requested is true.",
                "Right callback, too early: the robot is still in mid-step. CANCELED tells the client that it is safe.",
            ),
            Choice(
                "In the execute callback, when the robot stands and the result is filled.",
                "In that order: robot safe, result filled, terminal call, return.",
                right=True,
            ),
        ),
    ),
    Question(
        "A newer goal takes the robot. How does the older goal end?",
        (
            Choice(
                "PREEMPTED",
                "There is no such status in action_msgs/GoalStatus. ROS 1 had one, and many texts still speak of it.",
            ),
            Choice(
                "CANCELED",
                "CANCELED answers a request to cancel, and nobody sent one. From EXECUTING the call would raise.",
            ),
            Choice(
                "ABORTED, and the result's error_code says PREEMPTED",
                "The server itself ended the goal, so ABORTED; the code tells the client that nothing is broken.",
                right=True,
            ),
        ),
    ),
    Question(
        "The server accepts your cancel, and the goal ends SUCCEEDED. Is the server broken?",
        (
            Choice(
                "Yes: after an accepted cancel the only end is CANCELED.",
                "Accepting means 'I will try'. From CANCELING a goal may also end SUCCEEDED or ABORTED.",
            ),
            Choice(
                "No: the robot arrived before it could stop.",
                "Both sides must expect this race. The status says what happened; a cancel is only a request.",
                right=True,
            ),
            Choice(
                "No: the client read an old status.",
                "The status that comes with the result is final and never old.",
            ),
        ),
    ),
    Question(
        "An execute callback calls succeed() and raises an exception in the next line. What does the client get?",
        (
            Choice(
                "SUCCEEDED and an empty result",
                "succeed() decided the status, and the exception lost the result. Fill it first, and the same bug "
                "ends ABORTED.",
                right=True,
            ),
            Choice(
                "ABORTED, because an exception aborts the goal",
                "It does when it comes before the terminal call. The first terminal call counts.",
            ),
            Choice(
                "Nothing: the node is dead",
                "An exception in a service callback ends spin(); one in an execute callback is caught and logged.",
            ),
        ),
    ),
    Question(
        "Where does an action server say that the robot has 0.4 m left, and where that it ended at x = 0.97 m?",
        (
            Choice(
                "Both in the feedback, which goes on after the end.",
                "Feedback is for the way. A client that connects late never sees it, and after the end none comes.",
            ),
            Choice(
                "0.4 m in the feedback while the goal is executing, 0.97 m in the result.",
                "Feedback says how it goes, again and again. The result comes once, with the status, when it is over.",
                right=True,
            ),
            Choice(
                "Both in the result, which the client asks for again and again.",
                "A request for the result is answered once, at the end. Until then only feedback speaks.",
            ),
            Choice(
                "0.4 m in the goal's answer, 0.97 m in the feedback.",
                "The answer to a goal holds `accepted` and a time stamp. There is no room for anything else.",
            ),
        ),
    ),
)

PREDICTIONS = (
    Question(
        "You cancel the turn after its first feedback. Which status has the goal in the end?",
        (
            Choice(
                "CANCELED",
                "A sensible guess: the loop asks for is_cancel_requested in every round. But this server "
                "has no cancel callback, and rclpy's default one refuses every request. So "
                "is_cancel_requested never became true.",
            ),
            Choice(
                "SUCCEEDED",
                "This server has no cancel callback, and rclpy's default one refuses every request. The "
                "robot turned to the end.",
                right=True,
            ),
            Choice(
                "ABORTED",
                "A sensible guess: the turn didn't go as the client wanted. But the server refused the "
                "cancel, so nothing kept the robot from turning to the end.",
            ),
        ),
    ),
    Question(
        "The goal is a turn of 40°, and you cancel it at the first feedback. What happens?",
        (
            Choice(
                "The robot stops at once: CANCELED.",
                "A sensible guess: this server accepts every cancel request. But its only thread loops "
                "and sleeps in execute, so the request waits in the queue until execute has returned.",
            ),
            Choice(
                "The robot turns 40°: SUCCEEDED, and the cancel comes too late.",
                "A sensible guess: the cancel does come too late, because the only thread is in execute. "
                "But the odom messages wait as well. angle_left never changes, and the robot turns on "
                "until the time limit.",
            ),
            Choice(
                "The robot turns far past 40°.",
                "The only thread is in execute. So the node answers no cancel request and receives no "
                "odom, and only the time limit ends the turn.",
                right=True,
            ),
        ),
    ),
    Question(
        "The cancel callback calls goal_handle.canceled() and accepts. What does the client see?",
        (
            Choice(
                "The server accepts the cancel, and the goal ends CANCELED.",
                "A sensible guess: a cancel has come, and canceled() says so. But the goal is still "
                "EXECUTING until the callback has said yes. From there canceled() raises, and the "
                "exception ends the node.",
            ),
            Choice(
                "The server refuses the cancel, and the goal goes on.",
                "A sensible guess: canceled() comes at the wrong moment. But rclpy doesn't turn the "
                "exception into a refusal. The exception ends spin(), and nobody answers.",
            ),
            Choice(
                "The server never answers the cancel.",
                "Inside the cancel callback the goal is still EXECUTING, so canceled() raises. The "
                "exception ends spin(), and nobody answers.",
                right=True,
            ),
        ),
    ),
    Question(
        "The server calls succeed(). After that it fills the result, and that raises an exception. How does "
        "the goal end for the client?",
        (
            Choice(
                "ABORTED.",
                "A sensible guess: rclpy aborts a goal whose execute callback raises before a terminal "
                "call. But succeed() was that call, and it decided the status. The exception only lost "
                "the result.",
            ),
            Choice(
                "SUCCEEDED, with the final pose in the result.",
                "A sensible guess: self.result() fills in the pose before the line that raises. But the "
                "exception keeps execute from returning that result. The client gets one full of zeros.",
            ),
            Choice(
                "SUCCEEDED, with a result full of zeros.",
                "succeed() decided the status, and the exception lost the result. Nothing on the "
                "client's side looks wrong.",
                right=True,
            ),
        ),
    ),
    Question(
        "While the robot turns left, a second goal asks for a turn to the right. What happens to the "
        "second goal?",
        (
            Choice(
                "It waits until the first has ended.",
                "A sensible guess: the robot can't turn both ways. But rclpy begins each goal at once, here in a "
                "thread of its own. If one goal should wait for another, your server has to see to it.",
            ),
            Choice(
                "The server rejects it.",
                "A sensible guess: the robot is busy. But only a goal callback rejects a goal, and the one of "
                "this server doesn't ask whether the robot is busy. Both goals run, each in a thread of its own.",
            ),
            Choice(
                "It runs beside the first.",
                "Each goal runs in a thread of its own, and both write to cmd_vel. The robot obeys "
                "whichever message came last.",
                right=True,
            ),
        ),
    ),
)
