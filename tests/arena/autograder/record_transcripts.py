"""Records all or some of the transcripts for test_evidence.py.

PYTHONPATH=tests python tests/arena/autograder/record_transcripts.py [EXERCISE …] [EXERCISE:SCENARIO …]

Run it after a change of a scenario. It opens an arena for each submission, one after the other: a minute or two an
exercise on a quiet machine.
"""

from __future__ import annotations

import json
import sys
from dataclasses import replace

from audited.clause_table import clause_table
from audited.proof import enough_to_catch
from audited.recorded import FOLDER, scenarios_of, write
from autograder.authoring.evidence.transcript import Transcript
from autograder.classroom.audit.known_submission import KnownSubmission, known_submission
from autograder.engine.arena_run import ArenaRun, run_in_arena
from autograder.engine.exercise import Exercise, exercise_names, load_exercise
from autograder.engine.simulation_lag import RETRY_LAG, lateness
from autograder.engine.submission_arenas import SubmissionArenas
from ros_runtime.project import PROJECT

# A submission that passes everything, and a few with different faults: an answer that is wrong, one that never comes,
# a node that ends.
SUBMISSIONS_OF = {
    "balance_controller": [
        *("correct/class_based", "faulty/publishes_at_10_hz", "faulty/keeps_while_it_checks"),
        *("faulty/volatile_gains", "faulty/traceback_at_a_bad_start"),
    ],
    "battery_guard": [
        *(
            "correct/one_loop",
            "faulty/volatile_battery",
            "faulty/looks_away",
            "faulty/leaves_after_the_cancel",
        ),
        *("faulty/counts_to_100", "faulty/waits_for_a_battery_for_ever"),
    ],
    "battery_service": [
        *("correct/class_based", "faulty/answers_from_a_cache", "faulty/no_test_for_none"),
        *("faulty/forgets_after_a_second", "faulty/waits_for_the_first_message"),
    ],
    "calibration": [
        *("correct/threads_and_events", "faulty/async_but_sleeps", "faulty/awaits_in_one_group"),
        *("faulty/looks_only_before", "faulty/never_forgets"),
    ],
    "cancel_client": [
        *(
            "correct/one_loop",
            "faulty/input_in_a_daemon",
            "faulty/no_handle_yet",
            "faulty/waits_for_the_answer",
        ),
        *("faulty/believes_the_answer", "faulty/the_end_of_input_cancels"),
    ],
    "cancellable_walk": [
        *("correct/threads_and_sleep", "faulty/sleeps_on_one_thread", "faulty/pretends", "faulty/walks_on"),
        "faulty/feedback_for_ever",
    ],
    "compute_ik": ["correct/class_based", "faulty/raises_for_a_frame", "faulty/ignores_elbow_up"],
    "interfaces": ["correct/bare", "faulty/no_separator"],
    "joint_query": [
        *("correct/class_based", "faulty/key_error", "faulty/keeps_the_first_message"),
        "faulty/remembers_the_places",
    ],
    "low_battery_fetch": [
        *("correct/one_thread_awaits", "faulty/cancels_itself_alone", "faulty/ignores_the_status"),
        *("faulty/opens_the_hand", "faulty/leaves_a_silent_child"),
    ],
    "motor_services": [
        *("correct/class_based", "faulty/sets_a_field_of_its_own", "faulty/refuses_and_obeys"),
        *("faulty/flag_of_its_own", "faulty/only_a_flag"),
    ],
    "move_arm": [
        *("correct/threads_and_sleep", "faulty/sleeps_on_one_thread", "faulty/aborts_and_lets_go"),
        "faulty/ignores_cancel",
    ],
    "navigate_to_pose": [
        *("correct/threads_and_sleep", "faulty/sleeps_on_one_thread", "faulty/velocity_goes_on"),
        "faulty/feedback_for_ever",
    ],
    "pick_and_place": [
        *("correct/threads_and_sleep", "faulty/drops_when_canceled", "faulty/waits_for_the_hand_for_ever"),
        "faulty/crashes_on_a_name",
    ],
    "patterns": ["correct/as_in_the_notebook", "faulty/eleven_answers"],
    "robot_controller": [
        *("correct/class_based", "faulty/asks_only_once", "faulty/both_at_once", "faulty/always_exit_0"),
        *("faulty/raises_before_the_node", "faulty/no_overall_deadline"),
    ],
    "stand_up": [
        *("correct/threads_and_sleep", "faulty/says_it_once", "faulty/raises_for_the_unknown"),
        *("faulty/ignores_the_loads", "faulty/feedback_for_ever", "faulty/height_is_enough"),
    ],
    "walk_client": [
        *("correct/one_loop", "faulty/reads_the_message_itself", "faulty/waits_for_the_result_for_ever"),
        *("faulty/always_0", "faulty/ctrl_c_just_ends", "faulty/gives_up_soon"),
    ],
    "walk_to": ["correct/threads_and_sleep", "faulty/in_mid_stride", "faulty/before_odom"],
}


def main(wanted: list[str]) -> None:
    """Record the requested transcripts, or all."""
    for each in wanted or exercise_names():
        name, _, scenario = each.partition(":")
        for submission in SUBMISSIONS_OF[name]:
            _record(load_exercise(name, hidden=True), known_submission(name, submission), scenario)
        write_needed(name)
        (PROJECT / "docs" / "clauses" / f"{name}.md").write_text(clause_table(name))


def write_needed(exercise: str) -> None:
    """Write the events that each check needs to pass; review the diff before you commit it."""
    from test_evidence import NEEDED, needed_by, recorded, reference

    sound = (case for case in recorded(exercise) if case.submission in reference(exercise))
    needed = {case.check.id: sorted(needed_by(case)) for case in sound}
    (FOLDER / exercise / NEEDED).write_text(json.dumps(needed, indent=1) + "\n")


def _record(exercise: Exercise, known: KnownSubmission, only: str) -> None:
    files = known.read().files
    wanted = {scenario for check in enough_to_catch(known, exercise).checks for scenario in check.on}
    with SubmissionArenas(exercise.scenario_file) as arenas:
        for name, scenario in scenarios_of(exercise.name).items():
            if scenario in wanted and only in ("", scenario.name):
                run = ArenaRun(exercise, files, scenario)
                transcript = _carry_out(run, arenas)
                write(FOLDER / exercise.name / f"{known.path.stem}.{name}.jsonl.gz", transcript)
                print(f"{exercise.name} {known.path.stem} {name}: {transcript.end:.1f} s", flush=True)


def _carry_out(run: ArenaRun, arenas: SubmissionArenas) -> Transcript:
    """Run a scenario until the simulator kept up; lower the scale each time the machine was too busy."""
    for scale in (5.0, 5.0, 5.0, 2.0, 2.0, 1.0):
        transcript = run_in_arena(replace(run, scale=scale), arenas=arenas)
        if not run.scenario.timed or lateness(transcript) <= RETRY_LAG:
            return transcript
    raise SystemExit(f"the machine is too busy to record {run.scenario.name}")


if __name__ == "__main__":
    main(sys.argv[1:])
