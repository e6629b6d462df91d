"""Calls a student's `ask_once` or `ask` with servers of different kinds, and prints a line of JSON for each call.

    bounded_calls.py ask_once answering:2.0 silent:0.5

calls `ask_once` first with a limit of 2 s and a server that responds, then with 0.5 s and one that does not.
"""

from __future__ import annotations

import json
import os
import sys
import threading
import time
from importlib import import_module
from typing import Any

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.client import Client
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.task import Future
from rclpy.utilities import remove_ros_args
from std_srvs.srv import Trigger

UNANSWERED_REQUESTS = {  # how many, from the first one on, by kind of server
    "answering": 0,
    "first_lost": 1,
    "silent": 1000,
}
WARM_UP_TIMEOUT = 20.0  # s to find a server
MAX_REQUESTS = 100


class Server(Node):
    """A server that responds to every request until `serve` makes it ignore some."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.requests = 0
        self._unanswered = 0
        self.create_service(Trigger, name, self._on_request, callback_group=ReentrantCallbackGroup())

    def serve(self, kind: str) -> None:
        """Start counting requests, and ignore the first ones as this kind of server does."""
        self.requests, self._unanswered = 0, UNANSWERED_REQUESTS[kind]

    async def _on_request(self, request: Any, response: Any) -> Any:
        self.requests += 1
        if self.requests <= self._unanswered:
            await Future()  # never completed, so no response is sent
        response.success = True
        response.message = "here"
        return response


def main() -> None:
    """Make the calls that the arguments describe."""
    sys.path.insert(0, os.getcwd())
    rclpy.init()
    function, *cases = remove_ros_args()[1:]
    servers = SingleThreadedExecutor()
    threading.Thread(target=servers.spin, daemon=True).start()
    node = Node("trial")
    for number, case in enumerate(cases):
        kind, seconds = case.split(":")
        print(json.dumps(_try(function, node, servers, f"trial_{number}", kind, float(seconds))), flush=True)
    servers.shutdown()
    rclpy.try_shutdown()


def _try(
    function: str, node: Node, servers: SingleThreadedExecutor, name: str, kind: str, seconds: float
) -> dict[str, Any]:
    client = node.create_client(Trigger, name)
    server = None
    if kind != "missing":
        server = Server(name)
        servers.add_node(server)
        _warm_up(node, client)
        server.serve(kind)
    saw: dict[str, Any] = {"returned": None, "raised": ""}
    started = time.monotonic()
    try:
        saw["returned"] = _described(_call(function, node, client, seconds))
    except Exception as problem:
        saw["raised"] = f"{type(problem).__name__}: {problem}"
    saw["seconds"] = time.monotonic() - started
    saw["requests"] = server.requests if server else 0
    saw["kept"] = sum(_is_kept(client, number) for number in range(MAX_REQUESTS))
    return saw


def _warm_up(node: Node, client: Client) -> None:
    """Send requests until a response arrives; after that, client and server have discovered each other."""
    until = time.monotonic() + WARM_UP_TIMEOUT
    while time.monotonic() < until:
        future = client.call_async(Trigger.Request())
        rclpy.spin_until_future_complete(node, future, timeout_sec=0.5)
        client.remove_pending_request(future)
        if future.done():
            return
    raise SystemExit("the server of this trial was not found: run the cell again")


def _call(function: str, node: Node, client: Client, seconds: float) -> Any:
    if function == "ask_once":
        return import_module("ask_once").ask_once(node, client, Trigger.Request(), seconds)
    return import_module("bounded").ask(node, client, Trigger.Request(), time.monotonic() + seconds)


def _described(returned: Any) -> str | None:
    """Describe what the student's function returned: "response", None, or the name of another type."""
    if returned is None or isinstance(returned, Trigger.Response):
        return returned and "response"
    return f"a {type(returned).__name__}"


def _is_kept(client: Client, number: int) -> bool:
    try:
        client.get_pending_request(number)
    except KeyError:
        return False
    return True


if __name__ == "__main__":
    main()
