"""Chapter 1: the robot and its graph."""

from lab.question import Choice, Question

QUESTIONS = (
    Question(
        "Your node subscribes to imu, relative name, right type, create_subscription(Imu, 'imu', callback, 10). "
        "The robot runs, and no message ever comes. Why?",
        (
            Choice(
                "The IMU publishes too fast, and the queue of 10 overflows.",
                "Then you would miss some messages. Here not one arrives.",
            ),
            Choice(
                "A plain number asks for reliable, and imu offers only best effort.",
                "Asked for more than is offered: no match at all. Use qos_profile_sensor_data, and look into the log: "
                "one line there says 'incompatible QoS'.",
                right=True,
            ),
            Choice(
                "The robot does not know that your node listens.",
                "It need not know. The middleware brings publishers and subscribers together, if their terms fit.",
            ),
        ),
    ),
    Question(
        "The node walk.py, which publishes cmd_vel ten times a second, crashes while the robot walks. What follows?",
        (
            Choice(
                "The robot walks on with the last command.",
                "It would, without a watchdog. Ours takes a command for valid for 0.5 s and no longer.",
            ),
            Choice(
                "The robot falls, because nobody balances it any more.",
                "Balance is the robot's own business, 200 times a second. Your node only wished for a speed.",
            ),
            Choice(
                "Half a second after the last command the robot finishes its step and stands.",
                "A program that has crashed cannot say so. Whoever obeys has to notice the silence.",
                right=True,
            ),
        ),
    ),
    Question(
        "A node started in the namespace /robot publishes on '/cmd_vel'. What does the robot do?",
        (
            Choice(
                "It walks: the names are the same but for the slash.",
                "The slash makes the name absolute. The robot listens to /robot/cmd_vel, "
                "and nobody listens to /cmd_vel.",
            ),
            Choice(
                "Nothing, and no error appears anywhere.",
                "A topic without listeners is no mistake to ROS. Leave the slash out: the name becomes /robot/cmd_vel.",
                right=True,
            ),
            Choice(
                "rclpy refuses to make the publisher.",
                "Absolute names are allowed. They are right for things that exist once, such as /clock.",
            ),
        ),
    ),
    Question(
        "battery_state offers transient local. You subscribe with a plain 10, just after a message was sent. "
        "When do you hear the charge?",
        (
            Choice(
                "At once: the publisher keeps its last message for me.",
                "It keeps it for those who ask. A plain subscription asks for volatile and gets only what comes next.",
            ),
            Choice(
                "With the next message, up to half a second later.",
                "Terms that ask for less than is offered do fit. You only do without the kept message.",
                right=True,
            ),
            Choice(
                "Never: the terms do not fit.",
                "That would be the other way round: asking for transient local where it is not offered.",
            ),
        ),
    ),
    Question(
        "odom says position x 2.0, y 0.0 and orientation x 0, y 0, z 0.71, w 0.71. "
        "You send linear.x = 0.3. Which way does the robot go?",
        (
            Choice(
                "To x 2.3 and on: linear.x is along x.",
                "Along the x of base_link. The robot has turned, and its x with it.",
            ),
            Choice(
                "Along the y of odom.",
                "z = sin 45° and w = cos 45°: the heading is 90° to the left. Forward is now the y of odom.",
                right=True,
            ),
            Choice(
                "It lies on its side and goes nowhere.",
                "So it looks to whoever reads the four numbers as w, x, y, z. ROS writes x, y, z, w.",
            ),
        ),
    ),
    Question(
        "Another team offers your arm as 'move the gripper to a position; the reply says whether it got there'. "
        "Which pattern is right?",
        (
            Choice(
                "A service, because the client needs a reply.",
                "An action replies as well. A service cannot be taken back while the arm moves for three seconds.",
            ),
            Choice(
                "A topic, because positions are data.",
                "Nobody would answer that it got there, or that it did not.",
            ),
            Choice(
                "An action.",
                "Somebody may step into the way of the arm: the possibility of a cancel decides, "
                "before any look at the clock.",
                right=True,
            ),
        ),
    ),
    Question(
        "message.linear.x = 1 goes out with rclpy from PyPI, and the robot does not move. What was sent?",
        (
            Choice(
                "1.0; the robot ignores speeds above its limit of 0.4 m/s.",
                "It clamps them: 1.0 would make it walk at 0.4 m/s. But 1.0 was not what left your node.",
            ),
            Choice(
                "Nothing: rclpy drops messages with wrong fields.",
                "It would be kinder. Without ROS_PYTHON_CHECK_FIELDS=1 rclpy does not look.",
            ),
            Choice(
                "5e-324: the int was taken for a float, bit by bit.",
                "A float field needs a float: 1.0. With ROS_PYTHON_CHECK_FIELDS=1 the line itself raises; "
                "the rclpy of apt ends the process.",
                right=True,
            ),
        ),
    ),
)

PREDICTIONS = (
    Question(
        "senses.py subscribes to all five sensors, each with a plain 10. From how many does it receive "
        "messages?",
        (
            Choice(
                "All five.",
                "A sensible guess: names and types match, and the robot publishes all five. But a "
                "subscription also asks for a quality of service. The plain 10 asks for reliable, and "
                "imu and joint_states offer only best effort.",
            ),
            Choice(
                "Three of them.",
                "A plain 10 asks for reliable. imu and joint_states offer only best effort, so you get "
                "nothing from them. Your node's log says so: 'incompatible QoS'.",
                right=True,
            ),
            Choice(
                "Only odom.",
                "A sensible guess: the node prints when odom has come forty times. But it notes every "
                "topic that it receives, and battery_state and robot_state arrive too. Only imu and "
                "joint_states stay silent.",
            ),
        ),
    ),
    Question(
        "The world stands still, so the robot publishes nothing. Now late.py starts and subscribes to "
        "battery_state twice. What does it print before the world goes on?",
        (
            Choice(
                "Nothing.",
                "A sensible guess: nobody publishes while the world stands still. But battery_state "
                "offers transient local. The publisher keeps its last message and hands it to a late "
                "subscription that asks for it.",
            ),
            Choice(
                "One line, from the transient local subscription.",
                "It asks for the kept message, and the publisher hands it over. The plain subscription "
                "waits for the next message.",
                right=True,
            ),
            Choice(
                "One line from each subscription.",
                "A sensible guess: the publisher does keep its last message. But it hands it only to a "
                "subscription that asks for transient local. The plain one waits for the next message.",
            ),
        ),
    ),
    Question(
        'You kill walk.py while the robot walks, and nothing has said "stop". What does the robot do?',
        (
            Choice(
                "It walks on, for ever.",
                "A sensible guess: the last command said 0.3 m/s, and a crashed program can't take it "
                "back. But this robot has a watchdog: a command older than 0.5 s counts for nothing.",
            ),
            Choice(
                "It freezes in mid-step and falls.",
                "A sensible guess: a humanoid that freezes in mid-step falls. But your node only asks "
                "for a speed, and the robot keeps its own balance. When the commands end, it finishes "
                "its step and stands.",
            ),
            Choice(
                "It stops and stands.",
                "A command older than 0.5 s counts for nothing, so the robot finishes its step and "
                "stands. A crashed program can't say that it has crashed: the watchdog notices the "
                "silence.",
                right=True,
            ),
        ),
    ),
    Question(
        "slash.py subscribes to odom and to /odom, in the namespace /robot. It has received twenty "
        "messages. How many came on each topic?",
        (
            Choice(
                "Ten and ten.",
                "A sensible guess: the two names differ by one character, and rclpy accepts both. But "
                "the slash makes a name absolute. The robot publishes on /robot/odom, and nobody "
                "publishes on /odom.",
            ),
            Choice(
                "Twenty on odom, none on /odom.",
                "A name without a slash gets the namespace in front: /robot/odom. /odom means exactly "
                "/odom, and nobody publishes on it.",
                right=True,
            ),
            Choice(
                "None on odom, twenty on /odom.",
                "A sensible guess: in a file system the path with the slash is the one that works "
                "everywhere. But the robot publishes on /robot/odom, and only a relative name gets the "
                "namespace in front.",
            ),
        ),
    ),
)
