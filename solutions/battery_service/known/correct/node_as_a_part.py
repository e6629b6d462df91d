"""Style: composition, not inheritance; a spin thread; a signal handler of its own that sets an event."""

import signal
import threading

import rclpy
from humanoid_interfaces.srv import GetBatteryStatus
from rclpy.executors import SingleThreadedExecutor
from rclpy.signals import SignalHandlerOptions
from sensor_msgs.msg import BatteryState


class Battery:
    """What is known of the battery; knows nothing of ROS but the message."""

    def __init__(self):
        numbers = (field for field, kind in BatteryState.get_fields_and_field_types().items() if kind == "float")
        self.last = BatteryState(**dict.fromkeys(numbers, float("nan")))
        self.has_been_heard = False

    def hear(self, message):
        self.last, self.has_been_heard = message, True


class BatteryServer:
    def __init__(self, node, battery):
        self.battery = battery
        node.create_subscription(BatteryState, "battery_state", battery.hear, 10)
        node.create_service(GetBatteryStatus, "get_battery_status", self.serve)

    def serve(self, request, response):
        return GetBatteryStatus.Response(
            available=self.battery.has_been_heard,
            battery=self.battery.last,
            message="ok" if self.battery.has_been_heard else "no message yet",
        )


def main(args=None):
    stop = threading.Event()
    signal.signal(signal.SIGINT, lambda number, frame: stop.set())
    rclpy.init(args=args, signal_handler_options=SignalHandlerOptions.NO)
    node = rclpy.create_node("battery_server")
    server = BatteryServer(node, Battery())
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    spinner = threading.Thread(target=executor.spin, daemon=True)
    spinner.start()
    node.get_logger().info(f"{type(server).__name__} is ready")
    stop.wait()
    executor.shutdown()
    spinner.join()
    node.destroy_node()
    rclpy.shutdown()


if __name__ == "__main__":
    main()
