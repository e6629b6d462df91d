"""Calls a student's `ask_once` or `ask` beside servers of its own, and prints a line of JSON for each call.

    bounded_calls.py ask_once answering:2.0 silent:0.5

calls it with 2 s at a server that answers, then with 0.5 s at one that does not.
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

NOT_ANSWERED = {"answering": 0, "first_lost": 1, "silent": 1000}  # of the first requests, by kind of server
WARM_UP = 20.0  # s to find a server
MOST_REQUESTS = 100


class Server(Node):
    """Offers a service of its own; answers only the warm-up until `serve` tells which requests to answer."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.requests = 0
        self._not_answered = 0
        self.create_service(Trigger, name, self._on_request, callback_group=ReentrantCallbackGroup())

    def serve(self, kind: str) -> None:
        """Begin to count, and leave the first requests without an answer."""
        self.requests, self._not_answered = 0, NOT_ANSWERED[kind]

    async def _on_request(self, request: Any, response: Any) -> Any:
        self.requests += 1
        if self.requests <= self._not_answered:
            await Future()  # which nobody completes
        response.success = True
        response.message = "here"
        return response


def main() -> None:
    """Make the calls that the arguments ask for."""
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
    saw["kept"] = sum(_is_kept(client, number) for number in range(MOST_REQUESTS))
    return saw


def _warm_up(node: Node, client: Client) -> None:
    """Ask until an answer comes: from then on no request is lost on its way."""
    until = time.monotonic() + WARM_UP
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
    """Return "response", None, or what else was returned."""
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
