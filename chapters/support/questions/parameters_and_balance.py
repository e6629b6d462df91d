"""Chapter 10: parameters and balance."""

from lab.learning.question import Choice, Question

QUESTIONS = (
    Question(
        "What may an on-set callback do?",
        (
            Choice(
                "Store the new values, and then accept or refuse them.",
                "Then even a refused set changes the node: that's why the robot of the textbook's node walked "
                "backwards.",
            ),
            Choice(
                "Check its argument, and accept it, or refuse it with a reason.",
                "It may do nothing else, because another callback may still refuse. In an atomic set, one refusal "
                "drops all values.",
                right=True,
            ),
            Choice(
                "Read the new values with get_parameter() and check them.",
                "Inside the callback get_parameter() still returns the old values. The new ones are its argument.",
            ),
        ),
    ),
    Question(
        "A node has a parameter that is declared with 276.0. Somebody types `ros2 param set … 300`. What happens?",
        (
            Choice(
                "The node takes 300.0, because every integer is also a number.",
                "Python would do that. A declared parameter keeps its type, and ROS 2 converts nothing.",
            ),
            Choice(
                "The set is refused, and the command's exit status is 0.",
                "The command sent its request and printed the answer, so it exits with 0. A script that checks only "
                "the exit status believes that the set was accepted.",
                right=True,
            ),
            Choice(
                "The node ends with an exception about the type.",
                "That happens with a value from the command line, in declare_parameter(). At run time the set is "
                "refused.",
            ),
        ),
    ),
    Question(
        "Two parameters have to fit together. How do you change both?",
        (
            Choice(
                "With two calls of ros2 param set, one right after the other.",
                "Between the two calls the pair of values is one that you don't want. And the second set may be "
                "refused after the first was accepted.",
            ),
            Choice(
                "With one request to set_parameters that has both.",
                "It is one request, but the node sets the parameters one by one, each with a result of its own.",
            ),
            Choice(
                "With one request to set_parameters_atomically.",
                "The on-set callback gets both values together, and either both are set or none.",
                right=True,
            ),
        ),
    ),
    Question(
        "A node is started with -p speed:=0.1, declares speed, and registers its on-set callback afterwards. "
        "Which values does the callback get?",
        (
            Choice(
                "0.1, because rclpy calls every callback with the values from the command line.",
                "rclpy calls the callbacks when the parameter is declared, and none was registered at that time.",
            ),
            Choice(
                "Only those that are set later.",
                "The value from the command line was set before the callback was registered. So register before you "
                "declare.",
                right=True,
            ),
            Choice(
                "The default, and then 0.1.",
                "The default is never set: the declaration uses the value from the command line instead.",
            ),
        ),
    ),
    Question(
        "Which test refuses NaN as well?",
        (
            Choice(
                "if value < 0.3: refuse",
                "NaN < 0.3 is false, so NaN is accepted.",
            ),
            Choice(
                "if value < 0.3 or value > 2.0: refuse",
                "Both comparisons with NaN are false, so NaN is accepted.",
            ),
            Choice(
                "if not 0.3 <= value <= 2.0: refuse",
                "The comparison with NaN is false, so `not` makes it true: everything outside the range is refused, "
                "and NaN, too.",
                right=True,
            ),
        ),
    ),
    Question(
        "A file for --params-file names a parameter sped. The node declares speed. What do you see?",
        (
            Choice(
                "The node ends: there is no such parameter.",
                "rclpy keeps the values of the file until the node declares parameters with these names. It never "
                "declares sped.",
            ),
            Choice(
                "A warning in the node's log.",
                "rclpy keeps the value in case the node declares a parameter of that name later, so it doesn't warn.",
            ),
            Choice(
                "Nothing. The node starts with the default of speed.",
                "So check the node's real values with ros2 param dump.",
                right=True,
            ),
        ),
    ),
    Question(
        "How do you stop the robot at once, whatever else is broken?",
        (
            Choice(
                "By a parameter named stop, because everybody can set parameters.",
                "A set may be refused, for example because of its type, and even then ros2 param set exits with 0.",
            ),
            Choice(
                "By hardware; a topic is for an ordinary stop at most.",
                "A wire needs no program and no network. A parameter is a setting, and a set may be refused.",
                right=True,
            ),
            Choice(
                "In the on-set callback of speed.",
                "This callback only accepts or refuses values. A side effect in it takes effect even when the set is "
                "refused.",
            ),
        ),
    ),
    Question(
        "A client sends a stand-up goal for a robot that already stands. How does your server report that?",
        (
            Choice(
                "It rejects the goal.",
                "The client gets only `accepted: false`. It would get the same from a server that has no data yet.",
            ),
            Choice(
                "It publishes feedback with the phase 'stands already'.",
                "A client must not depend on feedback, because messages may get lost. The status and the result have "
                "to report it.",
            ),
            Choice(
                "It accepts the goal and aborts it with ALREADY_STANDING.",
                "A result has fields for a code and a sentence. A rejection has neither.",
                right=True,
            ),
        ),
    ),
)

PREDICTIONS = (
    Question(
        "The robot stands with a kp of 40 N·m/rad, and gets a push of 10 N·s. What happens?",
        (
            Choice(
                "It stands as before: the controller still pulls back.",
                "A sensible guess: it pulls back, and kd damps the motion. But gravity pulls with 51 N·m/rad, and 40 "
                "is less, so the robot never comes back.",
            ),
            Choice(
                "It leans a little further than with its own gains, and stays like that.",
                "A sensible guess: a soft spring does that. But with every degree of lean the torque of gravity grows "
                "more than that of the controller.",
            ),
            Choice(
                "It leans, further and further, and falls.",
                "With each degree of lean the torque of gravity grows more than that of the controller.",
                right=True,
            ),
        ),
    ),
    Question(
        "The robot walks its circle. To stop it, you type: ros2 param set /robot/circle speed 0. What happens?",
        (
            Choice(
                "It stops: 0 and 0.0 are the same number.",
                "A sensible guess: in Python they are equal. But YAML makes an integer of 0, speed is a double, and "
                "ROS 2 converts nothing.",
            ),
            Choice(
                "It walks on, and the command says why.",
                "An integer is refused for a double. The reason is printed, and the robot walks.",
                right=True,
            ),
            Choice(
                "The node ends with an error, and the robot stops half a second later.",
                "A sensible guess: that happens with a wrong type at the start. But a running node refuses the set.",
            ),
        ),
    ),
    Question(
        "The textbook's node has accepted -0.2. Now you set speed to 0.0. What does the robot do?",
        (
            Choice(
                "It stops.",
                "A sensible guess: 0.0 is a valid value. But the callback doesn't check 0.0. It checks the value that "
                "was set before.",
            ),
            Choice(
                "The set is refused, and it walks on ahead.",
                "A sensible guess: a refused set should change nothing. But the callback has stored -0.2 before it "
                "refused.",
            ),
            Choice(
                "The set is refused, and it walks backwards.",
                "The callback stores the -0.2 that was set before, finds it negative, and refuses the 0.0.",
                right=True,
            ),
        ),
    ),
    Question(
        "0.1 m/s and 0.2 rad/s are a circle of 0.5 m. One request to set_parameters has turn 0.45 and speed 0.2, in "
        "this order. Which circle does the robot walk after that?",
        (
            Choice(
                "A circle of 0.44 m, as requested.",
                "A sensible guess: it is one request. But rclpy sets its parameters one by one, and 0.45 rad/s does "
                "not fit the old speed.",
            ),
            Choice(
                "The old circle of 0.5 m: one of the two is refused, so none is set.",
                "A sensible guess: set_parameters_atomically does that. But the request goes to set_parameters.",
            ),
            Choice(
                "A circle of 1 m, twice as wide.",
                "turn is refused, because the speed is still 0.1. Then speed is accepted, because the turn is "
                "still 0.2.",
                right=True,
            ),
        ),
    ),
    Question(
        "The node has 0.2 and 0.45. You load the file that has 0.1 and 0.2, dumped from this very node. "
        "What does it have afterwards?",
        (
            Choice(
                "0.1 and 0.2.",
                "A sensible guess: together they are valid. But load sets them one by one, and 0.1 doesn't fit 0.45.",
            ),
            Choice(
                "0.2 and 0.2.",
                "speed comes first and is refused, because the turn is still 0.45. Then turn is accepted.",
                right=True,
            ),
            Choice(
                "0.2 and 0.45.",
                "A sensible guess: a file looks like one thing. But load sends it to set_parameters, not to "
                "set_parameters_atomically.",
            ),
        ),
    ),
    Question(
        "kp is 60. The robot gets four pushes of 10 N·s, one every second. What does its pitch look like?",
        (
            Choice(
                "As with 276: four small swings, each back at 0 before the next.",
                "A sensible guess: with 60 the robot does come back. But gravity takes 51 of the 60, so only 9 are "
                "left and it takes seconds.",
            ),
            Choice(
                "A staircase: each push adds to the lean that the pushes before have left.",
                "The robot comes back, but that takes seconds, and the next push comes after one second.",
                right=True,
            ),
            Choice(
                "It falls at the first push: 60 is far too little.",
                "A sensible guess: 60 is a fifth of the robot's own gain. But it is more than the 51 that gravity "
                "takes, so the robot comes back.",
            ),
        ),
    ),
    Question(
        "The robot has to rise by 0.15 m, so the server commands 0.3 m/s for half a second. How high is the pelvis "
        "after SUCCEEDED?",
        (
            Choice(
                "0.60 m, as computed.",
                "A sensible guess: 0.3 m/s times 0.5 s is 0.15 m. But the robot rises at 0.15 m/s at most, and the "
                "server measures only the time.",
            ),
            Choice(
                "About half way, 0.53 m.",
                "The robot rises by at most 0.15 m/s, and in half a second that is 0.075 m.",
                right=True,
            ),
            Choice(
                "Still 0.45 m: the robot refuses a speed over its limit.",
                "A sensible guess: some robots do. But this one clamps the command without a warning.",
            ),
        ),
    ),
)
