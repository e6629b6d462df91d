"""The arena's trusted process: starts the robot and the student's node, carries out one scenario, reports what it saw.

:mod:`.clocked_start` starts it as `python -m autograder.arena.agent EVENTS_FD`.
"""

from __future__ import annotations

import base64
import importlib
import json
import os
import sys
import threading
import time
import traceback
from contextlib import suppress
from pathlib import Path
from typing import Any

from autograder.arena.clocked_start import CLOCK_PAGE, SPEC_FILE
from autograder.arena.recorder import Recorder
from autograder.arena.simulator import Simulator
from autograder.arena.student_watch import StudentWatch
from autograder.isolation.limits import StudentLimits
from autograder.isolation.student_process import StudentProcess, start_student
from ros_runtime.clock.scaled_clock import ScaledClock
from ros_runtime.environment import ros_environment


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
    namespace = spec["namespace"]
    environment = dict(os.environ)
    simulator = Simulator(recorder, changed, namespace, spec["robot_options"], environment)
    finished = threading.Event()
    student = _start_student(spec, recorder, changed, clock, finished)
    watch = StudentWatch(student, recorder, StudentLimits())
    try:
        _perform(spec, recorder, changed, simulator, student, clock)
    finally:
        watch.report()
        finished.set()
        student.kill()
        simulator.stop()


def _start_student(
    spec: dict[str, Any],
    recorder: Recorder,
    changed: threading.Condition,
    clock: ScaledClock,
    finished: threading.Event,
) -> StudentProcess:
    def on_exit(returncode: int) -> None:
        if not finished.is_set():  # that end is ours
            recorder.record("node_exited", returncode=returncode)
        with changed:
            changed.notify_all()

    recorder.record("node_started")
    return start_student(
        [
            sys.executable,
            spec["file_name"],
            *spec["arguments"],
            "--ros-args",
            "-r",
            f"__ns:={spec['namespace']}",
        ],
        workdir_files={name: base64.b64decode(content) for name, content in spec["files"].items()},
        env={**ros_environment(), **clock.environment()},
        read_only_paths=[*spec["student_paths"], os.environ[CLOCK_PAGE]],
        on_line=lambda t, stream, text: recorder.record("node_output", t=t, stream=stream, text=text),
        on_exit=on_exit,
    )


def _perform(
    spec: dict[str, Any],
    recorder: Recorder,
    changed: threading.Condition,
    simulator: Simulator,
    student: StudentProcess,
    clock: ScaledClock,
) -> None:
    # rclpy is imported only now, while the robot and the student's node are starting beside us
    import rclpy
    from rclpy.executors import SingleThreadedExecutor
    from rclpy.signals import SignalHandlerOptions

    from autograder.arena.stage import NodeMissing, Stage

    scenario = getattr(importlib.import_module(spec["module"]), spec["scenario"])
    rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.NO)
    node = rclpy.create_node("observer", namespace=spec["namespace"])
    stranger = rclpy.create_node("stranger", namespace=spec["namespace"])
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    executor.add_node(stranger)
    threading.Thread(target=executor.spin, daemon=True).start()
    stage = Stage(node, stranger, recorder, changed, simulator, student, lambda: clock.run_at(spec["scale"]))
    with suppress(NodeMissing):  # recorded already
        scenario(stage, **spec["params"])
    if not simulator.is_running():
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
