"""Chapter 5: executors, threads, groups."""

from lab.learning.question import Choice, Question

PREDICTIONS = (
    Question(
        "The node runs on one thread. While look_around sleeps for 3 s, how long is the longest gap between two "
        "heartbeats?",
        (
            Choice(
                "0.1 s: a timer has a clock of its own.",
                "A sensible guess: the timer does become ready ten times a second. But the executor has to call its "
                "callback, and the executor's only thread sleeps in look_around.",
            ),
            Choice(
                "3 s, and then the 30 missed beats come at once.",
                "A sensible guess: messages in a queue would arrive like that. But a timer has no queue. rclpy calls "
                "its callback once when the thread is free; the missed calls are gone.",
            ),
            Choice(
                "3 s, and the missed beats never come.",
                "The only thread sleeps in look_around, so nobody calls beat. A timer has no queue: the missed beats "
                "are gone.",
                right=True,
            ),
        ),
    ),
    Question(
        "The same node, now on a MultiThreadedExecutor with four threads. How long is the longest gap?",
        (
            Choice(
                "0.1 s: three threads are free.",
                "A sensible guess: the threads are free. But both callbacks are in the node's default group, which "
                "is mutually exclusive: it lets in one callback at a time, on however many threads.",
            ),
            Choice(
                "About 1 s: each gets its share.",
                "A sensible guess: operating systems share time like that. But an executor never interrupts a "
                "callback. Either the group lets beat run beside look_around, or beat waits until look_around ends.",
            ),
            Choice(
                "3 s, as on one thread.",
                "Both callbacks are in the node's default group. It lets in one callback at a time, on however many "
                "threads.",
                right=True,
            ),
        ),
    ),
    Question(
        "look_around becomes `async def` and still calls time.sleep(3.0). The heartbeat has a group of its own, and "
        "there is one thread. How long is the longest gap?",
        (
            Choice(
                "0.1 s: an async callback doesn't block.",
                "A sensible guess: that is what the word suggests. But a coroutine gives its thread back only at an "
                "`await`. time.sleep is not awaited, so it keeps the thread.",
            ),
            Choice(
                "3 s, as without async.",
                "A coroutine gives its thread back only at an `await`. There is none here, so time.sleep keeps the "
                "only thread.",
                right=True,
            ),
            Choice(
                "No heartbeat comes: rclpy refuses async.",
                "A sensible guess: some libraries do. But rclpy accepts coroutines as callbacks. It runs "
                "them until they await, and this one never awaits.",
            ),
        ),
    ),
    Question(
        "report calls where_am_i with client.call() inside its callback. This time it has four threads. What does its "
        "client get?",
        (
            Choice(
                "The position: another thread receives the response.",
                "A sensible guess: there are free threads. But the client is in the node's default group, like the "
                "callback that waits. This group runs one callback at a time, so the response can't be handled.",
            ),
            Choice(
                "No response: it is a deadlock, as on one thread.",
                "The client is in the same group as the callback that waits for the response. Free threads don't help: "
                "the group still runs one callback at a time.",
                right=True,
            ),
            Choice(
                "An exception: rclpy sees the deadlock.",
                "A sensible guess: it would help a lot. But rclpy can't know that your own callback keeps the response "
                "from being handled. Nothing is printed.",
            ),
        ),
    ),
    Question(
        "The simulation is paused, and the node is started with use_sim_time. look_around commands the head and calls "
        "time.sleep(3.0). What do you get?",
        (
            Choice(
                "No answer: time.sleep waits for the paused clock.",
                "A sensible guess: use_sim_time sounds as if it applied to everything. But time.sleep is a function of "
                "Python, which doesn't use /clock.",
            ),
            Choice(
                "After 3 s the answer “looked left and right”, and the head has not moved.",
                "time.sleep waits for seconds of the system clock. The robot's time stood still, so the head didn't "
                "move, although the node responds that it looked around.",
                right=True,
            ),
            Choice(
                "After 3 s the answer, and the head has moved.",
                "A sensible guess: the command was sent. But a paused simulation makes no step, so no joint moves.",
            ),
        ),
    ),
)

QUESTIONS = (
    Question(
        "A node has a timer and a slow service, and rclpy.spin(node) runs it. You want the timer to stay punctual. "
        "Which change is enough?",
        (
            Choice(
                "A MultiThreadedExecutor.",
                "More threads alone change nothing: the default group still lets in one callback at a time.",
            ),
            Choice(
                "A MultiThreadedExecutor, and a callback group of its own for the timer.",
                "One thread can sleep in the service while another runs the timer, and the two callbacks share no "
                "group.",
                right=True,
            ),
            Choice(
                "A callback group of its own for the timer.",
                "The group would allow the timer to run, but the only thread sleeps in the service.",
            ),
        ),
    ),
    Question(
        "An async callback awaits a future. The timer that completes this future is in the same mutually exclusive "
        "group. What happens?",
        (
            Choice(
                "The timer completes the future, because an awaiting callback doesn't count.",
                "It holds no thread, but it counts as running: its group runs no other callback until it returns.",
            ),
            Choice(
                "It awaits forever.",
                "A callback that awaits still counts as running, so its group never runs the timer.",
                right=True,
            ),
            Choice(
                "rclpy raises an exception.",
                "rclpy doesn't detect such deadlocks. Nothing is printed, and the node looks alive.",
            ),
        ),
    ),
    Question(
        "await asyncio.sleep(1.0) in an rclpy callback raises “no running event loop”. Why?",
        (
            Choice(
                "main has to start asyncio's event loop: asyncio.run(rclpy.spin(node)).",
                "rclpy.spin(node) is an ordinary function, which returns when the node ends. While it runs, there is "
                "no event loop.",
            ),
            Choice(
                "rclpy's executor resumes coroutines without asyncio's event loop.",
                "So you await rclpy's futures: the futures of clients, or one that a timer completes.",
                right=True,
            ),
            Choice(
                "The callback has to be declared with `async def` for that.",
                "It is already declared with `async def`, or `await` would be a syntax error.",
            ),
        ),
    ),
    Question(
        "A program calls rate.sleep() from create_rate(10) in a loop in main, and nothing else. How often does the "
        "loop run?",
        (
            Choice(
                "Ten times a second.",
                "The rate is a timer of the node, and nobody spins the node. So the timer never wakes the loop.",
            ),
            Choice(
                "Once.",
                "rate.sleep() waits for a timer of the node, and only a spinning executor calls timers.",
                right=True,
            ),
            Choice(
                "As fast as it can.",
                "rate.sleep() does wait, for a timer that never fires.",
            ),
        ),
    ),
    Question(
        "A node with use_sim_time has to wait for two seconds of the robot's time. What does it use?",
        (
            Choice(
                "time.sleep(2.0)",
                "That waits for two seconds of the system clock: too short when the simulation is slow or paused.",
            ),
            Choice(
                "A timer of the node.",
                "create_timer takes the node's clock, and that clock follows /clock.",
                right=True,
            ),
            Choice(
                "get_clock().sleep_for() in the callback of a single-threaded node.",
                "It never returns: the only thread sleeps, so the node can't receive the /clock message that would "
                "end the sleep.",
            ),
        ),
    ),
    Question(
        "calibrate_imu takes 3 s. Is a service right for it?",
        (
            Choice(
                "No: whatever takes longer than a second has to be an action.",
                "There is no such limit. ROS's guide does recommend services for quick tasks, so decide by the need: "
                "does anybody want to watch the progress, or to cancel?",
            ),
            Choice(
                "Yes: nobody watches it or cancels it, and only its answer counts.",
                "A client can wait for 3 s with a time limit of, say, 5 s. Your task is to let the node run its other "
                "callbacks meanwhile.",
                right=True,
            ),
            Choice(
                "Yes, because it moves nothing: only what moves has to be an action.",
                "A move can be a service too, if nobody needs to stop it half way. Cancel and progress decide.",
            ),
        ),
    ),
)
