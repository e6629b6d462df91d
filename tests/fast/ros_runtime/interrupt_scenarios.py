"""Ctrl-C between two steps of rclpy, to be run in a process of their own: `python interrupt_scenarios.py NAME`.

Each scenario sends the interrupt at a moment at which it rarely comes; status and stderr show how the program ends.
"""

import signal
import sys
import threading

import rclpy
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from std_msgs.msg import Empty


def between_the_look_at_the_context_and_the_wait_set():
    executor, look = executor_with_traffic(), Node.subscriptions.fget

    def shut_down_and_look(node):
        rclpy.get_default_context().try_shutdown()
        return look(node)

    Node.subscriptions = property(shut_down_and_look)
    spin_as_a_sound_node_does(executor)


def while_a_message_is_made():
    executor = executor_with_traffic()
    Empty.__init__ = lambda self, **fields: signal.raise_signal(signal.SIGINT)
    spin_as_a_sound_node_does(executor)


def while_a_callback_publishes():
    executor = executor_with_traffic()
    node = executor.get_nodes()[0]
    publisher = node.create_publisher(Empty, "more", 10)

    def shut_down_and_publish():
        rclpy.get_default_context().try_shutdown()
        publisher.publish(EMPTY)

    node.create_timer(0.05, shut_down_and_publish)
    spin_as_a_sound_node_does(executor)


def inside_try_shutdown():
    rclpy.init()
    context = rclpy.get_default_context()
    context._Context__context = ContextThatGoesDownWhenAsked(context._Context__context)
    rclpy.try_shutdown()


def while_a_daemon_thread_spins():
    executor = executor_with_traffic()
    threading.Thread(target=executor.spin, daemon=True).start()
    received.acquire()


class ContextThatGoesDownWhenAsked:
    """A context that is ok at the first check and shut down right after it."""

    def __init__(self, handle):
        self._handle = handle

    def __enter__(self):
        return self._handle.__enter__()

    def __exit__(self, *details):
        return self._handle.__exit__(*details)

    def ok(self):
        was_up = self._handle.ok()
        if was_up:
            self._handle.shutdown()
        return was_up

    def shutdown(self):
        self._handle.shutdown()


received = threading.Semaphore(0)


def executor_with_traffic():
    rclpy.init()
    node, executor = Node("node"), SingleThreadedExecutor()
    publisher = node.create_publisher(Empty, "traffic", 10)
    node.create_subscription(Empty, "traffic", lambda message: received.release(), 10)
    node.create_timer(0.001, lambda: publisher.publish(EMPTY))
    executor.add_node(node)
    return executor


def spin_as_a_sound_node_does(executor):
    try:
        executor.spin()
    except (KeyboardInterrupt, ExternalShutdownException):
        print("caught", flush=True)
    finally:
        rclpy.try_shutdown()


EMPTY = Empty()

if __name__ == "__main__":
    # SIGINT is ignored if the tests run in the background.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    globals()[sys.argv[1]]()
