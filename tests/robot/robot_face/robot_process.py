"""A robot in a process of its own, and a node that subscribes to its topics."""

import os
import signal
import subprocess
import sys
import threading
import time
from contextlib import contextmanager

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.signals import SignalHandlerOptions

from humanoid_interfaces.msg import RobotState
from ros_runtime.environment import ros_environment
from ros_runtime.ros_domain import ReservedDomain

NAMESPACE = "/topics_test/robot"
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
TIMEOUT = 30.0


class Listener:
    """A node that collects messages and waits for particular ones."""

    def __init__(self, context):
        self.node = rclpy.create_node("listener", namespace=NAMESPACE, context=context)
        self.executor = SingleThreadedExecutor(context=context)
        self.executor.add_node(self.node)
        self.arrived = threading.Condition()
        threading.Thread(target=self.executor.spin, daemon=True).start()

    def collect(self, message_type, topic, count, qos=10, until=lambda message: True):
        """Return `count` messages that satisfy `until`."""
        messages = []

        def keep(message):
            with self.arrived:
                if until(message):
                    messages.append(message)
                self.arrived.notify_all()

        subscription = self.node.create_subscription(message_type, topic, keep, qos)
        try:
            with self.arrived:
                enough = self.arrived.wait_for(lambda: len(messages) >= count, TIMEOUT)
            assert enough, f"{len(messages)} of {count} wanted messages on {topic} within {TIMEOUT:.0f} s"
            return messages[:count]
        finally:
            self.node.destroy_subscription(subscription)

    def publish(self, message, topic):
        """Publish once, as soon as the robot's subscription matches."""
        publisher = self.node.create_publisher(type(message), topic, 10)
        deadline = time.monotonic() + TIMEOUT
        while publisher.get_subscription_count() == 0:
            assert time.monotonic() < deadline, f"nobody listens to {topic}"
            time.sleep(0.01)
        publisher.publish(message)

    def call(self, service_type, name, request):
        """Call a service and return the response."""
        client = self.node.create_client(service_type, name)
        assert client.wait_for_service(TIMEOUT), f"{name} is not offered"
        answered = threading.Event()
        future = client.call_async(request)
        future.add_done_callback(lambda _: answered.set())
        assert answered.wait(TIMEOUT), f"{name} did not answer"
        return future.result()

    def one(self, message_type, topic, qos=10, until=lambda message: True):
        return self.collect(message_type, topic, 1, qos, until)[0]


@contextmanager
def running_robot(*options, pass_fds=()):
    with ReservedDomain() as domain:
        yield from _running_robot(domain, options, pass_fds)


def _running_robot(domain, options, pass_fds):
    environment = {**os.environ, **ros_environment(), "ROS_DOMAIN_ID": str(domain)}
    process = subprocess.Popen(
        [sys.executable, "-m", "robot_sim", "--namespace", NAMESPACE, *options],
        env=environment,
        stdout=subprocess.DEVNULL,
        pass_fds=pass_fds,
    )
    context = rclpy.Context()
    rclpy.init(context=context, domain_id=domain, signal_handler_options=SignalHandlerOptions.NO)
    listener = Listener(context)
    try:
        listener.one(
            RobotState, "robot_state", LATCHED, until=lambda state: state.mode == RobotState.STANDING
        )
        yield listener
    finally:
        listener.executor.shutdown()
        rclpy.shutdown(context=context)
        process.send_signal(signal.SIGINT)
        assert process.wait(TIMEOUT) == 0, "SIGINT ends the robot cleanly"
