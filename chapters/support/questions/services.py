"""Chapter 2: services."""

from lab.learning.question import Choice, Question

QUESTIONS = (
    Question(
        "Your service callback can't do what was asked: the robot lies on the floor. What should it do?",
        (
            Choice(
                "Raise an exception, so that the client notices.",
                "The client gets nothing: the exception leaves spin() and ends the node. "
                "There is no response, and no server any more.",
            ),
            Choice(
                "Return a response with success false and a sentence that says why.",
                "A failure is reported in the response: the flag for programs, the sentence for people.",
                right=True,
            ),
            Choice(
                "Wait until somebody has set the robot up again, then do it.",
                "Your callback holds the node's only thread meanwhile, so every other client waits, too, "
                "perhaps forever.",
            ),
        ),
    ),
    Question(
        "You have waited two seconds for a response, and you give up. What do you know about the request?",
        (
            Choice(
                "The server didn't carry it out.",
                "It may have: the self-test of this chapter ran to its end after the client had given up.",
            ),
            Choice(
                "The server carried it out, because services are reliable.",
                "Only the delivery is reliable, between two running nodes and for up to ten requests in the queue. "
                "The server can die before, during or after the work.",
            ),
            Choice(
                "Nothing: it may be done, half done, or not done.",
                "So repeat a request only if asking twice does no harm.",
                right=True,
            ),
        ),
    ),
    Question(
        "wait_for_service() has just returned True. What does that mean?",
        (
            Choice(
                "The server is alive, and will answer as soon as it has time.",
                "With Fast DDS a killed server looks alive for up to 20 s. A busy or deadlocked server "
                "looks alive as long as it runs.",
            ),
            Choice(
                "A server of this name and type has announced itself.",
                "Discovery knows no more than that. Only the time limit on the call protects you.",
                right=True,
            ),
            Choice(
                "The server has no other request to work on.",
                "A client can't see the server's queue, so wait_for_service() can't know that.",
            ),
        ),
    ),
    Question(
        "A node runs with rclpy.spin(node). Its service callback uses client.call() to ask another node. What happens?",
        (
            Choice(
                "It works, because the other node has its own thread.",
                "The other node does respond. But only this node's thread can receive the response, "
                "and that thread waits in call().",
            ),
            Choice(
                "A deadlock: only the thread that waits could receive the response.",
                "Respond with data that your node already has. If you must call another server, chapter 5 shows "
                "how: async, await and a second callback group.",
                right=True,
            ),
            Choice(
                "rclpy raises an exception, because a call in a callback is forbidden.",
                "rclpy raises nothing and prints nothing. The node never responds again.",
            ),
        ),
    ),
    Question(
        "No battery_state has arrived yet, and a client asks for the battery. What should be in the response?",
        (
            Choice(
                "available true and percentage 0.0, to be on the safe side",
                "The client reads a measured, empty battery. The robot walks home, although its battery may be full.",
            ),
            Choice(
                "available false and percentage NaN",
                "Programs read the flag, and no client can take NaN for a measured charge.",
                right=True,
            ),
            Choice(
                "No response yet: wait for the first message",
                "That message may never arrive. Then this client waits forever, and so do all later ones.",
            ),
        ),
    ),
    Question(
        "percentage is NaN. What does `if percentage < 0.20: go_home()` do?",
        (
            Choice(
                "It goes home, because NaN counts as zero.",
                "NaN isn't zero. Every <, > and == with it is false, even level == level.",
            ),
            Choice(
                "It raises a ValueError.",
                "Python compares NaN without an error, and the result is False.",
            ),
            Choice(
                "It goes on as if all were well.",
                "The comparison is false. Call math.isnan() first, and decide what to do when the charge is unknown.",
                right=True,
            ),
        ),
    ),
)

PREDICTIONS = (
    Question(
        "The callback fills its response and has no `return`. What does the client get?",
        (
            Choice(
                "The filled response.",
                "A sensible guess: rclpy made that object, so it could send it, and in C++ filling it is enough. "
                "But in Python rclpy sends what your callback returns, and that is None.",
            ),
            Choice(
                "An empty response.",
                "A sensible guess: rclpy could replace None by an empty response. But it doesn't guess. "
                "It raises a TypeError, and that ends the node.",
            ),
            Choice(
                "No response at all.",
                "rclpy sends what your callback returns. None is no Trigger.Response, so rclpy raises a "
                "TypeError, and that ends the node.",
                right=True,
            ),
        ),
    ),
    Question(
        "The robot is off, so nothing arrives on odom. You call where_am_i. What do you get?",
        (
            Choice(
                "A response with success false.",
                "A sensible guess: that's what a good server sends. But this one doesn't check. "
                "self.odom is None, so the callback raises, and rclpy sends no response.",
            ),
            Choice(
                "A response with an empty message.",
                "A sensible guess: rclpy passes an empty response to the callback. But self.odom is None, so "
                "the callback raises before it returns that response.",
            ),
            Choice(
                "No response at all.",
                "self.odom is None, so the callback raises an exception. It leaves rclpy.spin() "
                "and ends the node: there is no response, and no server any more.",
                right=True,
            ),
        ),
    ),
    Question(
        "This time you kill the server in the middle of the test. What does the client see?",
        (
            Choice(
                "An error: the connection is lost.",
                "A sensible guess: a web browser shows such an error. But a ROS client isn't notified when its "
                "server dies. It sees the same as before: no response within its time limit.",
            ),
            Choice(
                "A response with success false.",
                "A sensible guess: the test did fail. But only the server could send that response, and "
                "it's dead. The client sees the same as before: no response within its time limit.",
            ),
            Choice(
                "No response within one second, as before.",
                "The client can't distinguish a test that ran to its end from one that was interrupted. Without a "
                "response the outcome is unknown.",
                right=True,
            ),
        ),
    ),
    Question(
        "The callback of report calls where_am_i with client.call(). What does the client of report get?",
        (
            Choice(
                "The position.",
                "A sensible guess: where_am_i runs in a process of its own and responds as always. But "
                "client.call() blocks the executor's thread, and only that thread could receive the "
                "response.",
            ),
            Choice(
                "No response, because an exception ends report.",
                "A sensible guess: you saw that with where_am_i.py. But rclpy raises no exception here. "
                "report still runs, and its thread waits for a response that only this thread could "
                "receive.",
            ),
            Choice(
                "No response, and report goes on running.",
                "It's a deadlock: client.call() blocks the executor's thread, and only that thread could "
                "receive the response. rclpy raises no exception and prints nothing.",
                right=True,
            ),
        ),
    ),
    Question(
        "level is NaN. Which of the four lines print True?",
        (
            Choice(
                "Only math.isnan.",
                "With NaN, <, >= and == are all false, even level == level. So call math.isnan() "
                "before you compare.",
                right=True,
            ),
            Choice(
                '"at least 0.20" and math.isnan.',
                "A sensible guess: a number that isn't below 0.20 is at least 0.20. But NaN is not a "
                "number, so both >= and < are false. Only math.isnan() is true.",
            ),
            Choice(
                '"equal to itself" and math.isnan.',
                "A sensible guess: every number is equal to itself. But NaN is not a number, and "
                "`level == level` is false.",
            ),
        ),
    ),
)
