"""Style: functions only; one deadline for everything, and each wait takes what is left of it."""

import sys
import time

import rclpy
from std_srvs.srv import SetBool, Trigger


def call(node, client, request, deadline):
    """Return the response, or None."""
    for _ in range(2):
        limit = min(time.monotonic() + 2.0, deadline)
        while not client.service_is_ready():
            if time.monotonic() > limit:
                return None
            rclpy.spin_once(node, timeout_sec=0.05)
        future = client.call_async(request)
        limit = min(time.monotonic() + 2.0, deadline)
        while rclpy.ok() and not future.done() and time.monotonic() < limit:
            rclpy.spin_once(node, timeout_sec=0.1)
        if future.done():
            return future.result()
        client.remove_pending_request(future)
    return None


def main(args=None):
    rclpy.init(args=args)
    node = rclpy.create_node("controller")
    deadline = time.monotonic() + 10.0
    enable = node.create_client(SetBool, "enable_motors")
    status = node.create_client(Trigger, "get_status")
    try:
        answer = call(node, enable, SetBool.Request(data=True), deadline)
        if answer is None:
            print("no answer from enable_motors", file=sys.stderr)
            return 1
        if not answer.success:
            print(f"enable_motors refused: {answer.message}", file=sys.stderr)
            return 1
        answer = call(node, status, Trigger.Request(), deadline)
        if answer is None:
            print("no answer from get_status", file=sys.stderr)
            return 1
        sys.stdout.write(f"Robot status: {answer.message}\n")
        return 0
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    raise SystemExit(main())
