"""Style: functions and closures, no class; all parameters declared at once, and no range begins below what is allowed."""

import math
import sys

import rclpy
from humanoid_interfaces.msg import BalanceGains
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor, SetParametersResult
from rclpy.exceptions import ParameterException
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSDurabilityPolicy, QoSProfile, QoSReliabilityPolicy

KP_ABOVE = 51.0
NAMES = ["kp_pitch", "kd_pitch", "kp_roll", "kd_roll", "max_torque"]


def described(text, lowest, highest):
    return ParameterDescriptor(
        description=text, floating_point_range=[FloatingPointRange(from_value=lowest, to_value=highest)]
    )


def objection_to(name, value):
    """Return why a gain is no good, or None; all comparisons ask for what is good, so that NaN is not."""
    if name not in NAMES:
        return None
    if name in ("kp_pitch", "kp_roll") and not value > KP_ABOVE:
        return f"{name} must be above {KP_ABOVE}, and is {value}"
    if not 0.0 <= value < math.inf or (name == "max_torque" and value == 0.0):
        return f"{name} must be a positive finite number, and is {value}"
    return None


def accept_or_refuse(parameters):
    objections = [objection_to(parameter.name, parameter.value) for parameter in parameters]
    reasons = [objection for objection in objections if objection]
    return SetParametersResult(successful=not reasons, reason="; ".join(reasons))


def make_node():
    node = Node("balance_controller")
    qos = QoSProfile(
        depth=1, reliability=QoSReliabilityPolicy.RELIABLE, durability=QoSDurabilityPolicy.TRANSIENT_LOCAL
    )
    publisher = node.create_publisher(BalanceGains, "balance_gains", qos)
    node.add_on_set_parameters_callback(accept_or_refuse)
    node.declare_parameters(
        "",
        [
            ("kp_pitch", 276.0, described("stiffness about the pitch axis, N·m/rad", KP_ABOVE, 1000.0)),
            ("kd_pitch", 34.0, described("damping about the pitch axis, N·m·s/rad", 0.0, 300.0)),
            ("kp_roll", 302.0, described("stiffness about the roll axis, N·m/rad", KP_ABOVE, 1000.0)),
            ("kd_roll", 38.0, described("damping about the roll axis, N·m·s/rad", 0.0, 300.0)),
            ("max_torque", 10000.0, described("most torque about each axis, N·m", 0.0, 10000.0)),
        ],
    )

    def publish(_parameters=()):
        values = [parameter.value for parameter in node.get_parameters(NAMES)]
        message = BalanceGains()
        for name, value in zip(NAMES, values):
            setattr(message, name, value)
        publisher.publish(message)

    node.add_post_set_parameters_callback(publish)
    publish()
    return node


def main(args=None):
    rclpy.init(args=args)
    executor = SingleThreadedExecutor()
    try:
        executor.add_node(make_node())
        executor.spin()
    except ParameterException as problem:
        sys.exit(f"refused to start: {problem}")
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
