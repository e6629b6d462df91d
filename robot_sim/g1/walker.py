"""The learned walking controller of the G1: a network that reads the state and sets the targets of all servos."""

from __future__ import annotations

import json
import math
from pathlib import Path

import mujoco
import numpy as np

from robot_sim.model.side import SIDES
from robot_sim.sensors.foot_sensor import FootSensor
from robot_sim.walking.balance_gains import BalanceGains
from robot_sim.walking.footsteps import Command, Goal
from robot_sim.walking.planar import clamp
from ros_runtime.angles import wrap, yaw_of

RATE = 50.0  # Hz, of the network
STRIDE_TIME = 1.0  # s, two steps
LEG, ARM = (-0.312, 0.0, 0.0, 0.669, -0.363, 0.0), (0.2, 0.2, 0.0, 0.6, 0.0, 0.0, 0.0)  # left; rad
STANCE = np.array(
    [*LEG, *LEG, 0.0, 0.0, 0.0, *ARM, *ARM[:1], -ARM[1], *ARM[2:]]
)  # rad, in the order of the joints
ACTION_SCALE = 0.25  # rad for each unit of the network's output
RATE_SCALE, JOINT_RATE_SCALE = 0.25, 0.05  # of angular velocities in the network's input
# What the network walks (m/s) when it is asked for a velocity (m/s), measured over 10 s: it is slower, and drifts.
ASKED_AHEAD = (-0.4, -0.2, -0.05, 0.0, 0.1, 0.3, 0.5, 0.7)
WALKED_AHEAD = (-0.301, -0.173, -0.033, 0.017, 0.113, 0.263, 0.372, 0.456)
ASKED_LEFT = (-0.3, -0.2, -0.1, 0.0, 0.1, 0.2, 0.3)
WALKED_LEFT = (-0.13, -0.088, -0.037, 0.022, 0.084, 0.136, 0.176)
HEADING_GAIN, MOST_TURN, MOST_HEADING_ERROR = 1.5, 0.7, 0.3  # 1/s, rad/s and rad
LEFT_OF_TURN = 0.05  # rad; if more is left when it stops, it makes another step
LOADED = 20.0  # N on a foot that stands
SWING_TIME = 0.1  # s; a foot that was in the air for less has not made a step
# After a walk it stands when both feet have been on the floor, and the pelvis slower than this, for a while.
STILL, SETTLING_TIME = 0.04, 0.2  # m/s, s


class Policy:
    """The network in an ONNX file, with the joints it was trained for and the gains of their servos."""

    def __init__(self, file: Path) -> None:
        import onnxruntime

        options = onnxruntime.SessionOptions()  # one thread: others would not survive the fork of an arena
        options.intra_op_num_threads = options.inter_op_num_threads = 1
        self._session = onnxruntime.InferenceSession(str(file), options, providers=["CPUExecutionProvider"])
        about = self._session.get_modelmeta().custom_metadata_map
        self._joints: list[str] = json.loads(about["dof_names"])  # in the order of inputs and outputs
        self._stiffness, self._damping = (np.array(json.loads(about[gain])) for gain in ("kp", "kd"))
        (self._input,) = (each.name for each in self._session.get_inputs())

    def set_servos(self, model: mujoco.MjModel) -> None:
        """Give the servos of a model the gains with which the network was trained."""
        if [model.actuator(index).name for index in range(model.nu)] != self._joints:
            raise ValueError("the model and the network have different joints")
        model.actuator_gainprm[:, 0] = self._stiffness
        model.actuator_biasprm[:, 1], model.actuator_biasprm[:, 2] = -self._stiffness, -self._damping

    def __call__(self, observation: np.ndarray) -> np.ndarray:
        """Return the action (29,) for an observation (100,)."""
        return self._session.run(None, {self._input: observation[None].astype(np.float32)})[0][0]


class LearnedWalker:
    """The walking controller; around the network, a loop holds the heading, and a table corrects the velocity.

    It has the interface of `walking.walker.Walker`, but takes no Goal, has no gains, and is never idle, as the network
    always acts; setting the height of the pelvis has no effect.

    Attributes:
        stands: it has come to rest after its last command, and has made no step since.
        steps: touchdowns so far.
    """

    goal_reached = is_idle = False
    gains: BalanceGains | None = None
    height = math.inf  # it never crouches

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, policy: Policy) -> None:
        self._data, self._policy = data, policy
        self._ticks_an_action = round(1.0 / RATE / model.opt.timestep)
        self._tick = 0
        self._command: Command = None
        self._heading = 0.0
        self._action = np.zeros(len(STANCE))
        self._phases: np.ndarray | None = None  # of the left and right foot while it walks, rad
        self._makes_further_step = False  # after a command to stop
        self._feet = [FootSensor(model, data, side) for side in SIDES]
        self._in_air = [0.0, 0.0]  # s, of each foot
        self.stands, self.steps = True, 0
        self._settled = 0.0  # s

    def follow(self, command: Command) -> None:
        """Walk at a Velocity; None stops.

        Raises:
            ValueError: the command is a Goal.
        """
        if isinstance(command, Goal):
            raise ValueError("this robot walks at a velocity; it takes no goal")
        # what is left of its own last turn is less: something else has turned it
        if abs(wrap(self._heading - self._yaw)) > MOST_HEADING_ERROR:
            self._heading = self._yaw
        self._command = command
        self._makes_further_step = self._makes_further_step and command is None
        self.stands = self.stands and command is None

    def tick(self, dt: float) -> None:
        """Set the servos' targets for the next `dt` (s); call it between `mj_step1` and `mj_step2`."""
        if self._tick % self._ticks_an_action == 0:
            self._count_steps()
            self._act()
        self._tick += 1

    @property
    def _yaw(self) -> float:
        w, x, y, z = self._data.qpos[3:7].tolist()
        return yaw_of(x, y, z, w)

    def _act(self) -> None:
        data = self._data
        vx, vy, turn = self._velocity()
        to_body, gravity = np.empty(4), np.empty(3)
        mujoco.mju_negQuat(to_body, data.qpos[3:7])
        mujoco.mju_rotVecQuat(gravity, np.array([0.0, 0.0, -1.0]), to_body)
        phases = np.full(2, math.pi) if self._phases is None else self._phases
        observation = np.concatenate(
            (
                self._action,
                data.qvel[3:6] * RATE_SCALE,
                (turn, vx, vy),
                np.cos(phases),
                data.qpos[7:] - STANCE,
                data.qvel[6:] * JOINT_RATE_SCALE,
                gravity,
                np.sin(phases),
            )
        )
        self._action = self._policy(observation)
        data.ctrl[:] = STANCE + ACTION_SCALE * self._action

    def _velocity(self) -> tuple[float, float, float]:
        """Return the velocity to ask for now, and advance the phases of the feet; a step is completed before a stop.

        Otherwise a program that stops and goes on many times a second would begin the same step over and over. If more
        than LEFT_OF_TURN is left, it makes one more step: as it comes to rest, the body turns back a little, and a
        program with a small tolerance would correct that for ever.
        """
        if self._command is None and self._phases is None:
            return 0.0, 0.0, 0.0
        vx, vy, wz = self._command or (0.0, 0.0, 0.0)
        before = np.array([0.0, math.pi]) if self._phases is None else self._phases
        advance = 2 * math.pi / STRIDE_TIME / RATE
        self._phases = np.remainder(before + advance + math.pi, 2 * math.pi) - math.pi
        if self._command is None and math.cos(before[0]) * math.cos(self._phases[0]) <= 0.0:
            # both feet are on the floor
            left = abs(wrap(self._heading - self._yaw))
            self._makes_further_step = left > LEFT_OF_TURN and not self._makes_further_step
            if not self._makes_further_step:
                self._phases = None
                return 0.0, 0.0, 0.0
        self._heading += wz / RATE
        error = clamp(wrap(self._heading - self._yaw), -MOST_HEADING_ERROR, MOST_HEADING_ERROR)
        self._heading = self._yaw + error
        vx, vy = np.interp(vx, WALKED_AHEAD, ASKED_AHEAD), np.interp(vy, WALKED_LEFT, ASKED_LEFT)
        return float(vx), float(vy), clamp(wz + HEADING_GAIN * error, -MOST_TURN, MOST_TURN)

    def _count_steps(self) -> None:
        swings = False
        for index, foot in enumerate(self._feet):
            is_swing = self._in_air[index] > SWING_TIME
            swings = swings or is_swing
            if foot.read().force[2] < LOADED:
                self._in_air[index] += 1 / RATE
            else:
                self.steps += is_swing
                self._in_air[index] = 0.0
        vx, vy = self._data.qvel[:2].tolist()
        moves = swings or self._command is not None or math.hypot(vx, vy) > STILL
        self._settled = 0.0 if moves else self._settled + 1 / RATE
        self.stands = not swings and (self.stands or self._settled >= SETTLING_TIME)
