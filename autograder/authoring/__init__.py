"""The API for authors of checks: one import provides all of it.

    from autograder.authoring import Scenario, check_of, expect, obligation, standard, whole_run

`evidence` reads a recorded run, and `diagnosis` explains why something did not happen. `requirements` and `walking`
contain what every server, client or walk must do. docs/write_an_exercise.md shows how to use them.
"""

from autograder.authoring.checks import MAY_REST, RESTING, Check, Scenario, check, in_order, program
from autograder.authoring.diagnosis.connections import (
    lesson_on_subscribing,
    why_no_command_arrives,
    why_no_message_arrives,
)
from autograder.authoring.diagnosis.goal_diagnosis import error_name, lesson_on_the_end, why_rclpy_aborted
from autograder.authoring.diagnosis.missing import Missing, held_up, not_shown, unseen
from autograder.authoring.diagnosis.readiness import require_alive, require_ready, require_within_limits
from autograder.authoring.diagnosis.root_cause import why_it_went_no_further
from autograder.authoring.diagnosis.stack_location import where_it_waited
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.call import Call, Request
from autograder.authoring.evidence.fields import differing_fields, expect_field, same, shown, shown_fields
from autograder.authoring.evidence.goal import ABORTED, CANCELED, SUCCEEDED, Goal
from autograder.authoring.evidence.robot_record import RobotRecord
from autograder.authoring.evidence.robot_topic import BATTERY, DELIVERY, JOINTS, known_messages
from autograder.authoring.evidence.scripted_goal import ScriptedCancel, ScriptedGoal
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import Failure, NoOccasion, expect
from autograder.authoring.obligation import Obligation, calls, check_of, goals, obligation, whole_run
from autograder.authoring.requirements import standard
from autograder.authoring.requirements.client_checks import (
    how_to_give_up,
    require_end,
    require_failure,
    require_one_goal,
    require_requests,
    require_success,
    started_at,
    why_not_this_status,
)
from autograder.authoring.requirements.falls import fall_after, require_fall_reported, require_knocked_over
from autograder.authoring.requirements.feedback import (
    end_of_feedback,
    require_feedback,
    require_good_feedback_rate,
)
from autograder.authoring.requirements.standard_obligations import (
    answered_within,
    answers_without_waiting,
    one_or_several,
    require_fastest,
)
from autograder.authoring.rubric import Criterion
from autograder.authoring.sequence import NOT_FINITE, STEPS, rounded, shuffled, steps_until
