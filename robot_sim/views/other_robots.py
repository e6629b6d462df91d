"""Real robots to look at, from MuJoCo Menagerie: they stand in the posture of their model, and do nothing else."""

from __future__ import annotations

import time
from collections.abc import Callable

import mujoco

from robot_sim.ros.pacing import Pacing
from robot_sim.views.web_view import WebView

STANDING = ("stand", "home")  # keyframes, the first there is
FRAME = 0.02  # s


class RobotUnavailable(Exception):
    """The model cannot be had here; the message says why and what to do."""


class OtherRobot:
    """A robot of MuJoCo Menagerie whose servos hold the posture of its model's keyframe.

    Args:
        name: as Menagerie has it, such as "unitree_g1". It is downloaded once, a few MB.

    Attributes:
        model, data: of MuJoCo.
        posture: name of the keyframe, or "" where the model has none and the robot just falls.

    Raises:
        RobotUnavailable: the name is not known, or the model cannot be downloaded.
    """

    def __init__(self, name: str) -> None:
        self.model = _load(name)
        self.data = mujoco.MjData(self.model)
        keys = [self.model.key(index).name for index in range(self.model.nkey)]
        self.posture = next((key for key in STANDING if key in keys), keys[0] if keys else "")
        if self.posture:
            mujoco.mj_resetDataKeyframe(self.model, self.data, self.model.key(self.posture).id)
        mujoco.mj_forward(self.model, self.data)

    @property
    def time(self) -> float:
        """Simulated time, s."""
        return self.data.time

    def step(self) -> None:
        """Simulate one timestep."""
        mujoco.mj_step(self.model, self.data)


def show(name: str, port: int, is_running: Callable[[], bool]) -> None:
    """Show a robot in the browser, in real time, until `is_running` says no.

    Raises:
        RobotUnavailable: it cannot be had.
        OSError: the port is taken.
    """
    robot = OtherRobot(name)
    view = WebView(robot, port)
    print(f"{name} stands in its posture {robot.posture!r}" if robot.posture else f"{name} has no posture")
    print(f"view: {view.url}", flush=True)
    pacing = Pacing()
    pacing.restart(robot.time)
    try:
        while is_running():
            end = robot.time + FRAME
            while robot.time < end:
                robot.step()
            view.show()
            time.sleep(pacing.wall_time_until(robot.time))
    finally:
        view.close()


def _load(name: str) -> mujoco.MjModel:
    try:
        import mujoco_menagerie as menagerie
    except ImportError as error:
        raise RobotUnavailable(
            "other robots come with mujoco-menagerie, which needs Python 3.11 or newer"
        ) from error
    try:
        return menagerie.load(name)
    except LookupError as error:
        humanoids = ", ".join(robot.name for robot in menagerie.robots("humanoid"))
        raise RobotUnavailable(f"{error} The humanoids are {humanoids}.") from error
    except menagerie.MenagerieError as error:
        raise RobotUnavailable(
            f"{name} could not be had from MuJoCo Menagerie: {error}. It is downloaded once and needs the network "
            "then; without it, put the model's folder somewhere and name the folder above it in MENAGERIE_ROOT."
        ) from error
