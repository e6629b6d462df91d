"""Chapter 8: navigation."""

from lab.learning.question import Choice, Question

QUESTIONS = (
    Question(
        "Why does the server decide the phase anew in every round, instead of running three loops one after the other?",
        (
            Choice(
                "Because three loops cannot be cancelled.",
                "They can, if each of them asks is_cancel_requested. They still would not look at the goal again.",
            ),
            Choice(
                "Because it can then go back to an earlier phase, when a push makes that necessary.",
                "Three loops know only the way forward: they end at a place that was right before the push.",
                right=True,
            ),
            Choice(
                "Because odom drifts, and one loop corrects that.",
                "No loop sees the drift of odom, because it measures in odom. It sees that the robot has left its way.",
            ),
        ),
    ),
    Question(
        "You sum up all small pieces of odom while the robot turns on the spot for eight seconds. What do you get?",
        (
            Choice(
                "Nothing: the robot does not move from its place.",
                "Its place is the same afterwards, but the pelvis has moved to each side with every step.",
            ),
            Choice(
                "Decimetres: lengths are never negative, so the sway adds up.",
                "The movement to the left and the movement to the right are both counted as distance.",
                right=True,
            ),
            Choice(
                "A few millimetres: the movement to the left cancels the one to the right.",
                "That is true of the positions. The sum has lengths in it, and lengths do not cancel.",
            ),
        ),
    ),
    Question(
        "What belongs in estimated_time_remaining, when a turn and a walk lie ahead?",
        (
            Choice(
                "The sum of the parts, each at the speed that the robot really reaches: turns in rad/s, way in m/s.",
                "A turn takes seconds and no metre, so it needs a speed of its own. Measure both, once or on the way.",
                right=True,
            ),
            Choice(
                "The distance, divided by the speed that you command.",
                "The robot clamps a command, and it slips. And the turn, which takes seconds, is forgotten.",
            ),
            Choice(
                "The distance, divided by the speed of the last two seconds.",
                "That is right while the robot walks. While it turns, that speed is about 0, and even a bounded one is "
                "wrong by more than a factor of two.",
            ),
        ),
    ),
    Question(
        "A goal is the pose at which the robot already stands. What should the server do?",
        (
            Choice(
                "Reject it: there is nothing to do.",
                "A client that asks for a place wants the robot to be there, and it is. A rejection gives no reason: "
                "the client would believe that it cannot be reached.",
            ),
            Choice(
                "Divide, and let the NaN go out as progress.",
                "Python raises a ZeroDivisionError here, which aborts the goal. And NaN is no progress bar.",
            ),
            Choice(
                "Succeed at once with a progress of 100 %.",
                "What has to be done is done. Decide what nothing is before you divide by it.",
                right=True,
            ),
        ),
    ),
    Question(
        "A guard has cancelled a goal. When may it report that the robot is safe?",
        (
            Choice(
                "When the server has accepted the cancel.",
                "Accepting means 'I will try'. The robot is still in mid-step.",
            ),
            Choice(
                "When the status is CANCELED.",
                "A sound server says that only when the robot stands. But is this server sound?",
            ),
            Choice(
                "When the status is CANCELED and robot_state says STANDING.",
                "The status is the server's word, and the mode is the robot's. Wait for both, each with a limit.",
                right=True,
            ),
        ),
    ),
    Question(
        "Your subscription gets a percentage of NaN. Which condition lets the robot walk on?",
        (
            Choice(
                "if not percentage >= 0.20: cancel()",
                "NaN >= 0.20 is false, so `not` makes it true: the robot stops because a sensor is silent.",
            ),
            Choice(
                "if percentage < 0.20: cancel()",
                "Every `<` and `>` with NaN is false, so the walk goes on. A good guard warns once, too: this line "
                "alone tells nobody that nothing was measured.",
                right=True,
            ),
            Choice(
                "if int(percentage * 100) < 20: cancel()",
                "int() of NaN raises a ValueError, and the exception ends your node.",
            ),
        ),
    ),
    Question(
        "A goal's pose has frame_id map. Your server knows only odom, and there is no tf2. What now?",
        (
            Choice(
                "Reject the goal.",
                "Without a transform from map to odom the three numbers mean nothing to this server.",
                right=True,
            ),
            Choice(
                "Take the numbers as they are: map and odom begin at the same place.",
                "Perhaps when the robot is switched on at the map's origin. Then odom drifts, and they part.",
            ),
            Choice(
                "Change the frame_id to odom and go on.",
                "That changes the label and not the numbers. Only a transform changes the numbers.",
            ),
        ),
    ),
)

PREDICTIONS = (
    Question(
        "Somebody turns the robot off its way in the middle of its walk. How does the goal of the three loops end?",
        (
            Choice(
                "SUCCEEDED, at the goal: the server measures with odom.",
                "A sensible guess: odom does see the turn. But the server asks it only how far the robot has walked, "
                "and never again where the goal is.",
            ),
            Choice(
                "SUCCEEDED, far beside the goal.",
                "The loop ends after 1.6 m of walking, and succeed() follows whatever loop has ended.",
                right=True,
            ),
            Choice(
                "ABORTED: the server sees that the robot is not there.",
                "A sensible guess: it has all it needs to see that. But nobody wrote that comparison, and rclpy "
                "does not know what a goal means.",
            ),
        ),
    ),
    Question(
        "The robot turns around and walks 1.4 m straight ahead. What is the sum of all pieces of odom?",
        (
            Choice(
                "Between 1.3 and 1.5 m.",
                "A sensible guess: 3 cm are little beside 1.4 m. But they come with every step, about 30 times, and "
                "also while the robot turns.",
            ),
            Choice(
                "More than 1.7 m.",
                "Each step adds its sway, and the turn on the spot adds sway without any distance.",
                right=True,
            ),
            Choice(
                "Less than 1.3 m: odom comes only 20 times a second and cuts the corners.",
                "A sensible guess: straight pieces are shorter than a curve. But the sway that they follow is longer "
                "than the way.",
            ),
        ),
    ),
    Question(
        "The point is 0.6 m to the left of the robot. What does progress_percentage say during the quarter turn?",
        (
            Choice(
                "It rises from 0 to 100 %.",
                "A sensible guess: that is what it is for. But the formula knows distances only, and there is none.",
            ),
            Choice(
                "It is 100 % all the time: the robot is near enough.",
                "A sensible guess: there is nothing to walk. But the pelvis sways by 3 cm, and the formula divides "
                "that by less than a millimetre at the start.",
            ),
            Choice(
                "It says thousands of percent, plus or minus.",
                "3 cm of sway, divided by less than a millimetre at the start.",
                right=True,
            ),
        ),
    ),
    Question(
        "A goal is being canceled, and a second cancel of the same goal arrives. What is the answer to the second one?",
        (
            Choice(
                "Accepted, like the first one.",
                "A sensible guess: both want the same. But rcl offers your cancel callback only goals that can still "
                "change to CANCELING. This one is there already.",
            ),
            Choice(
                "Not accepted, return_code 3: the goal has terminated.",
                "It has not terminated yet, but rcl has no other code for a goal that cannot be cancelled any more.",
                right=True,
            ),
            Choice(
                "None: the server is busy with the first one.",
                "A sensible guess: a server on one thread would be. But this one has eight, and answers at once.",
            ),
        ),
    ),
    Question(
        "0.2 and 0.7 arrive in float32 fields. Which of the two is below the Python number 0.2 or 0.7?",
        (
            Choice(
                "Neither: they are equal.",
                "A sensible guess: it is true of a message that you only create. But on its way to you the Python "
                "number becomes a float32, with half of the digits.",
            ),
            Choice(
                "Both: float32 cuts digits off.",
                "A sensible guess: digits do get lost. But the number is rounded to the nearest float32, which may lie "
                "above.",
            ),
            Choice(
                "0.7 is below, 0.2 is not.",
                "The nearest float32 of 0.2 is 0.200000003, and that of 0.7 is 0.699999988.",
                right=True,
            ),
        ),
    ),
)
