"""Measures the rate and the cost of the robot's live picture, as a notebook shows it."""

from __future__ import annotations

import time
from dataclasses import dataclass

import ipywidgets
import psutil
from rclpy.node import Node
from rosgraph_msgs.msg import Clock

from lab.client import topics
from lab.client.commands import walking
from lab.client.connection import connection
from lab.client.exchange import wait_until
from lab.pictures.live_view import stop_watching, watch_robot
from lab.running.robot import robot_process, start_robot
from lab.running.session import stop_everything
from ros_runtime.workarounds.gl_backend import NoOpenGLError

CIRCLE = {"forward": 0.2, "turn": 0.3}  # m/s, rad/s: every picture differs


@dataclass(frozen=True)
class Load:
    """The load in an interval of time.

    Attributes:
        wall: its length, s.
        simulated: how far the simulation went, s.
        simulator, notebook: processor time of the two processes, s.
    """

    wall: float = 0.0
    simulated: float = 0.0
    simulator: float = 0.0
    notebook: float = 0.0

    @property
    def pace(self) -> float:
        """Simulated seconds a second."""
        return self.simulated / self.wall

    @property
    def simulator_share(self) -> float:
        """The share of one core that it used, 0 to 1."""
        return self.simulator / self.wall

    @property
    def notebook_share(self) -> float:
        """The share of one core that it used, 0 to 1."""
        return self.notebook / self.wall

    def __add__(self, other: Load) -> Load:
        return Load(
            self.wall + other.wall,
            self.simulated + other.simulated,
            self.simulator + other.simulator,
            self.notebook + other.notebook,
        )

    def __sub__(self, earlier: Load) -> Load:
        return self + Load(-earlier.wall, -earlier.simulated, -earlier.simulator, -earlier.notebook)


@dataclass(frozen=True)
class ViewCost:
    """Different pictures a second, and the load of the two processes without and with the picture."""

    frames: float
    without: Load
    watched: Load


def view_cost(seconds: float = 5.0, rounds: int = 3) -> ViewCost:
    """Start the robot, let it walk in a circle, and measure for `seconds` without and with the picture, in turns.

    In turns, because then other load on the machine affects both alike. It ends the lab's session.

    Raises:
        NoOpenGLError: this machine cannot draw; the message says what to install.
        NoRobotError: the robot does not come up.
    """
    pictures, without, watched = 0, Load(), Load()
    try:
        start_robot()
        clock = connection().get_or_create("simulated time", _SimulatedTime)
        wait_until(lambda: clock.seconds > 0, what="the robot's /clock")
        with walking(**CIRCLE):
            wait_until(lambda: topics.mode() == "WALKING", what="the robot walks")
            for _ in range(rounds):
                without += _measure(clock, seconds)
                seen = _watch()
                before = len(seen)
                watched += _measure(clock, seconds)
                pictures += len(seen) - before
                stop_watching()
    finally:
        stop_everything()
    return ViewCost(pictures / watched.wall, without, watched)


def _watch() -> set[bytes]:
    """Begin to watch, and return a list that gets each new picture once."""
    view = watch_robot()
    if isinstance(view, ipywidgets.Label):
        raise NoOpenGLError(view.value)
    assert isinstance(view, ipywidgets.Image)  # no lab has started this process
    seen: set[bytes] = set()
    view.observe(lambda change: seen.add(change["new"]), "value")
    return seen


def _measure(clock: _SimulatedTime, seconds: float) -> Load:
    before = _now(clock)
    time.sleep(seconds)
    return _now(clock) - before


def _now(clock: _SimulatedTime) -> Load:
    """Return the resources used so far."""
    robot = psutil.Process(robot_process().pid).cpu_times()
    return Load(time.monotonic(), clock.seconds, robot.user + robot.system, time.process_time())


class _SimulatedTime:
    """The last message on /clock, s."""

    def __init__(self, node: Node) -> None:
        self.seconds = 0.0
        node.create_subscription(Clock, "/clock", self._keep, 10)

    def _keep(self, message: Clock) -> None:
        self.seconds = message.clock.sec + message.clock.nanosec * 1e-9
