"""Style: a frozen dataclass that refuses to exist with bad gains; the node tries the new ones on a copy; threads."""

import math
from dataclasses import asdict, dataclass, fields, replace

import rclpy
from humanoid_interfaces.msg import BalanceGains
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor, SetParametersResult
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile

WEAKEST = 51.0  # N·m/rad; gravity is as strong


@dataclass(frozen=True)
class Gains:
    kp_pitch: float = 276.0
    kd_pitch: float = 34.0
    kp_roll: float = 302.0
    kd_roll: float = 38.0
    max_torque: float = 10_000.0

    def __post_init__(self):
        for name, value in asdict(self).items():
            if not isinstance(value, float):
                raise ValueError(f"{name} has to be a double, got {value!r}")
            if math.isnan(value) or math.isinf(value) or value < 0.0:
                raise ValueError(f"{name} has to be finite and not negative, got {value}")
        if min(self.kp_pitch, self.kp_roll) <= WEAKEST:
            raise ValueError(f"kp_pitch and kp_roll have to be above {WEAKEST}")
        if self.max_torque == 0.0:
            raise ValueError("max_torque has to be above 0")


KNOWN = {field.name for field in fields(Gains)}


class Controller:
    """Has a node instead of being one."""

    def __init__(self):
        self.node = Node("balance_controller")
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.gains = Gains()
        self.publisher = self.node.create_publisher(
            BalanceGains, "balance_gains", latched, callback_group=ReentrantCallbackGroup()
        )
        self.node.add_on_set_parameters_callback(self.check)
        for name, default in asdict(self.gains).items():
            lowest, highest = (WEAKEST, 1000.0) if name.startswith("kp") else (0.0, 10_000.0)
            self.node.declare_parameter(
                name,
                default,
                ParameterDescriptor(
                    description=f"gain {name.replace('_', ' of ')} of the trunk's balance, in N, m, s and rad",
                    floating_point_range=[FloatingPointRange(from_value=lowest, to_value=highest)],
                ),
            )
        self.gains = Gains(**{name: self.node.get_parameter(name).value for name in KNOWN})
        self.node.add_post_set_parameters_callback(self.take)
        self.publish()

    def check(self, parameters):
        try:
            replace(self.gains, **self.ours(parameters))
        except ValueError as problem:
            return SetParametersResult(successful=False, reason=str(problem))
        return SetParametersResult(successful=True)

    def take(self, parameters):
        if changes := self.ours(parameters):
            self.gains = replace(self.gains, **changes)
            self.publish()

    def publish(self):
        self.publisher.publish(BalanceGains(**asdict(self.gains)))

    @staticmethod
    def ours(parameters):
        return {parameter.name: parameter.value for parameter in parameters if parameter.name in KNOWN}


def main(args=None):
    rclpy.init(args=args)
    try:
        controller = Controller()
    except Exception as problem:
        rclpy.logging.get_logger("balance_controller").fatal(f"bad parameters: {problem}")
        rclpy.try_shutdown()
        raise SystemExit(1) from None
    executor = MultiThreadedExecutor(num_threads=2)
    executor.add_node(controller.node)
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        executor.shutdown()
        controller.node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
