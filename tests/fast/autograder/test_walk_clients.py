"""The failure of a client of walk_to: the observation from the record, and one next step."""

from __future__ import annotations

from typing import Any

import pytest
from action_msgs.msg import GoalStatus

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import CannotBeJudged, Failure
from autograder.authoring.requirements.client_checks import require_end
from autograder.engine.exercise import load_exercise
from humanoid_interfaces.action import WalkTo

WALK = {check.id: check for check in load_exercise("walk_client", hidden=True).checks}
CANCEL = {check.id: check for check in load_exercise("cancel_client", hidden=True).checks}
ARGUMENTS = {"arguments": ["1.0", "0.5", "0.3"]}
DISTANCES = (1.0, 0.8, 0.6, 0.4)
END = 26.0  # s
HUNG = [ev.Unanswered(t=END, what="end", id="program", waited=25.0)]
OFFERED = [ev.ActionOffered(t=0.1, action="walk_to", server="server 1", type="WalkTo")]


def goal(t: float = 2.0) -> Any:
    message = WalkTo.Goal()
    pose = message.target_pose
    pose.header.frame_id = "odom"
    pose.pose.position.x, pose.pose.position.y = 1.0, 0.5
    pose.pose.orientation.z, pose.pose.orientation.w = 0.14944, 0.98877
    return ev.GoalReceived(t=t, goal="goal 1", action="walk_to", server="server 1", message=message)


def answered(accepted: bool = True, t: float = 2.1) -> Any:
    return ev.GoalReplySent(t=t, goal="goal 1", accepted=accepted)


def on_the_way() -> list[Any]:
    return [
        ev.FeedbackSent(
            t=2.2 + 0.2 * number, goal="goal 1", feedback=WalkTo.Feedback(distance_remaining=metres)
        )
        for number, metres in enumerate(DISTANCES)
    ]


def over(status: int, t: float = 4.0) -> Any:
    result = WalkTo.Result()
    result.final_pose.pose.position.x, result.final_pose.pose.position.y = 0.97, 0.52
    result.error_msg = "it fell" if status == GoalStatus.STATUS_ABORTED else ""
    return ev.GoalFinished(t=t, goal="goal 1", status=status, result=result)


def finished(status: int, t: float = 4.0) -> list[Any]:
    asked, sent = ev.ResultRequested(t=2.2, goal="goal 1"), ev.ResultSent(t=t, goal="goal 1")
    return [asked, over(status, t), sent]


def cancelled(*replies: ev.CancelReplySent, t: float = 3.0, number: int = 1) -> list[Any]:
    received = [
        ev.CancelReceived(
            t=t + 0.1 * index,
            cancel=f"cancel {index + 1}",
            action="walk_to",
            server="server 1",
            goal="goal 1",
        )
        for index in range(number)
    ]
    return [*received, *replies]


def replied(code: int = 0, canceling: tuple[str, ...] = (), t: float = 3.2) -> ev.CancelReplySent:
    return ev.CancelReplySent(t=t, cancel="cancel 1", return_code=code, canceling=list(canceling))


def said(*lines: str, t: float = 4.1, stream: str = "stdout") -> list[Any]:
    return [ev.NodeOutput(t=t, stream=stream, text=line) for line in lines]


def printed(delay: float = 0.0) -> list[Any]:
    return [
        line
        for number, metres in enumerate(DISTANCES)
        for line in said(f"{metres:.2f} m to go", t=2.25 + 0.2 * number + delay)
    ]


def ended(status: int, t: float = 4.2) -> Any:
    return ev.NodeExited(t=t, returncode=status)


TYPED = ev.NodeTyped(t=2.8, line="q")
SUCCEEDED = [*finished(GoalStatus.STATUS_SUCCEEDED), *said("SUCCEEDED at 0.97, 0.52"), ended(0)]
FOLLOWED = [goal(), answered(), *on_the_way(), *printed()]


def run_of(*events: Any) -> Transcript:
    """The record of a run with these events of a server and a user."""
    start = [ev.NodeStarted(t=0.0), ev.NodeReady(t=1.0, waited=1.0), *OFFERED]
    replies = [event.accepted for event in events if isinstance(event, ev.GoalReplySent)]
    server = {"accepted": next(iter(replies), None), "ends_after": None}
    server |= {"cancel": {"agreed": None, "ends_after": None}}
    acts = [event for event in events if isinstance(event, ev.NodeTyped | ev.NodeSignalled)]
    steps = ["press_ctrl_c" if isinstance(act, ev.NodeSignalled) else "type" for act in acts]
    marks = [ev.Mark(t=act.t, name=f"step {number}") for number, act in enumerate(acts, start=1)]
    params = {**ARGUMENTS, "server": server, "steps": [[step] for step in steps]}
    return Transcript.from_events("any", params, [*start, *events, *marks, ev.ScenarioEnded(t=END)])


def failure_of(check: Any, *runs: Transcript) -> Failure:
    with pytest.raises(Failure) as caught:
        check.run(runs)
    return caught.value


def test_a_walk_that_is_followed_to_its_end_passes() -> None:
    run = run_of(*FOLLOWED, *SUCCEEDED)
    for check in ("sends_the_goal", "prints_the_feedback", "says_how_it_succeeded"):
        WALK[check].run([run])
    for check in ("walks", "prints_feedback_at_once"):
        CANCEL[check].run([run])


def test_a_client_that_does_not_find_an_existing_server_is_advised_about_names() -> None:
    run = run_of(*said("nobody offers walk_to", t=5.4, stream="stderr"), ev.NodeExited(t=5.5, returncode=1))
    failure = failure_of(WALK["sends_the_goal"], run)
    assert "with status 1: nobody offers walk_to" in failure.observed
    assert (
        "although the grader offered walk_to: check its reason, and that all names are relative"
        in failure.help
    )


@pytest.mark.parametrize(
    ("line", "next_step"),
    [
        (
            "AttributeError: 'WalkTo_FeedbackMessage' object has no attribute 'distance_remaining'",
            "read message.feedback.field",
        ),
        ("walk_client.py: error: the following arguments are required: yaw", "nargs='?' and a default"),
    ],
)
def test_for_a_client_that_ends_early_its_last_line_is_explained(line: str, next_step: str) -> None:
    traceback = ["Traceback (most recent call last):"] if line.startswith("AttributeError") else []
    run = run_of(*said(*traceback, line, t=0.4, stream="stderr"), ev.NodeExited(t=0.5, returncode=1))
    assert next_step in failure_of(WALK["sends_the_goal"], run).help


def test_for_a_client_that_abandons_an_active_goal_the_last_feedback_is_reported() -> None:
    run = run_of(goal(), answered(), *on_the_way(), *cancelled(replied()), ended(1, t=3.4))
    failure = failure_of(WALK["says_how_it_succeeded"], run)
    assert "a goal may take long, and the last message came at 2.8 s" in failure.help


@pytest.mark.parametrize(
    ("events", "where"),
    [
        ([], "before it sent anything: wait_for_server has no timeout_sec"),
        ([goal()], "waiting for the answer to its goal"),
        ([goal(), answered(accepted=False)], "after its goal was rejected, at 2.1 s"),
        ([goal(), answered()], "give up when no feedback has come"),
        ([goal(), answered(), *cancelled()], "waiting for the answer to its cancel request"),
        (
            [goal(), answered(), *cancelled(replied(canceling=("goal 1",)))],
            "because the cancelled goal did not end",
        ),
        ([goal(), answered(), over(GoalStatus.STATUS_SUCCEEDED)], "It never requested the result"),
        (
            [
                *(goal(), answered()),
                *finished(GoalStatus.STATUS_SUCCEEDED),
            ],
            "after the result came, at 4.0 s",
        ),
    ],
)
def test_for_a_client_that_hangs_the_state_of_its_goal_is_reported(events: list[Any], where: str) -> None:
    with pytest.raises(Failure) as caught:
        require_end(run_of(*events, *HUNG), 10.0)
    assert where in caught.value.help


def test_a_second_line_for_a_feedback_was_not_sent() -> None:
    failure = failure_of(WALK["prints_the_feedback"], run_of(*FOLLOWED, *printed(0.01), *SUCCEEDED))
    assert (failure.expected, failure.observed[:3]) == ("one line for each feedback, 4 in all", "8: ")
    assert "one line for each feedback" in failure.help


def test_a_table_of_numbers_does_not_count_as_a_line_for_each_feedback() -> None:
    table = said(" ".join(f"{number / 100:.2f}" for number in range(300)), t=2.5)
    events = [goal(), answered(), *on_the_way(), *table, *SUCCEEDED]
    assert failure_of(WALK["prints_the_feedback"], run_of(*events)).expected.endswith("a line with 1.00")


def test_a_client_that_does_not_wait_for_a_server_is_advised_to_wait() -> None:
    start = [ev.NodeStarted(t=0.0), ev.NodeReady(t=1.0, waited=1.0)]
    end = [*said("no server", t=1.9, stream="stderr"), ended(1, t=2.0), ev.ScenarioEnded(t=END)]
    nobody = {**ARGUMENTS, "server": None, "steps": []}
    run = Transcript.from_events("any", nobody, [*start, *end])
    failure = failure_of(WALK["gives_up_without_a_server"], run)
    assert failure.observed == "it gave up after 1.0 s"


def test_feedback_that_is_printed_late_points_to_the_reading_of_stdin() -> None:
    late = [goal(), answered(), *on_the_way(), *printed(delay=1.5), *SUCCEEDED]
    failure = failure_of(CANCEL["prints_feedback_at_once"], run_of(*late))
    assert failure.observed == "it came 1.5 s after it"
    assert "by reading stdin" in failure.help


def test_python_that_aborts_in_a_daemon_thread_is_explained() -> None:
    abort = said(
        "Fatal Python error: _enter_buffered_busy: could not acquire lock for <_io.BufferedReader name='<stdin>'> at "
        "interpreter shutdown, possibly due to daemon threads",
        stream="stderr",
    )
    events = [*FOLLOWED, *finished(GoalStatus.STATUS_SUCCEEDED), *said("SUCCEEDED"), *abort, ended(-6)]
    failure = failure_of(CANCEL["walks"], run_of(*events))
    assert failure.observed == "exit status -6; Python aborted"
    assert "for line in sys.stdin" in failure.help


REFUSED = [*FOLLOWED, TYPED, *cancelled(replied())]


@pytest.mark.parametrize(
    "words", ["cancel refused", "the server rejected the cancel", "will not cancel", "Cancel was declined"]
)
def test_a_rejection_may_be_printed_in_any_words(words: str) -> None:
    CANCEL["reports_a_refusal"].run([run_of(*REFUSED, *said(words, t=3.3), *SUCCEEDED)])


def test_a_rejected_cancel_taken_for_accepted_points_to_goals_canceling() -> None:
    failure = failure_of(
        CANCEL["reports_a_refusal"], run_of(*REFUSED, *said("it is being cancelled", t=3.3), *SUCCEEDED)
    )
    assert failure.observed.startswith("it is being cancelled")
    assert "goals_canceling" in failure.help


def test_a_second_request_to_cancel_is_counted() -> None:
    twice = [
        *FOLLOWED,
        TYPED,
        ev.NodeTyped(t=2.9, line="q"),
        *cancelled(replied(canceling=("goal 1",)), number=2),
    ]
    canceled = [*finished(GoalStatus.STATUS_CANCELED), *said("CANCELED"), ended(4)]
    failure = failure_of(CANCEL["cancels_once"], run_of(*twice, *canceled))
    assert failure.expected == "one request to cancel the goal"
    assert failure.observed == "2, the last 0.1 s after the first"


def test_the_answer_to_the_cancel_is_not_the_end_of_the_goal() -> None:
    agreed = [*FOLLOWED, TYPED, *cancelled(replied(canceling=("goal 1",)))]
    failure = failure_of(
        CANCEL["q_cancels_the_goal"], run_of(*agreed, *said("CANCELED", t=3.3), ended(4, t=3.4))
    )
    assert failure.observed == "it ended with status 4 at 3.4 s, while the goal was under way"
    assert failure.help.startswith("The answer to a cancel says only")


# -- after Ctrl-C, the program says how it ended, and ends with 4 ---------------------------------------------

PRESSED = [*FOLLOWED, ev.NodeSignalled(t=2.9, signal="SIGINT"), *cancelled(replied(canceling=("goal 1",)))]
STOPPED = [*PRESSED, *finished(GoalStatus.STATUS_CANCELED)]
ARRIVED = [*PRESSED, *finished(GoalStatus.STATUS_SUCCEEDED)]


@pytest.mark.parametrize(
    ("words", "at"), [("CANCELED: Ctrl-C", 4.1), ("the goal ended with status 5", 4.1), ("canceled", 3.0)]
)
def test_the_last_line_after_ctrl_c_must_name_the_goals_outcome(words: str, at: float) -> None:
    for checks in (WALK, CANCEL):
        checks["ctrl_c_cancels_the_goal"].run([run_of(*STOPPED, *said(words, t=at), ended(4))])


ON_AND_ON = [*said("canceling it", t=3.0), *said("0.40 m to go", t=3.5)]


@pytest.mark.parametrize("words", [[], ON_AND_ON, said("CANCELED", stream="stderr")])
def test_lines_during_the_goal_do_not_count_as_the_outcome(words: list[Any]) -> None:
    failure = failure_of(WALK["ctrl_c_cancels_the_goal"], run_of(*STOPPED, *words, ended(4)))
    assert failure.expected.startswith("a line on stdout at the end")


def test_after_ctrl_c_the_status_is_4_whatever_the_goals_outcome() -> None:
    check = WALK["ctrl_c_ends_it_in_any_case"]
    check.run([run_of(*ARRIVED, *said("Ctrl-C, but it SUCCEEDED"), ended(4))])
    failure = failure_of(check, run_of(*ARRIVED, *said("SUCCEEDED"), ended(0)))
    assert "whatever the status of the goal" in failure.help


def test_after_ctrl_c_the_client_waits_at_most_5_s_whatever_feedback_comes() -> None:
    check = WALK["ctrl_c_cancels_the_goal"]
    check.run([run_of(*PRESSED, *said("Ctrl-C: it goes on", t=7.9), ended(4, t=8.0))])
    failure = failure_of(check, run_of(*PRESSED, *said("CANCELED", t=11.9), ended(4, t=12.0)))
    assert failure.observed == "it ended at 12.0 s"


def test_a_reason_that_is_printed_twice_is_counted() -> None:
    abort = [*FOLLOWED, *finished(GoalStatus.STATUS_ABORTED), *said("ABORTED: it fell", stream="stderr")]
    WALK["tells_an_abort"].run([run_of(*abort, ended(3))])
    failure = failure_of(WALK["tells_an_abort"], run_of(*abort, *said("it fell"), ended(3)))
    assert failure.observed == "2: ABORTED: it fell | it fell"


# -- what a sound cancel client leaves in the record passes, and what is missing there does not ---------------

AGREED = [TYPED, *cancelled(replied(canceling=("goal 1",)))]
CANCELED = [*finished(GoalStatus.STATUS_CANCELED), *said("CANCELED at 0.97, 0.52"), ended(4)]
ABORTED = [*finished(GoalStatus.STATUS_ABORTED), *said("ABORTED (1): it fell", stream="stderr"), ended(3)]
END_OF_INPUT = ev.NodeTyped(t=2.8, line=None)
EARLY = ev.FeedbackSent(t=2.05, goal="goal 1", feedback=WalkTo.Feedback(distance_remaining=4.0))
LATE = [TYPED, *cancelled(replied(code=3)), *said("refused: it has ended", t=3.3)]
SOUND = {
    "q_cancels_the_goal": [*FOLLOWED, *AGREED, *said("it will be canceled", t=3.3), *CANCELED],
    "believes_the_end": [*FOLLOWED, *AGREED, *SUCCEEDED],
    "remembers_an_early_q": [goal(), ev.NodeTyped(t=2.05, line="q"), answered(), *cancelled(), *CANCELED],
    "reports_a_refusal": [*REFUSED, *said("cancel refused", t=3.3), *SUCCEEDED],
    "goes_on_at_the_end_of_input": [*FOLLOWED, END_OF_INPUT, *SUCCEEDED],
    "a_rejected_goal_needs_no_cancel": [
        *(goal(), ev.NodeTyped(t=2.05, line="q"), answered(accepted=False)),
        *(*said("rejected", stream="stderr"), ended(2)),
    ],
    "tells_an_abort": [*FOLLOWED, *ABORTED],
    "tells_an_abort_after_q": [*FOLLOWED, *AGREED, *ABORTED],
    "reports_a_late_cancel": [*FOLLOWED, *LATE, *SUCCEEDED],
    "does_not_wait_for_the_answer": [*FOLLOWED, TYPED, *cancelled(), *SUCCEEDED],
    "gives_up_without_an_answer": [goal(), *said("no answer", t=7.1, stream="stderr"), ended(1, t=7.2)],
    "survives_early_feedback": [goal(), EARLY, answered(t=3.0), *SUCCEEDED],
    "cancels_once": [*FOLLOWED, *AGREED, ev.NodeTyped(t=3.4, line="q"), *CANCELED],
    "other_lines_cancel_nothing": [*FOLLOWED, ev.NodeTyped(t=2.8, line="stop"), *SUCCEEDED],
    "walks_without_an_input": [*FOLLOWED, END_OF_INPUT, *SUCCEEDED],
}


@pytest.mark.parametrize("check", SOUND)
def test_a_correct_cancel_client_passes(check: str) -> None:
    CANCEL[check].run([run_of(*SOUND[check])])


@pytest.mark.parametrize(
    ("check", "missing"),
    [
        (check, kind)
        for check, events in SOUND.items()
        for kind in (ev.ActionOffered, ev.GoalReceived, ev.NodeTyped, ev.NodeExited)
        if kind is ev.ActionOffered or any(isinstance(event, kind) for event in events)
    ],
)
def test_without_the_recorded_events_no_cancel_check_passes(check: str, missing: type) -> None:
    whole = run_of(*SOUND[check])
    less = [event for event in whole.events if not isinstance(event, missing)]
    with pytest.raises((Failure, CannotBeJudged)):
        CANCEL[check].run([Transcript.from_events("any", whole.params, less)])


@pytest.mark.parametrize(
    ("check", "instead"),
    [
        (
            "believes_the_end",
            [*FOLLOWED, *AGREED, *finished(GoalStatus.STATUS_SUCCEEDED), *said("CANCELED"), ended(4)],
        ),
        (
            "tells_an_abort_after_q",
            [*FOLLOWED, *AGREED, *finished(GoalStatus.STATUS_ABORTED), *said("CANCELED"), ended(4)],
        ),
        ("reports_a_late_cancel", [*FOLLOWED, TYPED, *cancelled(replied(code=3)), *SUCCEEDED]),
        ("reports_a_refusal", [*REFUSED, *said("cancel refused", t=3.3, stream="stderr"), ended(1, t=3.4)]),
        ("goes_on_at_the_end_of_input", [*FOLLOWED, END_OF_INPUT, *cancelled(), *CANCELED]),
        ("other_lines_cancel_nothing", [*FOLLOWED, ev.NodeTyped(t=2.8, line="w"), *cancelled(), *CANCELED]),
        ("q_cancels_the_goal", [*FOLLOWED, *cancelled(t=2.5), TYPED, *CANCELED]),
        (
            "remembers_an_early_q",
            [
                *(goal(), ev.NodeTyped(t=2.05, line="q"), answered()),
                *finished(GoalStatus.STATUS_SUCCEEDED, t=6.0),
                *(*said("SUCCEEDED at 0.97, 0.52", t=6.1), ended(0, t=6.2)),
            ],
        ),
        (
            "does_not_wait_for_the_answer",
            [*FOLLOWED, TYPED, *cancelled(), *finished(GoalStatus.STATUS_SUCCEEDED), *HUNG],
        ),
    ],
)
def test_a_faulty_cancel_client_fails(check: str, instead: list[Any]) -> None:
    failure = failure_of(CANCEL[check], run_of(*instead))
    assert failure.observed
    assert failure.help
