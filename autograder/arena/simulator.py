"""The simulator as a process of the arena: commands go in and ground truth comes out by pipes, never by topic."""

from __future__ import annotations

import json
import multiprocessing
import os
import threading
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

from autograder.arena import events as ev
from autograder.arena.arena_log import ArenaLog
from autograder.arena.robots import Robots

TIMEOUT = 30.0  # s on a clock that still runs at scale 1


class Simulator:
    """Forks the simulator and appends its reports to the log.

    Make it while this process has only one thread, then call `listen`.
    """

    def __init__(
        self, log: ArenaLog, robots: Robots, namespace: str, options: Sequence[str], *, postures: bool = False
    ) -> None:
        truth_read, truth_write = os.pipe()
        control_read, self._control = os.pipe()
        self._log = log
        more = (
            "--namespace",
            namespace,
            "--ground-truth-fd",
            str(truth_write),
            "--control-fd",
            str(control_read),
            *(("--postures",) if postures else ()),
        )
        self.process = multiprocessing.get_context("fork").Process(
            target=_simulate, args=(robots, options, more)
        )
        self.process.start()
        os.close(truth_write)
        os.close(control_read)
        self._thread = threading.Thread(target=self._read_ground_truth, args=(truth_read,), daemon=True)

    def listen(self) -> None:
        """Begin to read the ground truth."""
        self._thread.start()

    def wait_until_up(self) -> None:
        """Wait until the robot has published its latched topics and the first ground truth.

        Raises:
            RuntimeError: the simulator ended, or did not start in time.
        """
        self._log.wait_until(lambda: self._is_up() or not self.is_running(), TIMEOUT)
        if not self._is_up():
            raise RuntimeError(f"the simulator was not up within {TIMEOUT:g} s")

    def _is_up(self) -> bool:
        return self._log.last(ev.RobotTruth) is not None

    def command(self, command: Mapping[str, Any]) -> None:
        """Send one command of `robot_sim.ros.scenario_control`."""
        self._log.append(ev.CommandSent(command=dict(command)))
        os.write(self._control, json.dumps(command).encode() + b"\n")

    def is_running(self) -> bool:
        """Return whether the process is alive."""
        return self.process.is_alive()

    def stop(self) -> None:
        """End the process and read the ground truth to its end."""
        self.process.kill()  # written events stay in the pipe
        self.process.join()
        self._thread.join(5)

    def _read_ground_truth(self, fd: int) -> None:
        with os.fdopen(fd, "rb") as lines:
            for line in lines:
                if not line.endswith(b"\n"):
                    return  # a partial line: the process was killed while writing
                fields = json.loads(line)
                event = ev.KINDS[fields.pop("kind")](**fields)
                self._log.append_written(event, line)


def _simulate(robots: Robots, options: Sequence[str], more: Sequence[str]) -> None:
    with suppress(OSError):
        Path("/proc/self/comm").write_text("robot_sim")  # the name shown by ps and top
    try:
        robots.serve(options, *more)
    finally:
        os._exit(1)  # only reached when serving failed
