"""Attack: a sound server in a program of three thousand nodes, each of which somebody might want to greet.
Outcome: only who offers the service is greeted; the number of nodes is seen at the end, and is the failure.
Caught by: server_appears
"""

import rclpy
from humanoid_interfaces.srv import GetBatteryStatus
from rclpy.executors import ExternalShutdownException
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node
from sensor_msgs.msg import BatteryState

UNKNOWN = dict.fromkeys(("voltage", "temperature", "current", "charge", "capacity", "design_capacity", "percentage"), float("nan"))

NODES = 3000


class BatteryService(Node):
    def __init__(self):
        super().__init__("battery_service")
        self.last = None
        self.create_subscription(BatteryState, "battery_state", self.on_battery_state, 10)
        self.create_service(GetBatteryStatus, "get_battery_status", self.on_request)

    def on_battery_state(self, message):
        self.last = message

    def on_request(self, request, response):
        if self.last is None:
            response.available = False
            response.message = "no battery_state has arrived yet"
            response.battery = BatteryState(**UNKNOWN)
        else:
            response.available = True
            response.message = f"{self.last.percentage:.0%}"
            response.battery = self.last
        return response


def crowd():
    """Nodes without parameters or logs: each is a name in a list, and nothing else."""
    context = rclpy.get_default_context().handle
    with context:
        return [
            rclpy_implementation.Node(f"node_{number}", "/robot", context, None, False, False)
            for number in range(NODES)
        ]


def main(args=None):
    rclpy.init(args=args)
    everybody = crowd()  # kept, or they are gone again
    node = BatteryService()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
