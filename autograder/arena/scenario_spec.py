"""The specification of a scenario, and how the controller sends it to an arena, with the pipe for its events."""

from __future__ import annotations

import base64
import json
import socket
import struct
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any, Literal

DONE = b"\n"  # the answer to an order, when nothing of its scenario is left
_LENGTH = struct.Struct("=Q")
_CHUNK = 2**20


@dataclass(frozen=True)
class ScenarioSpec:
    """A scenario and the submission it is carried out on.

    Attributes:
        scenario_file, scenario: the module's path, and the function in it.
        params: the function's arguments, as JSON has them.
        scale: how much faster than real time the arena's clock runs after discovery.
        timed: whether deadlines are judged, so that a run with too much delay is repeated.
        namespace: ROS namespace of robot and student.
        robot_options: options of the simulator; None: there is no robot.
        student: a "node" is started before the scenario, a "program" by it.
        files: what the student wrote, by name; `program` is the name of the one that is run.
        parameters: ROS parameters of the program.
        student_paths: folders of the host that the program may read, besides the system's.
        private_network: the arena has its own network, so every ROS domain is free.
        measured: record what each phase costs.
        recorded: have the simulator report whole postures, for a film.
    """

    scenario_file: str
    scenario: str
    params: Mapping[str, Any]
    scale: float
    timed: bool
    namespace: str
    robot_options: Sequence[str] | None
    student: Literal["node", "program"]
    program: str
    files: Mapping[str, bytes]
    parameters: Mapping[str, Any]
    student_paths: Sequence[str]
    private_network: bool
    measured: bool
    recorded: bool

    def to_json(self) -> bytes:
        """Return the JSON text (UTF-8) that the controller sends to the host; files are base64."""
        files = {name: base64.b64encode(content).decode() for name, content in self.files.items()}
        return json.dumps(asdict(replace(self, files={})) | {"files": files}).encode()

    @classmethod
    def from_json(cls, content: bytes) -> ScenarioSpec:
        """Read what `to_json` returned."""
        fields = json.loads(content)
        files = {name: base64.b64decode(text) for name, text in fields.pop("files").items()}
        return cls(**fields, files=files)


def send_order(orders: socket.socket, spec: ScenarioSpec, events_fd: int) -> None:
    """Send a scenario's specification and the descriptor of its events."""
    content = spec.to_json()
    socket.send_fds(orders, [_LENGTH.pack(len(content))], [events_fd])
    orders.sendall(content)


def receive_order(orders: socket.socket) -> tuple[ScenarioSpec, int] | None:
    """Wait for an order and return it; None when the controller has closed the socket."""
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
