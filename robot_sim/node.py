"""The robot's ROS face: node `humanoid`, every name relative to its namespace."""

from __future__ import annotations

import math

import numpy as np
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from rclpy.time import Time
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import BatteryState, Imu, JointState
from std_msgs.msg import Bool

from humanoid_interfaces.msg import BalanceGains as BalanceGainsMessage
from humanoid_interfaces.msg import RobotState
from robot_sim.balance_gains import BalanceGains
from robot_sim.humanoid import Humanoid, Mode
from robot_sim.manipulation_topics import ManipulationTopics
from robot_sim.messages import is_heard, set_fields
from robot_sim.schedule import Schedule
from robot_sim.truth import BatterySample, TruthWriter

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
CMD_VEL_TIMEOUT = 0.5  # s; an older command stops the robot

JOINT_STATE_RATE = 20.0  # Hz, as all rates below, in simulated time
IMU_RATE = 50.0
ODOM_RATE = 20.0
BATTERY_RATE = 2.0
ROBOT_STATE_RATE = 5.0
CLOCK_RATE = 50.0
PEERS_RATE = 10.0


class HumanoidNode(Node):
    """Publishes the humanoid's state and passes commands on to it.

    The node neither spins nor steps: :func:`robot_sim.run.run` calls :meth:`publish_due` after each step and
    :meth:`hear` in between, so one thread owns the simulation. `heard` are the subscriptions it listens to.
    """

    def __init__(
        self, humanoid: Humanoid, namespace: str = "/robot", truth: TruthWriter | None = None
    ) -> None:
        super().__init__("humanoid", namespace=namespace)
        self.humanoid = humanoid
        self.battery_sensor_connected = True
        self.joint_sensors_connected = True
        self.joint_states_reversed = False
        self.robot_state_published = True
        self._truth = truth
        self._velocity_command_time: float | None = None
        self._last_announced: tuple[int, bool, int] | None = None

        self._joint_states = self.create_publisher(JointState, "joint_states", qos_profile_sensor_data)
        self._imu = self.create_publisher(Imu, "imu", qos_profile_sensor_data)
        self._odom = self.create_publisher(Odometry, "odom", 10)
        self._battery_state = self.create_publisher(BatteryState, "battery_state", LATCHED)
        self._robot_state = self.create_publisher(RobotState, "robot_state", LATCHED)
        self._clock_topic = self.create_publisher(Clock, "/clock", 10)
        manipulation = ManipulationTopics(self, humanoid)
        self.heard = [
            self.create_subscription(Twist, "cmd_vel", self._on_velocity, 10),
            self.create_subscription(Bool, "motor_power", self._on_motor_power, 10),
            self.create_subscription(BalanceGainsMessage, "balance_gains", self._on_balance_gains, 10),
            *manipulation.heard,
        ]
        self._peers: tuple[dict[str, int], dict[str, int]] = ({}, {})

        self._schedule = Schedule(
            (PEERS_RATE, self._report_peers),
            (JOINT_STATE_RATE, self._publish_joint_states),
            (IMU_RATE, self._publish_imu),
            (ODOM_RATE, self._publish_odom),
            (BATTERY_RATE, self._publish_battery_state),
            (ROBOT_STATE_RATE, self._publish_robot_state),
            (CLOCK_RATE, self._publish_clock),
            *manipulation.jobs,
        )

    def publish_due(self) -> None:
        """Publish whatever is due at the simulated time, and the robot's state as soon as it changes."""
        self._stop_on_stale_command()
        if self._announcement() != self._last_announced:
            self._publish_robot_state()
        self._schedule.run(self.humanoid.time)

    def hear(self) -> None:
        """Obey the commands that have arrived, without the 0.3 ms that an executor's wait set costs each time."""
        for heard in self.heard:
            while taken := heard.handle.take_message(heard.msg_type, heard.raw):
                heard.callback(taken[0])

    def restart(self) -> None:
        """Forget commands and deadlines of before; call it after the humanoid was reset."""
        self._velocity_command_time = None
        self._last_announced = None
        self._schedule.restart()

    # -- commands -----------------------------------------------------------------------------------------------------

    def _on_velocity(self, message: Twist) -> None:
        """Walk; or, where no walking is asked for, crouch or rise at linear.z (m/s)."""
        command = (message.linear.x, message.linear.y, message.angular.z)
        if not all(math.isfinite(value) for value in (*command, message.linear.z)):
            self.get_logger().error(f"cmd_vel ignored: it must be finite, got {command}")
            return
        self._velocity_command_time = self.humanoid.time
        self.humanoid.walk_velocity(*command)
        if not any(command):
            self.humanoid.move_body(message.linear.z)

    def _stop_on_stale_command(self) -> None:
        commanded = self._velocity_command_time
        if commanded is not None and self.humanoid.time - commanded > CMD_VEL_TIMEOUT:
            self._velocity_command_time = None
            self.humanoid.stop()
            self.humanoid.move_body(0.0)

    def _on_motor_power(self, message: Bool) -> None:
        self.humanoid.set_motor_power(message.data)

    def _on_balance_gains(self, message: BalanceGainsMessage) -> None:
        try:
            self.humanoid.balance_gains = BalanceGains(
                message.kp_pitch, message.kd_pitch, message.kp_roll, message.kd_roll, message.max_torque
            )
        except ValueError as error:
            self.get_logger().error(f"balance_gains ignored: {error}")

    # -- state --------------------------------------------------------------------------------------------------------

    def _publish_joint_states(self) -> None:
        if not self.joint_sensors_connected or not is_heard(self._joint_states):
            return
        joints = self.humanoid.joint_state()
        order = slice(None, None, -1 if self.joint_states_reversed else 1)
        message = JointState(
            name=list(joints.names)[order],
            position=np.asarray(joints.position)[order].tolist(),
            velocity=np.asarray(joints.velocity)[order].tolist(),
            effort=np.asarray(joints.effort)[order].tolist(),
        )
        message.header.stamp = self._now()
        if self._truth:  # before others can answer with it
            self._truth.joints_published(message.name, message.position)
        self._joint_states.publish(message)

    def _publish_imu(self) -> None:
        if not is_heard(self._imu):
            return
        sample = self.humanoid.imu()
        message = Imu()
        message.header.stamp = self._now()
        message.header.frame_id = "imu_link"
        set_fields(message.orientation, "xyzw", sample.orientation)
        set_fields(message.angular_velocity, "xyz", sample.angular_velocity)
        set_fields(message.linear_acceleration, "xyz", sample.linear_acceleration)
        self._imu.publish(message)

    def _publish_odom(self) -> None:
        if not is_heard(self._odom):
            return
        pose, velocity = self.humanoid.base_pose(), self.humanoid.base_velocity()
        message = Odometry()
        message.header.stamp = self._now()
        message.header.frame_id = "odom"
        message.child_frame_id = "base_link"
        set_fields(message.pose.pose.position, "xyz", pose.position)
        set_fields(message.pose.pose.orientation, "xyzw", pose.quaternion)
        set_fields(message.twist.twist.linear, "xyz", velocity.linear)
        set_fields(message.twist.twist.angular, "xyz", velocity.angular)
        self._odom.publish(message)

    def _publish_battery_state(self) -> None:
        if not self.battery_sensor_connected:
            return
        battery = self.humanoid.battery
        sample = BatterySample(battery.percentage, battery.voltage, battery.current)
        nan = math.nan
        message = BatteryState(
            voltage=sample.voltage,
            current=sample.current,
            percentage=sample.percentage,
            temperature=nan,
            charge=nan,
            capacity=nan,
            design_capacity=nan,
            power_supply_status=BatteryState.POWER_SUPPLY_STATUS_DISCHARGING,
            power_supply_health=BatteryState.POWER_SUPPLY_HEALTH_GOOD,
            power_supply_technology=BatteryState.POWER_SUPPLY_TECHNOLOGY_LION,
            present=True,
        )
        message.header.stamp = self._now()
        self._battery_state.publish(message)
        if self._truth:
            self._truth.battery_published(sample)

    def _publish_robot_state(self) -> None:
        mode, motors_enabled, steps = self._last_announced = self._announcement()
        if not self.robot_state_published:
            return
        message = RobotState(mode=mode, motors_enabled=motors_enabled, steps=steps)
        message.header.stamp = self._now()
        self._robot_state.publish(message)

    def _announcement(self) -> tuple[int, bool, int]:
        robot = self.humanoid
        return int(Mode(robot.mode)), bool(robot.motors_enabled), int(robot.steps)

    def _publish_clock(self) -> None:
        if not is_heard(self._clock_topic):
            return
        self._clock_topic.publish(Clock(clock=Time(nanoseconds=round(self.humanoid.time * 1e9)).to_msg()))

    def _report_peers(self) -> None:
        """Tell when connections change, so that a scenario need not guess how long discovery takes."""
        if self._truth is None:
            return
        said = (self._joint_states, self._imu, self._odom, self._battery_state, self._robot_state)
        peers = (
            {publisher.topic_name: publisher.get_subscription_count() for publisher in said},
            {heard.topic_name: self.count_publishers(heard.topic_name) for heard in self.heard},
        )
        if peers != self._peers:
            self._peers = peers
            self._truth.peers(*peers)

    def _now(self):  # builtin_interfaces Time, system clock
        return self.get_clock().now().to_msg()
