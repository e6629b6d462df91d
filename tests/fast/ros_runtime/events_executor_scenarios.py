"""A correct node on an EventsExecutor, run in a process of its own: `python events_executor_scenarios.py SPIN`.

SPIN names a way to spin without a timeout. The timer sends SIGINT; a spin that runs no callback ends by SIGALRM.
"""

import signal
import sys

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.experimental import EventsExecutor
from rclpy.task import Future


def main(spin):
    rclpy.init()
    node, executor = rclpy.create_node("node"), EventsExecutor()
    executor.add_node(node)
    node.create_timer(0.05, lambda: signal.raise_signal(signal.SIGINT))
    signal.setitimer(signal.ITIMER_REAL, 2.0)
    try:
        WAYS[spin](executor, node)
    except (KeyboardInterrupt, ExternalShutdownException):
        print("caught")
    finally:
        executor.shutdown()
        node.destroy_node()
        rclpy.try_shutdown()


WAYS = {
    "executor.spin": lambda executor, node: executor.spin(),
    "rclpy.spin": lambda executor, node: rclpy.spin(node, executor),  # calls spin_once again and again
    "spin_until_future_complete": lambda executor, node: executor.spin_until_future_complete(Future()),
}

if __name__ == "__main__":
    main(sys.argv[1])
