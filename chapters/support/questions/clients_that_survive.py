"""Chapter 3a: a bounded call."""

from lab.learning.question import Choice, Question

QUESTIONS = (
    Question(
        "spin_until_future_complete(node, future, timeout_sec=2.0) has returned. What do you do next?",
        (
            Choice(
                "Read future.result(): without an answer, rclpy would have raised an exception.",
                "A sensible idea, because many libraries do raise one. rclpy doesn't: the function returns, "
                "result() is None, and the next line fails.",
            ),
            Choice(
                "Check future.done(); if it is false, remove the request and treat the outcome as unknown.",
                "The function only limits the wait. Your code has to check whether there is an answer.",
                right=True,
            ),
            Choice(
                "Call it again until the future is done.",
                "Then you wait forever, two seconds at a time, because a dead server never answers.",
            ),
        ),
    ),
    Question(
        "The server is killed while it has your request. What does your client see?",
        (
            Choice(
                "The future gets an exception: connection lost.",
                "With TCP you might see one. A ROS service has no connection that could be lost, so the "
                "future simply never becomes done.",
            ),
            Choice(
                "service_is_ready() becomes false at once, so the client can stop waiting.",
                "A server that is killed sends no notice. With Fast DDS it looks ready for up to 20 s more, with "
                "Cyclone DDS for up to 10 s.",
            ),
            Choice(
                "Nothing: it looks the same as a slow server or a lost message.",
                "So your own time limit is the only protection.",
                right=True,
            ),
        ),
    ),
    Question(
        "A client has 10 s for two calls. Each call has two tries, and each try takes at most 2 s. Finding the servers "
        "took 5 s, the first call 4 s. How long may the first try of the second call take?",
        (
            Choice(
                "2 s, as for every try.",
                "Then the client ends after 11 s, and after 13 s with a second try. A try may take at most 2 s, but "
                "the deadline leaves less.",
            ),
            Choice(
                "1 s.",
                "min(2.0, deadline - now): 10 - 5 - 4 leaves 1 s. Then nothing is left for another try.",
                right=True,
            ),
            Choice(
                "0.5 s, so that the second try gets as much.",
                "A fair idea, but a different rule. This chapter's rule gives each step all the time that is left, "
                "up to the step's own limit.",
            ),
        ),
    ),
    Question(
        "A client computes its deadline with time.time(). While it waits, the robot's clock is set back by a "
        "minute, because it found a time server. What happens?",
        (
            Choice(
                "Nothing: both times come from the same clock.",
                "They do, but the clock was changed between the two readings.",
            ),
            Choice(
                "The client may wait a minute longer.",
                "deadline - now has grown by 60 s. time.monotonic() only goes forward, even when somebody sets "
                "the system's clock.",
                right=True,
            ),
            Choice(
                "The client gives up at once.",
                "That is what happens when the clock is set forward.",
            ),
        ),
    ),
    Question(
        "main() returns 1 on failure. The last lines of the file are: if __name__ == '__main__': main(). What "
        "does the script see that started it?",
        (
            Choice(
                "Exit status 1, since main() returned 1.",
                "In C that is right. Python ignores what main() returns unless you pass it on: "
                "sys.exit(main()).",
            ),
            Choice(
                "Exit status 0, as if all had gone well.",
                "Without sys.exit(main()), a Python program that ends without an exception ends with 0.",
                right=True,
            ),
            Choice(
                "No exit status at all.",
                "Every process has one. Without sys.exit() Python sets it to 0.",
            ),
        ),
    ),
    Question(
        "The answer has arrived and says success=False. What is the right exit status of the client?",
        (
            Choice(
                "0, because the call itself worked.",
                "The call did work, and ros2 service call would exit with 0, too. But whoever started your client "
                "wants to know whether the job is done. It isn't.",
            ),
            Choice(
                "1, and the server's message on stderr.",
                "0 is for success only, and the message explains to a person why it failed.",
                right=True,
            ),
            Choice(
                "None: the client should repeat the request until success is true.",
                "The server received the request and refused. It would refuse again each time, and the "
                "client would never end.",
            ),
        ),
    ),
)

PREDICTIONS = (
    Question(
        "The client of the textbooks runs twice. In the first run there is no server. In the second run the server is "
        "killed while it has the request. How do the two runs end?",
        (
            Choice(
                "Both give up with an error after a few seconds.",
                "A sensible guess: most network programs have a time limit by default. But rclpy has none "
                "unless you pass one, so both clients wait until the lab stops them.",
            ),
            Choice(
                "The first waits forever; the second gets an error.",
                "A sensible guess: a broken TCP connection does raise an error. But a ROS service has no "
                "connection, and a killed server sends no notice. The second client waits forever, too.",
            ),
            Choice(
                "Neither ends by itself, however long you wait.",
                "The client waits without a limit, and it isn't notified when its server dies.",
                right=True,
            ),
        ),
    ),
    Question(
        "The server takes 2.5 s, and the client waits 1 s. How does ask_half.py end?",
        (
            Choice(
                "With a time-out error.",
                "A sensible guess: many libraries raise one. But spin_until_future_complete raises "
                "nothing. It returns, future.result() is None, and None has no message.",
            ),
            Choice(
                "With an AttributeError.",
                "When the time is up, spin_until_future_complete simply returns. future.result() is None "
                "then, and None has no message.",
                right=True,
            ),
            Choice(
                'It prints "The robot is at" without a position.',
                "A sensible guess: there's no position to print. But Python reads "
                "future.result().message before it prints. The result is None, and None has no message, "
                "so that line raises.",
            ),
        ),
    ),
    Question(
        "ask_for.py gets a time limit of -0.1 s, and the server doesn't answer for 30 s. What does it do?",
        (
            Choice(
                "It prints None at once.",
                "A sensible guess: you would want that, and rclpy does so with 0.0. But it treats a negative "
                "limit as no limit, so the client waits.",
            ),
            Choice(
                "It ends with a ValueError.",
                "A sensible guess: that would be more helpful. But rclpy accepts a negative limit without a warning "
                "and treats it as no limit, so the client waits.",
            ),
            Choice(
                "It waits without a limit.",
                "For spin_until_future_complete a negative limit means no limit, like None. So pass "
                "max(0.0, the time that is left).",
                right=True,
            ),
        ),
    ),
    Question(
        "The fourth server dies while it has the request. ask.py makes two tries of at most 2 s. What "
        "does it print?",
        (
            Choice(
                '"where_am_i is not there", after a try.',
                "A sensible guess: the process is gone. But it couldn't announce its end, so Fast DDS considers it "
                "ready for up to 20 s more. The client tries twice and gets no answer.",
            ),
            Choice(
                '"where_am_i looks ready and does not answer", after two tries.',
                "Nobody has announced that the server is gone. It looks ready, each try waits its 2 s, and "
                "then the client gives up.",
                right=True,
            ),
            Choice(
                '"The robot is at …": the second try is answered.',
                "A sensible guess: that's what happened with the slow server. But this one is dead, and nobody "
                "starts another.",
            ),
        ),
    ),
    Question(
        "The server dies with the first request, and another is started. The client keeps its client object "
        "and tries again every 2 s. What happens?",
        (
            Choice(
                "The new server answers the first request when it is up.",
                "A sensible guess: the client still exists, so the middleware could send the request again. "
                "But requests aren't stored for servers that start later. The request was lost with its server, "
                "and a retry gets the answer.",
            ),
            Choice(
                "No answer: the client belongs to the server that died.",
                "A sensible guess: a TCP connection would be gone. But a ROS client belongs to a name. It "
                "discovers the new server, and a retry gets the answer.",
            ),
            Choice(
                "The first request is lost, and a retry is answered.",
                "A client's request goes to every server that offers the name. The first request was lost with the old "
                "server; the new server answers the next try.",
                right=True,
            ),
        ),
    ),
)
