"""Attack: sends trajectories of 40,000 points to the robot without end, so that its time stands still and its first battery_state
stays its last.
Outcome: the robot looks at the length of a message before it unpacks it, and goes on; one that is too large is the failure.
Caught by: server_appears
"""

import rclpy
from humanoid_interfaces.srv import GetBatteryStatus
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.serialization import serialize_message
from sensor_msgs.msg import BatteryState
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

POINTS = 40_000

UNKNOWN = dict.fromkeys(("voltage", "temperature", "current", "charge", "capacity", "design_capacity", "percentage"), float("nan"))


class BatteryService(Node):
    def __init__(self):
        super().__init__("battery_service")
        self.last = None
        self.create_subscription(BatteryState, "battery_state", self.on_battery_state, 10)
        self.flood = self.create_publisher(JointTrajectory, "joint_trajectory", 10)
        message = JointTrajectory(joint_names=["none"], points=[JointTrajectoryPoint()] * POINTS)
        self.bytes = serialize_message(message)
        self.create_timer(0.05, lambda: self.flood.publish(self.bytes))
        self.create_service(GetBatteryStatus, "get_battery_status", self.on_request)

    def on_battery_state(self, message):
        if self.last is None:
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


def main(args=None):
    rclpy.init(args=args)
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
