"""The failure for a missing event is a sentence, with the reason if one is known."""

from dataclasses import replace

import pytest
from std_srvs.srv import Trigger

from autograder.authoring.checks import Check, Scenario
from autograder.authoring.diagnosis.missing import Missing, not_shown, unseen
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import CannotBeJudged, Failure
from autograder.engine.completeness import require_whole
from autograder.engine.judging import judge
from humanoid_interfaces.action import WalkTo
from records import robot

BEGINNING = (ev.NodeStarted(t=0.0), ev.NodeReady(t=1.0, waited=1.0))
ASKED = ev.ServiceCalled(t=2.0, call="first", service="get_status", request=Trigger.Request())
ANSWERED = ev.ServiceAnswered(t=2.1, call="first", response=Trigger.Response(success=True))
RAISED = ev.NodeOutput(t=3.0, stream="stderr", text="RuntimeError: no motors")
EXITED = ev.NodeExited(t=3.1, returncode=1)
GIVEN_UP = ev.Unanswered(t=7.0, what="call", id="first", waited=5.0)
BUSY = ev.NodeUsage(t=9.0, cpu=9.0, wall=9.5, peak_memory_mib=30, cpu_in_time=8.0, in_time=9.0)
AT_ONCE = replace(BUSY, cpu_in_time=1.2, burst=1.9)
REFUSED = ev.RobotRefused(
    t=4.0,
    topic="joint_trajectory",
    count=1240,
    bytes=1_400_000,
    limit=316_192,
    reason="the robot takes at most 500 points",
)
WITH_ROBOT, WITHOUT = Scenario("ask"), Scenario("ask", robot=None)


def transcript(*events, until=10.0, robot_until=10.0):
    truth = [robot(tenth / 10) for tenth in range(int(robot_until * 10) + 1)]
    return Transcript.from_events("ask", {}, [*BEGINNING, *truth, *events, ev.ScenarioEnded(t=until)])


def test_a_question_that_was_never_asked_since_the_node_had_ended():
    with pytest.raises(Missing) as missing:
        transcript(ASKED, ANSWERED, RAISED, EXITED).call("second")
    assert (
        missing.value.observed
        == "the request “second” was never sent, because the node had ended at 3.1 s, with status 1: "
        "RuntimeError: no motors"
    )
    assert "An exception in a callback" in missing.value.help
    assert missing.value.at == 3.1


@pytest.mark.parametrize(
    ("events", "because"),
    [
        ([ASKED, GIVEN_UP], "get_status had given no answer after 5.0 s"),
        ([ASKED, ANSWERED], "the scenario went no further than 10.0 s"),
        (
            [ASKED, ANSWERED, ev.NodeKilled(t=3.0, reason="it used 900 MiB"), EXITED],
            "the node had been ended at 3.0 s: it used 900 MiB",
        ),
        (
            [ASKED, ANSWERED, ev.NodeSignalled(t=3.0, signal="SIGINT"), EXITED],
            "the scenario went no further than 10.0 s",
        ),
    ],
)
def test_the_reason_is_the_first_thing_that_went_wrong(events, because):
    with pytest.raises(Missing) as missing:
        transcript(*events).call("second")
    assert missing.value.observed.endswith(f"because {because}")


@pytest.mark.parametrize(
    ("ask", "never"),
    [
        (lambda run: run.call("first"), "the request “first” was never sent"),
        (lambda run: run.goal("walk"), "the goal “walk” was never sent"),
        (lambda run: run.mark("fallen"), "it never reached it"),
    ],
)
def test_every_query_for_what_never_happened_is_a_failure_of_the_submission(ask, never):
    with pytest.raises(Missing) as missing:
        ask(transcript(EXITED))
    assert missing.value.observed == f"{never}, because the node had ended at 3.1 s, with status 1"


def test_a_goal_that_nobody_asked_to_cancel_is_a_failure_of_the_submission():
    sent = ev.GoalSent(t=2.0, goal="walk", action="walk_to", request=WalkTo.Goal())
    with pytest.raises(Missing, match="a cancel of the goal “walk” was never requested"):
        transcript(sent, EXITED).goal("walk").requests_to_cancel  # noqa: B018


def test_an_answer_after_the_timeout_does_not_count():
    run = transcript(ASKED, GIVEN_UP, replace(ANSWERED, t=7.01))
    assert run.call("first").answer is None


def test_a_duplicate_event_counts_once():
    assert len(transcript(ASKED, ASKED, ANSWERED, ANSWERED).calls) == 1


@pytest.mark.parametrize(
    "ask",
    [
        lambda run: run.robot_at(6.0),
        lambda run: run.robot_between(3.0, 6.0),
        lambda run: run.last_command("push"),
    ],
)
def test_events_missing_by_the_arenas_fault_give_no_grade_unless_the_submission_caused_it(ask):
    with pytest.raises(CannotBeJudged):
        ask(transcript(robot_until=4.0))
    with pytest.raises(
        Failure, match=r"sent 1,240 joint_trajectory messages of up to 1\.4 MB; the robot takes at most 500"
    ):
        ask(transcript(REFUSED, robot_until=4.0))


def test_the_sentence_names_the_missing_event_and_the_reason():
    assert str(unseen(transcript(), "nobody pressed Ctrl-C")) == "ask: nobody pressed Ctrl-C"
    failure = unseen(transcript(BUSY), "nobody pressed Ctrl-C")
    assert isinstance(failure, Failure)
    assert failure.observed == (
        "nobody pressed Ctrl-C, because your program, with the processes that it started, used more than 4.7 "
        "processor-seconds in 9.0 s: 8.0"
    )


# -- the record as a whole --------------------------------------------------------------------------------------------


def test_a_complete_record_does_not_fail():
    require_whole(transcript(ASKED, ANSWERED), WITH_ROBOT)


def test_a_robot_whose_time_stands_still_is_not_judged():
    with pytest.raises(CannotBeJudged, match=r"the simulation stood still for 6\.0 s from 4\.0 s on"):
        require_whole(transcript(robot_until=4.0), WITH_ROBOT)
    require_whole(transcript(robot_until=4.0), WITHOUT)


@pytest.mark.parametrize(
    ("reason", "help"),
    [
        ("it used 900 MiB of memory; 700 MiB are allowed", "list that grows"),
        ("it made 11,045 files; 10,000 are allowed", "files that are created in a callback"),
        ("the arena had 80 TCP sockets; 64 are allowed", "connections that are created in a callback"),
    ],
)
def test_each_limit_has_a_remedy_of_its_own(reason, help):
    with pytest.raises(Missing) as missing:
        transcript(ASKED, ev.NodeKilled(t=3.0, reason=reason)).call("second")
    assert f"had been ended at 3.0 s: {reason}" in missing.value.observed
    assert help in missing.value.help


def test_a_sound_program_on_a_busy_machine_is_not_to_blame():
    """It used as much processor time as on an idle machine, but took longer, and waited for others at its start."""
    slow_start = replace(BUSY, cpu=3.5, wall=3.6, cpu_in_time=1.9, in_time=1.0, burst=1.2)
    for usage in (slow_start, replace(slow_start, cpu_in_time=4.0, in_time=30.0)):
        with pytest.raises(CannotBeJudged):
            require_whole(transcript(usage, robot_until=4.0), WITH_ROBOT)


def test_more_processors_may_be_busy_where_the_clock_is_fast():
    at_five = replace(transcript(replace(AT_ONCE, burst=1.45), robot_until=4.0), scale=5.0)
    with pytest.raises(CannotBeJudged):
        require_whole(at_five, WITH_ROBOT)


@pytest.mark.parametrize(
    "reason", [REFUSED, BUSY, AT_ONCE, ev.ArenaOverfull(memory_mib=3100, limit_mib=1536)]
)
def test_a_submission_that_delays_the_robot_fails(reason):
    with pytest.raises(Failure, match="simulation stood still"):
        require_whole(transcript(reason, robot_until=4.0), WITH_ROBOT)


def test_an_end_of_the_node_is_no_excuse_for_the_robot():
    with pytest.raises(CannotBeJudged):
        require_whole(transcript(EXITED, robot_until=4.0), WITH_ROBOT)


SENT = ev.CommandSent(t=3.0, command={"do": "push", "impulse": [0, 60, 0]})


def obeyed(t):
    return ev.RobotCommanded(t=t, command=SENT.command)


def test_each_command_must_have_taken_effect_once():
    require_whole(transcript(SENT, obeyed(3.1), SENT, obeyed(3.2)), WITH_ROBOT)
    with pytest.raises(CannotBeJudged, match=r"did not obey the grader's command push at 3\.0 s"):
        require_whole(transcript(SENT, obeyed(3.1), SENT), WITH_ROBOT)
    with pytest.raises(Failure, match="1,240 joint_trajectory"):
        require_whole(transcript(SENT, REFUSED), WITH_ROBOT)


def test_a_late_command_is_the_fault_of_the_submission_that_delayed_the_robot():
    require_whole(transcript(SENT, obeyed(6.0)), WITH_ROBOT)
    with pytest.raises(Failure, match=r"at 3\.0 s until 6\.0 s"):
        require_whole(transcript(SENT, obeyed(6.0), REFUSED), WITH_ROBOT)


def test_a_record_that_breaks_off_gives_no_grade():
    run = Transcript.from_events("ask", {}, [*BEGINNING, ASKED, ANSWERED])
    with pytest.raises(CannotBeJudged, match=r"breaks off at 2\.1 s"):
        require_whole(run, WITHOUT)


def check_that(judge_run):
    return Check("It does", 2, judge_run, (WITHOUT,))


def test_a_verdict_of_each_kind():
    whole = transcript(ASKED, ANSWERED)
    assert judge(check_that(lambda run: run.call("first")), [whole]).points == 2
    failed = judge(check_that(lambda run: run.call("second")), [whole])
    assert (failed.status, failed.points, failed.robot_time) == ("failed", 0, 10.0)
    unclear = judge(check_that(lambda run: run.last_command("push")), [whole])
    assert (unclear.status, unclear.help) == (
        "error",
        "Not graded: ask: the robot did not receive the command push",
    )
    broken = judge(check_that(lambda run: run.nonsense), [whole])
    assert broken.status == "error"
    assert "AttributeError" in broken.help


def test_missing_evidence_that_depends_only_on_the_submission_costs_points_in_the_end():
    quiet = transcript(ASKED, ANSWERED)

    def never_walks(run):
        raise not_shown(run, "the robot comes near the goal")

    check = Check("It walks", 1, never_walks, on=(WITH_ROBOT,))
    assert judge(check, [quiet]).status == "error"
    verdict = judge(check, [quiet], is_last_attempt=True)
    assert (verdict.status, verdict.expected) == (
        "failed",
        "an answer from which this can be judged: the robot comes near the goal",
    )
    assert "other checks" not in verdict.help
    after_others = judge(check, [quiet], is_last_attempt=True, others_failed=True)
    assert after_others.help.startswith("Fix what the other checks report first: ")
    assert isinstance(not_shown(transcript(RAISED, EXITED), "the robot comes near"), Failure)
