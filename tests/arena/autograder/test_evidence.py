"""Absence of evidence never passes: checks judge recorded transcripts with missing events.

Whatever event is lost, duplicated or late, each check returns a verdict with a sentence and raises nothing; and with
an event lost or duplicated no check passes that failed before.
"""

from __future__ import annotations

import json
import re
from dataclasses import replace
from functools import cache
from itertools import cycle
from zlib import crc32

import pytest

from audited.recorded import FOLDER, Case, cases
from autograder.authoring.diagnosis.root_cause import ALLOWED_LOAD, STARTUP_CPU_TIME
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.classroom.audit.known_submission import known_submissions
from autograder.engine.exercise import exercise_names, load_exercise
from autograder.engine.judging import judge
from autograder.engine.verdict import CheckVerdict

EXERCISES = exercise_names()
NEEDED = "needed.json"  # in the folder of an exercise's transcripts, written by record_transcripts.py
# These events are frequent: the ends of a sequence of them are enough.
RUNS_OF = (
    *("joints_published", "imu_published", "battery_published", "robot_peers", "woken_late"),
    *("joints_truth", "feet_truth", "hand_truth", "object_truth"),
    *("feedback_received", "message_received", "feedback_sent"),
    "message_published",
)
ANSWERS = (
    *("service_answered", "goal_answered", "cancel_answered", "result_received", "reply_sent"),
    "arm_reported",
)
MOST_PLACES = 40  # events of a transcript that are changed for one check; other checks get other events
DELAYS = (0.4, 2.0, 30.0)  # s, taken in turn
# Events that a program causes by itself. Without one of them a record is that of another program, maybe a correct one.
PROGRAM_EVENTS = (
    *("node_output", "node_exited", "node_killed", "request_received"),
    *("feedback_received", "status_seen"),
)


@cache
def recorded(exercise) -> list[Case]:
    return cases(exercise)


@cache
def verdict(case):
    return judge(case.check, case.transcripts)


@cache
def changed(case, change) -> list[tuple[str, CheckVerdict]]:
    """Judge a case with each change of one of its transcripts; return each change with the verdict."""
    return [
        (f"{case}, {transcript.scenario} {what}", without_log(judge(case.check, transcripts)))
        for index, transcript in enumerate(case.transcripts)
        for what, other in change(transcript, places_for(case, transcript))
        for transcripts in [[*case.transcripts[:index], other, *case.transcripts[index + 1 :]]]
    ]


def places_for(case, transcript) -> list[int]:
    """Return every nth of a transcript's places, no more than `MOST_PLACES`; each check begins at another one."""
    found = places(transcript)
    step = -(-len(found) // MOST_PLACES)
    return found[crc32(case.check.id.encode()) % step :: step] if found else []


def without_log(verdict: CheckVerdict) -> CheckVerdict:
    """Remove the verdict's long text, because there are a hundred thousand verdicts."""
    return replace(verdict, log="")


def places(transcript) -> list[int]:
    """Return the indices of the events; of a sequence of frequent events, only the ends of each kind."""
    kinds = [event.kind for event in transcript.events]
    first = beginnings(kinds)
    last = [len(kinds) - 1 - index for index in beginnings(kinds[::-1])]
    return sorted({*first, *last})


def beginnings(kinds) -> list[int]:
    """Return the indices of rare events, and of the first event of each kind in a sequence of frequent events."""
    found = []
    row: set[str] = set()
    for index, kind in enumerate(kinds):
        if kind not in RUNS_OF:
            row.clear()
        if kind not in row:
            found.append(index)
        if kind in RUNS_OF:
            row.add(kind)
    return found


def prefixes(transcript, places):
    for index in places:
        prefix = cut(transcript, index + 1)
        to_its_end = "to its end and " if prefix.first(ev.ScenarioEnded) else ""
        yield f"{to_its_end}until {transcript.events[index].kind} {index}", prefix


def ended_prefixes(transcript, places):
    """Return the transcript as if the program and the scenario had ended there."""
    for what, prefix in prefixes(transcript, places):
        events = [event for event in prefix.events if event.kind != "scenario_ended"]
        t = events[-1].t if events else 0.0
        if is_its_own_choice(prefix):
            what += ", where it leaves"
            events.append(ev.NodeExited(t=t, returncode=0))
        yield what, replace(prefix, events=[*events, ev.ScenarioEnded(t=t)])


def is_its_own_choice(run) -> bool:
    """Whether the program may end here: it has started, is not yet ended, and the robot has executed all commands."""
    commands = len(run.all(ev.CommandSent)), len(run.all(ev.RobotCommanded))
    ends = any(map(run.first, (ev.NodeExited, ev.NodeSignalled)))
    return run.first(ev.NodeStarted) is not None and not ends and commands[0] == commands[1]


def cut(transcript, number) -> Transcript:
    events = list(transcript.events[:number])
    end = events[-1].t if events else 0.0
    return replace(
        transcript, events=events, ground_truth=[robot for robot in transcript.ground_truth if robot.t <= end]
    )


def without_one(transcript, places):
    for index in places:
        events = [*transcript.events[:index], *transcript.events[index + 1 :]]
        yield f"without {transcript.events[index].kind} {index}", replace(transcript, events=events)


def without_a_kind(transcript, _places):
    for kind in sorted({event.kind for event in transcript.events}):
        yield f"without any {kind}", lacking(transcript, kind)
    yield "without any robot_truth", replace(transcript, ground_truth=[])


def lacking(transcript, kind):
    """The transcript without events of a kind; without the effects of commands, it also lacks the sent commands."""
    kinds = (kind, "command_sent") if kind == "robot_commanded" else (kind,)
    return replace(transcript, events=[event for event in transcript.events if event.kind not in kinds])


def doubled(transcript, places):
    for index in places:
        events = [*transcript.events[: index + 1], *transcript.events[index:]]
        yield f"with {transcript.events[index].kind} {index} twice", replace(transcript, events=events)


def delayed(transcript, places):
    for delay, index in zip(cycle(DELAYS), places):
        event = transcript.events[index]
        late = replace(event, t=event.t + delay)
        others = [*transcript.events[:index], late, *transcript.events[index + 1 :]]
        events = sorted(others, key=lambda event: event.t)
        yield f"with {event.kind} {index} {delay} s late", replace(transcript, events=events)


def flooded(transcript, _places):
    for kind in ("feedback_received", "status_seen", "request_received", "service_answered", "woken_late"):
        dropped = ev.RecordDropped(t=transcript.end, what=kind, count=1, seconds=1.0)
        yield f"with a flood of {kind}", replace(transcript, events=[*transcript.events, dropped])


def require_a_verdict(what, verdict):
    assert verdict.status in ("passed", "failed", "not run", "error"), what
    assert "Traceback" not in verdict.help, f"{what}: {verdict.help}"
    if verdict.status == "failed":
        assert verdict.expected, what
        assert verdict.observed, what
        assert verdict.help, what


@pytest.mark.parametrize("exercise", EXERCISES)
def test_complete_transcripts_have_their_known_verdicts(exercise):
    known = {known.path.stem: known for known in known_submissions(exercise)}
    for case in recorded(exercise):
        submission = known[case.submission]
        require_a_verdict(case, verdict(case))
        if case.check.id in submission.caught_by:
            assert verdict(case).status == "failed", case
        elif case.check.id not in submission.also_fails and not unmet(case, submission):
            assert verdict(case).status == "passed", (case, verdict(case))


def unmet(case, submission):
    """Whether the check depends on one that fails for the submission."""
    checks = {check.id: check for check in load_exercise(submission.exercise, hidden=True).checks}
    needs = [need.id for need in case.check.needs]
    for need in needs:
        needs += [each.id for each in checks[need].needs]
    return bool({*submission.caught_by, *submission.also_fails} & set(needs))


@pytest.mark.parametrize("change", [prefixes, ended_prefixes, without_one, without_a_kind, doubled, delayed])
@pytest.mark.parametrize("exercise", EXERCISES)
def test_there_is_always_a_verdict_and_nothing_passes_that_failed(exercise, change):
    for case in recorded(exercise):
        failed = verdict(case).status != "passed"
        for what, judged in changed(case, change):
            require_a_verdict(what, judged)
            if failed and change is not delayed and not own_doing(what):
                assert judged.status != "passed", what


def own_doing(what):
    return re.search(rf"where it leaves|(?:without|with)(?: any)? (?:{'|'.join(PROGRAM_EVENTS)})\b", what)


@pytest.mark.parametrize("exercise", EXERCISES)
def test_a_flood_or_a_truncated_record_never_passes(exercise):
    for case in recorded(exercise):
        broken_off = [judged for judged in changed(case, prefixes) if "to its end" not in judged[0]]
        assert broken_off
        for what, judged in (*broken_off, *changed(case, flooded)):
            assert judged.status != "passed", what


@pytest.mark.parametrize("exercise", EXERCISES)
def test_a_program_that_leaves_at_any_moment_is_judged(exercise):
    for case in recorded(exercise):
        for what, judged in changed(case, ended_prefixes):
            if "where it leaves" in what and judged.status == "error":
                assert "nothing showed whether" in judged.help, (
                    what,
                    judged.help,
                )  # which is a failure in the end


@pytest.mark.parametrize("exercise", EXERCISES)
def test_a_record_that_ends_before_a_needed_event_does_not_pass(exercise):
    for case in recorded(exercise):
        if verdict(case).status == "passed":
            needed = [
                judged.status != "passed" and any(f" {kind} " in what for kind in ANSWERS)
                for what, judged in changed(case, without_one)
            ]
            early = [(what, judged.status != "passed") for what, judged in changed(case, ended_prefixes)]
            for index, (what, has_not_passed) in enumerate(early):
                assert has_not_passed or not any(needed_of_the_same(case, needed, index)), what


def needed_of_the_same(case, needed, index):
    """Of the places behind `index` in the same transcript, whether each is needed; the end itself is put there anew."""
    start = 0
    for transcript in case.transcripts:
        here = places_for(case, transcript)
        if index < start + len(here):
            kinds = [transcript.events[place].kind for place in here]
            behind = range(index - start + 1, len(here))
            return [needed[start + place] for place in behind if kinds[place] != "scenario_ended"]
        start += len(here)
    return []


@pytest.mark.parametrize("exercise", EXERCISES)
def test_each_check_needs_the_evidence_of_its_stimulus(exercise):
    sound = [case for case in recorded(exercise) if case.submission in reference(exercise)]
    known = json.loads((FOLDER / exercise / NEEDED).read_text())
    assert set(known) == {check.id for check in load_exercise(exercise, hidden=True).checks}
    assert {case.check.id for case in sound} == set(known)
    for case in sound:
        assert sorted(needed_by(case)) == known[case.check.id], case


def needed_by(case) -> set[str]:
    """Return the kinds of events without which a check passes no sound submission: the evidence it stands on."""
    return {
        what.split("without any ")[1]
        for what, judged in changed(case, without_a_kind)
        if judged.status != "passed"
    }


@pytest.mark.parametrize("exercise", EXERCISES)
def test_sound_programs_use_far_less_processor_time_than_is_allowed(exercise):
    sound = [case for case in recorded(exercise) if case.submission in reference(exercise)]
    for case in sound:
        for scenario, transcript in zip(case.check.on, case.transcripts, strict=True):
            if (used := transcript.first(ev.NodeUsage)) and scenario.timed:
                assert used.cpu < 0.25 * (STARTUP_CPU_TIME + ALLOWED_LOAD * used.wall * transcript.scale), (
                    case
                )


def reference(exercise):
    return [known.path.stem for known in known_submissions(exercise) if known.kind == "correct"]


# Only a real arena has these: the node's running line, its subscriptions, and the messages that the robot received.
SAID = {
    (
        "battery_service",
        "waits_for_the_first_message",
        "says_when_it_knows_nothing",
    ): "It was blocked in line 27 of battery_service.py, in on_request().",
    ("battery_service", "no_test_for_none", "says_when_it_knows_nothing"): "It was raised in line 23 of "
    "battery_service.py, in on_request().",
    (
        "motor_services",
        "only_a_flag",
        "powers_off",
    ): "On motor_power the grader received no message after the request.",
    (
        "motor_services",
        "flag_of_its_own",
        "follows_the_robot",
    ): "get_status reported the last request to enable_motors",
    ("cancellable_walk", "walks_on", "stops_when_canceled"): "Publish a zero Twist",
}


@pytest.mark.parametrize(("exercise", "submission", "check"), SAID)
def test_a_recorded_failure_names_what_the_arena_saw(exercise, submission, check):
    failed = {(case.submission, case.check.id): verdict(case) for case in recorded(exercise)}
    assert SAID[exercise, submission, check] in failed[submission, check].help


def slowed(transcript) -> Transcript:
    """The same run with a robot that takes twice the time for every motion."""
    robots = [
        replace(robot, t=2 * robot.t, speed=robot.speed / 2, turn_rate=robot.turn_rate / 2)
        for robot in transcript.ground_truth
    ]
    events = [replace(event, t=2 * event.t) for event in transcript.events]
    return replace(transcript, events=events, ground_truth=robots)


@pytest.mark.parametrize("check", ["faces_its_way", "names_its_phases"])
def test_a_slow_robot_is_judged_by_its_own_speed(check):
    judged = [case for case in recorded("navigate_to_pose") if case.check.id == check]
    assert {verdict(case).status for case in judged} == {"passed", "failed"}
    for case in judged:
        assert judge(case.check, [slowed(run) for run in case.transcripts]).status == verdict(case).status, (
            case
        )
