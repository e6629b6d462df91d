"""Chapter 7: cancel and preempt."""

from lab.quiz import Choice, Question

QUESTIONS = (
    Question(
        "A client cancels a goal. The answer has return_code 0 and an empty goals_canceling. What happens to the goal?",
        (
            Choice(
                "It is being cancelled: 0 means that there was no error.",
                "0 only says that the request was understood. The goals that will be cancelled are in the list, "
                "and it is empty.",
            ),
            Choice(
                "It goes on as if nothing had been asked.",
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
                "There the goal is still EXECUTING, and from EXECUTING there is no way to CANCELED: the call raises "
                "and takes the node with it.",
            ),
            Choice(
                "In the execute callback, as soon as is_cancel_requested is true.",
                "Right place, too early: the robot is still in mid-step. CANCELED tells the client that it is safe.",
            ),
            Choice(
                "In the execute callback, when the robot stands and the result is filled.",
                "Robot safe, result filled, terminal call, return.",
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
        "Your cancel was accepted, and the goal ends SUCCEEDED. Is the server broken?",
        (
            Choice(
                "Yes: after an accepted cancel the only end is CANCELED.",
                "Accepting means 'I will try'. From CANCELING a goal may also end SUCCEEDED or ABORTED.",
            ),
            Choice(
                "No: the robot arrived before it could stop.",
                "A race that both sides must expect. The status says what happened; the cancel was only a wish.",
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
                "The door was closed before the result was filled. Fill it first, and the same bug ends ABORTED.",
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
)
