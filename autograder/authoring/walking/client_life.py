"""What a client of `walk_to` owes, by what happened to it: how it may end, when, and what it has to cancel."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from math import inf

from action_msgs.msg import GoalStatus

from autograder.authoring import events as ev
from autograder.authoring.action_client_checks import require_one_goal
from autograder.authoring.client_checks import SLACK
from autograder.authoring.missing import unseen
from autograder.authoring.scripted_goal import ScriptedGoal
from autograder.authoring.transcript import Transcript
from autograder.authoring.walking.client import (
    ABORTED,
    CANCELED,
    FINDING,
    NO_SERVER,
    PATIENCE,
    REJECTED,
    STATUS_HELP,
    SUCCEEDED,
    WALK,
)
from autograder.authoring.walking.client_record import require_record

EXIT_STATUS = {
    GoalStatus.STATUS_SUCCEEDED: SUCCEEDED,
    GoalStatus.STATUS_ABORTED: ABORTED,
    GoalStatus.STATUS_CANCELED: CANCELED,
}
NAMES = {SUCCEEDED: "SUCCEEDED", ABORTED: "ABORTED", CANCELED: "CANCELED"}
# s on the arena's clock:
MARGIN = 0.5  # between two moments that a client surely sees in their order
NEARLY = 0.25  # less than PATIENCE, in which a busy client may already think that it is over
LEAVING = 8.0  # for what no clause limits: to print a line, and to end every thread and the node
SURELY_WAITED = 4.0  # of the 5 after Ctrl-C
_FIND = "wait_for_server(timeout_sec=5.0) returns False when there is none: print a line and return 1."
_AWAIT_AN_ANSWER = (
    "spin_until_future_complete(node, future, timeout_sec=5.0) returns with no result: look at future.done()."
)
_LOOK_AT_ACCEPTED = "Look at goal_handle.accepted before you ask for the result: a rejected goal has none."
_LISTEN = (
    "Give the waiting for the result a limit on silence, and return 1 when it is over.",
    "A server that has died answers nothing, no cancel either: give each wait a time limit.",
)
_WAIT_NO_LONGER = (
    "Wait for the result at most 5 s after the cancel, then print a line and return 4, whatever the status of the "
    "goal: you interrupted the program."
)


@dataclass(frozen=True)
class End:
    """A way in which the program may end.

    Attributes:
        status: its exit status.
        name, because: the reason, in a word or two and as a clause.
        at: when the program can know the reason (s).
        earliest, latest: of its end (s).
        help: what to do about another exit status.
    """

    status: int
    name: str
    because: str
    at: float
    earliest: float
    latest: float
    help: str = field(repr=False)


@dataclass(frozen=True)
class Cause:
    """A reason to cancel the goal: from `since` to `latest` (s) a request has to come, if it `is_owed`."""

    name: str
    because: str
    since: float
    latest: float
    is_owed: bool
    once: bool = False


@dataclass(frozen=True)
class ClientLife:
    """One run of a client, with the moments (s) that decide what it owes; a moment that never came is `inf`.

    Attributes:
        run: its record.
        goal: that it sent; None: nobody offered the action.
        asked: when somebody asked it to cancel, by a line q.
    """

    run: Transcript
    goal: ScriptedGoal | None
    asked: Sequence[float]

    @property
    def started(self) -> float:
        """When its node appeared."""
        ready = self.run.first(ev.NodeReady)
        if ready is None:
            raise unseen(self.run, "the program's node never appeared")
        return ready.t

    @property
    def accepted(self) -> float:
        """When its goal was accepted."""
        return self.goal.reply.t if self.goal and self.goal.reply and self.goal.is_accepted else inf

    @property
    def interrupted(self) -> float:
        """When Ctrl-C was pressed."""
        signalled = self.run.first(ev.NodeSignalled)
        return signalled.t if signalled else inf

    @property
    def result(self) -> float:
        """When the result was sent, or would have been sent if the client, which never did, had asked for it."""
        goal, after = self.goal, (self.run.params.get("server") or {}).get("result_after", 0.0)
        if goal and goal.result_sent:
            return goal.result_sent.t
        if goal and goal.finished and goal.result_requested is None and after is not None:
            return goal.finished.t + after
        return inf

    @property
    def died(self) -> float:
        """When its server was gone."""
        withdrawn = self.run.first(ev.ActionWithdrawn)
        return withdrawn.t if withdrawn else inf

    @property
    def exited(self) -> float:
        """When it ended."""
        exited = self.run.first(ev.NodeExited)
        return exited.t if exited else inf

    @property
    def heard(self) -> list[float]:
        """When it was accepted, and each feedback after that."""
        assert self.goal is not None
        return [self.accepted, *(each.t for each in self.goal.feedback if each.t > self.accepted)]

    def silences(self) -> Iterator[tuple[float, float, bool]]:
        """Yield the silences up to the first certain one: when each is 5 s long (s), the latest, and if it is certain.

        A client may begin to count anew when it is asked to cancel.
        """
        for earlier, later in pairwise([*self.heard, self.result]):
            anew = max([earlier, *(t for t in self.asked if earlier < t < earlier + PATIENCE)])
            if later - earlier > PATIENCE - NEARLY:
                is_certain = later - anew > PATIENCE + MARGIN
                yield earlier + PATIENCE, anew + PATIENCE, is_certain
                if is_certain:
                    return

    # -- what it owes -------------------------------------------------------------------------------------------------

    def ends(self) -> list[End]:
        """Return how it may end: more than one way only where two moments are too close to have an order."""
        if self.goal is None:
            return [self._without_a_server()]
        if self.goal.reply is None:
            return [self._without_an_answer(self.goal)]
        if not self.goal.is_accepted:
            return [self._after_a_rejection(self.goal.reply.t)]
        found = [(end, is_certain) for end, is_certain in self._after_the_acceptance() if end.at < inf]
        found.sort(key=lambda each: each[0].at)
        last = next((end.at for end, is_certain in found if is_certain), inf) + MARGIN
        return [end for end, _ in found if end.at <= last]

    def causes(self) -> list[Cause]:
        """Return what asks it to cancel its goal."""
        if self.accepted == inf:
            return []
        found: list[Cause] = []
        if self.asked:
            due = max(self.asked[0], self.accepted)
            found.append(self._cause("q", "you typed q", due, due, once=True))
        if self.interrupted < inf:
            due = self.interrupted
            found.append(self._cause("Ctrl-C", "you pressed Ctrl-C", due, due))
        for since, latest, is_certain in self.silences():
            because = f"nothing was heard of it for {PATIENCE:g} s"
            found.append(self._cause("silence", because, since - MARGIN, latest, is_certain))
        return found

    def _cause(
        self, name: str, because: str, since: float, due: float, is_certain: bool = True, once: bool = False
    ) -> Cause:
        """Return a cause; nothing is owed to a server that is gone, nor where another end comes first."""
        over = min([self.died, *(end.at for end in self.ends() if end.name != name)])
        return Cause(name, because, since, due + SLACK, is_certain and over > due + SLACK, once)

    def _without_a_server(self) -> End:
        due, because = self.started + PATIENCE, f"nobody offers {WALK}"
        return End(NO_SERVER, "no server", because, due, due - FINDING, due + SLACK + 3.0, _FIND)

    def _without_an_answer(self, goal: ScriptedGoal) -> End:
        due, because = goal.received.t + PATIENCE, "the goal was never answered"
        return End(NO_SERVER, "no answer", because, due, due - MARGIN, due + SLACK, _AWAIT_AN_ANSWER)

    def _after_a_rejection(self, t: float) -> End:
        return End(REJECTED, "rejected", "the goal was rejected", t, t, t + LEAVING, _LOOK_AT_ACCEPTED)

    def _after_the_acceptance(self) -> Iterator[tuple[End, bool]]:
        """Yield each end of an accepted goal's client, if nothing else came first, and whether it is certain."""
        assert self.goal is not None
        result, pressed, silent = self.result, self.interrupted, inf
        if self.goal.finished and result < inf:
            status = EXIT_STATUS[self.goal.finished.status]
            because = f"the goal {'' if status == SUCCEEDED else 'was '}{NAMES[status]}"
            yield End(status, NAMES[status], because, result, result, result + LEAVING, STATUS_HELP), True
        for since, latest, is_certain in self.silences():
            silent = min(silent, since)
            gone = self.died < since
            because, help = f"the server {'has died' if gone else 'is silent'}", _LISTEN[gone]
            latest += PATIENCE + SLACK + 1.0
            yield End(NO_SERVER, "silence", because, since, since - MARGIN, latest, help), is_certain
        earliest = max(pressed, min(result, pressed + SURELY_WAITED, silent - MARGIN))
        latest = pressed + PATIENCE + SLACK
        yield End(CANCELED, "Ctrl-C", "Ctrl-C was pressed", pressed, earliest, latest, _WAIT_NO_LONGER), True


def life_of(run: Transcript) -> ClientLife:
    """Return the life of the client, whose server and person did what the scenario says."""
    require_record(run, WALK)
    offered = any(event.action == WALK for event in run.all(ev.ActionOffered))
    goal = require_one_goal(run, WALK) if offered else None
    asked = [
        event.t
        for event in run.all(ev.NodeTyped)
        if any(line.strip() == "q" for line in (event.line or "").splitlines())
    ]
    return ClientLife(run, goal, asked)
