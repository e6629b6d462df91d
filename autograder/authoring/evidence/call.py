"""A service call as its client saw it, and a request as a scripted service saw it."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from autograder.authoring.diagnosis.blocked_callback import remedy_for_no_answer
from autograder.authoring.diagnosis.readiness import require_alive
from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.fields import expect_field
from autograder.authoring.failure import Failure, expect

if TYPE_CHECKING:
    from autograder.authoring.evidence.transcript import Transcript


@dataclass(frozen=True)
class Call:
    """One service call. If there is no answer, requirements on it fail with the reason."""

    name: str
    sent: ev.ServiceCalled
    answer: ev.ServiceAnswered | None  # None: never, or too late
    run: Transcript = field(repr=False)

    @property
    def service(self) -> str:
        """The name of the service, as the scenario wrote it."""
        return self.sent.service

    @property
    def request(self) -> Any:
        """The request, a ROS message."""
        return self.sent.request

    @property
    def response(self) -> Any:
        """The response, a ROS message."""
        return self.answered.response

    @property
    def answered(self) -> ev.ServiceAnswered:
        """Its answer, which must have come while the scenario waited for it."""
        return self.answered_within()

    def answered_within(self, limit: float | None = None) -> ev.ServiceAnswered:
        """Return its answer, however late; the failure without one names the limit (s) that the statement sets."""
        if self.answer is not None:
            return self.answer
        require_alive(self.run)
        given_up = self.run.given_up("call", self.name)
        remedy = remedy_for_no_answer(self.run)
        waited = given_up.waited if given_up else self.run.end - self.sent.t
        raise Failure(
            expected=f"an answer to {self.service}" + (f" within {limit:g} s" if limit else ""),
            observed=f"none after {waited:.0f} s of waiting{self._nor_to_others()}",
            help=remedy.help,
            at=self.sent.t,
            see=remedy.see,
        )

    def _nor_to_others(self) -> str:
        """Return a note if none of several requests was answered, else ''."""
        asked, answered = self.run.all(ev.ServiceCalled), self.run.first(ev.ServiceAnswered)
        return (
            f"; none of all {len(asked)} requests was answered" if len(asked) > 1 and answered is None else ""
        )

    @property
    def latency(self) -> float:
        """Seconds to the answer; infinite without one."""
        return self.answer.t - self.sent.t if self.answer else math.inf

    def expect(self, path: str, value: Any, *, because: str, help: str, see: str = "") -> None:
        """Require that a field of the response has a value, `because` of a state of the robot or of the request."""
        expect_field(self.response, path, value, because=because, help=help, at=self.answered.t, see=see)

    def require(self, condition: bool, *, expected: str, observed: str, help: str, see: str = "") -> None:
        """Require that a condition on its answer holds; a failure has the time of the answer."""
        expect(condition, expected=expected, observed=observed, help=help, at=self.answered.t, see=see)


@dataclass(frozen=True)
class Request:
    """One request of the student's client to a scripted service, and the reply (None: there was none)."""

    received: ev.RequestReceived
    reply: ev.ReplySent | None

    @property
    def message(self) -> Any:
        """The request, a ROS message."""
        return self.received.message
