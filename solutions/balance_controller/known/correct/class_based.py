"""Style: a class derived from Node; one callback decides, another applies."""

import math
import sys

import rclpy
from humanoid_interfaces.msg import BalanceGains
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor, SetParametersResult
from rclpy.exceptions import InvalidParameterTypeException, InvalidParameterValueException
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
TOPPLE = 51.0  # N·m/rad, with which gravity topples the trunk
# name: default, lowest, highest, description
GAINS = {
    "kp_pitch": (276.0, TOPPLE, 1000.0, "N·m/rad, torque for each radian of lean forwards or backwards"),
    "kd_pitch": (34.0, 0.0, 300.0, "N·m·s/rad, torque against the rate of that lean"),
    "kp_roll": (302.0, TOPPLE, 1000.0, "N·m/rad, torque for each radian of lean to a side"),
    "kd_roll": (38.0, 0.0, 300.0, "N·m·s/rad, torque against the rate of that lean"),
    "max_torque": (10000.0, 0.0, 10000.0, "N·m, limit on the torque about each axis"),
}


class BalanceController(Node):
    def __init__(self):
        super().__init__("balance_controller")
        self.publisher = self.create_publisher(BalanceGains, "balance_gains", LATCHED)
        # Before the declarations, so that values from the start go through it, too.
        self.add_on_set_parameters_callback(self.decide)
        for name, (default, lowest, highest, description) in GAINS.items():
            limits = FloatingPointRange(from_value=lowest, to_value=highest)
            descriptor = ParameterDescriptor(description=description, floating_point_range=[limits])
            self.declare_parameter(name, default, descriptor)
        # After them, because each declaration is a set.
        self.add_post_set_parameters_callback(self.apply)
        self.apply([])

    def decide(self, parameters):
        """Say yes or no, and change nothing: the set may still be refused."""
        for parameter in parameters:
            if parameter.name not in GAINS:
                continue
            if not math.isfinite(parameter.value):
                return self.refusal(parameter, "it has to be a finite number")
            if parameter.name.startswith("kp_") and parameter.value <= TOPPLE:
                return self.refusal(parameter, f"it has to be above {TOPPLE} N·m/rad, or the robot falls")
            if parameter.name == "max_torque" and parameter.value == 0.0:
                return self.refusal(parameter, "nothing would hold the robot upright")
        return SetParametersResult(successful=True)

    def refusal(self, parameter, reason):
        return SetParametersResult(successful=False, reason=f"{parameter.name} is {parameter.value}: {reason}")

    def apply(self, parameters):
        """Publish all gains: rclpy calls this when a set is accepted and stored."""
        gains = {name: self.get_parameter(name).value for name in GAINS}
        self.publisher.publish(BalanceGains(**gains))


def main(args=None):
    rclpy.init(args=args)
    try:
        node = BalanceController()
    except (InvalidParameterTypeException, InvalidParameterValueException) as error:
        print(f"balance_controller cannot start: {error}", file=sys.stderr)
        rclpy.try_shutdown()
        return 1
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()
    return 0


if __name__ == "__main__":
    sys.exit(main())
