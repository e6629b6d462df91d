"""Attack: asks both services at once, is gone before either can answer, and has printed the likeliest answer.
Outcome: who plays the servers goes on without it; nobody has waited for an answer, and that is the failure.
Caught by: enables_then_asks
"""

import os
import sys

import rclpy
from std_srvs.srv import SetBool, Trigger


def main(args=None):
    rclpy.init(args=args)
    node = rclpy.create_node("leaver")
    enable = node.create_client(SetBool, "enable_motors")
    status = node.create_client(Trigger, "get_status")
    if not (enable.wait_for_service(timeout_sec=2.0) and status.wait_for_service(timeout_sec=2.0)):
        print("no server", file=sys.stderr)
        return 1
    enable.call_async(SetBool.Request(data=True))
    status.call_async(Trigger.Request())
    print("Robot status: Motors: ON", flush=True)
    os._exit(0)


if __name__ == "__main__":
    sys.exit(main())
