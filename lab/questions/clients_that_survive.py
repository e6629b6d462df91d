"""Chapter 3: clients that survive."""

from lab.quiz import Choice, Question

QUESTIONS = (
    Question(
        "spin_until_future_complete(node, future, timeout_sec=2.0) has returned. What do you do next?",
        (
            Choice(
                "Read future.result(): if there was no answer, an exception would have been raised.",
                "Nothing is raised. The function returns, result() is None, and the next line fails.",
            ),
            Choice(
                "Ask future.done(); if it is not done, remove the request and treat the outcome as unknown.",
                "The function only bounds the waiting. Whether there is an answer is yours to look up.",
                right=True,
            ),
            Choice(
                "Call it again until it is done.",
                "That is waiting for ever, in slices of two seconds. A dead server never answers.",
            ),
        ),
    ),
    Question(
        "The server is killed in the middle of your request. What does your client see?",
        (
            Choice(
                "The future gets an exception: connection lost.",
                "There is no connection that could be lost. The future just stays undone.",
            ),
            Choice(
                "service_is_ready() turns false at once, so the client can stop waiting.",
                "Nobody said goodbye. With Fast DDS the dead server looks ready for up to 20 s.",
            ),
            Choice(
                "Nothing: the same silence as with a slow server or a lost message.",
                "So the only protection is your own time limit.",
                right=True,
            ),
        ),
    ),
    Question(
        "Which of these requests may a client send again when no answer came?",
        (
            Choice(
                "'Turn left by 10 degrees'",
                "If only the answer was lost, the robot turns by 20. Relative requests add up.",
            ),
            Choice(
                "'Face north'",
                "Asked twice, it ends the same: idempotent.",
                right=True,
            ),
            Choice(
                "'Toggle the gripper'",
                "Two toggles are none. Ask for 'open' or 'closed' instead.",
            ),
            Choice(
                "None: a retry is always dangerous.",
                "Then a single lost message would end every job. Make the request harmless instead.",
            ),
        ),
    ),
    Question(
        "A client stores every response in self.answer. After a time-out it asks again. What can go wrong?",
        (
            Choice(
                "The late answer to the first request is taken for the answer to the second.",
                "rclpy matches each response to its own future; the shared variable throws that away.",
                right=True,
            ),
            Choice(
                "rclpy gives the first answer to the second future.",
                "Never: requests are numbered, and each future gets only its own response.",
            ),
            Choice(
                "Nothing, because services keep the order.",
                "Order does not help: the old answer comes first, and that is exactly the trouble.",
            ),
        ),
    ),
    Question(
        "A service callback needs the answer of another service, with a time limit. What works in every executor?",
        (
            Choice(
                "rclpy.spin_until_future_complete(self, future, timeout_sec=1.0)",
                "It moves the node to another executor and does not bring it back: one answer, then a deaf node.",
            ),
            Choice(
                "client.call(request, timeout_sec=1.0)",
                "On one thread it blocks the thread that would deliver the answer: a second lost, and always None.",
            ),
            Choice(
                "async def, await the future, and a timer in another callback group that cancels it",
                "The thread is free while it waits, and the timer ends the waiting.",
                right=True,
            ),
        ),
    ),
    Question(
        "What is left of the deadline is -0.1 s, and you pass it on as timeout_sec. How long does rclpy spin?",
        (
            Choice(
                "Not at all: the time is up.",
                "That would be 0.0. Hence max(0.0, left).",
            ),
            Choice(
                "Without a limit.",
                "To spin_until_future_complete a negative limit means none, like None.",
                right=True,
            ),
            Choice(
                "It raises a ValueError.",
                "It would be kinder. It is accepted silently.",
            ),
        ),
    ),
    Question(
        "The answer has arrived and says success=False. What is the right exit status of the client?",
        (
            Choice(
                "0, because the call itself worked.",
                "Whoever started the client wants to know whether the job is done. It is not.",
            ),
            Choice(
                "1, and the server's message on stderr.",
                "0 is for success only, and the sentence tells a person why it failed.",
                right=True,
            ),
            Choice(
                "None: the client should ask until success is true.",
                "The server has understood and refused. Asking again gets the same refusal, and the client never ends.",
            ),
        ),
    ),
)
