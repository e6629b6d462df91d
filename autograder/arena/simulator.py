"""The simulator as a process of the arena: commands go in and truth comes out by pipes, never by topic."""

from __future__ import annotations

import json
import multiprocessing
import os
import threading
from collections import Counter
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

from autograder.arena.recorder import Recorder
from autograder.arena.robots import Robots


class Simulator:
    """Forks the simulator, passes its truth on to the recorder and keeps the latest to wait on.

    Make it while this process has one thread, and call :meth:`listen` then.
    """

    def __init__(
        self,
        recorder: Recorder,
        changed: threading.Condition,
        robots: Robots,
        namespace: str,
        options: Sequence[str],
    ) -> None:
        truth_read, truth_write = os.pipe()
        control_read, self._control = os.pipe()
        self._recorder = recorder
        self._changed = changed
        self.robot: dict[str, Any] | None = None
        self.subscribers: dict[str, int] = {}
        self.publishers: dict[str, int] = {}
        self.reports: Counter[str] = Counter()
        self._commands_left = 0
        more = ("--namespace", namespace, "--truth-fd", str(truth_write), "--control-fd", str(control_read))
        self.process = multiprocessing.get_context("fork").Process(
            target=_simulate, args=(robots, options, more)
        )
        self.process.start()
        os.close(truth_write)
        os.close(control_read)
        self._thread = threading.Thread(target=self._read_truth, args=(truth_read,), daemon=True)

    def listen(self) -> None:
        """Begin to take in the truth."""
        self._thread.start()

    def command(self, do: str, **arguments: Any) -> None:
        """Send one command of :mod:`robot_sim.ros.scenario_control`."""
        command = {"do": do, **arguments}
        self._recorder.record("command_sent", command=command)
        with self._changed:
            self._commands_left += 1
        os.write(self._control, json.dumps(command).encode() + b"\n")

    def has_obeyed(self) -> bool:
        """Whether every command has taken effect, and what it asked for has been reported."""
        return self._commands_left == 0

    def is_running(self) -> bool:
        """Whether the process is alive."""
        return self.process.is_alive()

    def stop(self) -> None:
        """End the process and read the truth to its end."""
        self.process.kill()  # what it has written stays in the pipe
        self.process.join()
        self._thread.join(5)

    def _read_truth(self, fd: int) -> None:
        with os.fdopen(fd, "rb") as lines:
            for line in lines:
                if not line.endswith(b"\n"):
                    return  # it was ended while it wrote
                self._recorder.forward(line)
                record = json.loads(line)
                with self._changed:
                    self.reports[record["kind"]] += 1
                    if record["kind"] == "robot":
                        self.robot = record
                    elif record["kind"] == "command":
                        self._commands_left -= 1
                    elif record["kind"] == "peers":
                        self.subscribers, self.publishers = record["subscribers"], record["publishers"]
                    self._changed.notify_all()


def _simulate(robots: Robots, options: Sequence[str], more: Sequence[str]) -> None:
    with suppress(OSError):
        Path("/proc/self/comm").write_text("robot_sim")  # what people look for in a list of processes
    try:
        robots.serve(options, *more)
    finally:
        os._exit(1)  # nobody ends it in this way
