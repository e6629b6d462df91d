"""Chapter 2: services."""

from lab.question import Choice, Question

QUESTIONS = (
    Question(
        "Your service callback cannot do what was asked: the robot lies on the floor. What should it do?",
        (
            Choice(
                "Raise an exception, so that the client notices.",
                "The client notices nothing: the exception ends spin() and with it the node. No answer, no server.",
            ),
            Choice(
                "Return a response with success false and a sentence that says why.",
                "A failure is an answer. The flag is for programs, the sentence for people.",
                right=True,
            ),
            Choice(
                "Wait until the robot has been stood up, then do it.",
                "Meanwhile the only thread is occupied and every other client waits as well, perhaps for ever.",
            ),
        ),
    ),
    Question(
        "A call has had no answer for two seconds, and you give up. What do you know about the request?",
        (
            Choice(
                "It was not carried out.",
                "It may well have been: the self-test of this chapter went on to its end after the client had left.",
            ),
            Choice(
                "It was carried out, because services are reliable.",
                "Reliable is the delivery between two living nodes. "
                "The server can die before, during or after the work.",
            ),
            Choice(
                "Nothing: it may have been carried out, half, or not at all.",
                "So repeat only what does no harm when it is done twice.",
                right=True,
            ),
        ),
    ),
    Question(
        "wait_for_service() has just returned True. What does that mean?",
        (
            Choice(
                "The server is alive and will answer.",
                "With Fast DDS a server that was killed looks like this for up to 20 s; one that is busy or deadlocked "
                "forever.",
            ),
            Choice(
                "A server of this name and type has been announced and has not said goodbye.",
                "That is all that discovery knows. The time limit on the call is your protection.",
                right=True,
            ),
            Choice(
                "The server has no other request to work on.",
                "The client learns nothing about the server's queue before its own answer comes.",
            ),
        ),
    ),
    Question(
        "A node runs with rclpy.spin(node). Its service callback uses client.call() to ask another node. What happens?",
        (
            Choice(
                "It works, because the other node has its own thread.",
                "The other node does answer. But the answer waits for this node's only thread, "
                "and that one is in call().",
            ),
            Choice(
                "A deadlock: the thread that would deliver the answer is the one that waits for it.",
                "Make the callback async def, await client.call_async(), "
                "and give the client a callback group of its own.",
                right=True,
            ),
            Choice(
                "rclpy raises an exception, because this is forbidden.",
                "Nothing is raised and nothing is printed. The node just never answers again.",
            ),
        ),
    ),
    Question(
        "No battery_state has arrived yet, and a client asks for the battery. What should be in the response?",
        (
            Choice(
                "available true and percentage 0.0, to be on the safe side",
                "It reads as a measured, empty battery: the robot walks home or sits down although it may be full.",
            ),
            Choice(
                "available false and percentage NaN",
                "A flag for programs, and a number that nobody can take for a measured one.",
                right=True,
            ),
            Choice(
                "Nothing: answer when the first message has come",
                "Then the client waits for something that may never come, and so does everybody behind it.",
            ),
        ),
    ),
    Question(
        "percentage is NaN. What does `if percentage < 0.20: go_home()` do?",
        (
            Choice(
                "It goes home, because NaN counts as zero.",
                "NaN is not zero. Every comparison with it is false, even the one with itself.",
            ),
            Choice(
                "It raises a ValueError.",
                "Comparing with NaN is legal Python and silently false.",
            ),
            Choice(
                "It goes on as if all were well.",
                "The comparison is false. Ask math.isnan() first, and decide what to do when you do not know.",
                right=True,
            ),
        ),
    ),
)

PREDICTIONS = (
    Question(
        "The robot is away, so nothing arrives on odom. You call where_am_i. What do you get?",
        (
            Choice(
                "A response with success false.",
                "A sensible guess: that's what a good server sends. But this one doesn't check. "
                "self.odom is None, so the callback raises, and rclpy sends no response.",
            ),
            Choice(
                "A response with an empty message.",
                "A sensible guess: rclpy hands the callback an empty response. But self.odom is None, so "
                "the callback raises before it returns that response.",
            ),
            Choice(
                "No response at all.",
                "self.odom is None, so the callback raises. The exception travels out of rclpy.spin() "
                "and ends the node: no response, and no server any more.",
                right=True,
            ),
        ),
    ),
    Question(
        "This time you kill the server in the middle of the test. What does the client see?",
        (
            Choice(
                "An error: the connection is lost.",
                "A sensible guess: a web browser tells you so. But nobody tells a ROS client that its "
                "server has died. It sees what it saw before: no response within its time limit.",
            ),
            Choice(
                "A response with success false.",
                "A sensible guess: the test did fail. But only the server could send that response, and "
                "it's dead. The client sees what it saw before: no response within its time limit.",
            ),
            Choice(
                "No response within one second, as before.",
                "The client can't tell a test that was carried out from one that was cut off. No "
                "response means unknown.",
                right=True,
            ),
        ),
    ),
    Question(
        "The callback of report calls where_am_i with client.call(). What does the client of report get?",
        (
            Choice(
                "The position.",
                "A sensible guess: where_am_i runs in a process of its own and answers as always. But "
                "client.call() blocks the executor's thread, and that same thread would deliver the "
                "answer.",
            ),
            Choice(
                "No response, because an exception ends report.",
                "A sensible guess: you saw that with where_am_i.py. But rclpy raises nothing here. "
                "report still runs, and its thread waits for an answer that it would have to deliver "
                "itself.",
            ),
            Choice(
                "No response, and report goes on running.",
                "It's a deadlock: client.call() blocks the executor's thread, and that same thread would "
                "deliver the answer. rclpy raises nothing and prints nothing.",
                right=True,
            ),
        ),
    ),
    Question(
        "level is NaN. Which of the four lines print True?",
        (
            Choice(
                "Only math.isnan.",
                "Every comparison with NaN is false, even the one with itself. So ask math.isnan() "
                "before you compare.",
                right=True,
            ),
            Choice(
                '"at least 0.20" and math.isnan.',
                "A sensible guess: a number that isn't below 0.20 is at least 0.20. But NaN is no "
                "number, and every comparison with it is false. Only math.isnan() tells you.",
            ),
            Choice(
                '"equal to itself" and math.isnan.',
                "A sensible guess: every number is equal to itself. But NaN is no number, and every "
                "comparison with it is false, even this one.",
            ),
        ),
    ),
)
