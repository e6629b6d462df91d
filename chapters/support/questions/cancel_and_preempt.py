"""Chapter 7: cancel and preempt."""

from lab.learning.question import Choice, Question

QUESTIONS = (
    Question(
        "A client cancels a goal. The answer has return_code 0 and an empty goals_canceling. What happens to the goal?",
        (
            Choice(
                "It is being cancelled: 0 means that there was no error.",
                "It should mean that. But rclpy's server also returns 0 when it refuses. The goals that it will cancel "
                "are in the list, and the list is empty.",
            ),
            Choice(
                "It goes on as if there had been no cancel request.",
                "The server refused, as rclpy's default cancel callback does. Check whether your goal is in the list.",
                right=True,
            ),
            Choice(
                "It had already ended.",
                "Then the response would have return_code 3, ERROR_GOAL_TERMINATED.",
            ),
        ),
    ),
    Question(
        "A server runs with rclpy.spin(node) and sleeps in its execute callback. When is a cancel request answered?",
        (
            Choice(
                "At once, because services have priority over actions.",
                "No callback has priority: all of them wait for the only thread, and the execute callback occupies it.",
            ),
            Choice(
                "During the next time.sleep().",
                "A sleeping thread is still occupied. It returns to the executor only when the callback returns.",
            ),
            Choice(
                "After the execute callback has returned, which is too late.",
                "Only then the thread is free again. The goal has ended by then, so the return_code is 3.",
                right=True,
            ),
        ),
    ),
    Question(
        "Where does goal_handle.canceled() belong?",
        (
            Choice(
                "In the cancel callback: that is what it is for.",
                "There the goal is still EXECUTING, and from EXECUTING no transition leads to CANCELED. The call "
                "raises an exception, which ends the node.",
            ),
            Choice(
                "In the execute callback, as soon as is_cancel_requested is true.",
                "The callback is right, but the call is too early: the robot is still in mid-step. A client reads "
                "CANCELED as: the robot is safe.",
            ),
            Choice(
                "In the execute callback, when the robot stands and the result is filled.",
                "In that order: robot safe, result filled, terminal call, return.",
                right=True,
            ),
        ),
    ),
    Question(
        "A newer goal takes over the robot. How does the older goal end?",
        (
            Choice(
                "PREEMPTED",
                "There is no such status in action_msgs/GoalStatus. ROS 1 had one, and many texts still mention it.",
            ),
            Choice(
                "CANCELED",
                "CANCELED is for a goal that a client has cancelled, and no cancel request was sent. Without one, "
                "canceled() raises an exception.",
            ),
            Choice(
                "ABORTED, and the result's error_code says PREEMPTED",
                "The server itself ended the goal, so the status is ABORTED. From the code the client knows that "
                "nothing is broken.",
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
                "Client and server must expect this race. A cancel is only a request; the status says what happened.",
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
                "succeed() decided the status, and because of the exception no result was returned. If you fill the "
                "result first, the same bug ends ABORTED.",
                right=True,
            ),
            Choice(
                "ABORTED, because an exception aborts the goal",
                "It does if it is raised before the terminal call. Here succeed() has already decided the status.",
            ),
            Choice(
                "Nothing: the node has ended",
                "An exception in a service callback ends spin(). But rclpy catches and logs one in an execute "
                "callback.",
            ),
        ),
    ),
    Question(
        "Where does an action server report that the robot has 0.4 m left, and where that it ended at x = 0.97 m?",
        (
            Choice(
                "Both in the feedback, which goes on after the end.",
                "Feedback reports the progress. After the end none is sent, and a client that connects late misses "
                "what was sent before.",
            ),
            Choice(
                "0.4 m in the feedback while the goal is executing, 0.97 m in the result.",
                "Feedback reports the progress repeatedly. The result is sent once, with the status, after the end.",
                right=True,
            ),
            Choice(
                "Both in the result, which the client requests again and again.",
                "A request for the result gets one response, at the end. Until then there is only feedback.",
            ),
            Choice(
                "0.4 m in the goal response, 0.97 m in the feedback.",
                "A goal response has the fields `accepted` and `stamp`, and no others.",
            ),
        ),
    ),
)

PREDICTIONS = (
    Question(
        "You cancel the turn after its first feedback. Which status does the goal end with?",
        (
            Choice(
                "CANCELED",
                "A sensible guess: the loop checks is_cancel_requested in every round. But this server "
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
                "A sensible guess: canceled() sounds like the way to accept a cancel. But the goal is still "
                "EXECUTING until the callback has returned ACCEPT. In that state canceled() raises an "
                "exception, which ends the node.",
            ),
            Choice(
                "The server refuses the cancel, and the goal goes on.",
                "A sensible guess: canceled() is called at the wrong moment. But rclpy doesn't turn the "
                "exception into a refusal. The exception ends spin(), and no response is sent.",
            ),
            Choice(
                "The server never answers the cancel.",
                "Inside the cancel callback the goal is still EXECUTING, so canceled() raises an exception. It "
                "ends spin(), and no response is sent.",
                right=True,
            ),
        ),
    ),
    Question(
        "The server calls succeed(). Then it fills the result, and filling it raises an exception. How does "
        "the goal end for the client?",
        (
            Choice(
                "ABORTED.",
                "A sensible guess: rclpy aborts a goal whose execute callback raises before a terminal "
                "call. But succeed() was a terminal call, and it decided the status. Because of the exception "
                "only the result is missing.",
            ),
            Choice(
                "SUCCEEDED, with the final pose in the result.",
                "A sensible guess: self.result() fills in the pose before the line that raises. But because of the "
                "exception execute doesn't return that result. The client gets one full of zeros.",
            ),
            Choice(
                "SUCCEEDED, with a result full of zeros.",
                "succeed() decided the status, and because of the exception no result was returned. The client "
                "sees nothing wrong.",
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
                "A sensible guess: the robot can't turn both ways. But rclpy executes each goal at once, here in a "
                "thread of its own. If one goal should wait for another, you have to program that.",
            ),
            Choice(
                "The server rejects it.",
                "A sensible guess: the robot is busy. But only a goal callback rejects a goal, and this server's "
                "goal callback doesn't check whether the robot is busy. Both goals run, each in a thread of its own.",
            ),
            Choice(
                "It runs beside the first.",
                "Each goal runs in a thread of its own, and both publish on cmd_vel. The robot follows the "
                "message that arrived last.",
                right=True,
            ),
        ),
    ),
)
