"""Chapter 1: the robot and its graph."""

from lab.learning.question import Choice, Question

QUESTIONS = (
    Question(
        "Your node calls create_subscription(Imu, 'imu', callback, 10). Name and type are right and the robot "
        "runs, but no message ever arrives. Why?",
        (
            Choice(
                "The robot publishes imu too fast, and the queue of 10 overflows.",
                "A sensible guess, because a full queue does drop messages. But it would drop some of them; here "
                "not one arrives.",
            ),
            Choice(
                "A plain number requests reliable, and imu offers only best effort.",
                "The subscription requests more than the publisher offers, so they don't match. Use "
                "qos_profile_sensor_data. Your node's log has a warning: 'incompatible QoS'.",
                right=True,
            ),
            Choice(
                "The robot doesn't know that your node subscribes.",
                "It doesn't have to know. The middleware matches a publisher and a subscription if their QoS settings "
                "are compatible.",
            ),
        ),
    ),
    Question(
        "walk.py publishes cmd_vel ten times a second. It crashes while the robot walks. What happens?",
        (
            Choice(
                "The robot walks on with the last command.",
                "It would, if it had no watchdog. This robot ignores a command that is older than 0.5 s.",
            ),
            Choice(
                "The robot falls, because no program balances it any more.",
                "walk.py only commands a speed. The robot balances by itself, 200 times a second.",
            ),
            Choice(
                "The robot finishes its step and stands, some 0.5 s later.",
                "A crashed program can't command a stop. The robot's watchdog notices that no commands arrive.",
                right=True,
            ),
        ),
    ),
    Question(
        "A node started in the namespace /robot publishes on '/cmd_vel'. What does the robot do?",
        (
            Choice(
                "It walks: the names are the same except for the slash.",
                "The slash makes the name absolute. The robot subscribes to /robot/cmd_vel, "
                "and nobody subscribes to /cmd_vel.",
            ),
            Choice(
                "Nothing, and no error appears anywhere.",
                "ROS sees no mistake in a topic without subscribers. Leave the slash out: the name becomes "
                "/robot/cmd_vel.",
                right=True,
            ),
            Choice(
                "rclpy refuses to make the publisher.",
                "Absolute names are allowed. They are right for things that exist once, such as /clock.",
            ),
        ),
    ),
    Question(
        "battery_state offers transient local. You subscribe with a plain 10, just after the robot has published. "
        "When do you receive the charge?",
        (
            Choice(
                "At once: the publisher keeps its last message for me.",
                "It does keep its last message, but only a subscription that requests transient local receives it. "
                "A plain 10 requests volatile.",
            ),
            Choice(
                "With the next message, up to half a second later.",
                "A subscription may request less than the publisher offers. You miss only the message that was "
                "published before.",
                right=True,
            ),
            Choice(
                "Never: the QoS settings are incompatible.",
                "The opposite case is incompatible: you request transient local, but the publisher offers volatile.",
            ),
        ),
    ),
    Question(
        "odom has position x 2.0, y 0.0 and orientation x 0, y 0, z 0.71, w 0.71. "
        "You send linear.x = 0.3. Which way does the robot go?",
        (
            Choice(
                "To x 2.3 and on: linear.x is along x.",
                "linear.x is along the x axis of base_link. That axis has turned with the robot.",
            ),
            Choice(
                "Along the y of odom.",
                "z = sin 45° and w = cos 45°: the heading is 90° to the left. Forward is now the y of odom.",
                right=True,
            ),
            Choice(
                "It lies on its side and goes nowhere.",
                "You get that if you read the four numbers as w, x, y, z. ROS's order is x, y, z, w.",
            ),
        ),
    ),
    Question(
        "Another team writes an interface to move the gripper to a position; it tells the client whether the gripper "
        "got there. Which pattern is right?",
        (
            Choice(
                "A service, because the client needs an answer.",
                "An action gives an answer, too: its result. But nobody can cancel a service while the arm moves "
                "for three seconds.",
            ),
            Choice(
                "A topic, because positions are data.",
                "A topic carries no answer, so the client would never learn whether the gripper got there.",
            ),
            Choice(
                "An action.",
                "Somebody may step in the way of the arm, so a client may want to cancel. That alone requires an "
                "action, however long the motion takes.",
                right=True,
            ),
        ),
    ),
    Question(
        "You use ROS from PyPI, ROS_PYTHON_CHECK_FIELDS is not set, and you publish a Twist with linear.x = 1. "
        "The robot doesn't move. What did your node send?",
        (
            Choice(
                "1.0; the robot ignores speeds above its limit of 0.4 m/s.",
                "The robot doesn't ignore them, it clamps them: with 1.0 it would walk at 0.4 m/s. But your node "
                "didn't send 1.0.",
            ),
            Choice(
                "Nothing: rclpy drops messages with wrong fields.",
                "A sensible guess, but without ROS_PYTHON_CHECK_FIELDS=1 rclpy doesn't check the fields at all.",
            ),
            Choice(
                "Practically 0: the bits of the int were read as a float.",
                "The bits of Python's 1, read as a float, are 5e-324 or 4e-323. A float field needs a float: 1.0. "
                "With ROS_PYTHON_CHECK_FIELDS=1 the assignment raises an exception; ROS from apt ends the process.",
                right=True,
            ),
        ),
    ),
)

PREDICTIONS = (
    Question(
        "monitor.py subscribes to all five topics, each with a plain 10. On how many does it receive messages?",
        (
            Choice(
                "All five.",
                "A sensible guess: names and types match, and the robot publishes all five. But a "
                "subscription also requests QoS settings. The plain 10 requests reliable, and "
                "imu and joint_states offer only best effort.",
            ),
            Choice(
                "Three of them.",
                "A plain 10 requests reliable. imu and joint_states offer only best effort, so you get "
                "nothing from them. Your node's log says so: 'incompatible QoS'.",
                right=True,
            ),
            Choice(
                "Only odom.",
                "A sensible guess: the node prints when odom has arrived forty times. But it records every "
                "topic that it receives, and battery_state and robot_state arrive, too. Only from imu and "
                "joint_states no message arrives.",
            ),
        ),
    ),
    Question(
        "The simulation is paused, so the robot publishes nothing. Now late.py starts and subscribes to "
        "battery_state twice. What does it print before the simulation goes on?",
        (
            Choice(
                "Nothing.",
                "A sensible guess: nobody publishes during the pause. But battery_state "
                "offers transient local. The publisher keeps its last message and sends it to a late "
                "subscription that requests transient local.",
            ),
            Choice(
                "One line, from the transient local subscription.",
                "It requests the stored message, and the publisher sends it. The plain subscription "
                "waits for the next message.",
                right=True,
            ),
            Choice(
                "One line from each subscription.",
                "A sensible guess: the publisher does keep its last message. But it sends that message only to a "
                "subscription that requests transient local. The plain one waits for the next message.",
            ),
        ),
    ),
    Question(
        "You kill walk.py while the robot walks, and nobody commands a stop. What does the robot do?",
        (
            Choice(
                "It walks on, forever.",
                "A sensible guess: the last command was 0.3 m/s, and a crashed program can't take it "
                "back. But this robot has a watchdog: it ignores a command older than 0.5 s.",
            ),
            Choice(
                "It freezes in mid-step and falls.",
                "A sensible guess: a humanoid that freezes in mid-step falls. But your node only commands "
                "a speed, and the robot keeps its own balance. When the commands end, it finishes "
                "its step and stands.",
            ),
            Choice(
                "It stops and stands.",
                "The robot ignores a command older than 0.5 s, so it finishes its step and "
                "stands. A crashed program can't report that it has crashed, but the watchdog notices that "
                "no commands arrive.",
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
