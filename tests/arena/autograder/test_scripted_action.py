"""A scripted action, used by an rclpy client in an arena: correct, faulty, and ended during a goal."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from action_msgs.msg import GoalStatus
from action_msgs.srv import CancelGoal

from autograder.authoring.checks import program
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.engine.arena_run import ArenaRun, run_in_arena
from autograder.engine.exercise import Exercise
from autograder.engine.submission_arenas import SubmissionArenas
from autograder.isolation.availability import available_isolation

pytestmark = pytest.mark.skipif(
    not available_isolation().trusted, reason=f"no namespaces here: {available_isolation().reason}"
)

NAME = "robot_controller"  # any client: its scenarios and its program are replaced
SCENARIOS = """
from std_msgs.msg import String

from autograder.arena import events as ev
from autograder.arena.scripted_action import CancelScript, GoalScript
from humanoid_interfaces.action import WalkTo

NEAR = WalkTo.Feedback(distance_remaining=0.5)


def offer(stage, *scripts):
    return stage.offer_action("walk_to", WalkTo, *scripts)


def run(stage, *arguments):
    stage.start_program(arguments)
    stage.wait_for_end()


def good(stage):
    result = WalkTo.Result(total_steps=7)
    offer(stage, GoalScript(early_feedback=[NEAR], feedback=[NEAR] * 3, ends_after=1.0, result=result))
    run(stage)


def forgetful(stage):
    offer(stage, GoalScript(feedback=[NEAR], kept_for=0.5))
    stage.start_program(["ask late"])
    stage.wait_for_end()


def rejecting(stage):
    offer(stage, GoalScript(accepted=False))
    run(stage)


def agreeing(stage):
    offer(stage, GoalScript(feedback=[NEAR] * 50, ends_after=None))
    run(stage, "cancel")


def refusing(stage):
    offer(stage, GoalScript(feedback=[NEAR], ends_after=1.5, cancel=CancelScript(agreed=False)))
    run(stage, "cancel")


def too_late(stage):
    offer(stage, GoalScript(feedback=[NEAR]))
    run(stage, "cancel after the end")


def deaf_to_cancels(stage):
    offer(stage, GoalScript(feedback=[NEAR], ends_after=1.5, cancel=CancelScript(agreed=None)))
    run(stage, "cancel")


def dying(stage):
    walk_to = offer(stage, GoalScript(feedback=[NEAR] * 50, ends_after=None))
    stage.start_program()
    stage.wait_until(lambda: walk_to.goals, 10.0)
    stage.wait(1.0)
    walk_to.withdraw()
    stage.wait_for_end()


def wait_for_line(stage, text):
    stage.wait_until(lambda: any(text in line.text for line in stage._log.all(ev.NodeOutput)), 10.0)


def typing(stage):
    topic = stage.offer_topic("words", String, latched=True)
    topic.publish(String(data="latched"))
    stage.start_program(["listen"])
    wait_for_line(stage, "latched")
    stage.type_line("q")
    wait_for_line(stage, "q")
    stage.end_input()
    wait_for_line(stage, "end of input")
    stage.interrupt_program()
    stage.wait_for_end()
"""

CLIENT = """
import sys
import threading
import time

import rclpy
from humanoid_interfaces.action import WalkTo
from rclpy.action import ActionClient
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String

PATIENCE = 3.0  # s


def listen(node):
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    node.create_subscription(String, "words", lambda message: print(message.data, flush=True), latched)

    def read():
        for line in sys.stdin:
            print("heard", line.strip(), flush=True)
        print("end of input", flush=True)

    threading.Thread(target=read, daemon=True).start()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        print("interrupted")


def walk(node, what):
    feedback = []
    client = ActionClient(node, WalkTo, "walk_to")
    print("found", client.wait_for_server(timeout_sec=PATIENCE))
    sent = client.send_goal_async(WalkTo.Goal(), feedback_callback=feedback.append)
    rclpy.spin_until_future_complete(node, sent, timeout_sec=PATIENCE)
    print("accepted", sent.result().accepted)
    if not sent.result().accepted:
        return
    if what == "ask late":
        time.sleep(1.5)
    ended = sent.result().get_result_async()
    if what == "cancel after the end":
        rclpy.spin_until_future_complete(node, ended, timeout_sec=PATIENCE)
    if what.startswith("cancel"):
        cancel = sent.result().cancel_goal_async()
        rclpy.spin_until_future_complete(node, cancel, timeout_sec=1.0)
        answer = cancel.result()
        print("cancel", answer and (answer.return_code, len(answer.goals_canceling)))
    rclpy.spin_until_future_complete(node, ended, timeout_sec=PATIENCE)
    print("result", ended.result() and (ended.result().status, ended.result().result.total_steps))
    print("feedback", len(feedback))


rclpy.init()
node = rclpy.create_node("client")
arguments = [argument for argument in rclpy.utilities.remove_ros_args(sys.argv)[1:]]
if arguments == ["listen"]:
    listen(node)
else:
    walk(node, " ".join(arguments))
"""


@pytest.fixture(scope="module")
def exercise(tmp_path_factory: pytest.TempPathFactory) -> Exercise:
    folder = tmp_path_factory.mktemp("client")
    (folder / "scenarios.py").write_text(SCENARIOS)
    return Exercise(NAME, folder, ())


@pytest.fixture(scope="module")
def arenas(exercise: Exercise) -> Iterator[SubmissionArenas]:
    with SubmissionArenas(exercise.scenario_file) as arenas:
        yield arenas


def run(exercise: Exercise, arenas: SubmissionArenas, scenario: str) -> tuple[Transcript, list[str]]:
    """The transcript, and the output of the client."""
    transcript = run_in_arena(
        ArenaRun(exercise, {f"{NAME}.py": CLIENT.encode()}, program(scenario)), arenas=arenas
    )
    assert transcript.first(ev.ScenarioEnded)
    return transcript, transcript.output("stdout").splitlines()


def test_a_goal_is_accepted_followed_and_ended(exercise: Exercise, arenas: SubmissionArenas) -> None:
    transcript, printed = run(exercise, arenas, "good")
    assert printed[:3] == ["found True", "accepted True", f"result ({GoalStatus.STATUS_SUCCEEDED}, 7)"]
    (goal,) = transcript.scripted_goals("walk_to")
    assert goal.reply
    assert goal.finished
    assert goal.result_requested
    assert goal.result_sent
    assert goal.is_accepted
    assert [feedback.t < goal.reply.t for feedback in goal.feedback] == [True, False, False, False]
    assert goal.received.t < goal.reply.t < goal.finished.t <= goal.result_sent.t
    assert goal.finished.t - goal.reply.t == pytest.approx(1.0, abs=0.3)
    assert goal.cancels == []


def test_a_goal_is_rejected(exercise: Exercise, arenas: SubmissionArenas) -> None:
    transcript, printed = run(exercise, arenas, "rejecting")
    assert printed == ["found True", "accepted False"]
    (goal,) = transcript.scripted_goals("walk_to")
    assert not goal.is_accepted


def test_an_expired_result_has_the_status_unknown(exercise: Exercise, arenas: SubmissionArenas) -> None:
    transcript, printed = run(exercise, arenas, "forgetful")
    assert f"result ({GoalStatus.STATUS_UNKNOWN}, 0)" in printed
    (goal,) = transcript.scripted_goals("walk_to")
    forgotten = transcript.first(ev.ResultForgotten)
    assert goal.result_requested
    assert forgotten
    assert goal.result_requested.t > forgotten.t
    assert goal.result_sent is None


@pytest.mark.parametrize(
    ("scenario", "printed", "code", "status"),
    [
        ("agreeing", "cancel (0, 1)", CancelGoal.Response.ERROR_NONE, GoalStatus.STATUS_CANCELED),
        ("refusing", "cancel (0, 0)", CancelGoal.Response.ERROR_NONE, GoalStatus.STATUS_SUCCEEDED),
        ("too_late", "cancel (3, 0)", CancelGoal.Response.ERROR_GOAL_TERMINATED, GoalStatus.STATUS_SUCCEEDED),
    ],
)
def test_a_cancel_is_answered(
    exercise: Exercise, arenas: SubmissionArenas, scenario: str, printed: str, code: int, status: int
) -> None:
    transcript, lines = run(exercise, arenas, scenario)
    assert printed in lines
    assert f"result ({status}, 0)" in lines
    (goal,) = transcript.scripted_goals("walk_to")
    (cancel,) = goal.cancels
    assert cancel.reply
    assert cancel.reply.return_code == code
    assert (cancel.reply.canceling == [goal.name]) == (scenario == "agreeing")
    assert goal.finished
    assert goal.finished.status == status


def test_an_unanswered_cancel_leaves_the_goal_running(exercise: Exercise, arenas: SubmissionArenas) -> None:
    transcript, printed = run(exercise, arenas, "deaf_to_cancels")
    assert "cancel None" in printed
    assert f"result ({GoalStatus.STATUS_SUCCEEDED}, 0)" in printed
    (goal,) = transcript.scripted_goals("walk_to")
    assert [cancel.reply for cancel in goal.cancels] == [None]


def test_a_server_dies_with_its_goal(exercise: Exercise, arenas: SubmissionArenas) -> None:
    transcript, printed = run(exercise, arenas, "dying")
    assert "result None" in printed
    (goal,) = transcript.scripted_goals("walk_to")
    died = transcript.first(ev.ActionWithdrawn)
    assert died
    assert goal.feedback[-1].t <= died.t
    assert goal.finished is goal.result_sent is None


def test_a_program_gets_input_messages_and_an_interrupt(exercise: Exercise, arenas: SubmissionArenas) -> None:
    transcript, printed = run(exercise, arenas, "typing")
    assert printed == ["latched", "heard q", "end of input", "interrupted"]
    assert [event.line for event in transcript.all(ev.NodeTyped)] == ["q", None]
    published = transcript.first(ev.MessagePublished)
    assert published
    assert published.message.data == "latched"
