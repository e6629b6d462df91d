"""Finds in the record why a client failed, and gives advice."""

from __future__ import annotations

from autograder.authoring import Transcript, ev, shown_fields, why_it_went_no_further, why_not_this_status

from .truth import ENABLE, STATUS

MIN_WAIT = 1.5  # s for a response before the retry, or for a server to appear; the task says 2 s
TRACEBACK = "Traceback (most recent call last)"
Advice = tuple[str, str]  # what the record shows, and the advice


def why_it_failed(run: Transcript, exited: ev.NodeExited) -> Advice:
    """Return why a program exited with a status other than 0 although its servers were there."""
    is_asked = bool(run.requests(STATUS))
    early = _gave_up_early(run, STATUS if is_asked else ENABLE, exited)
    went_no_further = not run.requests(ENABLE) or not (is_asked or early)
    if went_no_further or TRACEBACK in run.output("stderr"):
        cause = why_it_went_no_further(run)
        assert cause is not None  # it has ended
        return cause.words, cause.help
    if answer := _odd_answer(run, gave_up_at(run, exited)):
        return (
            f"Exit status {exited.returncode}, although get_status responded with {answer}.",
            "Every response of get_status counts, also with an empty message or success false: print it, and return 0. "
            "Only success false of enable_motors is a failure.",
        )
    return early or (
        f"Exit status {exited.returncode}, although both services responded.",
        "Return 0 from main() when both responses have come, and end the file with sys.exit(main()).",
    )


def why_not_one(run: Transcript, exited: ev.NodeExited) -> Advice:
    """Return why a program that had to exit with status 1 exited with another one."""
    refused = any(each.reply and not each.reply.response.success for each in run.requests(ENABLE))
    if exited.returncode == 0 and refused and run.requests(STATUS):
        return (
            "Your client called get_status although enable_motors responded with success false.",
            "If response.success of enable_motors is false, print the reason and return 1.",
        )
    help = (
        "Return 1 from main() if a service is missing, does not respond, or enable_motors responds with success false "
        "(2 to 4 are for action goals), and end the file with sys.exit(main())."
    )
    return why_not_this_status(run, exited, help)


def _odd_answer(run: Transcript, by: float) -> str:
    """Return, in words, a response of get_status up to a time (s) with an empty message or success false; else ""."""
    replies = [each.reply for each in run.requests(STATUS) if each.reply and each.reply.t <= by]
    odd = [reply.response for reply in replies if not (reply.response.success and reply.response.message)]
    return shown_fields(odd[-1], "success", "message") if odd else ""


def _gave_up_early(run: Transcript, service: str, exited: ev.NodeExited) -> Advice | None:
    """Return why the program did not wait for a service's response or did not use it; None if it did."""
    requests, gave_up = run.requests(service), gave_up_at(run, exited)
    if not requests:
        return None
    last = requests[-1]
    if last.reply is None or last.reply.t > gave_up:
        return (
            f"It gave up {gave_up - last.received.t:.1f} s after request {len(requests)} to {service}, before the "
            "response came.",
            "A response may take up to 2 s: wait with timeout_sec=2.0 after each request.",
        )
    if len(requests) > 1:
        return (
            f"Exit status {exited.returncode}, although request {len(requests)} to {service} got a response.",
            "Also use the response to the second request: check future.done() after each request.",
        )
    return None


def gave_up_at(run: Transcript, exited: ev.NodeExited) -> float:
    """Return when (s) it printed its last line on stderr, as exiting takes longer; without one, when it exited."""
    return max((line.t for line in run.all(ev.NodeOutput) if line.stream == "stderr"), default=exited.t)


def how_to_print_one(run: Transcript, lines: int, prefix: str) -> str:
    """Return advice on a status that is missing on stdout, or printed more than once."""
    if lines > 1 and lines <= sum(request.reply is not None for request in run.requests(STATUS)):
        return "The callback of a request that timed out also prints: call remove_pending_request for it."
    if lines:
        return "Print only once, when get_status has responded."
    if prefix in run.output("stderr"):
        return "The line is on stderr, where loggers write: use print(f'Robot status: {response.message}')."
    return "Add print(f'Robot status: {response.message}') after the response of get_status."
