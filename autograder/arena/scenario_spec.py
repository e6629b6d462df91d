"""The specification of a scenario, which controller, host, agent and the student's side share."""

from __future__ import annotations

import base64
import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any, Literal


@dataclass(frozen=True)
class ScenarioSpec:
    """A scenario and the submission it is carried out on.

    Attributes:
        scenario_file, scenario: the module's path, and the function in it.
        params: the function's arguments, as JSON has them.
        scale: how much faster than real time the arena's clock runs after discovery.
        timed: whether deadlines are judged, so that lateness counts.
        namespace: ROS namespace of robot and student.
        robot_options: options of the simulator; None: there is no robot.
        student: a "node" is started before the scenario, a "program" by it.
        files: what the student wrote, by name; `program` is the name of the one that is run.
        parameters: ROS parameters of the program.
        student_paths: what the program may see of the machine beside the system.
        warm: an interpreter that waits may become the program.
        private_network: the arena has a network, and so all ROS domains, for itself.
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
    warm: bool
    private_network: bool
    measured: bool
    recorded: bool

    def to_json(self) -> bytes:
        """Return it as it goes through a socket."""
        files = {name: base64.b64encode(content).decode() for name, content in self.files.items()}
        return json.dumps(asdict(replace(self, files={})) | {"files": files}).encode()

    @classmethod
    def from_json(cls, content: bytes) -> ScenarioSpec:
        """Read what `to_json` returned."""
        fields = json.loads(content)
        files = {name: base64.b64decode(text) for name, text in fields.pop("files").items()}
        return cls(**fields, files=files)
