"""The arena's trusted process: starts the robot and the student's node, carries out one scenario, reports what it saw.

:mod:`.clocked_start` starts it as `python -m autograder.arena.agent EVENTS_FD`.
"""

from __future__ import annotations

import importlib
import json
import os
import sys
import threading
import time
import traceback
from contextlib import nullcontext, suppress
from pathlib import Path
from typing import Any

from autograder.arena.clocked_start import CLOCK_PAGE, SPEC_FILE
from autograder.arena.punctuality import Punctuality
from autograder.arena.recorder import Recorder
from autograder.arena.simulator import Simulator
from autograder.arena.student import Student
from ros_runtime.clock.scaled_clock import ScaledClock


def main() -> None:
    """Carry out the scenario."""
    spec = json.loads(Path(os.environ[SPEC_FILE]).read_text())
    recorder = Recorder(int(sys.argv[1]))
    try:
        _carry_out(spec, recorder, ScaledClock.open(os.environ[CLOCK_PAGE]))
    except Exception as error:  # whatever it is, the controller must learn that this run cannot be judged
        recorder.record("scenario_failed", reason=f"{type(error).__name__}: {error}")
        raise


def _carry_out(spec: dict[str, Any], recorder: Recorder, clock: ScaledClock) -> None:
    changed = threading.Condition()
    simulator = _start_simulator(spec, recorder, changed)
    student = Student(spec, recorder, changed, clock)
    try:
        if spec["student"] == "node":
            student.start()
        _perform(spec, recorder, changed, simulator, student, clock)
    finally:
        student.close()
        if simulator:
            simulator.stop()


def _start_simulator(
    spec: dict[str, Any], recorder: Recorder, changed: threading.Condition
) -> Simulator | None:
    options = spec["robot_options"]
    if options is None:
        return None
    return Simulator(recorder, changed, spec["namespace"], options, dict(os.environ))


def _perform(
    spec: dict[str, Any],
    recorder: Recorder,
    changed: threading.Condition,
    simulator: Simulator | None,
    student: Student,
    clock: ScaledClock,
) -> None:
    # rclpy is imported only now, while the robot and the student's node are starting beside us
    import rclpy
    from rclpy.executors import SingleThreadedExecutor
    from rclpy.signals import SignalHandlerOptions

    from autograder.arena.client_stage import ClientStage
    from autograder.arena.spinning import keep_spinning
    from autograder.arena.stage import NodeMissing, Stage

    punctuality = Punctuality(recorder, student, spec["scale"])

    def speed_up() -> None:
        punctuality.begin()
        clock.run_at(spec["scale"])

    scenario = getattr(importlib.import_module(spec["module"]), spec["scenario"])
    rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.NO)
    node = rclpy.create_node("observer", namespace=spec["namespace"])
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    stage: Stage | ClientStage
    if spec["student"] == "program":
        stage = ClientStage(node, recorder, changed, student, speed_up)
    else:
        stranger = rclpy.create_node("stranger", namespace=spec["namespace"])
        executor.add_node(stranger)
        stage = Stage(node, stranger, recorder, changed, simulator, student, speed_up)
    threading.Thread(target=keep_spinning, args=(executor, recorder), daemon=True).start()
    # a robot says itself how late it is
    watch = punctuality.watch() if spec["timed"] and not simulator else nullcontext()
    with suppress(NodeMissing), watch:  # what is missing is recorded already
        scenario(stage, **spec["params"])
    stage.close()
    if simulator and not simulator.is_running():
        raise RuntimeError(f"the simulator ended with status {simulator.process.returncode}")
    recorder.record("scenario_ended", t=time.monotonic())


if __name__ == "__main__":
    status = 0
    try:
        main()
    except Exception:
        traceback.print_exc()
        status = 1
    os._exit(status)  # rclpy's own shutdown would take longer than the scenario's last step
