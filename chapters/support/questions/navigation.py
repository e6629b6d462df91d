"""Chapter 8: navigation."""

from lab.learning.question import Choice, Question

QUESTIONS = (
    Question(
        "Why does the server decide the phase anew in every round, instead of running three loops one after the other?",
        (
            Choice(
                "Because three loops cannot be cancelled.",
                "They can, if each of them checks is_cancel_requested. But they still don't measure again where the "
                "goal is.",
            ),
            Choice(
                "Because it can then go back to an earlier phase after a push.",
                "Three loops can't go back to an earlier phase. After a push they end at the wrong place.",
                right=True,
            ),
            Choice(
                "Because odom drifts, and a loop that looks again corrects that.",
                "No loop can detect the drift of odom, because it measures with odom. It can only detect that the "
                "robot has left its path.",
            ),
        ),
    ),
    Question(
        "You sum up all small pieces of odom while the robot turns on the spot for eight seconds. What do you get?",
        (
            Choice(
                "Nothing: the robot does not move from its place.",
                "Its place is the same afterwards, but the pelvis has moved to one side with every step.",
            ),
            Choice(
                "Decimetres: lengths are never negative, so the sway adds up.",
                "The movement to the left and the movement to the right are both counted as distance.",
                right=True,
            ),
            Choice(
                "A few millimetres: the movement to the left cancels the one to the right.",
                "That is true of the positions. But you sum up lengths, and lengths don't cancel each other.",
            ),
        ),
    ),
    Question(
        "What belongs in estimated_time_remaining, when a turn and a walk lie ahead?",
        (
            Choice(
                "Turn and walk added up, each at the speed that the robot really reaches.",
                "A turn takes seconds but no metres, so it needs a speed of its own. Measure both speeds.",
                right=True,
            ),
            Choice(
                "The distance that is left, divided by the speed that you command.",
                "The robot clamps a command, and it slips. And this formula leaves out the time for the turn.",
            ),
            Choice(
                "The distance that is left, divided by the mean speed of the last two seconds.",
                "That is right while the robot walks. But while it turns, the speed is about 0, so the estimate is "
                "far too long. Even with a lower limit for the speed it is wrong by more than a factor of two.",
            ),
        ),
    ),
    Question(
        "A goal is the pose at which the robot already stands. What should the server do?",
        (
            Choice(
                "Reject it: there is nothing to do.",
                "The client wants the robot to be there, and it is. A rejection gives no reason, so "
                "the client would believe that the pose can't be reached.",
            ),
            Choice(
                "Divide by the distance 0, and publish NaN as progress.",
                "Python raises a ZeroDivisionError here, which aborts the goal. And NaN is no useful progress.",
            ),
            Choice(
                "Succeed at once with a progress of 100 %.",
                "The robot is already at the goal. Handle a distance of 0 before you divide by it.",
                right=True,
            ),
        ),
    ),
    Question(
        "A guard has cancelled a goal of a server that you didn't write. When may it report that the robot is safe?",
        (
            Choice(
                "When the server has accepted the cancel.",
                "Accepting means 'I will try'. The robot is still in mid-step.",
            ),
            Choice(
                "When the status is CANCELED.",
                "A correct server ends the goal only when the robot stands. But you can't know whether this server is "
                "correct.",
            ),
            Choice(
                "When the status is CANCELED and the mode in robot_state is STANDING.",
                "The status comes from the server, and the mode from the robot itself. Wait for both, each with a "
                "time limit.",
                right=True,
            ),
        ),
    ),
    Question(
        "Your subscription receives a percentage of NaN. With which line does the robot walk on?",
        (
            Choice(
                "if not percentage >= 0.20: cancel()",
                "NaN >= 0.20 is false, so `not` makes it true: the robot stops because a sensor has no value.",
            ),
            Choice(
                "if percentage < 0.20: cancel()",
                "Every `<` and `>` with NaN is false, so the walk goes on. A good guard also logs one warning, because "
                "nothing was measured.",
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
                "They may begin there, if the robot is switched on at the map's origin. But then odom drifts away from "
                "map.",
            ),
            Choice(
                "Change the frame_id to odom and go on.",
                "That changes only the frame's name. To change the numbers you need a transform.",
            ),
        ),
    ),
)

PREDICTIONS = (
    Question(
        "In the middle of the walk somebody turns the robot to the side. How does the goal of the server with three "
        "loops end?",
        (
            Choice(
                "SUCCEEDED, at the goal.",
                "A sensible guess: odom does measure the turn. But the server uses odom only for the distance walked, "
                "and never checks again where the goal is.",
            ),
            Choice(
                "SUCCEEDED, far beside the goal.",
                "The loop ends after 1.6 m of walking, in whatever direction, and then the server calls succeed().",
                right=True,
            ),
            Choice(
                "ABORTED: the robot isn't there.",
                "A sensible guess: the server has the data for that. But its code doesn't compare them, and rclpy "
                "doesn't know what a goal means.",
            ),
        ),
    ),
    Question(
        "The robot turns around and walks 1.4 m straight ahead. What is the sum of all pieces of odom?",
        (
            Choice(
                "Between 1.3 and 1.5 m.",
                "A sensible guess: 3 cm are little compared with 1.4 m. But every step adds them, about 30 times, and "
                "also while the robot turns.",
            ),
            Choice(
                "More than 1.7 m.",
                "Each step adds its sway, and the turn on the spot adds sway without any distance.",
                right=True,
            ),
            Choice(
                "Less than 1.3 m: odom comes only 20 times a second and cuts the corners.",
                "A sensible guess: straight pieces are shorter than a curve. But with the sway the curve is much "
                "longer than the distance.",
            ),
        ),
    ),
    Question(
        "The point is 0.6 m to the left of the robot. What is progress_percentage during the quarter turn?",
        (
            Choice(
                "It rises from 0 to 100 %.",
                "A sensible guess: that is its purpose. But the formula uses distances only, and during the turn the "
                "robot covers none.",
            ),
            Choice(
                "It is 100 % all the time: the robot is near enough.",
                "A sensible guess: there is nothing to walk. But the pelvis sways by 3 cm, and the formula divides "
                "that by less than a millimetre at the start.",
            ),
            Choice(
                "Thousands of percent, positive or negative.",
                "The formula divides 3 cm of sway by the distance at the start, which is less than a millimetre.",
                right=True,
            ),
        ),
    ),
    Question(
        "A goal is being canceled, and a second cancel of the same goal arrives. What is the answer to the second one?",
        (
            Choice(
                "Accepted, like the first one.",
                "A sensible guess: both requests are the same. But rcl calls your cancel callback only for goals that "
                "can still change to CANCELING. This goal is already in that state.",
            ),
            Choice(
                "Not accepted, return_code 3: the goal has terminated.",
                "The goal has not terminated yet. But rcl has no other code for a goal that can't be cancelled any "
                "more.",
                right=True,
            ),
            Choice(
                "None: the server is busy with the first one.",
                "A sensible guess: a server on one thread would be busy. But this one has eight, and responds at once.",
            ),
        ),
    ),
    Question(
        "0.2 and 0.7 arrive in float32 fields. Which of them is now below the Python number that was sent?",
        (
            Choice(
                "Neither: they are equal.",
                "A sensible guess: they are equal in a message that you only create. But when it is sent, the Python "
                "number becomes a float32, with half of the digits.",
            ),
            Choice(
                "Both: float32 cuts digits off.",
                "A sensible guess: digits do get lost. But the number is rounded to the nearest float32, which may be "
                "larger.",
            ),
            Choice(
                "0.7 is below, 0.2 is not.",
                "The nearest float32 of 0.2 is 0.200000003, and that of 0.7 is 0.699999988.",
                right=True,
            ),
        ),
    ),
)
