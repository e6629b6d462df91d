"""Chapter 3b: clients in bad company."""

from lab.learning.question import Choice, Question

QUESTIONS = (
    Question(
        "Which of these requests may a client send again when no answer came?",
        (
            Choice(
                "'Turn left by 10 degrees'",
                "If only the answer was lost, the robot turns by 20. Relative requests add up.",
            ),
            Choice(
                "'Face north'",
                "It is idempotent: after two requests the robot faces the same way as after one.",
                right=True,
            ),
            Choice(
                "'Toggle the gripper'",
                "Two toggles cancel each other. Request 'open' or 'closed' instead.",
            ),
            Choice(
                "None: a retry is always dangerous.",
                "That is careful, but then a single lost message makes the job fail. Design a request that may be "
                "repeated instead.",
            ),
        ),
    ),
    Question(
        "A client stores every response in self.answer. After a time-out it asks again. What can go wrong?",
        (
            Choice(
                "The late first answer is taken for the second one.",
                "rclpy gives each response to its own future, but the shared variable doesn't say to which request an "
                "answer belongs.",
                right=True,
            ),
            Choice(
                "rclpy gives the first answer to the second future.",
                "Never: requests are numbered, and each future gets only its own response.",
            ),
            Choice(
                "Nothing, because answers come in the order of the requests.",
                "They often do. That is the problem: the late answer to the first request arrives first.",
            ),
        ),
    ),
    Question(
        "A node sends a request to a missing server ten times a second. It gives each request up without removing it. "
        "What happens?",
        (
            Choice(
                "call_async raises an exception, since there is no server.",
                "A sensible guess. But call_async doesn't check whether there is a server: it sends the request, "
                "which reaches nobody.",
            ),
            Choice(
                "rclpy forgets a request when the limit of spin_until_future_complete is over.",
                "That limit belongs to the wait, not to the request. The client still expects the answer.",
            ),
            Choice(
                "The node's memory grows with each request.",
                "The client keeps the future of every request that has no answer, until you call "
                "remove_pending_request or cancel the future.",
                right=True,
            ),
        ),
    ),
    Question(
        "The answer to 'close the gripper' has arrived, so future.done() is true. May the arm lift the cup?",
        (
            Choice(
                "Yes: the server has done it.",
                "It has only answered. The answer may be success=False, with a reason.",
            ),
            Choice(
                "Only if response.success is true.",
                "An answer has arrived, but only its content says whether the gripper is closed.",
                right=True,
            ),
            Choice(
                "No, because a service can't be trusted.",
                "Its answer is the best information that you have. But you have to read it.",
            ),
        ),
    ),
    Question(
        "A client sends two requests before it reads the answers. It fills one Request object twice. What "
        "does the server get?",
        (
            Choice(
                "Twice the second request, because both are the same object.",
                "It would, if rclpy sent the object later. But call_async turns the fields into bytes at once, so the "
                "server gets both requests. Only your own object holds the second one.",
            ),
            Choice(
                "Both requests; but the object now holds only the second.",
                "The answers are right. But if you print the first answer beside the request object, you print it "
                "beside the second request.",
                right=True,
            ),
            Choice(
                "An error: a request may be sent only once.",
                "rclpy allows it: each call_async is a request of its own, whatever object you pass.",
            ),
        ),
    ),
    Question(
        "Two servers offer /robot/where_am_i. What can the client tell from an answer?",
        (
            Choice(
                "Which of the two has answered: the response's header has its name.",
                "A response that rclpy gives you has the fields of its type and nothing else, so no header with "
                "a name.",
            ),
            Choice(
                "Nothing: both did the work, and the first answer came through.",
                "So when answers contradict each other, count the servers.",
                right=True,
            ),
            Choice(
                "That the other server hasn't got the request.",
                "It has received it, too. Both servers get every request, and both carry it out.",
            ),
        ),
    ),
    Question(
        "future.add_done_callback(on_answer), then spin_until_future_complete(node, future). The response "
        "comes, and on_answer has a bug. What do you see with this course's rclpy?",
        (
            Choice(
                "A traceback, and exit status 1.",
                "You get these if the error is in the code that reads future.result() after the wait, or if "
                "rclpy.spin() runs the callback.",
            ),
            Choice(
                "Nothing: the spin ends before on_answer runs.",
                "The executor would run the callback as a task, but nobody spins the executor any more. Read the "
                "result after the wait instead.",
                right=True,
            ),
            Choice(
                "A warning on stderr.",
                "You get that when you cancel a future that belongs to no executor: then rclpy runs the callback at "
                "once and turns its exception into a warning.",
            ),
        ),
    ),
)

PREDICTIONS = (
    Question(
        "The robot walks at 0.3 m/s. The client gives up after 1 s and asks again, and the first answer "
        "takes 2 s. How far off is the second position that the client prints?",
        (
            Choice(
                "A few centimetres.",
                "A sensible guess: the client set self.answer to None and asked again. But the late "
                "answer to the first request is stored in the same variable, and the client takes it for the "
                "second.",
            ),
            Choice(
                "About half a metre.",
                "The answer to the first request arrived while the client waited for the second. Both are "
                "stored in one variable, so the client prints an old position.",
                right=True,
            ),
            Choice(
                "It prints None for the second position too.",
                "A sensible guess: a server that was slow once may be slow again. But only its first "
                "answer is late, and it arrives while the client waits for the second. The client takes "
                "the first answer for the second.",
            ),
        ),
    ),
    Question(
        "The client requests 0.3 m from forward. The answer arrives after 2.5 s, and the client retries after 2 "
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
        "The robot lies on the floor without power. What do forward.py and go_to.py print?",
        (
            Choice(
                "Both print that the service refuses.",
                "A sensible guess: the service does refuse both requests. But forward.py only checks "
                "whether there is an answer, and never reads success. It prints that the robot walks.",
            ),
            Choice(
                "forward.py prints that the robot walks, go_to.py that the service refuses.",
                "Both get an answer with success false. forward.py only checks whether there is an answer; "
                "go_to.py also reads success.",
                right=True,
            ),
            Choice(
                "Both print that the service doesn't answer.",
                "A sensible guess: the robot can't do anything without power. But the server is a separate "
                "program, and it answers both with success false. forward.py doesn't read that.",
            ),
        ),
    ),
    Question(
        "Two servers offer where_am_i. One is quick, the other takes a second. What happens to a request?",
        (
            Choice(
                "It goes to one of them: the one that was found first.",
                "A sensible guess: a web client sends its request to one server. But a ROS request goes to every "
                "server that offers the name. Both do the work, and the client gets the first answer.",
            ),
            Choice(
                "None: the second server can't start, because the name is taken.",
                "A sensible guess: two programs can't share a network port. But two nodes can offer one service. "
                "Both get the request, and the client gets the first answer.",
            ),
            Choice(
                "Both do the work, and the client gets the first answer.",
                "The request reaches every server that offers the name. rclpy gives the first answer to the "
                "future and drops the other.",
                right=True,
            ),
        ),
    ),
    Question(
        "ask_by_callback.py has a typo in on_answer. The server works. What do you see?",
        (
            Choice(
                "A traceback, and exit status 1.",
                "A sensible guess: that's what Python does with an AttributeError. But the callback never "
                "runs: spin_until_future_complete returns as soon as the future is done, and nobody spins "
                "after it.",
            ),
            Choice(
                "Nothing, and exit status 0.",
                "rclpy makes a task of the callback, spin_until_future_complete returns before the task "
                "runs, and nobody spins after it.",
                right=True,
            ),
            Choice(
                '"The robot is at", and no position.',
                "A sensible guess: only the field's name is wrong. But that line would raise an exception before it "
                "prints. And the callback never runs: spin_until_future_complete returns as soon as the "
                "future is done, and nobody spins after it.",
            ),
        ),
    ),
)
