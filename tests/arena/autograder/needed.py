"""Without which kinds of events each check passes no sound submission: the evidence it stands on.

ALWAYS are needed by all, 'robot_truth' being the simulator's and 'node_ready' a server's appearance; where
'battery_published', 'joints_published', 'arm_reported' or 'robot_commanded' stand, it is also the simulator who says
that the stimulus took place.
"""

ALWAYS = ("node_started", "node_ready", "robot_truth", "scenario_ended")

_ASKED = "service_called service_answered"
_INTERRUPTED = "node_signalled node_exited"
_ENDED = "node_output node_exited"
_SERVED = f"{_ENDED} request_received reply_sent"
_GOAL = "goal_sent goal_answered"
_WALKED = f"{_GOAL} result_received"
_CANCELED = f"{_WALKED} cancel_sent cancel_answered"

NEEDED = {
    "battery_service": {
        "server_appears": "",
        "answers_with_the_last_message": f"{_ASKED} battery_published",
        "says_when_it_knows_nothing": _ASKED,
        "follows_the_battery": f"{_ASKED} battery_published robot_commanded",
        "ends_cleanly": _INTERRUPTED,
        "recovers_when_the_sensor_appears": f"{_ASKED} battery_published robot_commanded",
        "keeps_the_last_message": f"{_ASKED} battery_published robot_commanded",
        "answers_every_request": _ASKED,
        "works_in_any_namespace": f"{_ASKED} battery_published",
    },
    "cancellable_walk": {
        "server_appears": "",
        "accepts_a_goal": _GOAL,
        "arrives": _WALKED,
        "fills_the_result": _WALKED,
        "feedback_keeps_its_rate": f"{_WALKED} feedback_received",
        "feedback_is_true": f"{_WALKED} feedback_received",
        "feedback_ends_with_the_goal": f"{_WALKED} feedback_received",
        "rejects_a_wrong_frame": _GOAL,
        "rejects_nan": _GOAL,
        "rejects_without_power": f"{_GOAL} robot_commanded",
        "cancels_in_mid_stride": _CANCELED,
        "stops_when_canceled": "goal_sent cancel_sent",
        "walks_again_after_a_cancel": f"{_WALKED} cancel_sent",
        "new_goal_preempts_the_old": _WALKED,
        "aborts_when_the_robot_falls": f"{_WALKED} robot_commanded",
        "ends_cleanly": _INTERRUPTED,
        "arrives_anywhere": _WALKED,
        "cancels_at_the_start": _CANCELED,
        "stops_in_any_phase_of_the_gait": _CANCELED,
        "cancels_near_arrival": _CANCELED,
        "survives_a_cancel_after_the_end": _CANCELED,
        "survives_two_cancels": _CANCELED,
        "obeys_a_stranger": _CANCELED,
        "works_in_any_namespace": _WALKED,
    },
    "compute_ik": {
        "server_appears": "",
        "reaches_the_point": _ASKED,
        "bends_the_elbow_as_asked": _ASKED,
        "says_what_is_out_of_reach": _ASKED,
        "refuses_other_frames": _ASKED,
        "moves_the_real_hand": f"{_ASKED} robot_commanded arm_reported",
        "ends_cleanly": _INTERRUPTED,
        "reaches_any_point": _ASKED,
        "refuses_what_is_no_number": _ASKED,
        "declares_its_lengths": _ASKED,
        "does_what_it_says_of_new_lengths": _ASKED,
        "works_in_any_namespace": _ASKED,
    },
    "interfaces": {
        "service_builds": "node_output",
        "response_has_its_fields": "node_output",
        "action_builds": "node_output",
        "goal_has_its_fields": "node_output",
        "result_has_its_fields": "node_output",
        "feedback_has_its_fields": "node_output",
        "request_is_empty": "node_output",
        "error_codes_have_names": "node_output",
    },
    "joint_query": {
        "server_appears": "",
        "finds_the_joints": _ASKED,
        "keeps_the_order_asked": _ASKED,
        "positions_are_the_robots": f"{_ASKED} joints_published",
        "no_names_means_all": f"{_ASKED} joints_published",
        "follows_the_robot": f"{_ASKED} joints_published robot_commanded",
        "names_every_unknown_joint": f"{_ASKED} joints_published",
        "says_when_it_knows_nothing": _ASKED,
        "ends_cleanly": _INTERRUPTED,
        "recovers_when_the_sensors_appear": f"{_ASKED} joints_published robot_commanded",
        "answers_in_any_posture": f"{_ASKED} joints_published robot_commanded",
        "answers_every_request": _ASKED,
        "looks_joints_up_by_name": f"{_ASKED} joints_published robot_commanded",
        "takes_no_joint_for_another": _ASKED,
        "works_in_any_namespace": f"{_ASKED} joints_published",
    },
    "motor_services": {
        "server_appears": "",
        "tells_the_status": _ASKED,
        "follows_the_robot": f"{_ASKED} robot_commanded",
        "says_when_it_knows_nothing": _ASKED,
        "powers_off": _ASKED,
        "powers_on": _ASKED,
        "refuses_off_while_walking": f"{_ASKED} robot_commanded",
        "ends_cleanly": _INTERRUPTED,
        "refuses_however_it_walks": f"{_ASKED} robot_commanded",
        "refuses_nothing_else": f"{_ASKED} robot_commanded",
        "recovers_when_the_robot_speaks": f"{_ASKED} robot_commanded",
        "answers_every_request": _ASKED,
        "works_in_any_namespace": _ASKED,
    },
    "patterns": dict.fromkeys(("answers_everything", *(f"situation_{n}" for n in range(1, 13))), _ENDED),
    "robot_controller": {
        "enables_then_asks": "service_offered request_received reply_sent",
        "prints_the_status": _SERVED,
        "gives_up_without_servers": _ENDED,
        "asks_once_more": f"{_ENDED} service_offered request_received",
        "makes_use_of_the_second_answer": _SERVED,
        "keeps_one_deadline": f"{_ENDED} service_offered",
        "prints_any_status": _SERVED,
        "works_in_any_namespace": _SERVED,
        "needs_both_services": f"{_ENDED} service_offered",
        "gives_up_on_a_silent_status": f"{_SERVED} service_offered",
        "waits_for_slow_answers": _SERVED,
        "is_not_confused_by_a_late_answer": _SERVED,
        "survives_a_dying_server": f"{_ENDED} request_received service_withdrawn",
        "finds_a_restarted_server": f"{_SERVED} service_withdrawn",
        "copes_with_two_servers": f"{_SERVED} service_offered",
        "reports_a_refusal": _SERVED,
    },
}
