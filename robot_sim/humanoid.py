"""The simulated robot, without ROS."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import mujoco
import numpy as np

from robot_sim.arms.hand import Hand
from robot_sim.arms.joint_brakes import BRAKE_TORQUE, JointBrakes
from robot_sim.arms.joint_trajectory import HOLD, JointTrajectory
from robot_sim.arms.upper_body import UpperBody
from robot_sim.battery import Battery
from robot_sim.body import body_named
from robot_sim.model.scenes import OBJECTS
from robot_sim.model.side import SIDES, Side
from robot_sim.push import Pusher
from robot_sim.rest import Rest
from robot_sim.sensors.foot_sensor import FootSensor
from robot_sim.sensors.imu import Imu
from robot_sim.state import BasePose, BaseVelocity, ImuSample, JointState, Mode, ObjectPose
from robot_sim.walking.balance_gains import BalanceGains
from robot_sim.walking.body_height import BodyHeight
from robot_sim.walking.footsteps import Command, Goal
from robot_sim.walking.planar import clamp
from robot_sim.walking.walking_limits import walkable_velocity
from ros_runtime.angles import yaw_of

FALLEN_UP = 0.6  # z component of the torso's up-vector (1 upright, 0 lying), below which the robot has fallen


class Humanoid:
    """A humanoid that balances and walks in simulation; each `step()` is one timestep.

    The same seed and the same commands give the same motion, bit by bit.

    Args:
        scene: "flat", "table" (with a cup in front of the robot) or "stand" (which holds it, motors on or off).
        seed: of the sensors' errors.
        shape: called with the model before it is compiled, such as to tilt the floor.
        robot: one of `body.ROBOTS`.

    Raises:
        ValueError: the robot or the scene is not known.
        MissingParts: the robot is optional, and its packages are not installed.

    Attributes:
        body: what distinguishes this kind of robot from others.
        scene: its name.
        seed: of the sensors' errors; a new one takes effect at the next `reset()`.
        model, data: of MuJoCo; the pelvis is base_link, the world is odom.
        joints: names of the actuated joints, in the order of the actuators.
        stance_height: height (m) of the pelvis above the floor while it stands.
        battery: charge, voltage, current.
        hands: the grippers by side.
        feet: the force-torque sensors of the feet, by side.
        may_rest: while the robot stands still without a command, only time and battery are simulated, not the physics;
            such a step takes a fiftieth of the time.
        motors_enabled: whether torque is on. False after `set_motor_power(False)`, after a fall and at zero charge.
    """

    def __init__(
        self,
        scene: str = "flat",
        *,
        seed: int = 0,
        shape: Callable[[mujoco.MjSpec], object] = lambda spec: None,
        robot: str = "humanoid",
    ) -> None:
        self.body = body_named(robot)
        self.scene = scene
        self.model = self.body.model(scene, shape)
        self.data = mujoco.MjData(self.model)
        self.timestep: float = self.model.opt.timestep
        self.stance_height: float = self.model.body("pelvis").pos[2].item()
        self.seed = seed
        self.joints = tuple(self.model.actuator(index).name for index in range(self.model.nu))
        joints = [self.model.joint(name) for name in self.joints]
        self._joint_positions = np.array([joint.qposadr[0] for joint in joints])
        self._joint_velocities = np.array([joint.dofadr[0] for joint in joints])
        self._torso_rotation = self.data.xmat[self.model.body("torso").id]
        self._rest = Rest(self.data, self.timestep)
        self.reset()

    def reset(self, x: float = 0.0, y: float = 0.0, yaw: float = 0.0, *, height: float | None = None) -> None:
        """Stand at rest at (x, y) m, heading `yaw` rad, odom frame: time 0, battery full, motors on.

        With a `height` (m, of the pelvis) below that of the stance it begins in a crouch, if it can crouch.
        """
        self._set_actuation(True)
        stance = self.stance_height
        height = stance if height is None else clamp(height, self.body.heights.lowest, stance)
        self.body.take_stance(self.model, self.data, x, y, yaw, height)
        self.battery = Battery()
        self._imu = Imu(self.model, self.data, self.seed)
        self._pusher = Pusher(self.model, self.data, "torso")
        self._brakes = JointBrakes(self.model, self.data, self.body.movable)
        self._take_control()
        self._height.set(height)
        self.hands = {side: Hand(self.model, self.data, side) for side in self.body.hands}
        self.feet = {side: FootSensor(self.model, self.data, side) for side in SIDES}
        self._earlier_steps = 0
        self._fallen = False

    def _take_control(self) -> None:
        """Start the controllers from the present state of the robot."""
        self._walker = self.body.walker(self.model, self.data)
        self._height = BodyHeight(self._walker, self.stance_height, self.body.heights)
        self._pending: Command = None
        self._upper_body = UpperBody(self.model, self.data, self.body.movable)

    def step(self) -> None:
        """Simulate one timestep."""
        if self._rest.is_reached:
            self._pass_time()
            return
        mujoco.mj_step1(self.model, self.data)
        if self.motors_enabled:
            self._height.tick(self.timestep)
            if self._pending is not None and self._height.is_risen:
                self._walker.follow(self._pending)
                self._pending = None
            self._walker.tick(self.timestep)
            self._upper_body.tick(self.timestep)
        self._pusher.apply()
        self._brakes.apply()
        mujoco.mj_step2(self.model, self.data)
        for hand in self.hands.values():
            hand.tick(self.timestep)
        self.battery.drain(self.data.actuator_force, self.data.actuator_velocity, self.timestep)
        if not self._fallen and self._is_down:
            self._fallen = True
            self._set_actuation(False)
        elif self.motors_enabled and self.battery.is_empty:
            self._set_actuation(False)
        if self._rest.allowed:
            self._rest.watch(self._is_idle())

    @property
    def may_rest(self) -> bool:
        """Whether physics may be skipped while the robot only stands; setting this resumes physics."""
        return self._rest.allowed

    @may_rest.setter
    def may_rest(self, allowed: bool) -> None:
        self._rest.allowed = allowed and self.body.may_rest
        self._rest.wake()

    @property
    def is_resting(self) -> bool:
        """Whether physics is skipped at present."""
        return self._rest.is_reached

    def _pass_time(self) -> None:
        """Simulate one timestep of a robot at rest."""
        self.data.time += self.timestep
        self.battery.drain_as_before(self.timestep)
        if self.battery.is_empty:
            self._set_actuation(False)

    def _is_idle(self) -> bool:
        """Return whether it stands without a command."""
        return (
            self.motors_enabled
            and self._pending is None
            and self._walker.is_idle
            and self._height.is_idle
            and self._upper_body.is_idle
            and self._pusher.is_idle
            and self._brakes.is_idle
        )

    # Commands

    def walk_velocity(self, vx: float, vy: float, wz: float) -> None:
        """Walk at (m/s, m/s, rad/s) in base_link until the next command; (0, 0, 0) is `stop()`.

        Each component is clamped to the walking limits. Ignored while the motors are off.

        Raises:
            ValueError: a component is not finite.
        """
        self._follow(walkable_velocity(vx, vy, wz, self.body.limits))

    def walk_to(self, x: float, y: float, yaw: float) -> None:
        """Walk until the midpoint of the feet is at (x, y) m with heading `yaw` rad, odom frame.

        Ignored while the motors are off.

        Raises:
            ValueError: a number is not finite.
        """
        if not (math.isfinite(x) and math.isfinite(y) and math.isfinite(yaw)):
            raise ValueError(f"pose is ({x}, {y}, {yaw}); expected finite numbers in m, m and rad")
        self._follow(Goal(x, y, yaw))

    def stop(self) -> None:
        """Stop walking after one or two more steps, with the feet side by side."""
        self._follow(None)

    def set_motor_power(self, on: bool) -> None:
        """Switch the torque of all motors on or off; without torque the robot collapses.

        If torque is switched on again before the robot has fallen, it tries to stand. After a fall the motors stay
        off until `reset()`; with an empty battery they stay off until it is charged.
        """
        if on == self.motors_enabled or (on and (self._fallen or self.battery.is_empty)):
            return
        if on:
            self._earlier_steps = self.steps
            gains = self._walker.gains
            self._take_control()
            if gains:
                self._walker.gains = gains
            self._upper_body.follow(HOLD)
        self._set_actuation(on)

    def push(self, impulse: Sequence[float], duration: float = 0.1) -> None:
        """Push the torso with `impulse` (3,) N·s in the world frame over `duration` (s).

        Raises:
            ValueError: the impulse is not three finite numbers, or the duration is not positive.
        """
        self._pusher.push(impulse, duration)
        self._rest.wake()

    def hold_joint(self, joint: str, grip: float = BRAKE_TORQUE) -> None:
        """Hold a joint of waist, head or arm in its position, with at most `grip` (N·m), until `release_joint`.

        Raises:
            ValueError: the joint is not one that a trajectory moves, or the grip is not positive.
        """
        self._brakes.hold(joint, grip)
        self._rest.wake()

    def release_joint(self, joint: str) -> None:
        """Release a joint that is held."""
        self._brakes.release(joint)
        self._rest.wake()

    def move_object(self, name: str, position: Sequence[float]) -> None:
        """Put an object of the scene elsewhere, upright and at rest, as if somebody had taken it away.

        Args:
            name: of the object.
            position: (x, y, z) of its centre, m in the odom frame.

        Raises:
            ValueError: the scene has no such object, or the position is not three finite numbers.
        """
        if name not in OBJECTS[self.scene]:
            known = ", ".join(OBJECTS[self.scene]) or "nothing"
            raise ValueError(f"the scene {self.scene!r} has no object {name!r}; it has {known}")
        place = np.asarray(position, dtype=float)
        if place.shape != (3,) or not np.isfinite(place).all():
            raise ValueError(f"position is {position}; expected three finite numbers (x, y, z) in m")
        joint = self.data.joint(name)
        joint.qpos[:] = *place, 1.0, 0.0, 0.0, 0.0
        joint.qvel[:] = 0.0
        self._rest.wake()

    def move_body(self, rate: float) -> None:
        """Crouch or rise at `rate` (m/s, upwards) until the next command; ignored while the motors are off.

        The pelvis stays between the lowest crouch, 0.45 m, and the 0.60 m of the stance. A crouching robot rises before
        it walks. The G1 cannot crouch.

        Raises:
            ValueError: the rate is not finite.
        """
        if self.motors_enabled:
            self._height.move(rate)
            if rate:
                self._rest.wake()

    @property
    def balance_gains(self) -> BalanceGains | None:
        """How stiffly the trunk is held upright; gains that are too weak or too stiff make the robot fall.

        None if the robot's walker has none; setting them then raises a ValueError.
        """
        return self._walker.gains

    @balance_gains.setter
    def balance_gains(self, gains: BalanceGains) -> None:
        if self._walker.gains is None:
            raise ValueError("this robot's walker was learned and has no gains")
        self._walker.gains = gains
        self._rest.wake()

    def move_joints(self, trajectory: JointTrajectory) -> None:
        """Move joints of waist, head and arms along a trajectory, which replaces an earlier one. Empty: hold.

        Ignored while the motors are off.
        """
        if self.motors_enabled:
            self._upper_body.follow(trajectory)
            self._rest.wake()

    def open_hand(self, side: Side, opening: float) -> None:
        """Move the fingers of a side `opening` (m, 0 to 0.09) apart; ignored while the motors are off.

        Raises:
            ValueError: the opening is not finite.
        """
        if self.motors_enabled:
            self.hands[side].open_to(opening)
            self._rest.wake()

    # State

    @property
    def time(self) -> float:
        """Simulated time since reset, s."""
        return self.data.time

    @property
    def mode(self) -> Mode:
        """The robot's mode: off, standing, walking or fallen."""
        if self._fallen:
            return Mode.FALLEN
        if not self.motors_enabled:
            return Mode.OFF
        return Mode.STANDING if self._walker.stands else Mode.WALKING

    @property
    def steps(self) -> int:
        """Footsteps (touchdowns) since reset."""
        return self._earlier_steps + self._walker.steps

    @property
    def is_held(self) -> bool:
        """Whether a stand holds its chest and waist, so that it cannot fall."""
        return self.scene == "stand"

    @property
    def arrived(self) -> bool:
        """Whether the pose of the last `walk_to` is reached and both feet stand."""
        return self.mode is Mode.STANDING and self._walker.goal_reached

    def base_pose(self) -> BasePose:
        """Return the pose of base_link in the odom frame."""
        w, x, y, z = self.data.qpos[3:7].tolist()
        return BasePose(self.data.qpos[:3].copy(), np.array([x, y, z, w]), yaw_of(x, y, z, w))

    def base_velocity(self) -> BaseVelocity:
        """Return the velocity of base_link, in base_link."""
        to_body = np.empty(4)
        linear = np.empty(3)
        mujoco.mju_negQuat(to_body, self.data.qpos[3:7])
        mujoco.mju_rotVecQuat(linear, self.data.qvel[:3], to_body)
        return BaseVelocity(linear, self.data.qvel[3:6].copy())

    def up(self) -> float:
        """Return the z component of the torso's up-vector: 1 upright, 0 lying."""
        return float(self._torso_rotation[8])

    def joint_state(self) -> JointState:
        """Return positions, velocities and efforts of the actuated joints."""
        return JointState(
            self.joints,
            self.data.qpos[self._joint_positions],
            self.data.qvel[self._joint_velocities],
            self.data.actuator_force.copy(),
        )

    def object_poses(self) -> dict[str, ObjectPose]:
        """Return the poses of the scene's objects, by name."""
        poses = {}
        for name in OBJECTS[self.scene]:
            body = self.data.body(name)
            poses[name] = ObjectPose(body.xpos.copy(), np.roll(body.xquat, -1))  # MuJoCo has w first
        return poses

    def imu(self) -> ImuSample:
        """Return a sample of the inertial sensor in the pelvis."""
        return self._imu.read()

    @property
    def gyro_bias(self) -> list[float]:
        """The constant error of the gyro, rad/s about x, y, z of imu_link; `reset()` draws it from the seed again."""
        return self._imu.gyro_bias.tolist()

    @gyro_bias.setter
    def gyro_bias(self, bias: Sequence[float]) -> None:
        self._imu.gyro_bias = np.array(bias, dtype=float)

    # Helpers

    def _follow(self, command: Command) -> None:
        """Follow a command to walk, after rising from a crouch if needed, or a command to stop, at once."""
        if not self.motors_enabled:
            return
        if command is not None:
            self._rest.wake()
        if command is None or self._height.is_risen:
            self._pending = None
            self._walker.follow(command)
        else:
            self._pending = command
            self._height.rise()

    @property
    def _is_down(self) -> bool:
        return self.data.qpos[2] < self.body.fallen_height or self._torso_rotation[8] < FALLEN_UP

    def _set_actuation(self, on: bool) -> None:
        self._rest.wake()
        disabled = int(mujoco.mjtDisableBit.mjDSBL_ACTUATION)
        if on:
            self.model.opt.disableflags &= ~disabled
        else:
            self.model.opt.disableflags |= disabled
            self.data.actuator_force[:] = 0.0
        self.motors_enabled = on
