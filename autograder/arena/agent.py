"""The arena's trusted process: it carries out one scenario and reports what it saw.

It starts the robot and the student's node. `autograder.arena.host` forks it for each scenario.
"""

from __future__ import annotations

import importlib.util
import os
import sys
import tempfile
import threading
import traceback
from collections.abc import Sequence
from contextlib import nullcontext, suppress
from functools import cache
from pathlib import Path
from types import ModuleType

import rclpy
from rclpy.executors import Executor, ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions

from autograder.arena import events as ev
from autograder.arena.arena_log import ArenaLog
from autograder.arena.client_stage import ClientStage
from autograder.arena.phases import Phase, Phases
from autograder.arena.robots import Robots
from autograder.arena.scenario_spec import ScenarioSpec
from autograder.arena.scheduling_monitor import watch_scheduling
from autograder.arena.simulator import Simulator
from autograder.arena.stage import NodeMissing, Stage
from autograder.arena.student import Student
from ros_runtime.workarounds.scaled_clock.clock import ScaledClock, follow, library_path

SCENARIOS = "scenarios_of_the_exercise"  # the name of their module
RCLPY_ERRORS = (RuntimeError, UnicodeError, MemoryError)  # what rclpy can raise for an unreadable message


@cache
def scenarios_in(path: str) -> ModuleType:
    """Import the file, once in this process and its forks, and return the module."""
    spec = importlib.util.spec_from_file_location(SCENARIOS, path)
    assert spec
    assert spec.loader
    module = importlib.util.module_from_spec(spec)
    sys.modules[SCENARIOS] = module  # dataclasses look up their module in sys.modules
    spec.loader.exec_module(module)
    return module


def carry_out(
    spec: ScenarioSpec,
    events_fd: int,
    robots: Robots,
    domain: int | None,
    earlier_phases: Sequence[Phase] = (),
) -> None:
    """Carry out the scenario in this process, a new fork of the host, and end it."""
    status = 0
    log = ArenaLog(events_fd)
    phases = Phases(log, spec.measured, earlier_phases)
    try:
        with tempfile.TemporaryDirectory(prefix="scenario-") as folder:
            # the student's program reads the clock file here, in some arenas as another user
            os.chmod(folder, 0o711)
            clock = ScaledClock.create(Path(folder, "clock"))
            if library_path():
                follow(clock.path)
            if domain is not None:
                os.environ["ROS_DOMAIN_ID"] = str(domain)
            _carry_out(spec, log, phases, clock, robots)
    except Exception as error:  # after any error the controller must know that this run cannot be judged
        log.append(ev.ScenarioFailed(reason=f"{type(error).__name__}: {error}"))
        traceback.print_exc()
        status = 1
    os._exit(status)  # rclpy's own shutdown would take longer than the scenario's last step


def _carry_out(
    spec: ScenarioSpec,
    log: ArenaLog,
    phases: Phases,
    clock: ScaledClock,
    robots: Robots,
) -> None:
    simulator = None
    if spec.robot_options is not None:  # forked while this process has one thread
        simulator = Simulator(log, robots, spec.namespace, spec.robot_options, postures=spec.recorded)
    student = Student(spec, log, clock)
    try:
        if simulator:
            simulator.listen()
            simulator.wait_until_up()
        phases.end("start")
        _perform(spec, log, phases, simulator, student, clock)
    finally:
        student.close()
        if simulator:
            simulator.stop()
        phases.end("end")


def _perform(
    spec: ScenarioSpec,
    log: ArenaLog,
    phases: Phases,
    simulator: Simulator | None,
    student: Student,
    clock: ScaledClock,
) -> None:
    def speed_up() -> None:
        clock.run_at(spec.scale)
        student.count_from_now()
        phases.end("settling")

    scenario = getattr(scenarios_in(spec.scenario_file), spec.scenario)
    rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.NO)
    node = _bare_node("observer", spec.namespace)
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    stage: Stage | ClientStage
    if spec.student == "program":
        stage = ClientStage(node, log, student, phases, speed_up)
    else:
        stranger = _bare_node("stranger", spec.namespace)
        executor.add_node(stranger)
        stage = Stage(node, stranger, log, simulator, student, phases, speed_up)
    threading.Thread(target=keep_spinning, args=(executor, log), daemon=True).start()
    # with a robot, the simulator reports how late it is
    watch = watch_scheduling(log, student) if spec.timed and not simulator else nullcontext()
    with suppress(NodeMissing), watch:  # the stage has recorded the missing endpoints
        scenario(stage, **spec.params)
    stage.close()
    if simulator and not simulator.is_running():
        raise RuntimeError(f"the simulator ended with status {simulator.process.exitcode}")
    log.append(ev.ScenarioEnded())
    phases.end("scenario")


def _bare_node(name: str, namespace: str) -> Node:
    """Make a node without parameter services and rosout, so that other nodes have less to discover."""
    return rclpy.create_node(name, namespace=namespace, start_parameter_services=False, enable_rosout=False)


def keep_spinning(executor: Executor, log: ArenaLog) -> None:
    """Spin until the context is shut down; count unreadable messages; an error of the grader fails the scenario."""
    while executor.context.ok():
        try:
            executor.spin_once()
        except ExternalShutdownException:
            return
        except RCLPY_ERRORS:
            traceback.print_exc()
            log.drop("unreadable")
        except Exception as error:
            traceback.print_exc()
            log.append(ev.ScenarioFailed(reason=f"{type(error).__name__}: {error}"))
            return
