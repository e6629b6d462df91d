"""Chapter 4: your own interfaces."""

from lab.learning.question import Choice, Question

QUESTIONS = (
    Question(
        "A service switches the gripper's light on or off. Which type do you use?",
        (
            Choice(
                "One of my own, SwitchLight.srv, because the name says what it does.",
                "The service's name already says that. And every client would have to build your package for one bool.",
            ),
            Choice(
                "std_srvs/srv/SetBool, on a service called switch_light.",
                "SetBool has one bool in the request, and success and a message in the response. Every tool has it.",
                right=True,
            ),
            Choice(
                "A topic of std_msgs/msg/Bool.",
                "A topic has no response: the server couldn't say that the lamp is broken.",
            ),
        ),
    ),
    Question(
        "Which field says without doubt where the hand should go?",
        (
            Choice(
                "float64[2] position",
                "Metres or millimetres? From the shoulder, the pelvis, the floor? "
                "Each reader will guess, and they will guess differently.",
            ),
            Choice(
                "geometry_msgs/Point position",
                "The unit is metres now, by REP-103. But the origin is still unknown.",
            ),
            Choice(
                "geometry_msgs/PointStamped target  # m",
                "It carries its frame_id, so the server can refuse a point in a frame that it doesn't know.",
                right=True,
            ),
        ),
    ),
    Question(
        "The result of your action has `bool success`. What is better?",
        (
            Choice(
                "A code with named constants, and a sentence for people.",
                "The status says whether the goal succeeded. The code says why not, "
                "and a program can distinguish a fall from a timeout.",
                right=True,
            ),
            Choice(
                "Nothing, because success is clear, and every program knows a bool.",
                "It repeats the goal's status and can contradict it, such as status SUCCEEDED with success false. "
                "Then the client can't know which one counts.",
            ),
            Choice(
                "A string with the reason.",
                "For people a string is better. But a program would have to search it for words, "
                "and the next version may use other words.",
            ),
        ),
    ),
    Question(
        "You added a field in the middle of a message, built it, and started your new node. "
        "The other node has run since yesterday. What happens?",
        (
            Choice(
                "ROS refuses to connect the two, because the definitions differ.",
                "With DDS, ROS compares only the name of the type, which is the same. "
                "The hashes of the definitions differ, but ROS doesn't compare them.",
            ),
            Choice(
                "The old node picks up the new definition.",
                "The old node read the definition when it imported the type. A running process doesn't read it again.",
            ),
            Choice(
                "They connect, and the bytes of one field are read as another.",
                "Only the bytes are sent, in the order of the definition. "
                "After a change, restart every program that uses the type.",
                right=True,
            ),
        ),
    ),
    Question(
        "acos gets 1.38 for a target 0.6 m away, in a service callback. What should the client of the service see?",
        (
            Choice(
                "The error code NO_IK_SOLUTION, and a sentence.",
                "A target out of reach is an expected outcome: the interface has a code for it.",
                right=True,
            ),
            Choice(
                "The ValueError that acos raises.",
                "The exception ends the server's spin, and with it the node. The client gets no response at all.",
            ),
            Choice(
                "The angles for the nearest point that can be reached.",
                "These angles are for another target. "
                "The client believes that the hand is at its target, and closes the fingers on air.",
            ),
        ),
    ),
    Question(
        "Your server declared the parameter forearm_length with the default 0.25. "
        "Somebody starts it with -p forearm_length:=1. What happens?",
        (
            Choice(
                "The forearm is 1.0 m long.",
                "1 is an integer and the parameter is a double. ROS 2 doesn't convert one into the other.",
            ),
            Choice(
                "The node ends at the declaration: the type is wrong.",
                "Write 1.0. A parameter's type is fixed when it is declared.",
                right=True,
            ),
            Choice(
                "The default stays, and the node's log has a warning.",
                "There is no warning: declare_parameter raises.",
            ),
        ),
    ),
)

PREDICTIONS = (
    Question(
        "The target is too far away. You hand the cosine from the formula to math.acos. What does Python do?",
        (
            Choice(
                "It returns NaN.",
                "A sensible guess: NumPy's arccos does that. But math.acos raises a ValueError, and in a "
                "service callback that exception ends the node.",
            ),
            Choice(
                "It raises an exception.",
                "The cosine is 1.38, and no angle has that cosine. In a service callback the exception "
                "ends the node, so check the cosine before you call acos.",
                right=True,
            ),
            Choice(
                "It returns 0: the arm is stretched towards the target.",
                "A sensible guess: the stretched arm comes closest. But math.acos doesn't clamp its argument, it "
                "raises an exception. If you clamped the cosine yourself, the caller would read success and close "
                "the fingers on air.",
            ),
        ),
    ),
    Question(
        "The client sends one request object three times, with x = 0.1, 0.3 and 0.6. What do the three "
        "printed lines say?",
        (
            Choice(
                "x is 0.1, 0.3, 0.6; the distance is 0.1, 0.3, 0.6.",
                "A sensible guess: rclpy turns a request into bytes the moment you send it, so the "
                "answers are right. But the client has stored the same object three times, and it holds the "
                "last request.",
            ),
            Choice(
                "x is 0.6 each time; the distance is 0.6 each time.",
                "A sensible guess: the client has stored one object three times, and it holds 0.6 at the end. But "
                "rclpy turned it into bytes the moment you sent it, so the server got 0.1, 0.3 and 0.6.",
            ),
            Choice(
                "x is 0.6 each time; the distance is 0.1, 0.3, 0.6.",
                "The distances are right: rclpy turns a request into bytes the moment you send it. The "
                "values of x are wrong: the client has stored one object three times, and it holds the last request.",
                right=True,
            ),
        ),
    ),
    Question(
        "The client waits two seconds for the walk and gives up. What does the robot do?",
        (
            Choice(
                "It stops when the client gives up.",
                "A sensible guess: nobody waits for the walk any more. But a service has no message to "
                "cancel a request, so the robot walks on.",
            ),
            Choice(
                "It stops half a second later.",
                "A sensible guess: the robot's watchdog stops it when the commands end. But the server sends the "
                "commands, not the client: ten times a second, until the robot arrives.",
            ),
            Choice(
                "It walks on to the goal.",
                "A service has no message to cancel a request. The robot walks to the end, and nobody reads "
                "the answer.",
                right=True,
            ),
        ),
    ),
    Question(
        "She builds the package and starts the guard again. level.py has run all the time. What does the "
        "guard print?",
        (
            Choice(
                'About 0.15, and "walk home".',
                "A sensible guess: in the new definition the range is 0 to 1, and the guard uses that definition. "
                "But level.py still runs with the old version and sends about 15. The guard reads those "
                "bytes as percentage.",
            ),
            Choice(
                'About 15, and "go on".',
                "level.py still runs with the old version and sends about 15. Field names aren't part of a message, "
                "so the guard reads those bytes as percentage, and nothing fails.",
                right=True,
            ),
            Choice(
                "Nothing, because the two versions don't match.",
                "A sensible guess: the definitions differ, and so do their hashes. But here nobody "
                "compares the hashes. The type still has the same name, so the guard gets the old bytes.",
            ),
        ),
    ),
)
