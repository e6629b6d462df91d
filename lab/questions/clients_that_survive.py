"""Chapter 3: clients that survive."""

from lab.question import Choice, Question

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

PREDICTIONS = (
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
        "The robot walks at 0.3 m/s. The client gives up after 1 s and asks again, and the first answer "
        "takes 2 s. How far off is the second position that the client prints?",
        (
            Choice(
                "A few centimetres.",
                "A sensible guess: the client set self.answer to None and asked again. But the late "
                "answer to the first request lands in the same place, and the client takes it for the "
                "second.",
            ),
            Choice(
                "About half a metre.",
                "The answer to the first request came while the client waited for the second. One "
                "mailbox can't tell them apart, so the client prints an old position.",
                right=True,
            ),
            Choice(
                "It prints None for the second position too.",
                "A sensible guess: a server that was slow once may be slow again. But only its first "
                "answer is late, and it comes while the client waits for the second. The client takes "
                "one for the other.",
            ),
        ),
    ),
    Question(
        "The client asks forward for 0.3 m. The answer comes after 2.5 s, and the client retries after 2 "
        "s. How far does the robot walk?",
        (
            Choice(
                "0.3 m.",
                "A sensible guess: that's what the client asked for. But the server got the request "
                "twice, and each request means 0.3 m more.",
            ),
            Choice(
                "0.6 m.",
                "The server got both requests, and each one adds 0.3 m. Only the first answer was late; "
                "its request was carried out.",
                right=True,
            ),
            Choice(
                "Not at all.",
                "A sensible guess: the client gave up on its first request. But the server doesn't learn "
                "that, so it carries out the first request and the retry. Each one adds 0.3 m.",
            ),
        ),
    ),
    Question(
        "The robot lies on the floor without power. What do forward.py and go_to.py say?",
        (
            Choice(
                "Both say that the service refuses.",
                "A sensible guess: the service does refuse both requests. But forward.py looks only "
                "whether there is an answer, and never reads success. It says that the robot walks.",
            ),
            Choice(
                "forward.py says that the robot walks, go_to.py that the service refuses.",
                "Both get an answer with success false. forward.py looks only whether there is one; "
                "go_to.py also reads what it says.",
                right=True,
            ),
            Choice(
                "Both say that the service doesn't answer.",
                "A sensible guess: the robot can't do anything without power. But the server is a "
                "program of its own, and it answers both: success false. forward.py doesn't read that.",
            ),
        ),
    ),
    Question(
        "You call report three times in a row. Which of the calls get an answer?",
        (
            Choice(
                "All three.",
                "A sensible guess: there's a time limit, there are threads, and the client has a "
                "callback group of its own. But spin_until_future_complete takes the node away from "
                "main's executor and doesn't give it back.",
            ),
            Choice(
                "None of them.",
                "A sensible guess: client.call() in a callback gave no answer in chapter 2. But "
                "spin_until_future_complete spins with another executor, so the first answer does come. "
                "It keeps the node, and then report is deaf.",
            ),
            Choice(
                "Only the first.",
                "spin_until_future_complete spins with another executor and takes the node along. The "
                "executor of main goes on without a single node, so the second call reaches nobody.",
                right=True,
            ),
        ),
    ),
)
