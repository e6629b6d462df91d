'''Checks and scenarios as authors write them. A check is a function of transcripts, and its docstring is its title.

server_appears = standard.server_appears("the action walk_to", points=1, on=WALK)

@check(points=2, on=WALK, needs=server_appears)
def arrives_at_the_goal(walk: Transcript) -> None:
    """The robot ends within 0.10 m of the goal"""
    ...
    raise Failure(expected="…", observed="…", help="…", at=walk.goal("goal").result.t)
'''

from __future__ import annotations

import random
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from types import ModuleType
from typing import TYPE_CHECKING, Any, Literal

from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import Failure
from autograder.authoring.sequence import in_words, steps_until

if TYPE_CHECKING:
    from autograder.authoring.obligation import Obligation

MAY_REST = "--may-rest"  # simulator option: physics pauses while the robot only stands
RESTING = (MAY_REST,)  # simulator options of a scenario in which the robot never moves

Judge = Callable[..., None]
Inputs = Mapping[str, Any] | Callable[[random.Random], Mapping[str, Any]]


@dataclass(frozen=True, eq=False)
class Scenario:
    """A scenario function by name, with inputs that are fixed or drawn from a seeded generator during grading.

    Each Scenario object runs once for a submission, even if several checks judge it.

    Attributes:
        name: of the function in the exercise's scenarios.py.
        inputs: its arguments, or a function that draws them from a generator.
        robot: options of the simulator; None: the scenario needs no robot.
        student: 'node': it starts before the scenario and runs until Ctrl-C; 'program': the scenario starts it, and it
            ends by itself.
        namespace: ROS namespace of robot and student.
        parameters: ROS parameters that the student's program is started with.
        timed: whether deadlines are judged. If not (compiling, a quiz), the clock is not sped up, and a run on a busy
            machine counts.
    """

    name: str
    inputs: Inputs = field(default_factory=dict)
    robot: tuple[str, ...] | None = ()
    student: Literal["node", "program"] = "node"
    namespace: str = "/robot"
    parameters: Mapping[str, Any] = field(default_factory=dict)
    timed: bool = True

    @property
    def is_light(self) -> bool:
        """Whether it needs little processor time: it has no robot, or one that never moves."""
        return self.robot is None or MAY_REST in self.robot

    @property
    def is_drawn(self) -> bool:
        """Whether its inputs are drawn from a seed."""
        return callable(self.inputs)

    def draw(self, seed: int) -> dict[str, Any]:
        """Return the inputs for one seed; the same seed draws the same inputs."""
        if callable(self.inputs):
            return dict(self.inputs(random.Random(f"{seed}/{self.name}")))
        return dict(self.inputs)


def program(name: str, inputs: Inputs | None = None, **options: Any) -> Scenario:
    """Return a scenario without a robot for a student's program that ends by itself; `options` are its other fields."""
    return Scenario(name, inputs or {}, robot=None, student="program", **options)


def in_order(
    *steps: Sequence[Any],
    robot: tuple[str, ...] | None = RESTING,
    namespace: str = "/robot",
    parameters: Mapping[str, Any] | None = None,
    **inputs: Any,
) -> Scenario:
    """Return a scenario of the function `in_order` with these steps; `inputs` are its other arguments."""
    all_inputs = {"steps": list(steps), **inputs}
    return Scenario("in_order", all_inputs, robot, namespace=namespace, parameters=parameters or {})


@dataclass(eq=False)
class Check:
    """One check of an exercise.

    Attributes:
        judge: raises a Failure; takes the transcripts of all scenarios, or, with `obligations`, one of them.
        on: the scenarios that it judges.
        needs: the checks that must pass first.
        see: the lesson for its failures that name no other: CHAPTER#cell, or a URL.
        id: the name of its variable.
        hidden: whether it is defined in hidden.py; set by the loader.
        clauses: the numbers of the statement's clauses that it judges.
        promise: the text of these clauses; set by the loader.
        obligations: given by `check_of`. `judge` is then called for each transcript, so that only the scenarios that
            failed are retried.
    """

    title: str
    points: int
    judge: Judge
    on: tuple[Scenario, ...]
    needs: tuple[Check, ...] = ()
    see: str = ""
    id: str = ""
    hidden: bool = False
    clauses: tuple[int, ...] = ()
    promise: str = ""
    obligations: tuple[Obligation, ...] = ()

    @property
    def can_catch_any_fault(self) -> bool:
        """Whether any fault of a submission can make it fail: it judges obligations in drawn sequences."""
        return bool(self.obligations) and any(scenario.is_drawn for scenario in self.on)

    def run(self, transcripts: Sequence[Transcript]) -> None:
        """Judge the transcripts.

        Raises:
            Failure: the submission is at fault.
            CannotBeJudged: the record is not sufficient for a verdict.
        """
        if not self.obligations:
            self.judge(*transcripts)
            return
        for transcript in transcripts:
            try:
                self.judge(transcript)
            except Failure as failure:
                failure.steps = in_words(transcript, steps_until(transcript, failure.at))
                raise


def check(
    *,
    points: int = 1,
    on: Scenario | Sequence[Scenario],
    needs: Check | Sequence[Check] = (),
    see: str = "",
    clauses: Sequence[int] = (),
) -> Callable[[Judge], Check]:
    """Make a check, worth `points`, of the decorated function, which takes the transcript of each scenario in `on`.

    `needs` are checks that must pass first; otherwise this one is reported as not run. `see` is the lesson for its
    failures, such as "02_services#m9-why". `clauses` are the numbers of the statement's clauses that it judges.
    """

    def make(judge: Judge) -> Check:
        if not judge.__doc__:
            raise ValueError(f"the check {judge.__name__} needs a docstring: it is its title")
        title = judge.__doc__.strip().splitlines()[0].rstrip(".")
        return check_by(
            judge,
            title,
            points=points,
            on=on,
            needs=needs,
            see=see,
            clauses=clauses,
            id=judge.__name__,
        )

    return make


def check_by(
    judge: Judge,
    title: str,
    *,
    points: int = 1,
    on: Scenario | Sequence[Scenario],
    needs: Check | Sequence[Check] = (),
    see: str = "",
    clauses: Sequence[int] = (),
    obligations: Sequence[Obligation] = (),
    id: str = "",
) -> Check:
    """Make a check of a function of transcripts; with `obligations`, the function is called for one after the other.

    Only a check in a list needs an `id`: any other gets the name of its variable.
    """
    return Check(
        title,
        points,
        judge,
        (on,) if isinstance(on, Scenario) else tuple(on),
        (needs,) if isinstance(needs, Check) else tuple(needs),
        see,
        id,
        clauses=tuple(clauses),
        obligations=tuple(obligations),
    )


def checks_in(module: ModuleType, *, excluded: Sequence[Check] = ()) -> list[Check]:
    """Return the checks that a module defines, in order, also those in lists; without the `excluded`, imported ones.

    A check without an id gets the name of its variable.
    """
    found: list[Check] = []
    for name, value in vars(module).items():
        if isinstance(value, Check):
            value.id = value.id or name
        for one in value if isinstance(value, list | tuple) else (value,):
            if isinstance(one, Check) and one not in found and one not in excluded:
                found.append(one)
    return found
