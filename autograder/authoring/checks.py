'''What the author of a check writes: a function over transcripts, with its title as docstring.

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
from autograder.authoring.sequence import steps_until

if TYPE_CHECKING:
    from autograder.authoring.obligation import Obligation

MAY_REST = "--may-rest"  # option of a robot that is not integrated while it only stands
RESTING = (MAY_REST,)  # the robot of a scenario that asks nothing of its body

Judge = Callable[..., None]
Inputs = Mapping[str, Any] | Callable[[random.Random], Mapping[str, Any]]


@dataclass(frozen=True, eq=False)
class Scenario:
    """A stimulus by name, with its inputs: fixed, or drawn from a seeded generator when the submission is graded.

    Each Scenario object is run once for a submission, however many checks judge it.

    Attributes:
        name: of the function in the exercise's scenarios.py.
        inputs: its arguments, or a function that draws them from a generator.
        robot: options of the simulator; None: the scenario needs no robot.
        student: a 'node' is started before the scenario and stays; a 'program' is started by it and ends by itself.
        namespace: ROS namespace of robot and student.
        parameters: ROS parameters that the student's program is started with.
        timed: whether deadlines are judged. If not (compiling, a quiz), the clock is not sped up, and a run counts
            however busy the machine is.
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
        """Whether it costs the machine next to nothing: no robot, or one that rests."""
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
    """Return the scenario `in_order` with these steps; `inputs` are its other arguments."""
    all_inputs = {"steps": list(steps), **inputs}
    return Scenario("in_order", all_inputs, robot, namespace=namespace, parameters=parameters or {})


@dataclass(eq=False)
class Check:
    """One check: `id` is the name of its variable, `on` are the scenarios it judges, `needs` the checks before it.

    `see` is the lesson that its failures point to, unless one names another: CHAPTER#cell, or an address.
    `hidden` is set when it is loaded: a check is hidden because it stands in hidden.py.
    `clauses` are the numbers of the statement's clauses that it judges; `promise` is set when it is loaded: these
    clauses in words.
    `obligations` are what it is made of, if it was made by `check_of`: then `judge` takes one transcript and is applied
    to each, so that only a scenario that failed is retried.
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
    def meets_any_fault(self) -> bool:
        """Whether any fault of a submission may show in it: it judges obligations in sequences that are drawn."""
        return bool(self.obligations) and any(scenario.is_drawn for scenario in self.on)

    def run(self, transcripts: Sequence[Transcript]) -> None:
        """Judge the transcripts.

        Raises:
            Failure: the submission is at fault.
            CannotBeJudged: the record does not let anybody judge it.
        """
        if not self.obligations:
            self.judge(*transcripts)
            return
        for transcript in transcripts:
            try:
                self.judge(transcript)
            except Failure as failure:
                failure.steps = steps_until(transcript, failure.at)
                raise


def check(
    *,
    points: int = 1,
    on: Scenario | Sequence[Scenario],
    needs: Check | Sequence[Check] = (),
    see: str = "",
    clauses: Sequence[int] = (),
) -> Callable[[Judge], Check]:
    """Make a check of a function that is judged on the transcript of each scenario in `on`; it is worth `points`.

    `needs` are checks that must have passed; otherwise this one is reported as not run. `see` is the lesson that its
    failures point to, such as "02_services#m9-why". `clauses` are those of the statement that it judges.
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
    """Make a check of a function over transcripts; if it judges `obligations`, it takes one, and gets each.

    Only a check that stands in a list needs an `id`: any other gets its variable's name.
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


def checks_in(module: ModuleType, *, but: Sequence[Check] = ()) -> list[Check]:
    """Return the checks that a module defines, in its order, also those in its lists; `but` are others' it imports.

    Each variable gives its check its name.
    """
    found: list[Check] = []
    for name, value in vars(module).items():
        if isinstance(value, Check):
            value.id = value.id or name
        for one in value if isinstance(value, list | tuple) else (value,):
            if isinstance(one, Check) and one not in found and one not in but:
                found.append(one)
    return found
