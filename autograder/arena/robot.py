"""The robot as a scenario uses it: commands, and waiting for their effects."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from autograder.arena import events as ev
from autograder.arena.arena_log import ArenaLog
from autograder.arena.simulator import Simulator
from humanoid_interfaces.msg import RobotState

TIMEOUT = 30.0  # s on the arena's clock
FALL_TIMEOUT = 6.0  # s on the arena's clock, in which a robot that is knocked over has fallen


class RobotUnavailable(Exception):
    """The simulator does not provide what the scenario needs; the student's program is never the cause."""


class Robot:
    """The robot of a scenario. Commands go to the simulator by a pipe, so no node can interfere."""

    def __init__(self, simulator: Simulator, log: ArenaLog) -> None:
        self._simulator = simulator
        self._log = log

    @property
    def state(self) -> ev.RobotTruth:
        """The simulator's state of the robot, at most 20 ms old."""
        latest = self._log.last(ev.RobotTruth)
        if latest is None:
            raise RobotUnavailable("no state of the robot was received from the simulator yet")
        return latest

    # -- commands -----------------------------------------------------------------------------------------------------

    def push(self, impulse: Sequence[float]) -> None:
        """Push the torso (N·s in odom)."""
        self._command("push", impulse=list(impulse))

    def knock_over(self, impulse: Sequence[float]) -> None:
        """Push the torso (N·s in odom) so that the robot falls, and wait until it has fallen."""
        self.push(impulse)
        self.wait_for(lambda robot: robot.mode == RobotState.FALLEN, FALL_TIMEOUT)

    def lean_on(self, force: Sequence[float], duration: float) -> None:
        """Lean on the torso with a force (N in odom) for `duration` s."""
        self._command("push", impulse=[duration * each for each in force], duration=duration)

    def walk(self, velocity: Sequence[float]) -> None:
        """Walk with a velocity (m/s, m/s, rad/s in base_link); zeros stop it."""
        self._command("walk", velocity=list(velocity))

    def take_over(self, velocity: Sequence[float]) -> None:
        """Walk with a velocity (m/s, m/s, rad/s in base_link) and ignore cmd_vel, as under a remote control."""
        self._command("take_over", velocity=list(velocity))

    def give_back(self) -> None:
        """Stop, and follow cmd_vel again."""
        self._command("take_over", velocity=None)

    def set_battery(self, percentage: float) -> None:
        """Replace the battery by one with this charge, 0 to 1."""
        self._command("set_battery", percentage=percentage)

    def set_up(self) -> None:
        """Put the robot on its feet at the origin of odom, with its motors on and a full battery."""
        self._command("reset")

    def set_motor_power(self, on: bool) -> None:
        """Switch the motors on or off."""
        self._command("motor_power", on=on)

    def move_joints(self, positions: Mapping[str, float], duration: float) -> None:
        """Move joints to positions (rad) within `duration` s."""
        self._command("move_joints", positions=dict(positions), duration=duration)

    def report_arm(self, side: str) -> None:
        """Have the simulator report where elbow and hand of the arm "l" or "r" are."""
        self._command("report_arm", side=side)

    def report_joints(self, names: Sequence[str]) -> None:
        """Have the simulator report where these joints are, from now on."""
        self._command("report_joints", names=list(names))

    def report_feet(self) -> None:
        """Have the simulator report what each foot carries, from now on."""
        self._command("report_feet")

    def move_body(self, rate: float) -> None:
        """Crouch (rate < 0) or rise at a rate (m/s) until the next command."""
        self._command("move_body", rate=rate)

    def report_hand(self, side: str) -> None:
        """Have the simulator report position and contact forces of the hand "l" or "r" from now on."""
        self._command("report_hand", side=side)

    def report_object(self, name: str) -> None:
        """Have the simulator report where an object is, from now on."""
        self._command("report_object", name=name)

    def move_object(self, name: str, position: Sequence[float]) -> None:
        """Move an object to a position (m in odom), upright and at rest, even if a hand holds it."""
        self._command("move_object", name=name, position=list(position))

    def hold_joint(self, joint: str) -> None:
        """Hold a joint of waist, head or arm where it is, stronger than its motor."""
        self._command("hold_joint", joint=joint)

    def release_joint(self, joint: str) -> None:
        """Release a held joint."""
        self._command("release_joint", joint=joint)

    def connect_battery_sensor(self, connected: bool = True) -> None:
        """Begin, or stop, publishing battery_state."""
        self._command("battery_sensor", connected=connected)

    def connect_charge_sensor(self, connected: bool = True) -> None:
        """Connect or disconnect the charge sensor; without it battery_state has percentage NaN."""
        self._command("charge_sensor", connected=connected)

    def set_clock(self, offset: float) -> None:
        """Stamp all messages with the time plus `offset` (s), as after somebody has set the robot's clock."""
        self._command("clock_offset", seconds=offset)

    def connect_joint_sensors(self, connected: bool = True) -> None:
        """Begin, or stop, publishing joint_states."""
        self._command("joint_sensors", connected=connected)

    def connect_imu(self, connected: bool = True) -> None:
        """Begin, or stop, publishing imu."""
        self._command("imu_sensor", connected=connected)

    def set_gyro_bias(self, bias: Sequence[float]) -> None:
        """Give the gyro another bias (rad/s about x, y and z of imu_link)."""
        self._command("gyro_bias", bias=list(bias))

    def reverse_joint_states(self, is_reversed: bool = True) -> None:
        """List the joints of joint_states in reverse order, or in the usual one, from now on."""
        self._command("joint_states", reversed=is_reversed)

    def alternate_joint_states(self, alternate: bool = True) -> None:
        """Reverse the joint order in every second joint_states message, or stop doing so."""
        self._command("joint_states", alternate=alternate)

    def set_joint_readings(self, positions: Mapping[str, float]) -> None:
        """Make the sensors of these joints report fixed positions (rad, fingers: m); the other sensors measure."""
        self._command("joint_readings", positions=dict(positions))

    def publish_robot_state(self, published: bool = True) -> None:
        """Begin, or stop, publishing robot_state."""
        self._command("robot_state", published=published)

    # -- waiting ------------------------------------------------------------------------------------------------------

    def wait_for(self, condition: Callable[[ev.RobotTruth], Any], timeout: float = TIMEOUT) -> bool:
        """Wait for a condition on its state; return False if `timeout` s are over first."""
        return self._wait_until(lambda: condition(self.state), timeout)

    def wait_for_joint(self, joint: str, condition: Callable[[float], Any], timeout: float = TIMEOUT) -> bool:
        """Wait for a condition on the position (rad) of a joint; needs `report_joints`."""
        return self._wait_for_latest(lambda each: condition(each.positions[joint]), timeout, ev.JointsTruth)

    def wait_for_feet(self, condition: Callable[[float, float], Any], timeout: float = TIMEOUT) -> bool:
        """Wait for a condition on the loads of the left and right foot (N); needs `report_feet`."""
        return self._wait_for_latest(lambda feet: condition(feet.left, feet.right), timeout, ev.FeetTruth)

    def wait_for_hand(
        self, condition: Callable[[ev.HandTruth, ev.ObjectTruth], Any], timeout: float = TIMEOUT
    ) -> bool:
        """Wait for a condition on hand and object; needs `report_hand` and `report_object`."""
        return self._wait_for_latest(condition, timeout, ev.HandTruth, ev.ObjectTruth)

    def wait(self, duration: float) -> bool:
        """Wait until every command has taken effect, then for `duration` s of the robot's own time."""
        self.wait_for_commands()
        over = self.state.simulated + duration
        return self.wait_for(lambda robot: robot.simulated >= over)

    def wait_for_commands(self) -> bool:
        """Wait until every command has taken effect."""
        return self._wait_until(self._commands_took_effect, TIMEOUT)

    def wait_for_published(self, kind: type[ev.Event], number: int = 1) -> bool:
        """Wait until every command has taken effect, then for `number` more messages (BatteryPublished, …)."""
        self.wait_for_commands()
        enough = self._log.count(kind) + number
        return self._wait_until(lambda: self._log.count(kind) >= enough, TIMEOUT)

    def _commands_took_effect(self) -> bool:
        return self._log.count(ev.RobotCommanded) >= self._log.count(ev.CommandSent)

    def _wait_for_latest(self, condition: Callable[..., Any], timeout: float, *kinds: type[ev.Event]) -> bool:
        """Wait for a condition on the latest event of each kind."""

        def is_met() -> bool:
            latest = [self._log.last(kind) for kind in kinds]
            return None not in latest and bool(condition(*latest))

        return self._wait_until(is_met, timeout)

    def _wait_until(self, condition: Callable[[], Any], timeout: float) -> bool:
        return self._log.wait_until(lambda: condition() or not self._simulator.is_running(), timeout)

    def _command(self, do: str, **arguments: Any) -> None:
        self._simulator.command({"do": do, **arguments})
