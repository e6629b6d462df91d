"""An action client that is spun by another thread, to be run in a process of its own: `python goal_scenarios.py NAME`.

Each scenario returns which requests were answered, which is printed as JSON.
"""

import json
import os
import sys
import threading
import time

import rclpy
from rclpy.action import ActionClient, ActionServer, CancelResponse
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node

from humanoid_interfaces.action import WalkTo

PATIENCE = 3.0  # s for an answer
PREEMPTED = 0.3  # s without a processor, after a request has left


class Preempted:
    """Sends a client's requests in a thread that loses the processor right after it has sent a request."""

    def __init__(self, handle):
        self._handle = handle

    def __getattr__(self, name):
        method = getattr(self._handle, name)
        if not name.startswith("send_"):
            return method

        def send(*arguments):
            number = method(*arguments)
            time.sleep(PREEMPTED)
            return number

        return send


def a_goal_is_sent_cancelled_and_asked_for_its_result():
    serve(ActionServer(Node("server"), WalkTo, "walk_to", until_canceled, cancel_callback=accept))
    node = Node("client")
    client = ActionClient(node, WalkTo, "walk_to")
    spin(SingleThreadedExecutor(), node)
    assert client.wait_for_server(10.0)
    client._client_handle = Preempted(client._client_handle)
    answered = {}

    def wait(name, future):
        done = threading.Event()
        future.add_done_callback(lambda _: done.set())
        answered[name] = done.wait(PATIENCE)
        return future.result() if answered[name] else None

    if goal := wait("goal", client.send_goal_async(WalkTo.Goal())):
        wait("cancel", goal.cancel_goal_async())
        wait("result", goal.get_result_async())
    return answered


def accept(goal_handle):
    return CancelResponse.ACCEPT


def until_canceled(goal_handle):
    while not goal_handle.is_cancel_requested:
        time.sleep(0.01)
    goal_handle.canceled()
    return WalkTo.Result()


def serve(server):
    spin(MultiThreadedExecutor(3), server._node)


def spin(executor, node):
    executor.add_node(node)
    threading.Thread(target=executor.spin, daemon=True).start()


if __name__ == "__main__":
    rclpy.init()
    print(json.dumps(globals()[sys.argv[1]]()), flush=True)
    os._exit(0)  # with a goal that nobody cancels
