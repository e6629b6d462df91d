"""Each known submission gets its known verdict.

`./course audit` grades all of them with every check, and counts what fails twice. Here are as many as prove every
check, the faulty ones with the checks that must catch them; what fails counts at the first look. They are graded a few
at a time in the background from the first test that needs one on, in the order of the tests, so each test waits for its
own and only those that were selected are graded (`-k battery_service`, `-k walks_on`).

The correct and the hostile submission of each exercise come first. The faulty ones of an exercise follow one another,
as they share arenas. On a slow machine, `--audit-minutes` skips what has not begun by then, and the summary counts it.

Where the G1 is installed, some submissions of the exercises whose scenarios have a walking robot are then graded on it
(`-k g1`), and all of them by `course audit --robot g1`. The other walking exercises have scripted servers: no scenario
differs there.
"""

import threading
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, nullcontext

import psutil
import pytest

from audited.proof import enough_to_catch, enough_to_prove, some_that_walk
from audited.shared_arenas import SharedArenas
from autograder.classroom.audit.known_submission import known_submissions
from autograder.classroom.audit.run import audit_one
from autograder.engine.exercise import exercise_names, load_exercise
from autograder.isolation.availability import available_isolation
from autograder.other_robot import WALKING_EXERCISES, with_robot
from developer.test import LOST_POINTS
from g1 import needs_g1

ARENAS_AT_A_TIME = 3  # two processors: an arena waits for its own clock two thirds of the time
MORE_IF_IDLE = 3  # when the other tests have ended, three arenas use little more than half of two processors
IDLE_BELOW = 60  # % of the processors' time, in the last `LOOK` s
LOOK = 4.0  # s
EXERCISES = {name: load_exercise(name, hidden=True) for name in exercise_names()}
FAULTY_ON_G1 = 1  # of each exercise


def chosen():
    """Yield the known submissions to grade, each with the robot in its scenarios: "" is the course's."""
    for name, exercise in EXERCISES.items():
        submissions = known_submissions(name)
        yield from ((known, "") for known in enough_to_prove(submissions, of_each=1))
        if name in WALKING_EXERCISES:
            on_g1 = known_submissions(name, robot="g1")
            yield from ((known, "g1") for known in some_that_walk(on_g1, exercise, FAULTY_ON_G1))


def label(known, robot):
    return f"{known.exercise}/{known.name}{robot and f'-{robot}'}"


GRADED = [
    pytest.param(known, robot, id=label(known, robot), marks=needs_g1 if robot else ())
    for known, robot in sorted(chosen(), key=lambda one: (one[1], one[0].kind == "faulty"))
]


class Places:
    """Lets `ARENAS_AT_A_TIME` gradings go on at a time, and `MORE_IF_IDLE` more while processors are idle."""

    def __init__(self):
        self._places = threading.Semaphore(ARENAS_AT_A_TIME)
        self._turn = threading.Lock()

    @contextmanager
    def one(self):
        """Wait for a place, or until the processors are idle."""
        with self._turn:  # one after the other, so that each sees the load of the one before
            has_place = self._place_or_idle()
        try:
            yield
        finally:
            if has_place:
                self._places.release()

    def _place_or_idle(self):
        while True:
            psutil.cpu_percent()  # measures from here on
            if self._places.acquire(timeout=LOOK):
                return True
            if psutil.cpu_percent() < IDLE_BELOW:
                return False


@pytest.fixture(scope="session")
def audited(request):
    """Return a function that waits for the grading of a known submission, or skips a test that it has no time for."""
    if not available_isolation().trusted:
        pytest.skip(f"hidden checks need isolated arenas: {available_isolation().reason}")
    wanted = [
        (item.callspec.params["known"], item.callspec.params["robot"])
        for item in request.session.items
        if is_audit(item)
    ]
    minutes = request.config.getoption("audit_minutes")
    end = time.monotonic() + minutes * 60

    places = Places()

    def audit_in_time(known, robot):
        exercise = enough_to_catch(known, EXERCISES[known.exercise])
        if robot:
            exercise = with_robot(robot, exercise)
        lent = nullcontext() if robot else shared.lent_to(known, exercise)
        with places.one(), lent as arenas:
            if time.monotonic() > end:
                return None
            return audit_one(
                known,
                exercise,
                checks_without_retry=[*known.caught_by, *known.also_fails],
                arenas=arenas,
            )

    def result_of(*graded):
        audit = runs[graded].result()
        if audit is None:
            pytest.skip(f"not begun within --audit-minutes {minutes:g}: the machine is slow")
        return audit

    on_the_usual_robot = [known for known, robot in wanted if not robot]
    with (
        SharedArenas(on_the_usual_robot) as shared,
        ThreadPoolExecutor(ARENAS_AT_A_TIME + MORE_IF_IDLE) as pool,
    ):
        runs = {graded: pool.submit(audit_in_time, *graded) for graded in wanted}
        yield result_of
        pool.shutdown(cancel_futures=True)


def is_audit(item):
    """Whether a test needs a grading, and is not skipped because its robot is not installed."""
    if getattr(item, "originalname", "") != "test_verdict_is_as_known":
        return False
    return not any(mark.args[0] for mark in item.iter_markers("skipif"))


@pytest.mark.parametrize(("known", "robot"), GRADED)
def test_verdict_is_as_known(known, robot, audited, pytestconfig):
    audit = audited(known, robot)
    if known.kind == "correct" and audit.failed():
        pytestconfig.cache.set(LOST_POINTS, label(known, robot))
    surprises = audit.surprises()
    assert surprises == [], "\n".join(surprises)
