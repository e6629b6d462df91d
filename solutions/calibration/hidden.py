"""The hidden checks, which only the instructor's grading runs."""

from __future__ import annotations

from functools import partial
from random import Random
from typing import Any

from autograder.authoring import RESTING, NoOccasion, Scenario, Transcript, check_of, in_order, shuffled
from autograder.classroom.hidden_checks import standard_hidden

from . import checks, model, truth
from .checks import ASKS, BIASES, GROUPS, KNOWS_NOTHING, MEASURED, SETTLE, WAITS

Step = list[Any]
AT_ONCE: Step = ["status_answers", 0.0]
DISCOVERY_TIME = 3.5  # s for a server that was started again to be discovered


def _bias(random: Random) -> Step:
    """Draw the step that sets a gyro bias with no axis near zero."""
    return ["set_bias", *(round(random.choice((-1, 1)) * random.uniform(0.004, 0.014), 4) for _ in "xyz")]


def _steps(random: Random) -> dict[str, Any]:
    """Call the service in any order, while get_status, imu, bias and other clients change."""

    def seconds(least: float, most: float) -> float:
        return round(random.uniform(least, most), 2)

    def calibrate() -> list[Step]:
        return [_bias(random), SETTLE, ["calibrate"]]

    blocks: list[list[Step]] = [
        [["status_answers", seconds(0.6, 1.2)], *calibrate(), AT_ONCE],
        [["status_is_silent"], ["calibrate"], AT_ONCE, *calibrate()],
        [
            *(["status_answers", seconds(2.8, 3.2)], ["calibrate"], ["status_is_silent"], ["calibrate"]),
            *(AT_ONCE, ["calibrate"]),
        ],
        [["status_says_no", 0.0], *calibrate(), AT_ONCE],
        [["unplug_imu"], ["begin"], ["wait", seconds(1.8, 2.2)], ["plug_in_imu"], ["end"], *calibrate()],
        [["begin"], ["wait", seconds(2.4, 2.6)], ["unplug_imu"], ["end"], ["plug_in_imu"]],
        [
            *(["status_answers", 1.2], ["begin"], ["wait", seconds(0.1, 0.5)], ["send"]),
            *(["wait", seconds(1.8, 2.6)], ["send"], ["end"], AT_ONCE),
        ],
        [["begin", random.randint(2, 4)], ["end"]],
    ]
    return {"steps": [*shuffled(random, blocks), SETTLE]}


def _steps_and_walks(random: Random) -> dict[str, Any]:
    """Walk at random velocities before, between and during calibrations."""

    def way() -> list[float]:
        return random.choice(([0.0, 0.0, 0.35], [0.0, 0.0, -0.35], [-0.15, 0.0, 0.0], [0.3, 0.0, 0.0]))

    stand: list[Step] = [["stand"], ["wait", 2.5]]
    blocks: list[list[Step]] = [
        [["walk", *way()], SETTLE, ["calibrate"], *stand, ["calibrate"]],
        # The walk is short, so that the robot certainly stands at the end of the 3 s, also on a busy machine.
        [["begin"], ["wait", round(random.uniform(0.1, 0.3), 2)], ["walk_steps", 1, *way()], ["end"], *stand],
        [["status_answers", 0.9], ["begin"], ["wait", 0.4], ["walk", *way()], ["end"], *stand, AT_ONCE],
    ]
    return {"steps": [*shuffled(random, blocks), ["calibrate"], SETTLE]}


ANY_ORDER = Scenario("in_order", _steps, robot=RESTING)
WALKS_IN_ANY_ORDER = Scenario("in_order", _steps_and_walks)
NO_STATUS = in_order(
    *(["withdraw_status"], ["wait", 0.5], ["calibrate"]),
    *(["offer_status"], ["wait", DISCOVERY_TIME], ["calibrate"], SETTLE),
)
OTHER_NAMESPACE = in_order(["set_bias", *BIASES[1]], SETTLE, ["calibrate"], SETTLE, namespace="/lab_7/robot")

in_any_order = partial(check_of, on=ANY_ORDER)

calibrates_afresh = check_of(
    [*MEASURED, model.collects_for_three_seconds, model.publishes_the_means],
    title="Each calibration uses only its own samples, whatever came before",
    points=2,
    on=ANY_ORDER,
    needs=[checks.tells_what_it_measured, checks.publishes_the_bias],
)

waits_for_a_slow_status = in_any_order(
    [model.ends_right(truth.SLOW), model.ends_right(truth.SAYS_NO)],
    title="After a slow response of get_status, or one with success false, it also collects samples for 3 s",
    needs=checks.calibrates,
    see=ASKS,
)

recovers_when_status_answers = check_of(
    model.ends_right(truth.PROMPT, after="a failure"),
    title="After any rejected or failed calibration the next one can succeed",
    on=[ANY_ORDER, WALKS_IN_ANY_ORDER],
    needs=checks.calibrates,
    see=ASKS,
)

takes_no_answer_for_another = in_any_order(
    [model.ends_right(*model.GETS_NO_ANSWER), model.ends_right(truth.ANOTHERS_ANSWER), model.wastes_no_time],
    title="After 2 s without its own response of get_status it fails; a late response or another's does not count",
    needs=recovers_when_status_answers,
    see="03b_clients_in_bad_company#late-fix-run",
)

refuses_without_a_server = check_of(
    [model.ends_right(truth.MISSING), model.ends_right(truth.PROMPT, after="a failure"), model.beats],
    title="Without a server of get_status it fails within 2 s, the heartbeat goes on, and the next can succeed",
    on=NO_STATUS,
    needs=[checks.refuses_without_an_answer, checks.lives_while_it_waits],
    see=ASKS,
)

is_busy_while_it_asks = in_any_order(
    [model.ends_right(truth.ASKS), model.ends_right(*model.BUSY), model.calibrates_one_at_a_time],
    title="From the request on, a calibration is running: every other request is rejected until it ends",
    needs=[checks.refuses_a_second_caller, recovers_when_status_answers],
    see=GROUPS,
)

fails_after_a_few_steps = check_of(
    [model.ends_right(truth.WALKED_SHORTLY), model.ends_right(truth.WALKED_ON, truth.WALKS)],
    title="If the robot walks for a moment and stands again at the end, the calibration fails, too",
    on=WALKS_IN_ANY_ORDER,
    needs=checks.fails_when_it_begins_to_walk,
    see=WAITS,
)

fails_with_few_samples = in_any_order(
    model.ends_right(truth.FEW_SAMPLES),
    title="With some samples, but fewer than 100, the calibration fails",
    needs=[checks.fails_without_samples, recovers_when_status_answers],
    see=KNOWS_NOTHING,
)

is_content_with_enough_samples = in_any_order(
    model.ends_right(truth.ENOUGH_SAMPLES),
    title="With 100 samples or more the calibration succeeds, even if some are missing",
    needs=recovers_when_status_answers,
    see=WAITS,
)

recovers_when_the_robot_speaks = check_of(
    model.ends_right(*model.SUCCEEDS, after="a failure"),
    title="After the first robot_state it calibrates",
    on=checks.SILENT_ROBOT,
    needs=[checks.calibrates, checks.refuses_before_the_first_state],
    see=KNOWS_NOTHING,
)


def _calibrates(run: Transcript) -> None:
    for each in (model.ends_right(*model.SUCCEEDS), model.publishes_the_means, model.beats):
        if not each.judge(run):
            raise NoOccasion(each.sentence)


works_in_any_namespace = standard_hidden.works_in_any_namespace(
    "calibrates",
    _calibrates,
    on=OTHER_NAMESPACE,
    needs=[checks.publishes_the_bias, checks.keeps_its_heartbeat],
    clauses=[18],
)
