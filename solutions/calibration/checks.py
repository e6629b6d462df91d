"""The checks that students can see and run themselves."""

from __future__ import annotations

from autograder.authoring import MAY_REST, check_of, in_order, standard

from . import model, truth

BIASES = [[0.012, -0.008, 0.005], [-0.006, 0.011, -0.009]]  # rad/s
AHEAD = [0.3, 0.0, 0.0]  # m/s, m/s, rad/s
SETTLE = ["wait", 1.5]  # s, for a change to reach every node, and for imu_bias to arrive

INTERRUPT = in_order(interrupt=True)
TWICE = in_order(
    *(["set_bias", *BIASES[0]], SETTLE, ["calibrate"], SETTLE),
    *(["set_bias", *BIASES[1]], SETTLE, ["calibrate"], SETTLE),
)
LATE_LISTENER = in_order(["calibrate"], SETTLE, ["listen"], hears_bias=False)
WALKS = in_order(["walk", *AHEAD], SETTLE, ["calibrate"], SETTLE, robot=())
WALK_BEGINS = in_order(
    *(["begin"], ["wait", 0.8], ["walk", *AHEAD], ["wait", 0.6], ["end"]),
    *(["stand"], ["wait", 2.5], ["calibrate"], SETTLE),
    robot=(),
)
SILENT_ROBOT = in_order(
    *(["calibrate"], ["publish_robot_state"], SETTLE, ["calibrate"], SETTLE),
    robot=(MAY_REST, "--robot-state-unpublished"),
)
TWO_CALLERS = in_order(["status_answers", 0.7], ["begin"], ["wait", 0.2], ["send"], ["end"], SETTLE)
SILENT_STATUS = in_order(
    *(["status_is_silent"], ["calibrate"], SETTLE),
    *(["status_says_no", 0.0], ["calibrate"], SETTLE),
    *(["withdraw_status"], ["wait", 0.5], ["calibrate"], SETTLE),
)
NO_IMU = in_order(["unplug_imu"], SETTLE, ["calibrate"], SETTLE)

WAITS = "05_executors#await-why"
GROUPS = "05_executors#groups-why"
ASKS = "05_executors#report-why"
REFUSES = "02_services#set-refuse-why"
KNOWS_NOTHING = "02_services#m9-fix-why"
MEASURED = (model.tells_the_means, model.tells_the_count)

server_appears = standard.server_appears("calibrate_imu", on=INTERRUPT)

keeps_its_heartbeat = check_of(model.beats, points=2, on=TWICE, needs=server_appears)

refuses_before_the_first_state = check_of(
    model.ends_right(truth.UNKNOWN),
    title="Before the first robot_state it rejects requests at once",
    on=SILENT_ROBOT,
    needs=server_appears,
    see=KNOWS_NOTHING,
)

refuses_while_walking = check_of(
    model.ends_right(truth.WALKS),
    title="While the robot walks, it rejects requests at once",
    points=2,
    on=WALKS,
    needs=server_appears,
    see=REFUSES,
)

asks_get_status = check_of(model.asks_get_status, on=TWICE, needs=server_appears)

calibrates = check_of(
    model.ends_right(*model.SUCCEEDS),
    title="While the robot stands, it succeeds after 3 s, also a second time",
    on=TWICE,
    needs=asks_get_status,
    see=WAITS,
)

tells_what_it_measured = check_of(
    MEASURED,
    title="The message has the means of x, y and z with at least four decimals, and the number of its own samples, "
    "also after a failure",
    points=2,
    on=[TWICE, WALK_BEGINS],
    needs=calibrates,
)

refuses_without_an_answer = check_of(
    [
        model.ends_right(truth.SILENT),
        model.ends_right(truth.MISSING),
        model.ends_right(truth.SAYS_NO, after="a failure"),
    ],
    title="Without a response of get_status within 2 s the calibration fails and says so; the next can succeed",
    points=2,
    on=SILENT_STATUS,
    needs=calibrates,
    see=ASKS,
)

lives_while_it_waits = check_of(
    model.beats,
    title="The heartbeat goes on while get_status does not respond or has no server",
    points=2,
    on=SILENT_STATUS,
    needs=[asks_get_status, keeps_its_heartbeat],
)

refuses_a_second_caller = check_of(
    [model.ends_right(*model.BUSY), model.ends_right(*model.SUCCEEDS)],
    title="While a calibration runs, a second request is rejected at once, and the first one gets its response",
    points=2,
    on=TWO_CALLERS,
    needs=calibrates,
    see=GROUPS,
)

fails_when_it_begins_to_walk = check_of(
    model.ends_right(*model.WALKED),
    title="If the robot begins to walk during a calibration, the calibration fails",
    points=2,
    on=WALK_BEGINS,
    needs=calibrates,
    see=WAITS,
)

fails_without_samples = check_of(
    model.ends_right(truth.NO_SAMPLES),
    title="If no imu messages come, the calibration fails and the node goes on running",
    on=NO_IMU,
    needs=calibrates,
    see=KNOWS_NOTHING,
)

publishes_the_bias = check_of(model.publishes_the_means, on=TWICE, needs=calibrates)

latches_the_bias = check_of(model.latches_the_bias, on=LATE_LISTENER, needs=publishes_the_bias)

ends_cleanly = standard.ends_cleanly(on=INTERRUPT, needs=server_appears, clauses=[19])
