"""One run of a client of a walking action: how and when it may end, and when it has to cancel its goal."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from math import inf
from typing import ClassVar

from action_msgs.msg import GoalStatus

from autograder.authoring.diagnosis.missing import not_shown
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.scripted_goal import ScriptedGoal
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import Failure
from autograder.authoring.requirements.client_checks import SLACK, require_one_goal, why_it_left
from autograder.authoring.walking.client_record import require_record

SUCCEEDED, NO_SERVER, REJECTED, ABORTED, CANCELED = range(5)  # exit statuses
BY_STATUS = {
    GoalStatus.STATUS_SUCCEEDED: (SUCCEEDED, "SUCCEEDED", "the goal SUCCEEDED"),
    GoalStatus.STATUS_ABORTED: (ABORTED, "ABORTED", "the goal was ABORTED"),
    GoalStatus.STATUS_CANCELED: (CANCELED, "CANCELED", "the goal was CANCELED"),
}
SILENCE_LIMIT = 5.0  # s
# s on the arena's clock:
DETECTION_TIME = 2.0  # from the start of the node until the grader has detected it
ORDER_MARGIN = 0.5  # at this distance, a client certainly receives two events in their order
EARLY_SLACK = 0.25  # by which a busy client may detect a silence before SILENCE_LIMIT
EXIT_SLACK = 3.0  # beyond a clause's limit, on a busy machine
EXIT_TIME = 8.0  # for what no clause limits: to print a line, and to end every thread and the node
MIN_WAIT_TIME = 4.0  # of the 5 s that a client waits after Ctrl-C
STATUS_HELP = (
    "Check response.status first: 4 is SUCCEEDED, 5 CANCELED, 6 ABORTED (action_msgs/GoalStatus). "
    "Return the exit status from main() and end the file with sys.exit(main())."
)
_FIND = "wait_for_server(timeout_sec=5.0) returns False when there is none: print a line and return 1."
_AWAIT_AN_ANSWER = (
    "spin_until_future_complete(node, future, timeout_sec=5.0) returns without a result after 5 s: check "
    "future.done()."
)
_CHECK_ACCEPTED = "Check goal_handle.accepted before you request the result: a rejected goal has none."
_LIMIT_SILENCE = (
    "While you wait for the result, check when feedback came last, and return 1 after 5 s without any."
)
_EXPECT_DEATH = "A server that has died answers nothing, not even a cancel request: give each wait a timeout."
_WAIT_NO_LONGER = (
    "Wait for the result at most 5 s after the cancel, then print a line and return 4, whatever the status of the "
    "goal: the user interrupted the program."
)


@dataclass(frozen=True)
class End:
    """A way in which the program may end."""

    status: int  # its exit status
    name: str  # the reason in a word or two
    because: str  # the reason as a clause
    at: float  # s, when the program can know the reason
    earliest: float  # s, of its end
    latest: float
    help: str  # what to do about another exit status


@dataclass(frozen=True)
class Cause:
    """A reason to cancel the goal: if it `is_required`, a request must come from `since` to `latest` (s)."""

    name: str
    because: str
    since: float
    latest: float
    is_required: bool
    once: bool = False


@dataclass(frozen=True)
class ClientRun:
    """One run of a client, with the times (s) that decide what it must do; `inf` if an event never came."""

    run: Transcript
    action: ClassVar[str] = "walk_to"
    pose_field: ClassVar[str] = "target_pose"  # of its goal
    end_in_time: ClassVar[str] = (
        "Give each wait a timeout, also the wait for the answer to a cancel. After Ctrl-C, wait for the result at "
        "most 5 s."
    )

    @cached_property
    def goal(self) -> ScriptedGoal | None:
        """The goal that it sent; None: the action was not offered."""
        offered = any(event.action == self.action for event in self.run.all(ev.ActionOffered))
        return require_one_goal(self.run, self.action) if offered else None

    @cached_property
    def asked(self) -> list[float]:
        """When the user asked it to cancel, with a line q."""
        return [
            event.t
            for event in self.run.all(ev.NodeTyped)
            if any(line.strip() == "q" for line in (event.line or "").splitlines())
        ]

    def when(
        self, kind: type[ev.NodeExited | ev.NodeSignalled | ev.ActionOffered | ev.ActionWithdrawn]
    ) -> float:
        """Return when the first event of a kind came."""
        first = self.run.first(kind)
        return first.t if first else inf

    @property
    def started(self) -> float:
        """When its node appeared."""
        ready = self.run.first(ev.NodeReady)
        if ready is None:
            raise not_shown(self.run, "its node appears")
        return ready.t

    @property
    def accepted(self) -> float:
        """When its goal was accepted."""
        return self.goal.reply.t if self.goal and self.goal.reply and self.goal.is_accepted else inf

    @property
    def interrupted(self) -> float:
        """When Ctrl-C was pressed."""
        return self.when(ev.NodeSignalled)

    @property
    def result(self) -> float:
        """When the result was sent; if the client never requested it, when it would have been sent."""
        goal, after = self.goal, (self.run.params.get("server") or {}).get("result_after", 0.0)
        if goal and goal.result_sent:
            return goal.result_sent.t
        if goal and goal.finished and goal.result_requested is None and after is not None:
            return goal.finished.t + after
        return inf

    @property
    def exited(self) -> float:
        """When it ended."""
        return self.when(ev.NodeExited)

    @property
    def received(self) -> list[float]:
        """The times of the acceptance and of each feedback after it."""
        assert self.goal is not None
        return [self.accepted, *(each.t for each in self.goal.feedback if each.t > self.accepted)]

    def silences(self) -> Iterator[tuple[float, float, bool]]:
        """Yield each silence up to the first certain one: earliest and latest end (s) of its 5 s, and if it is certain.

        The two ends differ because a client may start its 5 s again when the user asks it to cancel.
        """
        for earlier, later in pairwise([*self.received, self.result]):
            anew = max([earlier, *(t for t in self.asked if earlier < t < earlier + SILENCE_LIMIT)])
            if later - earlier > SILENCE_LIMIT - EARLY_SLACK:
                is_certain = later - anew > SILENCE_LIMIT + ORDER_MARGIN
                yield earlier + SILENCE_LIMIT, anew + SILENCE_LIMIT, is_certain
                if is_certain:
                    return

    # -- what it must do ----------------------------------------------------------------------------------------------

    def causes(self) -> list[Cause]:
        """Return the reasons to cancel its goal."""
        if self.accepted == inf:
            return []
        because = f"no feedback came for {SILENCE_LIMIT:g} s"
        return [
            *self.reasons(),
            *(
                self._cause("silence", because, since - ORDER_MARGIN, due, is_certain)
                for since, due, is_certain in self.silences()
            ),
        ]

    def reasons(self) -> Iterable[Cause]:
        """Yield the reasons to cancel its goal, except silence."""
        if self.asked:
            due = max(self.asked[0], self.accepted)
            yield self._cause("q", "you typed q", due, due, once=True)
        if self.interrupted < inf:
            yield self._cause("Ctrl-C", "you pressed Ctrl-C", self.interrupted, self.interrupted)

    def _cause(
        self, name: str, because: str, since: float, due: float, is_certain: bool = True, once: bool = False
    ) -> Cause:
        """Return a cause; it requires no request if the server is gone or another end comes first."""
        others = [end.at for end in self.ends() if end.name != name]
        over = min([self.when(ev.ActionWithdrawn), *others])
        is_required = is_certain and over > due + SLACK and since <= self.exited
        return Cause(name, because, since, due + SLACK, is_required, once)

    def ends(self) -> list[End]:
        """Return how it may end: in several ways only if two events are too close to have a certain order."""
        if self.goal is None:
            return self._without_a_goal()
        if self.goal.reply is None:
            due, because = self.goal.received.t + SILENCE_LIMIT, "the goal was never answered"
            latest = due + EXIT_SLACK
            return [End(NO_SERVER, "no answer", because, due, due - ORDER_MARGIN, latest, _AWAIT_AN_ANSWER)]
        if not self.goal.is_accepted:
            t, because = self.goal.reply.t, "the goal was rejected"
            return [End(REJECTED, "rejected", because, t, t, t + EXIT_TIME, _CHECK_ACCEPTED)]
        found = [(end, is_certain) for end, is_certain in self._after_the_acceptance() if end.at < inf]
        found.sort(key=lambda each: each[0].at)
        last = next((end.at for end, is_certain in found if is_certain), inf) + ORDER_MARGIN
        return [end for end, _ in found if end.at <= last]

    def _without_a_goal(self) -> list[End]:
        due, because = self.started + SILENCE_LIMIT, f"no server offers {self.action}"
        return [End(NO_SERVER, "no server", because, due, due - DETECTION_TIME, due + SLACK + 3.0, _FIND)]

    def _after_the_acceptance(self) -> Iterator[tuple[End, bool]]:
        """Yield each end that is possible after the acceptance, and whether it is certain if no other comes first."""
        assert self.goal is not None
        result, pressed, silent = self.result, self.interrupted, inf
        if self.goal.finished and result < inf:
            yield by_status(self.goal.finished.status, result), True
        for end, is_certain in self._in_silence():
            silent = min(silent, end.at)
            yield end, is_certain
        earliest = max(pressed, min(result, pressed + MIN_WAIT_TIME, silent - ORDER_MARGIN))
        latest = pressed + SILENCE_LIMIT + SLACK
        yield End(CANCELED, "Ctrl-C", "Ctrl-C was pressed", pressed, earliest, latest, _WAIT_NO_LONGER), True

    def _in_silence(self) -> Iterator[tuple[End, bool]]:
        for since, latest, is_certain in self.silences():
            is_dead = self.when(ev.ActionWithdrawn) < since
            because, help = (
                ("the server has died", _EXPECT_DEATH)
                if is_dead
                else ("the server is silent", _LIMIT_SILENCE)
            )
            latest += SILENCE_LIMIT + EXIT_SLACK
            yield End(NO_SERVER, "silence", because, since, since - ORDER_MARGIN, latest, help), is_certain

    def left_early(self, end: End, exited: ev.NodeExited) -> Failure:
        """Return the failure of a program that ended before this end was allowed."""
        if self.accepted < inf:
            assert self.goal is not None
            return Failure(
                expected="a client that follows the goal to its end",
                observed=f"it ended with status {exited.returncode} at {exited.t:.1f} s, while the goal was under way",
                help=why_it_left(self.goal, exited),
                at=exited.t,
            )
        since = self.goal.received.t if self.goal else self.started
        return Failure(
            expected=f"{SILENCE_LIMIT:g} s of waiting: {end.because}",
            observed=f"it gave up after {exited.t - since:.1f} s",
            help=end.help,
            at=exited.t,
        )


def by_status(status: int, t: float) -> End:
    """Return the end of a program that got its goal's result, with this status, at a time (s)."""
    return End(*BY_STATUS[status], t, t, t + EXIT_TIME, STATUS_HELP)


def clients(run: Transcript) -> list[ClientRun]:
    """Return the one run of the client; raise if the record lacks what server and user did in the scenario."""
    require_record(run, ClientRun.action)
    return [ClientRun(run)]
