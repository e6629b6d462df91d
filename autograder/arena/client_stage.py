"""What a scenario for a client can do: offer scripted services, actions and topics, and run the student's program.

Nothing is judged here, and all durations are seconds on the arena's clock, as in `stage.py`.
"""

from __future__ import annotations

import time
from collections.abc import Sequence

from autograder.arena import events as ev
from autograder.arena.offering import Offering

# s, on a clock that still runs at scale 1:
APPEARING_TIMEOUT = 20.0  # for the student's node to appear
MODULE_TIMEOUT = 150.0  # for the grader's own modules in the student's sandbox, such as a compilation
MATCHING_TIMEOUT = 3.0  # for the discovery of its clients; some programs create them only before use
CONNECTION_TIME = 0.05  # for the program to discover the servers in turn
# s, on the arena's clock:
END_TIMEOUT = 25.0


class ClientStage(Offering):
    """The scripted services, actions and topics of a scenario, and the student's program."""

    # -- the student's program ----------------------------------------------------------------------------------------

    def has_ended(self) -> bool:
        """Return whether the program has ended."""
        return self._student.has_exited()

    def start_program(self, arguments: Sequence[str] = ()) -> None:
        """Run the student's program, and return when it has found the servers, if there are any.

        The clock is sped up only then, because discovery takes real time.
        """
        started = time.monotonic()
        self._student.start(arguments)
        appeared = self.poll_until(self._has_appeared, APPEARING_TIMEOUT)
        if appeared and not self._student.has_exited():
            self._log.append(ev.NodeReady(waited=time.monotonic() - started))
            self._phases.end("discovery")
        if appeared and self._offers_anything():
            self._wait_for_matching()
        self._graph.inspect()
        self._speed_up()

    def type_line(self, text: str) -> None:
        """Type a line on the program's stdin."""
        self._log.append(ev.NodeTyped(line=text))
        self._student.type_line(text)

    def end_input(self) -> None:
        """End the program's stdin, as Ctrl-D does."""
        self._log.append(ev.NodeTyped(line=None))
        self._student.end_input()

    def interrupt_program(self) -> None:
        """Send SIGINT, as Ctrl-C does."""
        self._log.append(ev.NodeSignalled(signal="SIGINT"))
        self._student.interrupt()

    def run_module(self, module: str, arguments: Sequence[str], files: Sequence[str]) -> None:
        """Run a module of the grader on some of the student's files, in the student's sandbox, and wait for its end.

        Use it only in scenarios in which nothing is timed. A timeout is recorded as for a student's program.
        """
        self._student.start_module(module, arguments, files)
        self._wait_for_end(MODULE_TIMEOUT)

    def wait_for_end(self) -> None:
        """Wait until the program ends by itself; record Unanswered after the timeout."""
        self._wait_for_end(END_TIMEOUT)

    # -- helpers ------------------------------------------------------------------------------------------------------

    def _wait_for_matching(self) -> None:
        """Wait until the program's clients are discovered, then for its own discovery; a request ends both waits."""

        def is_needless() -> bool:
            return self._was_asked() or self._student.has_exited()

        self.poll_until(lambda: is_needless() or self._is_known(), MATCHING_TIMEOUT)
        self.wait_until(is_needless, CONNECTION_TIME)

    def _wait_for_end(self, timeout: float) -> None:
        started = time.monotonic()
        if not self.wait_until(self._student.has_exited, timeout):
            waited = time.monotonic() - started
            self._log.append(ev.Unanswered(what="end", id="program", waited=waited))

    def _has_appeared(self) -> bool:
        """Return whether another node than the grader's exists, or the program has ended."""
        return self._student.has_exited() or self._graph.has_another_node()
