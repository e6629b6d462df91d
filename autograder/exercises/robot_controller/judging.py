"""How a run of the robot controller is judged."""

from __future__ import annotations

from collections.abc import Sequence

from autograder.checks import expect
from autograder.exercises.client_checks import require_end, require_success
from autograder.readiness import last_line
from autograder.transcript import Transcript

WITHIN = 10.0  # s for everything
NO_SERVER = (1,)
PREFIX = "Robot status: "


def require_enabled_before_asked(run: Transcript) -> None:
    """The motors were enabled, and get_status was asked after the answer."""
    requests = run.requests("enable_motors")
    if not requests:
        require_end(run, WITHIN)
    expect(
        bool(requests),
        expected="a request to enable_motors",
        observed=f"none; the last line on stderr: {last_line(run.output('stderr')) or 'none'}",
        help="Create the client with the relative name 'enable_motors' and type std_srvs/srv/SetBool, wait until the "
        "service is there, and send the request.",
        at=run.end,
    )
    first = requests[0]
    expect(
        first.received.fields["data"] is True,
        expected="data: true, which switches the motors on",
        observed="data: false",
        help="A new request holds false: set request.data = True before you send it.",
        at=first.received.t,
    )
    asked = run.requests("get_status")
    expect(
        bool(asked),
        expected="a request to get_status after enable_motors was answered",
        observed="none",
        help="The answer arrived, but nobody took it: whoever waits for a future must let the node spin, and a "
        "callback that waits keeps its own node from spinning.",
        at=run.end,
    )
    assert first.reply is not None
    expect(
        asked[0].received.t >= first.reply.t,
        expected="get_status to be asked after enable_motors was answered",
        observed=f"{first.reply.t - asked[0].received.t:.3f} s before",
        help="call_async returns at once: wait for the first future before you send the second request, or the "
        "status is that of a robot whose motors are still off.",
        at=asked[0].received.t,
    )


def require_printed_status(run: Transcript, messages: Sequence[str]) -> None:
    """The program succeeded and printed one status, with one of the messages."""
    require_success(run, WITHIN)
    printed = [
        line.rstrip() for line in run.output("stdout").splitlines() if line.startswith(PREFIX.rstrip())
    ]
    expect(
        len(printed) == 1,
        expected=f"one line on stdout that begins with “{PREFIX.rstrip()}”",
        observed=f"{len(printed)} of them" + (": " + " | ".join(printed[:3]) if printed else ""),
        help="print(f'Robot status: {response.message}') once, when the answer you waited for has come. A logger "
        "writes to stderr; a callback left on a request you gave up on prints as well, so remove that request.",
        at=run.end,
    )
    expect(
        printed[0] in [PREFIX + message for message in messages],
        expected=" or ".join(f"“{PREFIX}{message}”" for message in messages),
        observed=f"“{printed[0]}”",
        help="Print the message of the response to get_status, as it came.",
        at=run.end,
    )
