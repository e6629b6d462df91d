"""The robot's ROS interface: the node `humanoid`, with all names relative to its namespace."""

from __future__ import annotations

import math
from collections.abc import Sequence

from builtin_interfaces.msg import Time
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import BatteryState, Imu, JointState
from std_msgs.msg import Bool

from humanoid_interfaces.msg import BalanceGains as BalanceGainsMessage
from humanoid_interfaces.msg import RobotState
from robot_sim.humanoid import Humanoid, Mode
from robot_sim.ros.arm_ik_service import ArmIkService
from robot_sim.ros.foot_topics import FootTopics
from robot_sim.ros.ground_truth import GroundTruthWriter
from robot_sim.ros.inbox import Inbox
from robot_sim.ros.joint_limits import publish_joint_limits
from robot_sim.ros.manipulation_topics import ManipulationTopics
from robot_sim.ros.messages import floats, has_subscribers, set_fields
from robot_sim.ros.periodic_jobs import PeriodicJobs
from robot_sim.ros.trajectory_size import MOST_BYTES, why_too_large
from robot_sim.walking.balance_gains import BalanceGains
from ros_runtime.record.ground_truth import BatteryPublished, ImuPublished, JointsPublished, RobotPeers

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
    """The node that publishes the humanoid's state and passes commands on to it.

    The node neither spins nor steps: `robot_sim.ros.run` calls `publish_due` after each step and `process_commands` in
    between, so one thread owns the simulation.

    Attributes:
        inboxes: of the topics that it subscribes to.
    """

    def __init__(
        self, humanoid: Humanoid, namespace: str = "/robot", ground_truth: GroundTruthWriter | None = None
    ) -> None:
        super().__init__("humanoid", namespace=namespace)
        self.humanoid = humanoid
        self.battery_sensor_connected = True
        self.clock_offset = 0  # ns, added to the system clock in the stamps of all messages
        self.charge_measured = True  # if False, battery_state has percentage NaN
        self.joint_sensors_connected = True
        self.imu_connected = True
        self.joint_states_reversed = False
        self.joint_states_alternate = False  # the joint order is reversed in every second message
        self.joint_readings: dict[str, float] = {}  # false positions to publish, by joint: rad (fingers: m)
        self.robot_state_published = True
        self._ground_truth = ground_truth
        self._velocity_command_time: float | None = None
        self._is_taken_over = False
        self._last_announced: tuple[int, bool, int] | None = None

        self._joint_states = self.create_publisher(JointState, "joint_states", qos_profile_sensor_data)
        self._imu = self.create_publisher(Imu, "imu", qos_profile_sensor_data)
        self._odom = self.create_publisher(Odometry, "odom", 10)
        self._battery_state = self.create_publisher(BatteryState, "battery_state", LATCHED)
        self._robot_state = self.create_publisher(RobotState, "robot_state", LATCHED)
        self._clock_topic = self.create_publisher(Clock, "/clock", 10)
        manipulation = ManipulationTopics(self, humanoid)
        feet = FootTopics(self, humanoid)
        ArmIkService(self, humanoid)
        self._joint_limits = publish_joint_limits(self, humanoid, LATCHED)
        report = ground_truth.write if ground_truth else None
        subscriptions = (
            self.create_subscription(Twist, "cmd_vel", self._on_velocity, 10),
            self.create_subscription(Bool, "motor_power", self._on_motor_power, 10),
            self.create_subscription(BalanceGainsMessage, "balance_gains", self._on_balance_gains, 10),
            # This one also receives earlier messages, but matches only transient local publishers.
            self.create_subscription(BalanceGainsMessage, "balance_gains", self._on_balance_gains, LATCHED),
            *manipulation.grippers,
        )
        self.inboxes = [Inbox(subscription, report) for subscription in subscriptions]
        self.inboxes.append(
            Inbox(manipulation.trajectory, report, most_bytes=MOST_BYTES, why_not=why_too_large)
        )
        self._command_topics = [inbox.topic for inbox in self.inboxes]
        self._peers: tuple[dict[str, int], dict[str, int]] = ({}, {})
        self._make_messages()

        self._periodic_jobs = PeriodicJobs(
            (PEERS_RATE, self._report_peers),
            (JOINT_STATE_RATE, self._publish_joint_states),
            (IMU_RATE, self._publish_imu),
            (ODOM_RATE, self._publish_odom),
            (BATTERY_RATE, self._publish_battery_state),
            (ROBOT_STATE_RATE, self._publish_robot_state),
            (CLOCK_RATE, self._publish_clock),
            *manipulation.jobs,
            *feet.jobs,
        )

    def _make_messages(self) -> None:
        """Make the messages that are reused for each publication: making a message costs more than publishing it.

        They share one stamp.
        """
        self._stamp = Time()
        self._joint_message = JointState()
        self._imu_message = Imu()
        self._imu_message.header.frame_id = "imu_link"
        self._odom_message = Odometry(child_frame_id="base_link")
        self._odom_message.header.frame_id = "odom"
        design_charge = self.humanoid.battery.parameters.design_charge
        cells = self.humanoid.battery.parameters.cells
        self._battery_message = BatteryState(
            temperature=math.nan,
            capacity=design_charge,
            design_capacity=design_charge,
            cell_temperature=[math.nan] * cells,
            location="torso",
            power_supply_status=BatteryState.POWER_SUPPLY_STATUS_DISCHARGING,
            power_supply_health=BatteryState.POWER_SUPPLY_HEALTH_GOOD,
            power_supply_technology=BatteryState.POWER_SUPPLY_TECHNOLOGY_LION,
            present=True,
        )
        self._state_message = RobotState()
        self._clock_message = Clock()
        for message in (
            *(self._joint_message, self._imu_message, self._odom_message),
            *(self._battery_message, self._state_message),
        ):
            message.header.stamp = self._stamp
        self._battery_message.header.frame_id = "base_link"

    @property
    def next_due(self) -> float:
        """Simulated time (s) at which the next message is due."""
        return self._periodic_jobs.next_due

    def publish_due(self) -> None:
        """Publish the messages that are due at the simulated time, and the robot's state as soon as it changes."""
        self._stop_on_stale_command()
        if self._announcement() != self._last_announced:
            self._publish_robot_state()
        self._periodic_jobs.run(self.humanoid.time)

    def process_commands(self) -> None:
        """Process the commands that have arrived, without an executor, whose wait set would take 0.3 ms each time."""
        for inbox in self.inboxes:
            inbox.process_arrived(self.humanoid.time)

    def report_refused(self) -> None:
        """Report the messages refused since the last report; call it at the end."""
        for inbox in self.inboxes:
            inbox.report()

    def restart(self) -> None:
        """Drop earlier commands and deadlines; call it after a reset of the humanoid."""
        self._velocity_command_time = None
        self._is_taken_over = False
        self._last_announced = None
        self._periodic_jobs.restart()

    def take_over(self, velocity: Sequence[float] | None) -> None:
        """Walk with a velocity (m/s, m/s, rad/s in base_link) and ignore cmd_vel, until called with None.

        This acts like an operator's joystick, which has priority over programs. With zeros the robot stands.
        """
        self._is_taken_over = velocity is not None
        self._velocity_command_time = None
        if velocity is None:
            self.humanoid.stop()
        else:
            self.humanoid.walk_velocity(*velocity)

    # -- commands -----------------------------------------------------------------------------------------------------

    def _on_velocity(self, message: Twist) -> None:
        """Walk; if no walking is commanded, crouch or rise at linear.z (m/s)."""
        command = (message.linear.x, message.linear.y, message.angular.z)
        if not all(math.isfinite(value) for value in (*command, message.linear.z)):
            self.get_logger().error(f"cmd_vel ignored: it must be finite, got {command}")
            return
        if self._is_taken_over:
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
        if self._ground_truth:
            self._ground_truth.motor_power(message.data)
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
        if not self.joint_sensors_connected or not has_subscribers(self._joint_states):
            return
        joints = self.humanoid.joint_state()
        if self.joint_states_alternate:
            self.joint_states_reversed = not self.joint_states_reversed
        order = slice(None, None, -1 if self.joint_states_reversed else 1)
        message = self._joint_message
        message.name = list(joints.names)[order]
        message.position = floats(joints.position[order])
        for name, reading in self.joint_readings.items():
            message.position[message.name.index(name)] = reading
        message.velocity = floats(joints.velocity[order])
        message.effort = floats(joints.effort[order])
        self._read_clock()
        if self._ground_truth:  # before others can answer with it
            self._ground_truth.write(
                JointsPublished(names=list(message.name), positions=list(message.position))
            )
        self._joint_states.publish(message)

    def _publish_imu(self) -> None:
        if not self.imu_connected or not has_subscribers(self._imu):
            return
        sample, message = self.humanoid.imu(), self._imu_message
        self._read_clock()
        if self._ground_truth:  # before others can answer with it
            rates, bias = sample.angular_velocity.tolist(), list(self.humanoid.gyro_bias)
            self._ground_truth.write(ImuPublished(angular_velocity=rates, gyro_bias=bias))
        set_fields(message.orientation, "xyzw", sample.orientation.tolist())
        set_fields(message.angular_velocity, "xyz", sample.angular_velocity.tolist())
        set_fields(message.linear_acceleration, "xyz", sample.linear_acceleration.tolist())
        self._imu.publish(message)

    def _publish_odom(self) -> None:
        if not has_subscribers(self._odom):
            return
        pose, velocity = self.humanoid.base_pose(), self.humanoid.base_velocity()
        message = self._odom_message
        self._read_clock()
        set_fields(message.pose.pose.position, "xyz", pose.position.tolist())
        set_fields(message.pose.pose.orientation, "xyzw", pose.quaternion.tolist())
        set_fields(message.twist.twist.linear, "xyz", velocity.linear.tolist())
        set_fields(message.twist.twist.angular, "xyz", velocity.angular.tolist())
        self._odom.publish(message)

    def _publish_battery_state(self) -> None:
        if not self.battery_sensor_connected:
            return
        battery = self.humanoid.battery
        message = self._battery_message
        message.serial_number = f"8S-{battery.pack:04}"
        message.voltage, message.current = battery.voltage, battery.current
        message.percentage = battery.percentage if self.charge_measured else math.nan
        message.charge = message.percentage * message.capacity
        cells = battery.parameters.cells
        message.cell_voltage = [battery.voltage / cells] * cells
        self._read_clock()
        self._battery_state.publish(message)
        if self._ground_truth:
            self._ground_truth.write(BatteryPublished(message=message))

    def _publish_robot_state(self) -> None:
        mode, motors_enabled, steps = self._last_announced = self._announcement()
        if not self.robot_state_published:
            return
        message = self._state_message
        message.mode, message.motors_enabled, message.steps = mode, motors_enabled, steps
        self._read_clock()
        self._robot_state.publish(message)

    def _announcement(self) -> tuple[int, bool, int]:
        robot = self.humanoid
        return int(Mode(robot.mode)), bool(robot.motors_enabled), int(robot.steps)

    def _publish_clock(self) -> None:
        if not has_subscribers(self._clock_topic):
            return
        clock = self._clock_message.clock
        clock.sec, clock.nanosec = divmod(round(self.humanoid.time * 1e9), 10**9)
        self._clock_topic.publish(self._clock_message)

    def _report_peers(self) -> None:
        """Write changes of connections to the ground truth, so that a scenario can wait for discovery."""
        if self._ground_truth is None:
            return
        topics = (
            *(self._joint_states, self._imu, self._odom),
            *(self._battery_state, self._robot_state, self._joint_limits),
        )
        subscribers = {topic.topic_name: topic.get_subscription_count() for topic in topics}
        # Node.count_publishers would expand and validate each name every time.
        publishers = {topic: self.handle.get_count_publishers(topic) for topic in self._command_topics}
        if (subscribers, publishers) != self._peers:
            self._peers = subscribers, publishers
            self._ground_truth.write(RobotPeers(subscribers=subscribers, publishers=publishers))

    def _read_clock(self) -> None:
        """Set the stamp that all messages share to the system clock plus `clock_offset`."""
        now = self.get_clock().now().nanoseconds + self.clock_offset
        self._stamp.sec, self._stamp.nanosec = divmod(now, 10**9)
