"""Chapter 6: walk to a pose."""

from lab.learning.question import Choice, Question

QUESTIONS = (
    Question(
        "An execute callback returns a filled result and makes no terminal call. What does the client get?",
        (
            Choice(
                "SUCCEEDED: a returned result means success.",
                "rclpy doesn't read the result. Only a terminal call decides the status.",
            ),
            Choice(
                "ABORTED, with the filled result.",
                "Without a terminal call rclpy aborts the goal. Its warning is in the server's log, where no client "
                "sees it.",
                right=True,
            ),
            Choice(
                "Nothing: the goal stays EXECUTING.",
                "rclpy ends every goal whose execute callback has returned.",
            ),
        ),
    ),
    Question(
        "Your goal was rejected. How do you learn why?",
        (
            Choice(
                "From the error_msg of the result, which comes with the rejection.",
                "A rejected goal never runs, so it has no result.",
            ),
            Choice(
                "Not from the goal response: it has no field for a reason.",
                "If the client's user must know the reason, the server accepts the goal and aborts it with a code.",
                right=True,
            ),
            Choice(
                "From the status topic.",
                "A rejected goal has no status. The topic lists only goals that were accepted.",
            ),
        ),
    ),
    Question(
        "When may a server for walking call succeed()?",
        (
            Choice(
                "As soon as the pelvis is at the goal, according to odom.",
                "At that moment the robot is in mid-step, and the pelvis sways. The robot will stand somewhere else.",
            ),
            Choice(
                "When it has stopped commanding the robot.",
                "The last command is valid for half a second, and then the robot needs another step to stop.",
            ),
            Choice(
                "When the robot stands, and stands within the tolerance.",
                "Stop, settle, measure. Then the robot really is at the goal when the client reads SUCCEEDED.",
                right=True,
            ),
        ),
    ),
    Question(
        "You sent a goal with send_goal_async(). Who sends the request for the result?",
        (
            Choice(
                "send_goal_async(), together with the goal.",
                "It sends the goal and registers the feedback callback. ros2 action send_goal and lab.send_goal "
                "do more for you; send_goal_async() doesn't.",
            ),
            Choice(
                "You do, with get_result_async() on an accepted goal.",
                "If you send it at once, the server already has your request when the goal ends, so no result expires.",
                right=True,
            ),
            Choice(
                "Nobody: the server sends the result when it is ready.",
                "A result is the response to a service call. Without a request the server can't send it.",
            ),
        ),
    ),
    Question(
        "A feedback message has distance_remaining: 0.00, and no more feedback arrives. Has the robot arrived?",
        (
            Choice(
                "Yes: nothing is left to walk.",
                "That was the distance in mid-step. The robot may still fall, or stand outside the tolerance.",
            ),
            Choice(
                "Yes, because feedback ends with the goal.",
                "Feedback also ends when the server dies, or when your queue has lost the rest.",
            ),
            Choice(
                "Only the status can tell.",
                "Feedback is for progress bars. Read the status that comes with the result.",
                right=True,
            ),
        ),
    ),
    Question(
        "The future of get_result_async() gives a response with status UNKNOWN and a result full of zeros. What "
        "happened?",
        (
            Choice(
                "The server doesn't know the goal: its result may have expired.",
                "A server keeps a result for result_timeout. A server that was restarted doesn't know the old goals, "
                "either.",
                right=True,
            ),
            Choice(
                "The goal is still under way.",
                "Then the response wouldn't have arrived yet: the server sends it when the goal has ended.",
            ),
            Choice(
                "The robot walked 0 m.",
                "Zeros are the values of an empty message. The status UNKNOWN means that no result was filled.",
            ),
        ),
    ),
    Question(
        "A client prints result.total_steps and exits with 0 as soon as the result arrives. What is missing?",
        (
            Choice(
                "Nothing: a result arrives only after success.",
                "A result arrives after every end: SUCCEEDED, ABORTED and CANCELED.",
            ),
            Choice(
                "It should read error_code first: 0 means success.",
                "An empty result has error_code 0, too. You get one if the execute callback raised an exception, for "
                "example.",
            ),
            Choice(
                "It should read the status first.",
                "An aborted walk has steps, too. Only the status says whether the robot has arrived.",
                right=True,
            ),
        ),
    ),
)

PREDICTIONS = (
    Question(
        "The robot walks 0.6 m. The execute callback returns a filled result and makes no terminal call. Which status "
        "does the client get?",
        (
            Choice(
                "SUCCEEDED.",
                "A sensible guess: the work is done, and the result says so. But rclpy doesn't read the result. "
                "Only a terminal call decides the status, and there was none.",
            ),
            Choice(
                "ABORTED.",
                "rclpy aborts a goal whose execute callback has returned without a terminal call.",
                right=True,
            ),
            Choice(
                "None: the goal stays EXECUTING.",
                "A sensible guess: the callback didn't end the goal. But when execute has returned, rclpy aborts a "
                "goal that is still active.",
            ),
        ),
    ),
    Question(
        "The server calls succeed() as soon as the pelvis is 1.0 m ahead. Where does the robot finally stand, "
        "compared with final_pose in the result?",
        (
            Choice(
                "At the same place, within 2 cm.",
                "A sensible guess: no command follows. But the robot was in mid-step. The last command is valid for "
                "half a second, and after that the robot needs another step to stop.",
            ),
            Choice(
                "Several centimetres further.",
                "The last command is valid for half a second. Then the robot puts its foot at the capture point, "
                "ahead of the pelvis.",
                right=True,
            ),
            Choice(
                "Several centimetres short of it.",
                "A sensible guess: the pelvis sways, also backwards. But it moves forward at 0.3 m/s, "
                "and no command to stop was sent.",
            ),
        ),
    ),
    Question(
        "The feedback callback reads message.distance_remaining. What happens at the first feedback?",
        (
            Choice(
                "It prints 0.00 m each time.",
                "A sensible guess: a field that isn't set is 0. But this object has no such field. Its fields are "
                "goal_id and feedback.",
            ),
            Choice(
                "An AttributeError ends the client, and the robot stops.",
                "A sensible guess: the exception does leave spin(), and it ends the client. But the server doesn't "
                "notice that its client has ended.",
            ),
            Choice(
                "An AttributeError ends the client, and the robot walks on.",
                "The exception leaves the callback and spin(). But the server executes the goal, and it doesn't "
                "notice that its client has ended.",
                right=True,
            ),
        ),
    ),
    Question(
        "The server publishes 50 feedback messages at once and works on for 6 s. The client's callback takes 0.2 s, "
        "and the topic is reliable. How many does the client see?",
        (
            Choice(
                "About thirty: as many as fit into 6 s.",
                "A sensible guess: reliable sounds as if all messages wait for the callback. But publisher and "
                "subscription keep only the last ten. Reliable means that these are sent again if they get lost.",
            ),
            Choice(
                "Between ten and twenty.",
                "The queues keep the last ten messages, and the callback handles a few more while they arrive.",
                right=True,
            ),
            Choice(
                "One: the last.",
                "A sensible guess: for a progress bar that would be enough. But the queue of feedback has a depth of "
                "ten, not of one.",
            ),
        ),
    ),
    Question(
        "The server keeps a result for 2 s. The client asks for it 4 s after the robot has arrived. What does it get?",
        (
            Choice(
                "Status 4, and the steps.",
                "A sensible guess: a parcel shop works like that. But the server discarded the result "
                "after two seconds, although no client had read it.",
            ),
            Choice(
                "No answer.",
                "A sensible guess: the server doesn't know the goal any more. But it does respond, with the status "
                "UNKNOWN.",
            ),
            Choice(
                "Status 0, and 0 steps.",
                "The server doesn't know this goal any more. It responds with status UNKNOWN and an empty result, and "
                "no exception is raised.",
                right=True,
            ),
        ),
    ),
)
