"""A scenario's commands to the simulator are in the transcript, whether they take effect or not."""

from __future__ import annotations

import json
import os
import time
from collections.abc import Sequence

from autograder.arena import events as ev
from autograder.arena.arena_log import ArenaLog
from autograder.arena.robot import Robot
from autograder.arena.simulator import Simulator
from ros_runtime.record.event import to_line


class Obedient:
    """Stands for a simulator: reports that the first command has taken effect, and runs on for a while."""

    def serve(self, options: Sequence[str], *more: str) -> None:
        given = dict(zip(more[::2], more[1::2], strict=True))
        command = json.loads(os.read(int(given["--control-fd"]), 1000))
        taken = to_line(ev.RobotCommanded(command=command))
        os.write(int(given["--ground-truth-fd"]), taken + b"no end of a line")
        time.sleep(60)


def test_a_command_is_recorded_as_sent_and_when_it_takes_effect(log: ArenaLog) -> None:
    simulator = Simulator(log, Obedient(), "/robot", ())  # type: ignore[arg-type]
    robot = Robot(simulator, log)
    robot.set_battery(0.35)
    assert log.all(ev.RobotCommanded) == []
    simulator.listen()
    assert robot.wait_for_commands()
    command = {"do": "set_battery", "percentage": 0.35}
    assert [event.command for event in log.all(ev.CommandSent)] == [command]
    assert [event.command for event in log.all(ev.RobotCommanded)] == [command]
    simulator.stop()
    assert not simulator.is_running()
