"""The controller's orders to an arena: a scenario's specification, and the pipe for its events."""

from __future__ import annotations

import socket
import struct

from autograder.arena.scenario_spec import ScenarioSpec

DONE = b"\n"  # the answer to an order, when nothing of its scenario is left
_LENGTH = struct.Struct("=Q")
_CHUNK = 2**20


def send_order(orders: socket.socket, spec: ScenarioSpec, events_fd: int) -> None:
    """Send a scenario's specification and the descriptor of its events."""
    content = spec.to_json()
    socket.send_fds(orders, [_LENGTH.pack(len(content))], [events_fd])
    orders.sendall(content)


def receive_order(orders: socket.socket) -> tuple[ScenarioSpec, int] | None:
    """Wait for an order; None when there will be no more."""
    length, descriptors, _, _ = socket.recv_fds(orders, _LENGTH.size, 1)
    if len(length) < _LENGTH.size:
        return None
    left = _LENGTH.unpack(length)[0]
    content = bytearray()
    while left:
        chunk = orders.recv(min(left, _CHUNK))
        if not chunk:
            return None
        content += chunk
        left -= len(chunk)
    return ScenarioSpec.from_json(bytes(content)), descriptors[0]
