"""The simulator as a process of the arena: commands go in and truth comes out by pipes, never by topic."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import threading
from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

from autograder.arena.recorder import Recorder


class Simulator:
    """Starts `python -m robot_sim`, passes its truth on to the recorder and keeps the latest to wait on."""

    def __init__(
        self,
        recorder: Recorder,
        changed: threading.Condition,
        namespace: str,
        options: Sequence[str],
        env: Mapping[str, str],
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
        self.process = subprocess.Popen(
            [
                *(sys.executable, "-m", "robot_sim", "--namespace", namespace),
                *("--truth-fd", str(truth_write), "--control-fd", str(control_read), *options),
            ],
            pass_fds=(truth_write, control_read),
            env={
                **env,
                "MUJOCO_GL": "disable",
            },  # nothing is drawn here, and looking for a screen takes 0.13 s
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
        )
        os.close(truth_write)
        os.close(control_read)
        self._thread = threading.Thread(target=self._read_truth, args=(truth_read,), daemon=True)
        self._thread.start()

    def command(self, do: str, **arguments: Any) -> None:
        """Send one command of :mod:`robot_sim.scenario_control`."""
        with self._changed:
            self._commands_left += 1
        os.write(self._control, json.dumps({"do": do, **arguments}).encode() + b"\n")

    def has_obeyed(self) -> bool:
        """Whether every command has taken effect, and what it asked for has been reported."""
        return self._commands_left == 0

    def is_running(self) -> bool:
        """Whether the process is alive."""
        return self.process.poll() is None

    def stop(self) -> None:
        """End the process and read the truth to its end."""
        self.process.terminate()
        try:
            self.process.wait(5)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        self._thread.join(5)

    def _read_truth(self, fd: int) -> None:
        with os.fdopen(fd, "rb") as lines:
            for line in lines:
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
