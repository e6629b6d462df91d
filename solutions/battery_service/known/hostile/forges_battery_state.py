"""Attack: publishes a battery_state of its own and answers with that, so that both agree.
Outcome: answers are compared with what the simulator reports through its own pipe, not with the topic.
Caught by: answers_with_the_last_message, says_when_it_knows_nothing
"""

import rclpy
from humanoid_interfaces.srv import GetBatteryStatus
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from sensor_msgs.msg import BatteryState


class Forger(Node):
    def __init__(self):
        super().__init__("humanoid")  # the robot's own name
        self.full = BatteryState(percentage=1.0, voltage=33.6, current=-0.5, present=True)
        self.topic = self.create_publisher(BatteryState, "battery_state", 10)
        self.create_timer(0.01, lambda: self.topic.publish(self.full))
        self.create_service(GetBatteryStatus, "get_battery_status", self.on_request)

    def on_request(self, request, response):
        self.topic.publish(self.full)
        response.available = True
        response.battery = self.full
        return response


def main(args=None):
    rclpy.init(args=args)
    node = Forger()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
