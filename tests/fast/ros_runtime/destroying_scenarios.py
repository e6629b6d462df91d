"""A node that destroys subscriptions while another thread spins it; prints how the spin ended."""

import sys
import threading
import time

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty

DURATION = 2.0  # s; without the repair the spin ends within half a second


def subscriptions_are_destroyed():
    """Make and destroy subscriptions; the threads change often, as on a busy machine."""
    sys.setswitchinterval(1e-5)
    node, executor, ends = Node("node"), SingleThreadedExecutor(), []
    executor.add_node(node)

    def spin():
        try:
            executor.spin()
        except Exception as error:
            ends.append(type(error).__name__)

    spinner = threading.Thread(target=spin)
    spinner.start()
    publisher = node.create_publisher(Empty, "topic", 10)
    begin = time.monotonic()
    while time.monotonic() - begin < DURATION and not ends:
        subscription = node.create_subscription(Empty, "topic", lambda _: None, 10)
        publisher.publish(Empty())
        node.destroy_subscription(subscription)
    executor.shutdown()
    spinner.join()
    return ends


if __name__ == "__main__":
    rclpy.init()
    print(*globals()[sys.argv[1]](), flush=True)
    rclpy.shutdown()
