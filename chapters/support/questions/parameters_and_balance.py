"""Chapter 10: parameters and balance."""

from lab.learning.question import Choice, Question

QUESTIONS = (
    Question(
        "What may an on-set callback do?",
        (
            Choice(
                "Store the new values, and then say whether they are good.",
                "A set that it refuses has then changed the node all the same: the textbook's robot walked backwards.",
            ),
            Choice(
                "Look at its argument and say yes, or no with a reason.",
                "And nothing else: another callback may still say no, and of an atomic set everything is dropped then.",
                right=True,
            ),
            Choice(
                "Read the new values with get_parameter() and check them.",
                "get_parameter() still has the old values there. The new ones are the callback's argument.",
            ),
        ),
    ),
    Question(
        "A node has a parameter that is declared with 276.0. Somebody types `ros2 param set … 300`. What happens?",
        (
            Choice(
                "The node takes 300.0, because every integer is a number.",
                "Python would do that. A declared parameter keeps its type, and ROS 2 converts nothing.",
            ),
            Choice(
                "The set is refused with a reason, and the command's exit status is 0.",
                "The command has asked and printed the answer. A script that looks at the status believes it worked.",
                right=True,
            ),
            Choice(
                "The node ends with an exception about the type.",
                "That happens to a value from the start, in declare_parameter(). At run time it is a refusal.",
            ),
        ),
    ),
    Question(
        "Two parameters have to fit together. In which way do you change both?",
        (
            Choice(
                "With two calls of ros2 param set, one right after the other.",
                "Between the two there is a pair that nobody wanted, and perhaps the first is accepted and the second "
                "refused.",
            ),
            Choice(
                "With one request to set_parameters that has both.",
                "It is one message, but the node sets them one by one, each with a result of its own.",
            ),
            Choice(
                "With one request to set_parameters_atomically.",
                "The on-set callback sees both together, and both are set or none is.",
                right=True,
            ),
        ),
    ),
    Question(
        "A node is started with -p speed:=0.1, declares speed, and registers its on-set callback afterwards. "
        "Which values does the callback see?",
        (
            Choice(
                "0.1, because rclpy asks every callback about values from the start.",
                "rclpy asks when the parameter is declared, and at that time nobody was registered.",
            ),
            Choice(
                "Only those that are set later.",
                "The value from the start counted before there was anybody to ask. Register before you declare.",
                right=True,
            ),
            Choice(
                "The default, and then 0.1.",
                "The default is never set: the value from the start takes its place in the declaration.",
            ),
        ),
    ),
    Question(
        "Which test refuses NaN as well?",
        (
            Choice(
                "if value < 0.3: refuse",
                "NaN < 0.3 is false, so NaN is welcome.",
            ),
            Choice(
                "if value < 0.3 or value > 2.0: refuse",
                "Both comparisons are false. So are the ones in C++'s ranges.",
            ),
            Choice(
                "if not 0.3 <= value <= 2.0: refuse",
                "Ask for what is good and refuse the rest: NaN is never good.",
                right=True,
            ),
        ),
    ),
    Question(
        "A file for --params-file names a parameter sped. The node declares speed. What do you see?",
        (
            Choice(
                "The node ends: there is no such parameter.",
                "rclpy keeps values from the start until somebody declares their names. Nobody declares this one.",
            ),
            Choice(
                "A warning in the node's log.",
                "rclpy keeps the value for a parameter of that name, and nobody declares one: no reason to warn.",
            ),
            Choice(
                "Nothing. The node starts with the default of speed.",
                "So look at what the node really has: ros2 param dump.",
                right=True,
            ),
        ),
    ),
    Question(
        "How do you give the order to stop the robot at once, whatever else is broken?",
        (
            Choice(
                "By a parameter named stop, because everybody can set parameters.",
                "A set may be refused, if only for its type, and the exit status of ros2 param set does not tell.",
            ),
            Choice(
                "By hardware; a topic is at most for an ordinary stop, and a parameter for none.",
                "A wire needs no program and no network. A parameter is a setting, and a set may be refused.",
                right=True,
            ),
            Choice(
                "In the on-set callback of speed.",
                "It decides about values. A side effect there moves the robot even when the set is refused.",
            ),
        ),
    ),
    Question(
        "Somebody asks a robot that stands already to stand up. How does your server tell the client?",
        (
            Choice(
                "It rejects the goal.",
                "The client learns only `accepted: false`. It cannot tell that from a server without data.",
            ),
            Choice(
                "It publishes feedback with the phase 'stands already'.",
                "A client must not need feedback: some of it may get lost. The end of the goal has to say it.",
            ),
            Choice(
                "It accepts the goal and aborts it with ALREADY_STANDING.",
                "A result has room for a code and a sentence. A rejection has none.",
                right=True,
            ),
        ),
    ),
)

PREDICTIONS = (
    Question(
        "The robot stands with a kp of 40 N·m/rad, 11 less than gravity needs, and gets a push of 10 N·s. "
        "What happens?",
        (
            Choice(
                "It stands as before: 40 is not much less than 51.",
                "A sensible guess: only the difference pulls it over, and kd still brakes. But the difference has the "
                "wrong sign, so nothing ever brings it back.",
            ),
            Choice(
                "It leans a little further than with its own gains, and stays like that.",
                "A sensible guess: a soft spring does that. But with every degree gravity gains more than the "
                "controller.",
            ),
            Choice(
                "It leans, further and further, and falls.",
                "Each degree of lean adds more to gravity than to the controller.",
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
                "A sensible guess: that is what a wrong type does at the start. But while it runs, the node refuses.",
            ),
        ),
    ),
    Question(
        "The textbook's node has accepted -0.2. Now you set speed to 0.0. What does the robot do?",
        (
            Choice(
                "It stops.",
                "A sensible guess: 0.0 is a good value. But the callback does not look at 0.0. It looks at what was "
                "set before.",
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
        "this order. What comes of it?",
        (
            Choice(
                "A circle of 0.44 m, as asked for.",
                "A sensible guess: it is one request. But rclpy sets its parameters one by one, and 0.45 rad/s does "
                "not fit the old speed.",
            ),
            Choice(
                "The old circle of 0.5 m: one of the two is refused, so none is set.",
                "A sensible guess: that is what set_parameters_atomically does. But this is the other service.",
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
                "0.1 and 0.2: the node has had these values before.",
                "A sensible guess: they are sound, together. But load sets them one by one, and 0.1 does not fit 0.45.",
            ),
            Choice(
                "0.2 and 0.2.",
                "speed comes first and is refused, because the turn is still 0.45. Then turn is accepted.",
                right=True,
            ),
            Choice(
                "0.2 and 0.45: the file is loaded whole or not at all.",
                "A sensible guess: a file looks like one thing. But load sends it to set_parameters, not to "
                "set_parameters_atomically.",
            ),
        ),
    ),
    Question(
        "kp is 60, 9 more than gravity takes. The robot gets four pushes of 10 N·s, one every second. "
        "What does its pitch look like?",
        (
            Choice(
                "As with 276: four small swings, each back at 0 before the next.",
                "A sensible guess: 60 is enough to come back. But only 9 of the 60 are left for that, so it takes "
                "seconds.",
            ),
            Choice(
                "A staircase: each push comes on top of the one before.",
                "It comes back, but that takes seconds, and the next push comes after one.",
                right=True,
            ),
            Choice(
                "It falls at the first push: 60 is far too little.",
                "A sensible guess: it is a fifth of the robot's own gain. But what counts is the sign of 60 - 51.",
            ),
        ),
    ),
    Question(
        "The server commands 0.3 m/s for half a second, as 0.15 m need. How high is the pelvis after SUCCEEDED?",
        (
            Choice(
                "0.60 m, as computed.",
                "A sensible guess: 0.3 m/s times 0.5 s are 0.15 m. But the robot rises at 0.15 m/s at most, and the "
                "clock does not know.",
            ),
            Choice(
                "About half way, 0.53 m.",
                "The robot rises by at most 0.15 m/s, and in half a second that is 0.075 m.",
                right=True,
            ),
            Choice(
                "Still 0.45 m: the robot refuses a speed over its limit.",
                "A sensible guess: some robots do. But this one clamps the command, and says nothing.",
            ),
        ),
    ),
)
