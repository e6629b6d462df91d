"""Reads from the record why a client failed, and chooses one thing to do about it."""

from __future__ import annotations

from autograder.authoring import Transcript, ev, shown_fields, why_it_went_no_further, why_not_this_status

from .truth import ENABLE, STATUS

SOONEST = 1.5  # s between a request and its repetition, or for a search; 2 s are asked for
TRACEBACK = "Traceback (most recent call last)"
Advice = tuple[str, str]  # what the record knows of a fault, and what to do


def why_it_failed(run: Transcript, exited: ev.NodeExited) -> Advice:
    """Say of a program whose servers were there why its exit status is not 0."""
    is_asked = bool(run.requests(STATUS))
    early = _gave_up_early(run, STATUS if is_asked else ENABLE, exited)
    went_no_further = not run.requests(ENABLE) or not (is_asked or early)
    if went_no_further or TRACEBACK in run.output("stderr"):
        cause = why_it_went_no_further(run)
        assert cause is not None  # it has ended
        return cause.words, cause.help
    if answer := _odd_answer(run, gave_up_at(run, exited)):
        return (
            f"Status {exited.returncode}, although get_status has answered {answer}.",
            "An answer is an answer, also where its message is empty or its success false: print it, and return 0. "
            "Only enable_motors can refuse.",
        )
    return early or (
        f"Status {exited.returncode}, although both services have answered.",
        "Return 0 from main() when the answers have come, and end the file with sys.exit(main()).",
    )


def why_not_one(run: Transcript, exited: ev.NodeExited) -> Advice:
    """Say of a program that had to give up with exit status 1 why it ended with another one."""
    refused = any(each.reply and not each.reply.response.success for each in run.requests(ENABLE))
    if exited.returncode == 0 and refused and run.requests(STATUS):
        return (
            "You asked get_status although enable_motors answered success: false.",
            "Look at response.success and return 1.",
        )
    help = (
        "Return 1 from main() where a service is missing, refuses or is silent (2 to 4 are for goals of actions), and "
        "end the file with sys.exit(main())."
    )
    return why_not_this_status(run, exited, help)


def _odd_answer(run: Transcript, by: float) -> str:
    """Return an answer of get_status (by a time, s) that is empty or not a success, in words; "" if none is."""
    replies = [each.reply for each in run.requests(STATUS) if each.reply and each.reply.t <= by]
    odd = [reply.response for reply in replies if not (reply.response.success and reply.response.message)]
    return shown_fields(odd[-1], "success", "message") if odd else ""


def _gave_up_early(run: Transcript, service: str, exited: ev.NodeExited) -> Advice | None:
    """Say why the answer of a service was not waited for or not used; None if nothing speaks for that."""
    requests, gave_up = run.requests(service), gave_up_at(run, exited)
    if not requests:
        return None
    last = requests[-1]
    if last.reply is None or last.reply.t > gave_up:
        return (
            f"It gave up {gave_up - last.received.t:.1f} s after request {len(requests)} to {service}, before the "
            "answer came.",
            "An answer may take 2 s, each time: wait with timeout_sec=2.0.",
        )
    if len(requests) > 1:
        return (
            f"Status {exited.returncode}, although request {len(requests)} to {service} was answered.",
            "An answer to the second request counts like one to the first: look at future.done() after each.",
        )
    return None


def gave_up_at(run: Transcript, exited: ev.NodeExited) -> float:
    """Return when it said so on stderr; ending takes a while longer."""
    return max((line.t for line in run.all(ev.NodeOutput) if line.stream == "stderr"), default=exited.t)


def how_to_print_one(run: Transcript, lines: int, prefix: str) -> str:
    """Say how the status gets on stdout, once."""
    if lines > 1 and lines <= sum(request.reply is not None for request in run.requests(STATUS)):
        return "A callback left on a request you gave up on prints as well: remove that request."
    if lines:
        return "Print once: when get_status has answered, and nothing before."
    if prefix in run.output("stderr"):
        return "It stands on stderr, where a logger writes: use print(f'Robot status: {response.message}')."
    return "print(f'Robot status: {response.message}') when get_status has answered."
