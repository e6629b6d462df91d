"""Chapter 2: services."""

from lab.quiz import Choice, Question

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
