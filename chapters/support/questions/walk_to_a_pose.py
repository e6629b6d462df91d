"""Chapter 6: walk to a pose."""

from lab.learning.question import Choice, Question

QUESTIONS = (
    Question(
        "An execute callback returns a filled result and makes no terminal call. What does the client get?",
        (
            Choice(
                "SUCCEEDED: a returned result means success.",
                "rclpy doesn't look into the result. Only a terminal call decides the status.",
            ),
            Choice(
                "ABORTED, with the filled result.",
                "rclpy assumes the worst. Its warning is in the server's log, where no client sees it.",
                right=True,
            ),
            Choice(
                "Nothing: the goal stays EXECUTING.",
                "rclpy ends a goal when its execute callback has returned. Nothing stays open.",
            ),
        ),
    ),
    Question(
        "Your goal was rejected. How do you learn why?",
        (
            Choice(
                "From the result's error_msg.",
                "A rejected goal never runs, so it has no result.",
            ),
            Choice(
                "Not from the answer: it has accepted and a time, and nothing else.",
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
                "As soon as odom says that the pelvis is at the goal.",
                "At that moment the robot is in mid-step, and the pelvis is in its swing. It'll stand elsewhere.",
            ),
            Choice(
                "When it has stopped commanding the robot.",
                "The last command holds for half a second, and then the robot still has to catch its fall.",
            ),
            Choice(
                "When the robot stands, and a measurement made then is within the tolerance.",
                "Stop, settle, measure. Then SUCCEEDED is true when the client reads it.",
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
                "If you ask at once, the server holds your request when the goal ends, and nothing can expire.",
                right=True,
            ),
            Choice(
                "Nobody: the server sends the result when it is ready.",
                "A result is the answer to a service call. A server can't answer what nobody asked.",
            ),
        ),
    ),
    Question(
        "A feedback message says distance_remaining: 0.00, and no more feedback comes. Has the robot arrived?",
        (
            Choice(
                "Yes: nothing is left to walk.",
                "That was the distance in mid-step. The server may find the robot out of tolerance when it stands, "
                "or the robot may fall.",
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
                "The server doesn't know the goal, or no longer: its result may have expired.",
                "A server keeps a result for result_timeout. A server that was restarted knows none of the old goals "
                "either.",
                right=True,
            ),
            Choice(
                "The goal is still under way.",
                "Then the server wouldn't have answered yet: it answers when the goal has ended.",
            ),
            Choice(
                "The robot walked 0 m.",
                "Zeros are what an empty message holds. The status says that nobody filled it.",
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
                "A result that nobody filled has error_code 0, too: that of a goal whose server raised an exception, "
                "for example.",
            ),
            Choice(
                "It should read the status first.",
                "An aborted walk has steps, too. The status says how to read the result.",
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
                "A sensible guess: the work is done, and the result says so. But rclpy doesn't look into the result. "
                "Only a terminal call decides the status, and there was none.",
            ),
            Choice(
                "ABORTED.",
                "rclpy found no terminal call when execute had returned, and assumed the worst.",
                right=True,
            ),
            Choice(
                "None: the goal stays EXECUTING.",
                "A sensible guess: nobody ended the goal. But rclpy looks at it when execute has returned. A goal "
                "that is still active then is aborted.",
            ),
        ),
    ),
    Question(
        "The server calls succeed() as soon as the pelvis is 1.0 m ahead. Where does the robot stand in the end, "
        "compared with final_pose in the result?",
        (
            Choice(
                "At the same place, within 2 cm.",
                "A sensible guess: no command follows. But the robot was in mid-step. The last command holds for half "
                "a second, and after that the robot has to catch its fall.",
            ),
            Choice(
                "Several centimetres further.",
                "The last command holds for half a second, and then the robot puts its foot at the capture point, "
                "ahead of the pelvis.",
                right=True,
            ),
            Choice(
                "Several centimetres short of it.",
                "A sensible guess: the pelvis sways, and a swing can also go back. But it moves forward at 0.3 m/s, "
                "and nobody has told it to stop.",
            ),
        ),
    ),
    Question(
        "The feedback callback reads message.distance_remaining. What happens at the first feedback?",
        (
            Choice(
                "It prints 0.00 m each time.",
                "A sensible guess: a field that nobody filled is 0. But this object has no such field at all. It has "
                "goal_id and feedback.",
            ),
            Choice(
                "An AttributeError ends the client, and the robot stops.",
                "A sensible guess: the error does leave the spin, and ends the client. But the server doesn't notice "
                "that its client is gone.",
            ),
            Choice(
                "An AttributeError ends the client, and the robot walks on.",
                "The error leaves the callback and the spin. The goal lives at the server, which doesn't notice that "
                "its client is gone.",
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
                "A sensible guess: reliable sounds as if all of them wait for the callback. But each end keeps only "
                "the last ten. Reliable means that those are sent again if the network loses them.",
            ),
            Choice(
                "Between ten and twenty.",
                "The queues keep the last ten messages, and the callback takes one or a few more in the meantime.",
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
                "Status 4, and the steps: a result is kept until somebody fetches it.",
                "A sensible guess: a parcel shop works like that, for a while. But the server threw the result away "
                "after two seconds, whether or not anybody had read it.",
            ),
            Choice(
                "No answer: the request waits in vain.",
                "A sensible guess: the server doesn't know the goal any more. But it says so, with a status of its "
                "own.",
            ),
            Choice(
                "Status 0, and 0 steps.",
                "The server doesn't know this goal any more. It answers UNKNOWN, with an empty result, and nothing "
                "raises.",
                right=True,
            ),
        ),
    ),
)
