"""Style: an executor on a thread of its own, so that the main thread may block in client.call(timeout_sec=2)."""

import sys
import threading
import time
from contextlib import suppress

import rclpy
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from std_srvs.srv import SetBool, Trigger


def left_until(end):
    return max(0.0, min(2.0, end - time.monotonic()))


def ask(client, request, end):
    if not client.wait_for_service(timeout_sec=left_until(end)):
        return None
    for _ in range(2):
        answer = client.call(request, timeout_sec=left_until(end))  # None when the time is over
        if answer is not None:
            return answer
    return None


def spin(executor):
    with suppress(ExternalShutdownException):
        executor.spin()


def main(args=None):
    end = time.monotonic() + 9.5  # leaves half a second for shutting down
    rclpy.init(args=args)
    node = rclpy.create_node("robot_controller")
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    spinning = threading.Thread(target=spin, args=(executor,))
    spinning.start()
    try:
        on = ask(node.create_client(SetBool, "enable_motors"), SetBool.Request(data=True), end)
        if on is None or not on.success:
            node.get_logger().error("the motors cannot be switched on")
            return 1
        status = ask(node.create_client(Trigger, "get_status"), Trigger.Request(), end)
        if status is None:
            node.get_logger().error("the robot does not tell its status")
            return 1
        print("Robot status:", status.message, flush=True)
        return 0
    finally:
        executor.shutdown()
        spinning.join()
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    sys.exit(main())
